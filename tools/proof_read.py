# SPDX-License-Identifier: MIT
"""Read what clang prints of a program for wasm32 at -O0: functions, their blocks and instructions, the tables of constants."""
import re

NOISE = re.compile(r", align \d+|, !\w+(?:\.\w+)* !\d+|, !nosanitize !\d+| #\d+$|"
                   r"\b(?:noundef|dead_on_unwind|noalias|writable|nonnull|zeroext|signext|nsw|nuw|nneg|disjoint|inbounds|exact|hidden|"
                   r"internal|dso_local|local_unnamed_addr|tail|immarg|readonly|writeonly|nocapture)\b ?|"
                   r"\b(?:sret|byval)\([^()]*\) |\balign \d+ ")


def split(text):
    """The parts of a list between its commas, those in brackets aside."""
    parts, depth, start = [], 0, 0
    for at, sign in enumerate(text):
        depth += (sign in "([{<") - (sign in ")]}>")
        if sign == "," and depth == 0:
            parts.append(text[start:at].strip())
            start = at + 1
    return parts + [text[start:].strip()] if text[start:].strip() else parts


def typed(text):
    """(type, the rest) of what begins with a type."""
    text = text.strip()
    if text[0] in "[{":
        depth = 0
        for at, sign in enumerate(text):
            depth += (sign in "[{") - (sign in "]}")
            if depth == 0:
                return text[:at + 1], text[at + 1:].strip()
    first, _, rest = text.partition(" ")
    return first, rest.strip()


class Function:
    """Its parameters, and its blocks in the order of the source."""

    def __init__(self, name, parameters):
        self.name, self.parameters, self.blocks, self.order = name, parameters, {}, []


class Program:
    """All that a file holds."""

    def __init__(self, path):
        self.path, self.types, self.functions, self.tables, self.sizes = path, {}, {}, {}, {}
        function = block = None
        with open(path) as file:
            for line in file:
                line = NOISE.sub("", line.rstrip()).rstrip()
                if line.startswith("%"):
                    name, _, body = line.partition(" = type ")
                    self.types[name] = body
                elif line.startswith("@"):
                    name, kind, text = re.match(r"@(\S+) = .*?\b(constant|global) (.*)", line).groups()
                    self.tables[name] = typed(text)
                elif line.startswith("define "):
                    name, inside = re.match(r"define .*?@([\w.]+)\((.*)\)", line).groups()
                    function = self.functions[name] = Function(name, [part.split()[-1] for part in split(inside)])
                    block = function.blocks["entry"] = []
                    function.order = ["entry"]
                    self.first = str(len(function.parameters))
                elif line == "}":
                    function = None
                elif function and line:
                    label = re.match(r"^(\w+):", line)
                    if label:
                        block = function.blocks[label.group(1)] = []
                        function.order.append(label.group(1))
                    else:
                        block.append(self.instruction(line.strip().split(" ;")[0]))

    @staticmethod
    def instruction(text):
        """(name of the result or None, operation, the rest)."""
        made = None
        if text.startswith("%"):
            made, _, text = text.partition(" = ")
        operation, _, rest = text.partition(" ")
        return made, operation, rest

    def layout(self, kind):
        """The types of the parts of a structure or an array, each with its place."""
        kind = self.types.get(kind, kind)
        if kind[0] == "[":
            count, _, inner = kind[1:-1].partition(" x ")
            size = self.size(inner)
            return [(inner, i * size) for i in range(int(count))]
        at, parts = 0, []
        for part in split(kind[1:-1]):
            align = self.align(part)
            at = -(-at // align) * align
            parts.append((part, at))
            at += self.size(part)
        return parts

    def align(self, kind):
        kind = self.types.get(kind, kind)
        if kind == "ptr":
            return 4
        if kind[0] == "i":
            return min(max(int(kind[1:]) // 8, 1), 16)
        if kind[0] == "[":
            return self.align(kind[1:-1].partition(" x ")[2])
        return max((self.align(part) for part in split(kind[1:-1])), default=1)

    def size(self, kind):
        """Bytes of a type."""
        kind = self.types.get(kind, kind)
        if kind not in self.sizes:
            if kind == "ptr":
                size = 4
            elif kind[0] == "i":
                size = max(int(kind[1:]) // 8, 1)
            elif kind[0] == "[":
                count, _, inner = kind[1:-1].partition(" x ")
                size = int(count) * self.size(inner)
            else:
                inner, at = self.layout(kind)[-1]
                align = self.align(kind)
                size = -(-(at + self.size(inner)) // align) * align
            self.sizes[kind] = size
        return self.sizes[kind]

    def constants(self, kind, text):
        """(place, bytes, number) of the numbers in a table."""
        kind = self.types.get(kind, kind)
        if text in ("zeroinitializer", "undef") and kind[0] != "i":
            return [(at + place, size, value) for part, at in self.layout(kind) for place, size, value in self.constants(part, text)]
        if text.startswith('c"'):
            found = re.findall(r"\\([0-9A-Fa-f]{2})|(.)", text[2:-1])
            return [(i, 1, int(code, 16) if code else ord(sign)) for i, (code, sign) in enumerate(found)]
        if kind[0] == "i":
            return [(0, self.size(kind), 0 if text in ("zeroinitializer", "undef") else int(text))]
        found = []
        for (part, at), inner in zip(self.layout(kind), split(text[1:-1])):
            found += [(at + place, size, value) for place, size, value in self.constants(part, typed(inner)[1])]
        return found
