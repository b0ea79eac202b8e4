#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
Every function of the headers that changes a world is recorded, redirected and tested. The command plays a
recording of a scene on the host and in WebAssembly, whether it began with the world or later; it names the
frame of an altered one; and it builds one into the image of a board that reads no files. TAP.

With the argument `long`: 10,000 frames of the car take less than 64 KB and are the same here, on a Cortex-M3
and in WebAssembly.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
os.chdir(ROOT)
FILE = "build/tests/car.replay"
FRAMES = 300
# These take a world that is not const, for scratch memory or for the caller's data, and change no bit of its
# state.
QUESTIONS = {"query_faces", "overlap_mesh", "cast_mesh", "closest_points", "body_set_user"}


def read(path):
    with open(path) as file:
        return file.read()


def changing():
    """The functions of the headers that change a world."""
    found = set()
    for name in sorted(os.listdir("include")):
        if name != "carom_replay.h":
            text = re.sub(r"/\*.*?\*/", "", read("include/" + name), flags=re.S)
            for function, given in re.findall(r"\bcarom_(\w+)\(([^;{}]*?)\);", text):
                if re.search(r"(?<!const )struct carom_world \*", given):
                    found.add(function)
    return found


def run(*command):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.STDOUT, errors="replace")
    return done.returncode, done.stdout


def without_make():
    return {k: v for k, v in os.environ.items() if not k.startswith("MAKE") and k != "MFLAGS"}


def make(board, *programs):
    subprocess.run(["make", "-s", "-j2", "BOARD=" + board, *("build/%s/%s.elf" % (board, name) for name in programs)],
                   stdout=subprocess.DEVNULL, env=without_make())


def record(*options):
    os.makedirs(os.path.dirname(FILE), exist_ok=True)
    return run("build/host/record.elf", *options, "to=" + FILE)[0] == 0


def on_board(board):
    """The command itself, without the lines of the builds that it starts."""
    done = subprocess.run(["make", "-s", "replay", "FILE=" + FILE, "BOARD=" + board], text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, env=without_make())
    return done.returncode, re.sub(r"^  .*\n", "", done.stdout, flags=re.M)


def cases():
    header, wanted = read("include/carom_replay.h"), changing() - QUESTIONS
    yield "headers_are_read", {"world_init", "body_push", "joint_set"} < wanted
    yield "all_are_listed", wanted == set(re.findall(r"^    X\((\w+)\)", header, re.M))
    yield "all_are_declared", wanted <= set(re.findall(r"^int carom_record_(\w+)\(", header, re.M))
    yield "all_are_redirected", wanted == set(re.findall(r"^#define carom_(\w+)\(\.\.\.\)", header, re.M))
    yield "all_are_tested", all("carom_record_%s(" % name in read("tests/test_replay.c")
                                for name in wanted)
    make("host", "record", "replay")
    make("wasm", "replay")
    yield "records", record("scene=car", "frames=%d" % FRAMES, "stages=1")
    yield "plays_in_wasm", run("tools/replay.py", FILE, "--board", "wasm") == (
        0, "host: %d frames, the same\nwasm: %d frames, the same\n" % (FRAMES, FRAMES))
    yield "plays", run("tools/replay.py", FILE) == (0, "host: %d frames, the same\n" % FRAMES)
    with open(FILE, "rb") as file:
        whole = bytearray(file.read())
    # the check of the last frame stands before the end (17 bytes), with the state's 2 bytes at its
    # own end
    whole[-18] ^= 1
    with open(FILE, "wb") as file:
        file.write(whole)
    status, said = run("tools/replay.py", FILE, "--board", "wasm")
    wanted = "%s: frame %d, stage commit differs"
    yield "names", status == 1 and wanted % ("host", FRAMES) in said
    yield "names_in_wasm", wanted % ("wasm", FRAMES) in said
    with open(FILE, "wb") as file:
        file.write(whole[:-18])
    status, said = run("tools/replay.py", FILE)
    yield "says_cut", status == 2 and "cut short" in said
    yield "records_from_the_middle", record("scene=walker", "frames=100", "from=60", "stages=1")
    yield "plays_the_middle", run("tools/replay.py", FILE) == (0, "host: 41 frames, the same\n")
    yield "records_for_a_small_board", record("scene=brick", "frames=60", "caps=2,1,4,6,0,6")
    yield "plays_built_in", on_board("microbit") == (
        0, "host: 60 frames, the same\nmicrobit: 60 frames, the same\n")
    yield "records_for_a_large_board", record("scene=brick", "frames=60")
    status, said = on_board("microbit")
    yield "says_too_large", status != 0 and "the board has room for" in said


def long_cases():
    """The long test, which takes minutes on an emulated board."""
    make("host", "record", "replay")
    make("wasm", "replay")
    make("mps2-an385", "replay")
    yield "records", record("scene=car", "frames=10000")
    yield "is_small", os.path.getsize(FILE) < 64 << 10
    wanted = "".join(board + ": 10000 frames, the same\n" for board in ["host", "mps2-an385", "wasm"])
    yield "is_the_same", run("tools/replay.py", FILE, "--board", "mps2-an385", "--board",
                             "wasm") == (0, wanted)


def main():
    failed = number = 0
    for number, (name, ok) in enumerate(long_cases() if "long" in sys.argv else cases(), 1):
        failed += not ok
        print("%s %d - replay/%s" % ("ok" if ok else "not ok", number, name), flush=True)
    print("1..%d" % number)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
