# SPDX-License-Identifier: MIT
"""Numbers of a program that runs for all inputs at once: a term of bits, and the interval that it is in.

Intervals decide most comparisons and overflows without a solver. A product is one number, however wide it is computed: it
has as many bits as its interval needs. Unless EXACT, nothing is known about a product or a quotient but its interval: that is
enough for most proofs, and spares the solver the circuits of multipliers.
"""
import math

import z3


class Facts:
    """What holds of all terms made so far, and whether products are exact."""

    def __init__(self, exact):
        self.exact = exact
        self.known, self.kept, self.products, self.inputs = [], [], {}, []

    def keep(self, term):
        """Its number stays its own: z3 gives numbers of dead terms again."""
        self.kept.append(term)
        return term.get_id()

    def fresh(self, name, low, high, width=None):
        """A new number in an interval."""
        width = width or bits_for(low, high)
        value = Value(width, z3.BitVec("%s!%d" % (name, len(self.kept)), width), low, high)
        value.key = ("s", self.keep(value.term))
        floor, ceiling = -(1 << (width - 1)), (1 << (width - 1)) - 1
        if value.low > floor:
            self.known.append(value.term >= value.low)
        if value.high < ceiling:
            self.known.append(value.term <= value.high)
        return value


def bits_for(low, high):
    """The width of two's complement that holds an interval."""
    return max(low.bit_length() if low >= 0 else (low + 1).bit_length(),
               high.bit_length() if high >= 0 else (high + 1).bit_length()) + 1


class Value:
    """A number of `width` bits in [low, high], as a signed one; a truth, of one bit, is 0 or 1 and has a term of z3's Bool.

    Places of an array are low and what is a multiple of `apart` from it; 0 if there is one.
    """
    __slots__ = "width", "term", "low", "high", "key", "apart"

    def __init__(self, width, term, low, high, key=None):
        floor, ceiling = (0, 1) if width == 1 else (-(1 << (width - 1)), (1 << (width - 1)) - 1)
        if low < floor or high > ceiling:
            low, high, key = floor, ceiling, None
        self.width, self.term, self.low, self.high, self.key = width, term, low, high, key
        self.apart = 0 if low == high else 1

    @property
    def constant(self):
        return self.low == self.high

    def bits(self):
        """The term, or that of a constant."""
        if self.width == 1:
            return z3.BoolVal(bool(self.low)) if self.constant else self.term
        return z3.BitVecVal(self.low, self.width) if self.constant else self.term


def number(width, value):
    """A constant."""
    if width == 1:
        return Value(1, None, value & 1, value & 1)
    value &= (1 << width) - 1
    value -= (value >> (width - 1)) << width
    return Value(width, None, value, value)


def truth(term):
    """A truth from Python's or z3's."""
    if isinstance(term, bool):
        return number(1, int(term))
    return Value(1, term, 0, 1)


def fits(width, low, high):
    return low >= -(1 << (width - 1)) and high < 1 << (width - 1)


def resize(term, width):
    size = term.size()
    return z3.SignExt(width - size, term) if width > size else term if width == size else z3.Extract(width - 1, 0, term)


def corners(x, y, made):
    found = [made(a, b) for a in (x.low, x.high) for b in (y.low, y.high)]
    return min(found), max(found)


def product(facts, x, y):
    """(term, low, high) of the exact product."""
    low, high = corners(x, y, lambda a, b: a * b)
    if x.key is not None and x.key == y.key and low < 0:
        low = 0
    if low == high:
        return z3.BitVecVal(low, bits_for(low, high)), low, high
    if facts.exact or x.constant or y.constant:
        width = bits_for(low, high)
        return resize(x.bits(), width) * resize(y.bits(), width), low, high
    keys = tuple(sorted(v.key or ("s", facts.keep(v.bits())) for v in (x, y)))
    known = facts.products.get(keys)
    if known is None or known.width < bits_for(low, high):
        known = facts.products[keys] = facts.fresh("product", low, high)
    return known.term, low, high


def multiply(facts, x, y):
    """(x y modulo 2^width, whether that is another number)."""
    term, low, high = product(facts, x, y)
    if fits(x.width, low, high):
        made = resize(term, x.width)
        return Value(x.width, made, low, high, ("s", facts.keep(term))), number(1, 0)
    low_part = resize(term, x.width)
    over = resize(low_part, term.size()) != term if term.size() > x.width else z3.BoolVal(False)
    return Value(x.width, low_part, low, high), truth(over)


def plus(x, y, sign):
    """(x + y or x - y, whether that overflows)."""
    low, high = (x.low + y.low, x.high + y.high) if sign > 0 else (x.low - y.high, x.high - y.low)
    a, b = x.bits(), y.bits()
    made = Value(x.width, a + b if sign > 0 else a - b, low, high)
    if fits(x.width, low, high):
        return made, number(1, 0)
    a, b = z3.SignExt(1, a), z3.SignExt(1, b)
    return made, truth(z3.SignExt(1, made.term) != (a + b if sign > 0 else a - b))


def place(x, y, apart):
    """x + y, where y is one of those that are `apart`; what may wrap is anywhere."""
    made = plus(x, y, 1)[0]
    if fits(x.width - 1, x.low, x.high) and fits(y.width - 1, y.low, y.high) and not made.constant:
        made.apart = math.gcd(x.apart, 0 if y.constant else apart)
    return made


def shift_left(x, s):
    low, high = -(1 << x.width), 1 << x.width
    if 0 <= s.low and s.high < x.width:
        low, high = corners(x, s, lambda a, b: a << b)
    return Value(x.width, x.bits() << s.bits(), low, high)


def shift_right(x, s, signed):
    if signed or x.low >= 0:
        low, high = min(x.low, 0), max(x.high, 0)
        if 0 <= s.low and s.high < x.width:
            low, high = corners(x, s, lambda a, b: a >> b)
    else:
        low, high = (0, (1 << (x.width - s.low)) - 1) if 0 < s.low and s.high < x.width else (-(1 << x.width), 0)
    a, b = x.bits(), s.bits()
    return Value(x.width, a >> b if signed else z3.LShR(a, b), low, high)


def mask(bits):
    return (1 << bits) - 1


def logic(name, x, y):
    """and, or, xor of bits."""
    if x.width == 1:
        if x.constant and y.constant:
            return number(1, {"and": x.low & y.low, "or": x.low | y.low, "xor": x.low ^ y.low}[name])
        a, b = x.bits(), y.bits()
        return truth(z3.simplify({"and": z3.And, "or": z3.Or, "xor": z3.Xor}[name](a, b)))
    a, b = x.bits(), y.bits()
    term = a & b if name == "and" else a | b if name == "or" else a ^ b
    full = -(1 << x.width), 1 << x.width
    if name == "and":
        for v, other in ((x, y), (y, x)):
            if v.constant and v.low >= 0 and v.low & (v.low + 1) == 0 and 0 <= other.low and other.high <= v.low:
                return other
        positive = [v.high for v in (x, y) if v.low >= 0]
        low, high = (0, min(positive)) if positive else full
    else:
        low, high = (0, mask(max(x.high, y.high).bit_length())) if x.low >= 0 and y.low >= 0 else full
    return Value(x.width, term, low, high)


def divide(facts, name, x, y):
    """sdiv, udiv, srem, urem by what is not 0."""
    signed = name[0] == "s"
    low, high = (-(1 << x.width), 1 << x.width)
    if x.low >= 0 and y.low >= 0 or signed and y.low > 0:
        ends = [a // b if a >= 0 else -(-a // b) for a in (x.low, x.high) for b in (max(y.low, 1), max(y.high, 1))]
        low, high = min(ends), max(ends)
        if name.endswith("rem"):
            low, high = -(y.high - 1) if x.low < 0 else 0, max(y.high - 1, 0) if x.high > 0 else 0
    if not facts.exact and not y.constant and fits(x.width, low, high):
        return facts.fresh(name, low, high, x.width)
    width = min(x.width, max(bits_for(x.low, x.high), bits_for(y.low, y.high)) + 1)
    if not signed and (x.low < 0 or y.low < 0):
        width = x.width
    a, b = resize(x.bits(), width), resize(y.bits(), width)
    term = {"sdiv": lambda: a / b, "udiv": lambda: z3.UDiv(a, b), "srem": lambda: z3.SRem(a, b),
            "urem": lambda: z3.URem(a, b)}[name]()
    return Value(x.width, resize(term, x.width), low, high)


def widen(facts, x, width, signed):
    if x.width == 1:
        if x.constant:
            return number(width, (-x.low if signed else x.low))
        return Value(width, z3.If(x.term, z3.BitVecVal(-1 if signed else 1, width), z3.BitVecVal(0, width)),
                     -1 if signed else 0, 0 if signed else 1)
    if x.constant:
        return number(width, x.low if signed else x.low & mask(x.width))
    if signed or x.low >= 0:
        return Value(width, z3.SignExt(width - x.width, x.term), x.low, x.high, x.key or ("s", facts.keep(x.term)))
    return Value(width, z3.ZeroExt(width - x.width, x.term), 0, mask(x.width), ("u", facts.keep(x.term)))


def narrow(x, width):
    if x.constant:
        return number(width, x.low)
    if width == 1:
        return truth(z3.Extract(0, 0, x.term) == 1)
    return Value(width, z3.Extract(width - 1, 0, x.term), x.low, x.high, x.key)


COMPARE = {"eq": lambda a, b: a == b, "ne": lambda a, b: a != b, "sgt": lambda a, b: a > b, "sge": lambda a, b: a >= b,
           "slt": lambda a, b: a < b, "sle": lambda a, b: a <= b, "ugt": z3.UGT, "uge": z3.UGE, "ult": z3.ULT, "ule": z3.ULE}
TURNED = {"eq": "ne", "ne": "eq", "gt": "le", "le": "gt", "lt": "ge", "ge": "lt"}


def compare(name, x, y):
    """The truth of a comparison."""
    plain = name if name in ("eq", "ne") else name[1:]
    if x.width > 1 and (name[0] != "u" or x.low >= 0 and y.low >= 0):
        less, more = x.high < y.low, x.low > y.high
        same = x.constant and y.constant and x.low == y.low
        at_most, at_least = x.high <= y.low, x.low >= y.high
        yes = {"eq": same, "ne": less or more, "lt": less, "gt": more, "le": at_most, "ge": at_least}[plain]
        no = {"eq": less or more, "ne": same, "lt": at_least, "gt": at_most, "le": more, "ge": less}[plain]
        if yes or no:
            return number(1, int(yes))
    return truth(COMPARE[name](x.bits(), y.bits()))


def choose(condition, x, y):
    """x where a condition of z3 holds, y elsewhere."""
    if x is y or x.constant and y.constant and x.low == y.low:
        return x
    if not x.constant and not y.constant and x.term.eq(y.term):
        return Value(x.width, x.term, min(x.low, y.low), max(x.high, y.high), x.key)
    return Value(x.width, chosen(condition, x.bits(), y.bits()), min(x.low, y.low), max(x.high, y.high))


def chosen(condition, a, b):
    """The term of a choice. One of a | b and b is b | (a or 0): bits that the result does not have are then not those of b at once."""
    for more, less, when in ((a, b, condition), (b, a, z3.Not(condition))):
        if z3.is_app_of(more, z3.Z3_OP_BOR) and more.num_args() == 2:
            for own, other in (more.children(), reversed(more.children())):
                if other.eq(less):
                    return less | z3.If(when, own, z3.BitVecVal(0, own.size()))
    return z3.If(condition, a, b)
