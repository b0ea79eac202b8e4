#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Run a PlayStation program in pcsxr, without a window: psx_run IMAGE.elf [ARGUMENT...]

make puts this into build/tools, beside tools/psx_plugin.c and tools/psx_preload.c as libraries. pcsxr has its own BIOS and gets
its own folder for files. The program is the .exe file beside the .elf; the arguments are written into the room that
port/psx/start.S leaves for them. The lines that the program prints go to stdout; its exit status is passed on. Two arguments
are also for the plugin, which describes them: pictures=DIRECTORY and press=N:KEYS,...
"""
import os
import select
import shutil
import subprocess
import sys
import tempfile

EMULATOR = "/usr/games/pcsxr"
SOUND, DISC, SERIAL = "libDFSound.so", "libDFCdrom.so", "libBladeSio1.so"
HERE = os.path.dirname(os.path.abspath(__file__))
PLUGIN, PRELOAD = os.path.join(HERE, "psx_plugin.so"), os.path.join(HERE, "psx_preload.so")
HEAD, ARGUMENTS_AT, ARGUMENTS_BYTES = 2048, 16, 256
LINE, STATUS = " * \x02", " * \x03"  # pcsxr's output for the bytes that begin a line of
                                     # port/psx/psx.c
SILENT_SECONDS, NEVER_ENDED = 120, 124

INTERPRETER = 1
CONFIGURATION = """Bios = HLE
BiosDir = %(home)s
PluginsDir = %(plugins)s
Gpu = %(plugin)s
Pad1 = %(plugin)s
Pad2 = %(plugin)s
Spu = %(sound)s
Cdr = %(disc)s
Sio1 = %(serial)s
Net = Disabled
Cpu = %(cpu)d
NoMemcard = 1
"""


def die(what):
    sys.exit("psx_run: " + what)


def program(image, arguments):
    """The bytes of the .exe with the arguments in it, each ended by a space."""
    with open(image.removesuffix(".elf") + ".exe", "rb") as file:
        code = bytearray(file.read())
    text = "".join(argument + " " for argument in [image, *arguments]).encode()
    if len(text) >= ARGUMENTS_BYTES:
        die("the arguments are too long")
    at = HEAD + ARGUMENTS_AT
    if any(code[at:at + ARGUMENTS_BYTES]):
        die(image + " has no room for arguments")
    code[at:at + len(text)] = text
    return code


def prepare(home, image, arguments):
    """Fill pcsxr's folder; returns the path of the program."""
    plugins = os.path.join(home, ".pcsxr", "plugins")
    os.makedirs(plugins)
    shutil.copy(PLUGIN, plugins)
    with open(os.path.join(home, ".pcsxr", "pcsxr.cfg"), "w") as file:
        file.write(CONFIGURATION % {
            "home": home, "plugins": plugins, "plugin": os.path.basename(PLUGIN), "sound": SOUND,
            "disc": DISC, "serial": SERIAL, "cpu": INTERPRETER})
    path = os.path.join(home, "program.exe")
    with open(path, "wb") as file:
        file.write(program(image, arguments))
    return path


def environment(home, arguments):
    """The environment of pcsxr: its home, no display, orders for the plugin."""
    new = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    new["HOME"], new["LD_PRELOAD"] = home, PRELOAD
    for argument in arguments:
        name, is_option, value = argument.partition("=")
        if is_option and name in ("pictures", "press"):
            new["PSX_" + name.upper()] = os.path.abspath(value) if name == "pictures" else value
    return new


def follow(process):
    """Pass on the program's output; returns its exit status, or None without one."""
    rest = b""
    while select.select([process.stdout], [], [], SILENT_SECONDS)[0]:
        some = os.read(process.stdout.fileno(), 65536)
        if not some:
            return None
        *lines, rest = (rest + some).split(b"\n")
        for line in lines:
            text = line.decode(errors="replace")
            if text.startswith(LINE):
                print(text.removeprefix(LINE), flush=True)
            elif text.startswith(STATUS):
                return int(text.removeprefix(STATUS))
    print("psx_run: it has said nothing for %d seconds" % SILENT_SECONDS, file=sys.stderr)
    return None


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    image, arguments = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory(prefix="pcsxr-", dir=os.path.dirname(os.path.abspath(image))) as home:
        path = prepare(home, image, arguments)
        log = os.path.join(home, "log")
        with open(log, "w") as errors, subprocess.Popen(
                [EMULATOR, "-nogui", "-psxout", "-cfg", "pcsxr.cfg", path], stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=errors, env=environment(home, arguments)) as process:
            try:
                status = follow(process)
            finally:
                process.kill()
        if status is None:
            with open(log) as file:
                print(file.read()[-2000:], file=sys.stderr)
            return NEVER_ENDED
    return status


if __name__ == "__main__":
    sys.exit(main())
