#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run a scene on a board and report: a table, frames.csv, pictures, an animation.

The program (examples/head.c) prints lines that begin with a word: "columns" and "frame" are the rows of frames.csv, "usage" a
pool, "hash" the final state, "unit" the unit of the stages; "picture" asks for a photograph of the LCD and waits. Other lines
are passed through.
"""
import argparse
import concurrent.futures
import csv
import glob
import json
import os
import socket
import subprocess
import sys
import tempfile
import time

from PIL import Image

import run_board
import terminal

GIF_EVERY = 3  # frames
GIF_WIDTH = 256  # pixels
GIF_SECONDS = 0.05  # a picture
WAITING_MOST = 32  # pictures that wait for compression


class Camera:
    """QEMU's monitor, which photographs the LCD."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        for _ in range(200):
            try:
                self.socket.connect(path)
                break
            except OSError:
                time.sleep(0.05)
        else:
            sys.exit("the emulator's monitor does not answer")
        self.stream = self.socket.makefile("r")
        self.stream.readline()  # skip the greeting
        self.ask("qmp_capabilities")

    def ask(self, command, **arguments):
        request = {"execute": command, "arguments": arguments}
        self.socket.sendall(json.dumps(request).encode())
        for line in self.stream:
            reply = json.loads(line)
            if "error" in reply:
                sys.exit("monitor: " + reply["error"]["desc"])
            if "return" in reply:
                return
        sys.exit("monitor: the emulator has gone")

    def photograph(self, path):
        self.ask("screendump", filename=path, format="ppm")


class Run:
    """The output of the program."""

    def __init__(self):
        self.columns, self.rows, self.usage = [], [], []
        self.hash = self.unit = None
        self.bytes = {}  # bytes of the world, and of the stack


def png_name(out, frame):
    return os.path.join(out, "frame-%04d.png" % frame)


def ppm_name(out, frame):
    return os.path.join(out, "frame-%04d.ppm" % frame)


class Album:
    """Turn pictures of a board or the emulator into PNG files, and some of them into an animation, during the run."""

    def __init__(self, out):
        self.out = out
        self.pool = concurrent.futures.ThreadPoolExecutor()
        self.waiting, self.small = [], {}

    def take(self, frame):
        """Take the picture of a frame, if there is one."""
        if os.path.exists(ppm_name(self.out, frame)):
            self.waiting.append(self.pool.submit(self.keep, frame))
        if len(self.waiting) > WAITING_MOST:
            self.waiting.pop(0).result()

    def keep(self, frame):
        image = Image.open(ppm_name(self.out, frame))
        image.save(png_name(self.out, frame), compress_level=1)
        os.remove(ppm_name(self.out, frame))
        self.shrink(frame, image)

    def shrink(self, frame, image):
        if frame % GIF_EVERY == 1:
            size = GIF_WIDTH, GIF_WIDTH * image.height // image.width
            self.small[frame] = image.convert("RGB").resize(size, Image.LANCZOS, reducing_gap=1)

    def finish(self, name):
        """Write the animation when all pictures are there; a board may have written PNG files itself."""
        for task in self.waiting:
            task.result()
        paths = pictures(self.out)
        for frame in range(1, len(paths) + 1, GIF_EVERY):
            if frame not in self.small:
                self.shrink(frame, Image.open(paths[frame - 1]))
        if not self.small:
            return
        shown = [self.small[frame] for frame in sorted(self.small)]
        palette = shown[len(shown) // 2].quantize(64)
        shown = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in shown]
        path = os.path.join(self.out, name + ".gif")
        shown[0].save(path, save_all=True, append_images=shown[1:], loop=0, duration=int(1000 * GIF_SECONDS))
        print("%s: %.1f MB" % (path, os.path.getsize(path) / 1e6))


def follow(process, camera, album, frames):
    """Read the program's output until it ends."""
    run = Run()
    progress = terminal.Progress(frames)
    pictures = 0
    for line in process.stdout:
        word, _, rest = line.rstrip("\n").partition(" ")
        if word == "picture":
            pictures += 1
            camera.photograph(ppm_name(os.path.abspath(album.out), pictures))
            process.stdin.write("\n")
            process.stdin.flush()
            album.take(pictures)
        elif word == "columns":
            run.columns = rest.split(",")
        elif word == "frame":
            run.rows.append(rest.split(","))
            if pictures == 0:  # the board writes its own pictures
                album.take(len(run.rows))
            progress.show(len(run.rows))
        elif word == "usage":
            run.usage.append(rest.split(","))
        elif word == "hash":
            run.hash = rest
        elif word in ("world", "stack"):
            run.bytes[word] = int(rest)
        elif word == "unit":
            run.unit = rest
        else:
            print(line, end="", flush=True)
    return run


def execute(arguments, budget, album):
    with tempfile.TemporaryDirectory() as folder:
        monitor = os.path.join(folder, "qmp")
        options = ["scene=" + arguments.scene, "frames=%d" % arguments.frames] + arguments.options
        if budget:
            options.append("budget=%d" % budget)
        if arguments.pictures:
            options.append("pictures=" + album.out)
        process = subprocess.Popen(
            run_board.command(arguments.image, options, monitor),
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        try:
            emulated = "QEMU" in run_board.settings(arguments.board)
            camera = Camera(monitor) if emulated and arguments.pictures else None
            run = follow(process, camera, album, arguments.frames)
            process.stdin.close()
            return run, process.wait()
        finally:
            if process.poll() is None:
                process.kill()


def stages(run):
    return run.columns[run.columns.index("faces") + 1:run.columns.index("over")]


def write_csv(run, out, budget):
    """Write a row a frame; with a budget, whether the frame kept it."""
    columns, rows = list(run.columns), run.rows
    if budget:
        rows = [row + [int(cost <= budget)] for row, cost in zip(rows, costs(run))]
    if run.unit == "nanoseconds":
        columns = [name + "_ns" if name in stages(run) else name for name in columns]
    with open(os.path.join(out, "frames.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns + ["held"] if budget else columns)
        writer.writerows(rows)


def pictures(out):
    return sorted(glob.glob(os.path.join(out, "frame-*.png")))


def show_result(out):
    """Show the last picture, if the terminal can, and say where the rest is."""
    paths = pictures(out)
    if paths:
        terminal.show_picture(Image.open(paths[-1]))
        print("pictures: %s to %s" % (paths[0], os.path.basename(paths[-1])))
    print("a row a frame: " + os.path.join(out, "frames.csv"))


def column(run, name):
    return [int(row[run.columns.index(name)]) for row in run.rows]


def costs(run):
    """The cost of a frame: the step and, where there is a display, its picture."""
    return [sum(pair) for pair in zip(column(run, "total"), column(run, "draw"))]


def mean(values):
    return sum(values) / len(values)


def print_table(run, budget):
    print("\n%-24s %12s %12s" % (run.unit, "mean", "worst"))
    for stage in stages(run):
        values = column(run, stage)
        if stage == "draw" and not any(values):
            continue  # a board without a display
        print("  %-22s %12.0f %12d" % (stage, mean(values), max(values)))
    print("\n%-24s %12s %12s" % ("a frame", "mean", "most"))
    for name, text in (("substeps", "sub-steps"), ("hits", "hits"), ("contacts", "contacts"),
                       ("candidates", "candidates"), ("faces", "interfering faces")):
        values = column(run, name)
        print("  %-22s %12.2f %12d" % (text, mean(values), max(values)))
    print("\n%-24s %12s %12s %12s" % ("pools", "size", "peak", "refused"))
    for name, size, _, peak, refused in run.usage:
        print("  %-22s %12s %12s %12s" % (name, size, peak, refused))
    print("\n%-24s %12s" % ("bytes", "in use"))
    for name, size in run.bytes.items():
        print("  %-22s %12d" % (name, size))
    frames = len(run.rows)
    print("\nframes %d, with a contact %d" % (frames, sum(c > 0 for c in column(run, "contacts"))))
    if budget:
        held = sum(cost <= budget for cost in costs(run))
        print("frame budget %d %s, %s: held by %d of %d frames, %s"
              % (budget, run.unit, "with drawing" if any(column(run, "draw")) else "physics",
                 held, frames, "pass" if held == frames else "fail"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--board", required=True)
    parser.add_argument("--frames", type=int, required=True)
    parser.add_argument("--pictures", type=int, required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--scene", required=True)
    parser.add_argument("image")
    parser.add_argument("options", nargs="*")
    arguments = parser.parse_args()
    budget = run_board.budget(arguments.board, arguments.scene)
    out = arguments.out

    os.makedirs(out, exist_ok=True)
    for old in glob.glob(os.path.join(out, "frame-*.p[np][gm]")):
        os.remove(old)
    album = Album(out)
    run, status = execute(arguments, budget, album)
    if not run.rows:
        return status or 1
    write_csv(run, out, budget)
    if arguments.pictures:
        album.finish(os.path.basename(out))
    if status == 0:
        print_table(run, budget)
        show_result(out)
        print("hash " + run.hash)
    return status


if __name__ == "__main__":
    sys.exit(main())
