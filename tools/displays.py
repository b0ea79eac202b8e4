#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Play a scene on every emulated board that has a display of its own, and put a picture of each side by side into
docs/displays.png."""
import os
import subprocess

from PIL import Image, ImageDraw

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FRAMES = 24  # the head is about to hit the field, its face to the camera
GAP, CAPTION = 8, 14  # pixels
# board, scene, width of its picture on the sheet, caption
ROWS = (
    (("riscv32", "head", 320, "RISC-V"), ("psx", "head", 320, "PlayStation"), ("nds", "head", 256, "Nintendo DS")),
    (("pico", "head450", 240, "Raspberry Pi Pico"), ("gba", "head450", 240, "Game Boy Advance"),
     ("lm3s6965evb", "head100", 384, "Cortex-M3, OLED of 16 greys")),
)


def picture(board, scene, width):
    subprocess.run(["make", "-s", "run", "BOARD=" + board, "SCENE=" + scene, "FRAMES=%d" % FRAMES, "PICTURES=1"],
                   cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    with Image.open(os.path.join(ROOT, "out", scene, "frame-%04d.png" % FRAMES)) as image:
        return image.convert("RGB").resize((width, image.height * width // image.width), Image.NEAREST)


def main():
    rows = [[(picture(*what), text) for *what, text in row] for row in ROWS]
    width = max(sum(image.width + GAP for image, _ in row) - GAP for row in rows)
    height = sum(max(image.height for image, _ in row) + CAPTION + GAP for row in rows) - GAP
    sheet = Image.new("RGB", (width, height), "white")
    draw, y = ImageDraw.Draw(sheet), 0
    for row in rows:
        x = 0
        for image, text in row:
            sheet.paste(image, (x, y))
            draw.text((x, y + image.height + 1), text, fill="black")
            x += image.width + GAP
        y += max(image.height for image, _ in row) + CAPTION + GAP
    sheet.quantize(128, method=Image.MEDIANCUT, dither=Image.NONE).save(
        os.path.join(ROOT, "docs", "displays.png"), optimize=True)


if __name__ == "__main__":
    main()
