#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""The window of `make view` on an X server without a screen, driven by keys and a pointer: test_window.py
[FOLDER FOR PICTURES]

The actions determine what a picture must show: a paused scene does not change a pixel, edges leave the sky on
both sides, a drag turns everything, a link leads to its own state, and the host's head.elf has the same
state.
"""
import os
import queue
import re
import subprocess
import sys
import threading
import time

from PIL import ImageChops, ImageGrab

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WINDOW = os.path.join(ROOT, "build", "host", "window.elf")
HEAD = os.path.join(ROOT, "build", "host", "head.elf")
WIDTH, HEIGHT = 1024, 720
BAR = (0xf6, 0xb2, 0x6b)  # colour of the stage boyse
PICTURES = sys.argv[1] if len(sys.argv) > 1 else None
tests = {"count": 0, "failed": 0}


def check(name, ok, seen=""):
    tests["count"] += 1
    tests["failed"] += not ok
    print("%s %d - window/%s%s" % ("ok" if ok else "not ok", tests["count"], name, "" if ok else " (%s)" % (seen,)),
          flush=True)


def until(what, seconds=30):
    """Wait until something holds; returns whether it does."""
    end = time.time() + seconds
    while time.time() < end:
        if what():
            return True
        time.sleep(0.05)
    return False


class Screen:
    """An X server of its own, with nothing else on it."""

    def __init__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x1000x24", "-noreset"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    def ask(self, *words):
        return subprocess.run(["xdotool"] + [str(word) for word in words], env=dict(os.environ, DISPLAY=self.name),
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


class Window:
    """The program, its window at the top left, and the lines that it prints."""

    def __init__(self, screen, *options, command=(WINDOW,)):
        self.screen = screen
        alone = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
        self.program = subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True,
                                        env=dict(alone, DISPLAY=screen.name))
        self.lines = queue.Queue()
        threading.Thread(target=lambda: [self.lines.put(line) for line in self.program.stdout], daemon=True).start()
        until(self.settles, 60)

    def settles(self):
        """Find the window, move it to the top left and give it the keys; returns whether all of that worked."""
        self.id = self.screen.ask("search", "--onlyvisible", "--name", "^Carom:").split("\n")[-1]
        if not self.id:
            return False
        self.screen.ask("windowmove", self.id, 0, 0, "mousemove", 5, HEIGHT - 5, "windowfocus", self.id)
        return ("Position: 0,0 " in self.screen.ask("getwindowgeometry", self.id) and
                self.screen.ask("getwindowfocus") == self.id)

    def state(self):
        """Link, frame and hash. The program prints them after all earlier keys and moves are done."""
        self.screen.ask("key", "k")
        found = self.says(r"link (\S+)/(\d+)/([0-9a-f]{16})$")
        return found.group(1), int(found.group(2)), found.group(3)

    def shown(self):
        """Wait until the last action is in the picture, which is drawn between two answers."""
        self.state()
        time.sleep(0.1)
        self.state()

    def press(self, *keys):
        for key in keys:
            self.screen.ask("key", key)
        self.shown()

    def move(self, *way, button=1):
        """Move the pointer along places, with a button held."""
        self.screen.ask("mousemove", *way[0], "mousedown", button)
        for place in way[1:]:
            self.shown()
            self.screen.ask("mousemove", *place)
        self.shown()
        self.screen.ask("mouseup", button)
        self.shown()

    def picture(self, name=None, width=WIDTH, height=HEIGHT):
        image = ImageGrab.grab(bbox=(0, 0, width, height), xdisplay=self.screen.name).convert("RGB")
        if PICTURES and name:
            image.save(os.path.join(PICTURES, name + ".png"))
        return image

    def says(self, pattern):
        """The next line that matches."""
        end = time.time() + 40
        while time.time() < end:
            try:
                found = re.match(pattern, self.lines.get(timeout=1))
            except queue.Empty:
                continue
            if found:
                return found
        return None

    def title(self):
        return self.screen.ask("getwindowname", self.id)

    def close(self):
        self.screen.ask("key", "Escape")
        try:
            return self.program.wait(10)
        except subprocess.TimeoutExpired:
            self.program.kill()
            return None


def changed(a, b):
    """The part of the pixels that differ."""
    grey = ImageChops.difference(a, b).convert("L").point(lambda v: 255 if v else 0)
    return grey.histogram()[255] / (a.width * a.height)


def thin(image):
    """The number of pixels with the sky's colour, which is the same along a row, on both sides: edges before
    the sky."""
    pixels, count = image.load(), 0
    for y in range(2, image.height, 3):
        sky = pixels[0, y]
        count += sum(pixels[x, y] != sky and pixels[x - 1, y] == sky and pixels[x + 1, y] == sky
                     for x in range(1, image.width - 1))
    return count


def of_colour(image, wanted, box=None):
    image = image.crop(box) if box else image
    return sum(count for count, colour in image.getcolors(1 << 24) if wanted(*colour))


def brown(red, green, blue):
    """The moving bodies, by their default ramp."""
    return red > green + 16 and green >= blue


def middle_of(image):
    pixels, places = image.load(), []
    for y in range(0, image.height, 2):
        places += [(x, y) for x in range(0, image.width, 2) if brown(*pixels[x, y])]
    return tuple(sum(each) // max(len(places), 1) for each in zip(*places)) if places else None


def state_on_host(scene, frames):
    said = subprocess.run([HEAD, "scene=" + scene, "frames=%d" % frames], stdout=subprocess.PIPE, text=True).stdout
    return re.search(r"^hash ([0-9a-f]{16})$", said, re.M).group(1)


def scenes_on_host():
    said = subprocess.run([HEAD, "scenes=1"], stdout=subprocess.PIPE, text=True).stdout
    return [name for name in re.findall(r"^scene ([^:]+):", said, re.M) if name != "user"]


def no_display():
    gone = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
    for which, driver in (("", {}), ("_of_x", {"SDL_VIDEODRIVER": "x11"})):
        run = subprocess.run(["timeout", "20", WINDOW], env=dict(gone, **driver), stderr=subprocess.PIPE, text=True)
        check("no_display%s_is_said" % which, run.returncode == 1 and "no display" in run.stderr, (run.returncode, run.stderr))


def pause_and_look(screen):
    window = Window(screen, "scene=head")
    check("opens", "head" in window.title() and until(lambda: of_colour(window.picture(), brown) > 500), window.title())
    # from the first frame: when the window opens late, the head may already lie still
    window.press("t", "space", "r")
    before = window.picture()
    window.press("space")
    check("goes_on", until(lambda: changed(before, window.picture()) > 0.001))
    window.press("space")
    still = window.picture("head")
    time.sleep(0.5)
    check("space_stops_it", changed(still, window.picture()) == 0)
    _, frame, state = window.state()
    check("state_is_the_hosts", state == state_on_host("head", frame), (frame, state))
    window.press("s", "s", "s")
    _, later, _ = window.state()
    check("s_is_a_step", later == frame + 3, (frame, later))
    still = window.picture()
    window.press("w")
    wire = window.picture("wire")
    check("w_shows_edges", thin(wire) > 3 * thin(still) + 100, (thin(still), thin(wire)))
    window.press("w", "b")
    bars = [of_colour(image, lambda *c: c == BAR, (0, HEIGHT // 2, WIDTH // 2, HEIGHT))
            for image in (still, window.picture("bars"))]
    check("b_shows_bars", bars[0] == 0 and bars[1] > 0, bars)
    window.press("b", "h")
    white = [of_colour(image, lambda *c: c == (255, 255, 255), (WIDTH // 4, HEIGHT // 4, WIDTH * 3 // 4, HEIGHT * 3 // 4))
             for image in (still, window.picture("help"))]
    check("h_shows_help", white[0] < 100 and white[1] > 3000, white)
    window.press("h")
    check("and_all_is_gone_again", changed(still, window.picture()) == 0)
    window.move((60, 60), (160, 60), (300, 90))
    turned = window.picture("turned")
    check("a_drag_turns_it", changed(still, turned) > 0.2, changed(still, turned))
    window.press("Home")
    check("home_turns_it_back", changed(still, window.picture()) == 0)
    screen.ask("click", "--repeat", 4, 4)
    window.shown()
    sizes = [of_colour(image, brown) for image in (still, window.picture("near"))]
    check("the_wheel_goes_nearer", sizes[1] > 1.5 * sizes[0], sizes)
    window.press("Home")
    window.move((60, 60), (60, 160), button=3)
    places = [middle_of(image) for image in (still, window.picture("aside"))]
    check("right_drag_moves_it", abs(places[1][1] - places[0][1] - 100) < 30, places)
    check("escape_leaves", window.close() == 0)


def scenes_and_size(screen):
    window = Window(screen, "scene=box")
    names = scenes_on_host()
    place = names.index("box")
    window.press("n")
    check("n_is_the_next_scene", "Carom: %s - " % names[place + 1] in window.title(), window.title())
    window.press("p", "p")
    check("p_is_the_one_before", "Carom: %s - " % names[place - 1] in window.title(), window.title())
    screen.ask("windowsize", "--sync", window.id, 1300, 900)
    check("a_larger_window_is_full", until(lambda: window.picture(None, 1300, 900).getpixel((1290, 890)) != (0, 0, 0)))
    window.shown()
    window.picture("large", 1300, 900)
    window.press("r", "minus", "minus", "minus", "minus", "minus")
    _, slow, _ = window.state()
    start = time.time()
    until(lambda: window.state()[1] >= slow + 3)
    # 60 frames a second at most; a 32nd of that is 2
    check("minus_is_slow", window.state()[1] - slow < 4 * (time.time() - start) + 2, (slow, time.time() - start))
    window.close()


def throw(screen):
    window = Window(screen, "scene=box")
    window.press("t")
    check("box_lands", until(lambda: window.state()[1] > 150, 60))
    before = window.picture()
    x, y = middle_of(before)
    window.move((x, y), (x - 20, y - 30), (x - 50, y - 45), (x - 80, y - 60), (x - 110, y - 60))
    ends = window.state()[1] + 60
    until(lambda: window.state()[1] > ends)
    window.press("space")
    after = window.picture("thrown")
    link, frame, state = window.state()
    ends = middle_of(after)
    check("a_hand_throws", ends and abs(ends[0] - x) > 40, ((x, y), ends))
    check("it_is_not_the_hosts_state", state != state_on_host("box", frame), state)
    check("the_link_has_it", "~" in link, link)
    window.close()
    window = Window(screen, "link=%s/%d/%s" % (link, frame, state))
    said = window.says(r"frame %d: (\w+) is the hash of the link$" % frame)
    check("who_follows_comes_to_the_same", said and said.group(1) == state, said)
    window.press("t")
    check("and_sees_the_same", until(lambda: changed(after, window.picture()) == 0, 10), changed(after, window.picture()))
    window.close()
    run = subprocess.run([WINDOW, "link=" + link[:-1]], env=dict(os.environ, DISPLAY=screen.name), stderr=subprocess.PIPE,
                         stdout=subprocess.PIPE, text=True, timeout=30)
    check("a_cut_link_is_refused", run.returncode == 1 and run.stderr.startswith("link:"), run.stderr)


def toggles(screen):
    """Contacts are yellow and red, leaves have many colours, cells are cyan, on bodies that lie there and
    sleep or nearly so."""
    window = Window(screen, "scene=pile")
    check("pile_lies", until(lambda: window.state()[1] > 90, 60))
    window.press("t", "space")
    plain = window.picture("pile")
    for key, name, wanted in [("c", "contacts", lambda r, g, b: (r > 240 and g > 220 and b < 60) or (r > 220 and g < 40 and b < 40)),
                              ("g", "cells", lambda r, g, b: r < 80 and g > 200 and b > 200),
                              ("l", "leaves", lambda r, g, b: b > r + 40 and b > g + 10)]:
        window.press(key)
        counts = [of_colour(image, wanted, (0, HEIGHT // 3, WIDTH, HEIGHT)) for image in (plain, window.picture(name))]
        check("%s_shows_%s" % (key, name), counts[1] > counts[0] + 100, counts)
        window.press(key)
    window.press("d")
    lights = [sum(i * n for i, n in enumerate(image.convert("L").histogram())) for image in (plain, window.picture("bright"))]
    check("without_shadows_it_is_lighter", lights[1] > lights[0], lights)
    window.press("d")
    check("toggles_leave_nothing", changed(plain, window.picture()) == 0)
    window.close()


def game(screen):
    window = Window(screen, "SCENE=car", command=("make", "-C", ROOT, "view"))
    screen.ask("keydown", "Up")
    window.shown()
    screen.ask("keyup", "Up")
    window.picture("car")
    window.press("space")
    link, frame, state = window.state()
    check("the_pad_drives", "~" in link and state != state_on_host("car", frame), link)
    check("make_view_ends_well", window.close() == 0)


def main():
    no_display()
    screen = Screen()
    try:
        for part in (pause_and_look, scenes_and_size, throw, toggles, game):
            part(screen)
    finally:
        screen.close()
    print("1..%d" % tests["count"])
    return 1 if tests["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
