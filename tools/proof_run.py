# SPDX-License-Identifier: MIT
"""Run a program for all inputs at once, and collect what must never happen.

States that meet again at a block become one: what differs is chosen by the condition under which it does. Loops are unrolled; a
block that is entered more often than `unwind` times must not be reachable. What must never happen: an operation that clang's
sanitizer catches, a failed assertion or check, an access outside of an object.
"""
import re

import z3

import proof_read
import proof_values as values

TRAPS = {0: "sum overflows", 3: "division by zero", 12: "product overflows", 13: "negation overflows", 20: "shift out of range",
         21: "difference overflows"}
NUMBERED = re.compile(r"^-?\d+$")


class Pointer:
    """Places that a pointer may have: (condition or None, object, offset). Object 0 is NULL."""

    def __init__(self, choices):
        self.choices = choices


class State:
    """A path: the conditions taken, the memory, the names of the function, and intervals that conditions made smaller."""

    def __init__(self, guard=(), memory=None, names=None, bounds=None):
        self.guard, self.memory, self.names, self.bounds = guard, memory or {}, names or {}, bounds or {}

    def copy(self):
        return State(self.guard, dict(self.memory), dict(self.names), dict(self.bounds))


def meet(a, b):
    """One state of two, which came by different conditions."""
    same = 0
    while same < min(len(a.guard), len(b.guard)) and a.guard[same] is b.guard[same]:
        same += 1
    rest_a, rest_b = a.guard[same:], b.guard[same:]
    condition = z3.And(*rest_a) if rest_a else z3.BoolVal(True)
    guard = a.guard[:same]
    if not (len(rest_a) == len(rest_b) == 1 and z3.simplify(z3.Not(rest_a[0])).eq(z3.simplify(rest_b[0]))):
        guard += (z3.Or(condition, z3.And(*rest_b) if rest_b else z3.BoolVal(True)),)
    memory = {}
    for thing in a.memory.keys() & b.memory.keys():
        cells_a, cells_b = a.memory[thing], b.memory[thing]
        memory[thing] = cells_a if cells_a is cells_b else joined(condition, cells_a, cells_b)
    names = {name: either(condition, a.names[name], b.names[name]) for name in a.names.keys() & b.names.keys()}
    bounds = {key: (min(a.bounds[key][0], b.bounds[key][0]), max(a.bounds[key][1], b.bounds[key][1]))
              for key in a.bounds.keys() & b.bounds.keys()}
    return State(guard, memory, names, bounds)


def joined(condition, a, b):
    """The cells of an object, by the condition; where two paths cut them in two ways, as bytes."""
    for one, other in ((a, b), (b, a)):
        for at, (size, _) in list(one.items()):
            inside = [(start, other[start][0]) for start in range(at - 15, at + size)
                      if start in other and start + other[start][0] > at]
            if inside and inside != [(at, size)]:
                a, b = (cut(cells, [(at, size), *inside]) for cells in (a, b))
                return joined(condition, a, b)
    return {at: (a.get(at) or b[at])[:1] + (either(condition, a[at][1] if at in a else None, b[at][1] if at in b else None),)
            for at in a.keys() | b.keys()}


def cut(cells, places):
    """Cells with those at some places as bytes."""
    cells = dict(cells)
    for at, size in places:
        if at in cells and cells[at][0] == size and size > 1:
            _, value = cells.pop(at)
            for byte in range(size):
                cells[at + byte] = (1, values.Value(8, z3.simplify(z3.Extract(8 * byte + 7, 8 * byte, value.bits())), -128, 127))
    return cells


def either(condition, x, y):
    """x where the condition holds, else y; what only one path has is that one's."""
    if x is y or y is None:
        return x
    if x is None:
        return y
    if isinstance(x, Pointer):
        if len(x.choices) == len(y.choices) == 1 and x.choices[0][1] == y.choices[0][1]:
            return Pointer([(None, x.choices[0][1], values.choose(condition, x.choices[0][2], y.choices[0][2]))])
        return Pointer([(both(condition, c), thing, place) for c, thing, place in x.choices] +
                       [(both(z3.Not(condition), c), thing, place) for c, thing, place in y.choices])
    if isinstance(x, list):
        return [either(condition, a, b) for a, b in zip(x, y)]
    return values.choose(condition, x, y)


def both(a, b):
    return a if b is None else z3.And(a, b)


class Run:
    """A program that runs from main on."""

    def __init__(self, program, facts, unwind, contracts):
        self.program, self.facts, self.unwind, self.contracts = program, facts, unwind, contracts
        self.failures, self.entered, self.origins = [], set(), {}
        self.sizes, self.statics = [0], {}
        self.function = None
        self.call("proof", [], State())

    # ------------------------------------------------------------ operands

    def value(self, state, kind, text):
        """The value of an operand."""
        if text[0] == "%":
            return self.bounded(state, state.names[text])
        if kind == "ptr":
            return self.place_of(state, text)
        if text in ("undef", "poison", "zeroinitializer"):
            if kind[0] in "{[":
                return [self.value(state, part, text) for part, _ in self.program.layout(kind)]
            return values.number(int(kind[1:]), 0)
        return values.number(int(kind[1:]), {"true": 1, "false": 0}[text] if text in ("true", "false") else int(text))

    def place_of(self, state, text):
        if text == "null":
            return Pointer([(None, 0, values.number(32, 0))])
        if text.startswith("getelementptr"):
            return self.element(state, text.partition("(")[2][:-1])
        name = text[1:]
        if name in self.program.functions:
            return Pointer([(None, name, values.number(32, 0))])
        if name not in self.statics:
            kind, initial = self.program.tables[name]
            self.statics[name] = self.new(state, self.program.size(kind))
            if not initial.startswith('c"') or "@fix" in text:
                state.memory[self.statics[name]] = {
                    place: (size, values.number(8 * size, value))
                    for place, size, value in self.program.constants(kind, initial)}
            self.first_cells = state.memory[self.statics[name]]
        thing = self.statics[name]
        state.memory.setdefault(thing, self.first_cells)
        return Pointer([(None, thing, values.number(32, 0))])

    def bounded(self, state, value):
        """The value with the interval that the path knows of it."""
        if not isinstance(value, values.Value) or value.constant or value.width == 1:
            return value
        found = state.bounds.get(value.term.get_id())
        if not found:
            return value
        low, high = max(found[0], value.low), min(found[1], value.high)
        if low > high:
            return value
        return values.Value(value.width, value.term, low, high, value.key)

    def typed(self, state, text):
        kind, rest = proof_read.typed(text)
        return self.value(state, kind, rest)

    # -------------------------------------------------------------- memory

    def new(self, state, size):
        self.sizes.append(size)
        state.memory[len(self.sizes) - 1] = {}
        return len(self.sizes) - 1

    def element(self, state, text):
        """The place of a part of an object."""
        parts = proof_read.split(text)
        base = self.typed(state, parts[1])
        moved = values.number(32, 0)
        kind = parts[0]
        for step, part in enumerate(parts[2:]):
            index = self.typed(state, part)
            index = values.narrow(index, 32) if index.width > 32 else index
            if step == 0:
                by = self.program.size(kind)
            elif self.program.types.get(kind, kind)[0] == "[":
                inner = self.program.types.get(kind, kind)[1:-1].partition(" x ")[2]
                kind, by = inner, self.program.size(inner)
            else:
                kind, by = self.program.layout(kind)[index.low]
                index, by = values.number(32, by), 1
            if index.width < 32:
                index = values.widen(self.facts, index, 32, True)
            moved = values.place(moved, values.multiply(self.facts, index, values.number(32, by))[0], by)
        return Pointer([(condition, thing, values.place(place, moved, moved.apart)) for condition, thing, place in base.choices])

    def fail(self, state, condition, what):
        """Remember a condition of z3 that must not hold here."""
        condition = z3.BoolVal(condition) if isinstance(condition, bool) else condition
        if not z3.is_false(z3.simplify(condition)):
            self.failures.append((state.guard, condition, "%s: %s" % (self.function, what)))

    def cells(self, state, thing, place, size, choice):
        """The cells of `size` bytes where an access may go; it must go to one of them."""
        guard = State(state.guard + ((choice,) if choice is not None else ()))
        if thing == 0 or not isinstance(thing, int):
            self.fail(guard, True, "access through a null pointer")
            return []
        if place.constant:
            if place.low < 0 or place.low + size > self.sizes[thing]:
                self.fail(guard, True, "access outside of an object")
                return []
            return [place.low]
        found = [at for at, cell in state.memory[thing].items()
                 if cell[0] == size and place.low <= at <= place.high and (at - place.low) % place.apart == 0]
        self.fail(guard, z3.And(*[place.term != at for at in found]), "access outside of an array, or before it is written")
        return found

    def load(self, state, pointer, size, kind):
        result = None
        for choice, thing, place in pointer.choices:
            for at in self.cells(state, thing, place, size, choice):
                found = self.cell(state, thing, at, size, kind)
                condition = None if place.constant else place.term == at
                condition = choice if condition is None else condition if choice is None else z3.And(choice, condition)
                result = found if result is None else either(condition, found, result) if condition is not None else found
        if result is None:
            result = self.facts.fresh("none", -(1 << (8 * size - 1)), (1 << (8 * size - 1)) - 1, 8 * size)
        return result

    def cell(self, state, thing, at, size, kind):
        cells = state.memory[thing]
        if at in cells and cells[at][0] == size:
            return cells[at][1]
        found = []
        for byte in range(at, at + size):
            start = next((start for start in range(byte, byte - 17, -1) if start in cells and start + cells[start][0] > byte), None)
            if start is None:
                self.fail(state, True, "reads what was never written")
                found.append(z3.BitVecVal(0, 8))
                continue
            bits = cells[start][1].bits()
            shift = 8 * (byte - start)
            found.append(z3.Extract(shift + 7, shift, bits))
        term = z3.simplify(z3.Concat(*reversed(found)) if len(found) > 1 else found[0])
        if z3.is_bv_value(term):
            return values.number(8 * size, term.as_long())
        return values.Value(8 * size, term, -(1 << (8 * size)), 1 << (8 * size))

    def store(self, state, pointer, size, value):
        single = len(pointer.choices) == 1
        for choice, thing, place in pointer.choices:
            for at in self.cells(state, thing, place, size, choice):
                if place.constant and single:
                    state.memory[thing] = put(state.memory[thing], at, size, value)
                    continue
                condition = z3.BoolVal(True) if place.constant else place.term == at
                condition = condition if choice is None else z3.And(choice, condition)
                former = self.cell(state, thing, at, size, None)
                state.memory[thing] = put(state.memory[thing], at, size, either(condition, value, former))

    def fill(self, state, pointer, byte, count):
        """memset: bytes of what is written so far."""
        (_, thing, place), = pointer.choices
        if count.constant and place.constant:
            self.fail(state, place.low < 0 or place.low + count.low > self.sizes[thing], "memset outside of an object")
            step = 8 if count.low % 8 == 0 and place.low % 8 == 0 and byte.constant and byte.low == 0 else 1
            for at in range(place.low, place.low + count.low, step):
                state.memory[thing] = put(state.memory[thing], at, step, values.number(8 * step, byte.low) if byte.constant else byte)
            return
        start, length = place.bits(), count.bits()
        self.fail(state, z3.Or(z3.UGT(start, self.sizes[thing]), z3.UGT(length, self.sizes[thing] - start)), "memset outside of an object")
        for at in range(self.sizes[thing]):
            inside = z3.And(z3.ULE(start, at), z3.ULT(at - start, length))
            state.memory[thing] = put(state.memory[thing], at, 1, values.choose(inside, byte, self.cell(state, thing, at, 1, None)))

    def copy(self, state, to, source, count):
        """memcpy of a constant size."""
        (_, thing, place), = to.choices
        (_, other, begin), = source.choices
        self.fail(state, place.low + count.low > self.sizes[thing] or begin.low + count.low > self.sizes[other], "memcpy outside")
        for at, (size, value) in list(state.memory[other].items()):
            if begin.low <= at and at + size <= begin.low + count.low:
                state.memory[thing] = put(state.memory[thing], place.low + at - begin.low, size, value)

    # ------------------------------------------------------------- control

    def call(self, name, arguments, state):
        """(state, result) after a call, or None if no path returns."""
        function = self.program.functions[name]
        outer, self.function = self.function, name
        self.entered.add(name)
        kept, state.names = state.names, dict(zip(function.parameters, arguments))
        waiting, visits, ends = {"entry": state}, {}, []
        index = {label: at for at, label in enumerate(function.order)}
        while waiting:
            label = min(waiting, key=index.get)
            here = waiting.pop(label)
            visits[label] = visits.get(label, 0) + 1
            if visits[label] > self.unwind:
                self.fail(here, True, "more than %d turns" % self.unwind)
                continue
            for target, there in self.block(function, label, here, ends):
                waiting[target] = meet(waiting[target], there) if target in waiting else there
        self.function = outer
        if not ends:
            return None
        end = ends[0]
        for other in ends[1:]:
            end = meet(end, other)
        result = end.names.get("return")
        end.names = kept
        return end, result

    def block(self, function, label, state, ends):
        """Run a block; returns where it goes, with the states there."""
        for made, operation, rest in function.blocks[label]:
            if operation == "br":
                return self.branch(function, label, state, rest)
            if operation == "ret":
                if rest != "void":
                    state.names["return"] = self.typed(state, rest)
                ends.append(state)
                return []
            if operation == "unreachable":
                return []
            if operation == "phi":
                continue  # set by enter()
            if operation == "call":
                state = self.called(state, made, rest)
                if state is None:
                    return []
                continue
            result = self.operate(state, operation, rest)
            if made:
                state.names[made] = result
        raise ValueError("a block without an end")

    def branch(self, function, label, state, rest):
        parts = proof_read.split(rest)
        if len(parts) == 1:
            return [self.enter(function, label, state, parts[0])]
        condition = self.typed(state, parts[0])
        if condition.constant:
            return [self.enter(function, label, state, parts[1] if condition.low else parts[2])]
        found = []
        term = condition.bits()
        for way, part in ((term, parts[1]), (z3.Not(term), parts[2])):
            target = part.split("%")[1]
            first = function.blocks[target][0]
            if first[1] == "call" and "ubsantrap" in first[2]:
                self.fail(state, way, TRAPS.get(int(re.search(r"i8 (\d+)", first[2]).group(1)), "undefined"))
                continue
            there = state.copy()
            there.guard += (way,)
            if self.learn(there, term, way is term):
                found.append(self.enter(function, label, there, part))
        return found

    def enter(self, function, label, state, part):
        """(block, state there), with the values that the block takes from where it is entered."""
        target = part.split("%")[1]
        taken = {}
        for made, operation, rest in function.blocks[target]:
            if operation != "phi":
                break
            kind, sources = proof_read.typed(rest)
            for source in proof_read.split(sources):
                value, came = source[1:-1].strip().rsplit(", ", 1)
                if came.strip()[1:] == label or came.strip()[1:] not in function.blocks and label == "entry":
                    taken[made] = self.value(state, kind, value.strip())
        state.names.update(taken)
        return target, state

    def learn(self, state, term, holds):
        """Make intervals smaller by a condition; False if it cannot hold."""
        origin = self.origins.get(term.get_id())
        if origin is None:
            return True
        name, x, y = origin
        x, y = self.bounded(state, x), self.bounded(state, y)
        if name[0] == "u" and (x.low < 0 or y.low < 0):
            return True
        plain = name if name in ("eq", "ne") else name[1:]
        plain = plain if holds else values.TURNED[plain]
        for plain, a, b in ((plain, x, y), ({"lt": "gt", "gt": "lt", "le": "ge", "ge": "le"}.get(plain, plain), y, x)):
            low, high = a.low, a.high
            if plain == "eq":
                low, high = max(low, b.low), min(high, b.high)
            elif plain in ("lt", "le"):
                high = min(high, b.high - (plain == "lt"))
            elif plain in ("gt", "ge"):
                low = max(low, b.low + (plain == "gt"))
            elif plain == "ne" and b.constant:
                low, high = low + (low == b.low), high - (high == b.low)
            if low > high:
                return False
            if not a.constant:
                state.bounds[self.facts.keep(a.term)] = low, high
        return True

    # ---------------------------------------------------------- operations

    def operate(self, state, operation, rest):
        """The result of an instruction that goes on to the next."""
        if operation in ("add", "sub", "mul", "shl", "lshr", "ashr", "and", "or", "xor", "sdiv", "udiv", "srem", "urem"):
            kind, pair = proof_read.typed(rest)
            x, y = (self.value(state, kind, part) for part in proof_read.split(pair))
            return self.arithmetic(operation, x, y)
        if operation == "icmp":
            name, _, rest = rest.partition(" ")
            kind, pair = proof_read.typed(rest)
            x, y = (self.value(state, kind, part) for part in proof_read.split(pair))
            return self.compared(name, x, y)
        if operation in ("sext", "zext", "trunc", "freeze"):
            source, _, kind = rest.partition(" to ")
            x = self.typed(state, source)
            if operation == "freeze":
                return x
            width = int(kind[1:])
            return values.narrow(x, width) if operation == "trunc" else values.widen(self.facts, x, width, operation == "sext")
        if operation == "alloca":
            return Pointer([(None, self.new(state, self.program.size(proof_read.split(rest)[0])), values.number(32, 0))])
        if operation == "load":
            kind, pointer = proof_read.split(rest)
            return self.load(state, self.typed(state, pointer), self.program.size(kind), kind)
        if operation == "store":
            value, pointer = proof_read.split(rest)
            kind = proof_read.typed(value)[0]
            return self.store(state, self.typed(state, pointer), self.program.size(kind), self.typed(state, value))
        if operation == "getelementptr":
            return self.element(state, rest)
        if operation == "extractvalue":
            whole, at = proof_read.split(rest)
            return self.typed(state, whole)[int(at)]
        if operation == "select":
            condition, x, y = (self.typed(state, part) for part in proof_read.split(rest))
            if condition.constant:
                return x if condition.low else y
            return either(condition.term, x, y)
        raise ValueError("does not know " + operation)

    def arithmetic(self, operation, x, y):
        if x.width == 1 or operation in ("and", "or", "xor"):
            return values.logic(operation, x, y)
        if operation in ("add", "sub"):
            return values.plus(x, y, 1 if operation == "add" else -1)[0]
        if operation == "mul":
            return values.multiply(self.facts, x, y)[0]
        if operation == "shl":
            return values.shift_left(x, y)
        if operation in ("lshr", "ashr"):
            return values.shift_right(x, y, operation == "ashr")
        return values.divide(self.facts, operation, x, y)

    def compared(self, name, x, y):
        if isinstance(x, Pointer):
            same = z3.BoolVal(False)
            for c, thing, place in x.choices:
                for d, other, at in y.choices:
                    equal = z3.BoolVal(thing == other) if thing == 0 or thing != other else place.bits() == at.bits()
                    same = z3.Or(same, z3.And(*[part for part in (c, d) if part is not None], equal))
            same = z3.simplify(same if name == "eq" else z3.Not(same))
            return values.number(1, int(z3.is_true(same))) if z3.is_true(same) or z3.is_false(same) else values.truth(same)
        found = values.compare(name, x, y)
        if not found.constant:
            self.origins[self.facts.keep(found.term)] = name, x, y
        return found

    def called(self, state, made, rest):
        """The state after a call; None if it does not return."""
        name, inside = re.match(r".*?[@%]([\w.]+)\((.*)\)$", rest).groups()
        arguments = [self.typed(state, part) for part in proof_read.split(inside)]
        name = self.contracts.get(name, name) if self.function != self.contracts.get(name) else name
        if "@" not in rest:
            name = state.names["%" + name].choices[0][1]
        if name in self.program.functions:
            ended = self.call(name, arguments, state)
            if ended is None:
                return None
            state, result = ended
        else:
            result = self.given(state, name, arguments)
            if result is None:
                return None
        if made:
            state.names[made] = result
        return state

    def given(self, state, name, arguments):
        """The result of what the program does not define; True if there is none, None if it does not return."""
        overflows = re.match(r"llvm\.(s)(add|sub|mul)\.with", name)
        if overflows:
            x, y = arguments
            return list(values.multiply(self.facts, x, y) if overflows.group(2) == "mul" else
                        values.plus(x, y, 1 if overflows.group(2) == "add" else -1))
        if name.startswith("llvm.ctlz"):
            return leading_zeros(arguments[0])
        if name.startswith("llvm.memcpy"):
            self.copy(state, *arguments[:3])
        elif name.startswith("llvm.memset") or name == "memset":
            self.fill(state, arguments[0], values.narrow(arguments[1], 8) if arguments[1].width > 8 else arguments[1], arguments[2])
        elif name == "proof_range":
            value = self.facts.fresh("in", arguments[0].low, arguments[1].high, 64)
            self.facts.inputs.append((value, state.guard))
            return value
        elif name == "proof_assume":
            if arguments[0].constant:
                return True if arguments[0].low else None
            state.guard += (arguments[0].bits(),)
            self.learn(state, arguments[0].term, True)
        elif name == "proof_check":
            self.fail(state, z3.Not(arguments[0].bits()), "a check fails")
        elif name in ("carom_assert_failed", "llvm.ubsantrap"):
            self.fail(state, True, "an assertion fails" if name[0] == "c" else "undefined")
            return None
        else:
            raise ValueError("does not know the function " + name)
        return True


def put(cells, at, size, value):
    """Cells with one written; those that it covers in part are cut to bytes."""
    cells = dict(cells)
    for start in range(at - 15, at + size):
        if start in cells and start + cells[start][0] > at and (start != at or cells[start][0] != size):
            width, former = cells.pop(start)
            for byte in range(width):
                if not at <= start + byte < at + size:
                    term = z3.simplify(z3.Extract(8 * byte + 7, 8 * byte, former.bits()))
                    cells[start + byte] = (1, values.Value(8, term, -128, 127))
    cells[at] = (size, value)
    return cells


def leading_zeros(x):
    if x.constant:
        return values.number(x.width, x.width - (x.low & values.mask(x.width)).bit_length())
    term = z3.BitVecVal(x.width, x.width)
    for bit in range(x.width):
        term = z3.If(z3.Extract(bit, bit, x.term) == 1, z3.BitVecVal(x.width - 1 - bit, x.width), term)
    low = x.width - x.high.bit_length() if x.low >= 0 else 0
    return values.Value(x.width, term, low, x.width)
