#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The files of a library that PlatformIO compiles, by its library.json: files.py FOLDER prints the sources, a line each;
files.py FOLDER --flags prints the folders for headers and the flags.

PlatformIO's rules: build.srcFilter is a list of +<pattern> and -<pattern>, applied in order; a pattern is one of glob below
build.srcDir, and a folder that it names stands for all files below. build.includeDir and build.srcDir are in the path for
headers. build.flags are left out: the only one repeats build.includeDir, and the library must compile without it.
"""
import glob
import json
import os
import re
import sys

SOURCES = (".c", ".cc", ".cpp", ".cxx", ".S", ".s", ".asm")


def below(path):
    """A file, or all files of a folder."""
    if not os.path.isdir(path):
        return {path}
    return {os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names}


def chosen(root, rules):
    """The sources below a folder that the rules select."""
    found = set()
    for sign, pattern in re.findall(r"([+-])<([^>]*)>", " ".join(rules)):
        matched = set()
        for path in glob.glob(os.path.join(glob.escape(root), pattern), recursive=True):
            matched |= below(path)
        found = found | matched if sign == "+" else found - matched
    return sorted(path for path in found if path.endswith(SOURCES))


def main():
    root = sys.argv[1]
    with open(os.path.join(root, "library.json")) as file:
        library = json.load(file)
    build = library["build"]
    source = os.path.join(root, build["srcDir"])
    if "--flags" in sys.argv:
        include = os.path.join(root, build["includeDir"])
        missing = [name for name in library["headers"] if not os.path.exists(os.path.join(include, name))]
        if missing:
            sys.exit("library.json names headers that are not there: " + " ".join(missing))
        print("-I" + include, "-I" + source)
        return
    paths = chosen(source, build["srcFilter"])
    if not paths:
        sys.exit("srcFilter leaves nothing")
    print("\n".join(paths))


if __name__ == "__main__":
    main()
