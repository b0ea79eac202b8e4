#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Make the page of `make web`, one file: tools/page.py MODULE.wasm PAGE.html; --readme writes its size into README.md

The module, the boards' states of tests/bench_scenes.csv, style and scripts go into examples/web/page.html, so that it works
from a folder, without a server.
"""
import base64
import csv
import gzip
import json
import os
import sys

import marked

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
README = os.path.join(ROOT, "README.md")
MODULE = os.path.join(ROOT, "build", "wasm", "page.wasm")
PAGE = os.path.join(ROOT, "out", "web", "index.html")
SOURCES = os.path.join(ROOT, "examples", "web")


def read(name):
    with open(os.path.join(SOURCES, name)) as file:
        return file.read()


def boards_states():
    """Frame and state of each scene that the boards ran unchanged."""
    states = {}
    with open(os.path.join(ROOT, "tests", "bench_scenes.csv")) as file:
        for row in csv.DictReader(file):
            options = {each.split("=")[0] for each in row["options"].split()}
            if row["label"] == row["scene"] and options <= {"draw", "first"}:
                states[row["scene"]] = {"frame": int(row["frames"]), "hash": row["hash"]}
    return states


def write_size():
    """Write the sizes of the page and of the module between two comments of README.md."""
    if not os.path.exists(MODULE) or not os.path.exists(PAGE):
        return
    with open(MODULE, "rb") as file:
        module = file.read()
    line = "The page is one file of %d KB; the module in it has %d KB, %d packed by gzip." % (
        os.path.getsize(PAGE) // 1024, len(module) // 1024, len(gzip.compress(module, 9)) // 1024)
    marked.write(README, "page", [line])


def main():
    if sys.argv[1:] == ["--readme"]:
        return write_size()
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        module = file.read()
    page = read("page.html")
    for mark, text in [("/*STYLE*/", read("page.css")),
                       ("/*SCRIPT*/", "".join(map(read, ["mesh.js", "module.js", "page.js"]))),
                       ("/*STATES*/", json.dumps(boards_states())),
                       ("/*MODULE*/", base64.b64encode(module).decode())]:
        if page.count(mark) != 1:
            sys.exit("page.html: %s is there %d times" % (mark, page.count(mark)))
        page = page.replace(mark, text)
    with open(sys.argv[2], "w") as file:
        file.write(page)
    print("%s: %d bytes, the module %d, %d as a server packs it" % (
        sys.argv[2], len(page), len(module), len(gzip.compress(module, 9))))


if __name__ == "__main__":
    main()
