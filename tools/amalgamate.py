#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Join Carom into two pairs of files to copy into a project: carom.h, carom.c, carom_draw.h, carom_draw.c.

usage: amalgamate.py FOLDER. Sources are joined as they are, in the order of the stages, except: a name that is private
to one source and also defined by another becomes NAME_in_SOURCE; a macro of a source ends with it; the engine's
headers stand before all sources. Functions that one source calls in another keep their linkage, as in the library.
"""
import collections
import os
import re
import sys

import gate

BRANDS = """/* SPDX-License-Identifier: MIT */
/*
 * Carom {version}: {what}
 * tools/amalgamate.py has made this file of several; do not edit it.
 *
{licence}
 */
"""
# C++ needs other words for parts of the text, and some warnings apply to C++ only.
OPEN = """
#if defined __cplusplus
#include <string.h>
#define restrict       __restrict
#define _Noreturn      [[noreturn]]
#define _Static_assert static_assert
#define _Alignof       alignof
#endif
#if defined __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wunused-function"
#if defined __cplusplus
#pragma clang diagnostic ignored "-Wmissing-field-initializers"
#endif
#elif defined __GNUC__ && defined __cplusplus
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wenum-compare"
#endif
#if defined __cplusplus
extern "C" {
#endif
"""
CLOSE = """
#if defined __cplusplus
}
#undef restrict
#undef _Noreturn
#undef _Static_assert
#undef _Alignof
#endif
#if defined __clang__
#pragma clang diagnostic pop
#elif defined __GNUC__ && defined __cplusplus
#pragma GCC diagnostic pop
#endif
"""
# Where size counts, the engine holds the one body of each inline function, and must see it first.
BODIES = """
#if defined __OPTIMIZE_SIZE__ && defined CAROM_FIX_H && !defined CAROM_FIX_BODIES
#error "carom.c stands before every carom.h of a source that includes it"
#endif
#ifndef CAROM_FIX_BODIES
#define CAROM_FIX_BODIES
#endif
"""
MEMORY = re.compile(r"((?:^(?:void \*|int )mem\w+\(.*\);\n)+)", re.M)

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+(["<])([^">]+)[">].*\n', re.M)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.M)
# names that are private to a file: static ones (under any macro for static), its tags, its types
TAG = re.compile(r"\b(?:struct|union|enum)\s+(\w+)\s*\{")
OWN = re.compile(r"\b(?:static|FORCE_INLINE|OUT_OF_LINE)\b")


def read(path):
    with open(path) as file:
        return file.read()


def includes(path):
    """The files of the engine that a file includes, in its order."""
    found = [gate.included(path, name) for mark, name in INCLUDE.findall(read(path)) if mark == '"']
    return [header for header in found if header]


def ordered(paths):
    """The headers that files include, with their own includes. A header comes after the headers that it
    includes itself."""
    order = []

    def visit(path):
        for header in includes(path):
            if header not in order:
                visit(header)
                order.append(header)

    for path in paths:
        visit(path)
    return order


def top_level(text):
    """The declarations of a file, without the inside of braces."""
    text = DIRECTIVE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), gate.code(text))
    out, depth = [], 0
    for part in re.split(r"([{}])", text):
        if part == "}":
            depth -= 1
        if depth == 0:
            out.append(part)
        if part == "{":
            depth += 1
            if depth == 1:
                out.append("{")
    return "".join(out)


def own_names(path):
    """Names that a file defines for itself: ("tag" or "name", NAME)."""
    found = set()
    for declaration in re.split(r"\{\}[;\s]|;", top_level(read(path)).replace("{}", "{} ")):
        for tag in TAG.findall(declaration):
            found.add(("tag", tag))
        if re.match(r"\s*typedef\b", declaration):
            found.add(("name", re.findall(r"\w+", declaration)[-1]))
        elif OWN.search(declaration):
            name = re.search(r"(\w+)\s*(?:\(|\[|=|$)", declaration[OWN.search(declaration).end():].rstrip("{} \n"))
            found.add(("name", name.group(1)))
    for body in re.findall(r"^enum\b[^;{]*\{(.*?)\}", gate.code(read(path)), re.M | re.S):
        found |= {("name", name) for name in re.findall(r"(?:^|,)\s*(\w+)", body)}
    return found


def renamed(path, clashing, taken):
    """The text of a source. Private names that clash get the source's name appended."""
    text = read(path)
    stem = os.path.basename(path)[:-2]
    new = {}
    for kind, name in own_names(path) & clashing:
        new[kind, name] = "%s_in_%s" % (name, stem)
        if new[kind, name] in taken:
            sys.exit("%s: %s cannot be called %s" % (path, name, new[kind, name]))

    def word(match):
        before, name = match.group(1) or "", match.group(2)
        kind = "tag" if before.split()[-1:] and before.split()[-1] in ("struct", "union", "enum") else "name"
        if before.strip() in (".", "->"):
            return match.group()
        return before + new.get((kind, name), name)

    if not new:
        return text
    blank = gate.code(text)  # comments and strings keep their words
    out, at = [], 0
    for match in re.finditer(r"((?:\b(?:struct|union|enum)\s+)|(?:\.(?!\.)\s*)|(?:->\s*))?\b([A-Za-z_]\w*)\b", blank):
        out += [text[at:match.start()], word(match)]
        at = match.end()
    return "".join(out) + text[at:]


def piece(path, text):
    """A file as part of the whole: without its licence and includes; its macros end with it."""
    text = INCLUDE.sub("", text.replace("/* SPDX-License-Identifier: MIT */\n", "", 1))
    if path.endswith(".c"):
        macros = dict.fromkeys(re.findall(r"^#[ \t]*define[ \t]+(\w+)", text, re.M))
        keep = set(re.findall(r"^#[ \t]*undef[ \t]+(\w+)", text, re.M)) | {"CAROM_FIX_BODIES"}
        text += "".join("#undef %s\n" % name for name in macros if name not in keep)
    else:
        text = MEMORY.sub(r"#ifndef __cplusplus\n\1#endif\n", text)
    return "\n/* %s */\n%s" % (" ".join([path, "-" * (100 - len(path))]), re.sub(r"\n{3,}", "\n\n", text).strip("\n") + "\n")


def bodies(paths):
    """A table of the inline functions that sources declare extern, for C++, which makes bodies only for used
    ones."""
    names = re.findall(r"^extern inline [^(]*?(\w+)\(", "".join(map(read, paths)), re.M)
    rows = "".join("    (void (*)(void))%s,\n" % name for name in names)
    return ("\n#if defined __cplusplus\nextern void (*const carom_inline_bodies[])(void);\n"
            "void (*const carom_inline_bodies[])(void) = {\n%s};\n#endif\n" % rows)


def brand(what):
    licence = "".join((" * " + line).rstrip() + "\n" for line in read("LICENSE").strip().split("\n")).rstrip("\n")
    numbers = re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", read("include/carom_version.h"), re.M)
    return BRANDS.format(version=".".join(numbers), what=what, licence=licence)


def write(folder, name, *texts):
    with open(os.path.join(folder, name), "w") as file:
        file.write("".join(texts))


def joined_headers(paths, left_out=()):
    headers = [path for path in ordered(paths) if path not in left_out]
    return "".join(piece(path, read(path)) for path in headers), headers


def main():
    os.makedirs(sys.argv[1], exist_ok=True)
    renderer = [path for path in gate.engine() if gate.stage(path) == "draw"]
    engine = sorted((path for path in gate.engine() if gate.stage(path) != "draw"),
                    key=lambda path: (gate.STAGES.index(gate.stage(path)), path))
    drawing = ["include/carom_draw.h", "include/carom_debug.h"]
    public = [path for path in gate.PUBLIC if path not in drawing]

    times = collections.Counter(name for path in engine + renderer for name in own_names(path))
    headers = ordered(engine + renderer)
    shared = set().union(*(own_names(path) for path in headers))
    clashing = {name for name, count in times.items() if count > 1 or name in shared}
    taken = set(re.findall(r"\w+", "".join(map(read, engine + renderer + headers))))

    # headers that a public header includes stand before it
    order = ordered(public)
    order += [path for path in public if path not in order]
    standard = "".join("#include <%s.h>\n" % name for name in ("limits", "stdbool", "stddef", "stdint"))
    write(sys.argv[1], "carom.h", brand("the interface, but for drawing"), standard,
          *(piece(path, read(path)) for path in order))
    write(sys.argv[1], "carom_draw.h", brand("pictures of worlds"), '#include "carom.h"\n',
          *(piece(path, read(path)) for path in drawing))
    for name, sources, what in [("carom", engine, "the engine"), ("carom_draw", renderer, "the renderer")]:
        inner = [path for path in ordered(sources) if path not in order + drawing]
        write(sys.argv[1], name + ".c", brand(what), BODIES if name == "carom" else "",
              '#include "%s.h"\n' % name, OPEN,
              *(piece(path, read(path)) for path in inner),
              *(piece(path, renamed(path, clashing, taken)) for path in sources),
              bodies(sources) if name == "carom" else "", CLOSE)


main()
