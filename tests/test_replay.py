#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""
Every function of the headers that changes a world is recorded, redirected and tested, and the command plays a
recording of a scene on the host and names the frame of one that was altered. TAP.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
os.chdir(ROOT)
FILE = "build/tests/car.replay"
FRAMES = 300
# They take a world that is not const, for their scratch or for what is yours, and change no bit of its state.
QUESTIONS = {"query_faces", "overlap_mesh", "cast_mesh", "closest_points", "body_set_user"}


def read(path):
    with open(path) as file:
        return file.read()


def changing():
    """The functions that change a world, by the headers."""
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


def cases():
    header, wanted = read("include/carom_replay.h"), changing() - QUESTIONS
    yield "headers_are_read", {"world_init", "body_push", "joint_set"} < wanted
    yield "all_are_listed", wanted == set(re.findall(r"^    X\((\w+)\)", header, re.M))
    yield "all_are_declared", wanted <= set(re.findall(r"^int carom_record_(\w+)\(", header, re.M))
    yield "all_are_redirected", wanted == set(re.findall(r"^#define carom_(\w+)\(\.\.\.\)", header, re.M))
    yield "all_are_tested", all("carom_record_%s(" % name in read("tests/test_replay.c")
                                for name in wanted)
    os.makedirs(os.path.dirname(FILE), exist_ok=True)
    environment = {k: v for k, v in os.environ.items() if not k.startswith("MAKE") and k != "MFLAGS"}
    subprocess.run(["make", "-s", "BOARD=host", "build/host/record.elf", "build/host/replay.elf"],
                   stdout=subprocess.DEVNULL, env=environment)
    yield "records", run("build/host/record.elf", "scene=car", "frames=%d" % FRAMES, "stages=1",
                         "to=" + FILE)[0] == 0
    yield "plays", run("tools/replay.py", FILE) == (0, "host: %d frames, the same\n" % FRAMES)
    with open(FILE, "rb") as file:
        whole = bytearray(file.read())
    # before the end (17 bytes) stands the check of the last frame, with the state's 2 bytes at its end
    whole[-18] ^= 1
    with open(FILE, "wb") as file:
        file.write(whole)
    status, said = run("tools/replay.py", FILE)
    yield "names", status == 1 and "frame %d, stage commit differs" % FRAMES in said
    with open(FILE, "wb") as file:
        file.write(whole[:-18])
    status, said = run("tools/replay.py", FILE)
    yield "says_cut", status == 2 and "cut short" in said


def main():
    failed = number = 0
    for number, (name, ok) in enumerate(cases(), 1):
        failed += not ok
        print("%s %d - replay/%s" % ("ok" if ok else "not ok", number, name), flush=True)
    print("1..%d" % number)
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
