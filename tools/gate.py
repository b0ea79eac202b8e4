# SPDX-License-Identifier: MIT
"""The common parts of the gates tools/check_*: the files, the layer order, the compilers, the verdict."""
import concurrent.futures
import glob
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
os.chdir(ROOT)

# The folders of src/, a stage each; each may use only those before it.
STAGES = "num mesh body pairs interfere boyse contact solve world step query replay draw".split()
# draw is a library of its own: of other folders than these it uses only what the public headers
# declare.
ALONE = {"draw": ["num", "mesh"]}

PUBLIC = ["include/carom.h", "include/carom_mesh.h", "include/carom_memory.h",
          "include/carom_body.h", "include/carom_joint.h", "include/carom_query.h",
          "include/carom_draw.h", "include/carom_debug.h", "include/carom_shapes.h",
          "include/carom_replay.h", "include/carom_version.h"]

WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Werror".split()
ENGINE_FLAGS = ["-std=c11", "-ffreestanding", "-Iinclude"]
# the processor and the call graphs that check_stack reads; other gates take the same objects
CORTEX_M3 = ["-mcpu=cortex-m3", "-mthumb", "-fcallgraph-info=su"]
JOBS = os.cpu_count() or 1


def need(*things):
    """Install what a gate needs and the machine lacks."""
    if subprocess.run(["tools/need", *things]).returncode:
        sys.exit("cannot install what this gate needs")


def output(command):
    """The output of a command; a command that fails ends the gate."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode:
        sys.exit("%s\nfailed: %s" % (done.stdout.strip(), " ".join(command)))
    return done.stdout


def complaints(commands):
    """Run commands side by side; returns the output of those that failed, in order."""
    def run(command):
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        return "%s\n%s" % (" ".join(command), done.stdout.strip()) if done.returncode else None

    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        return [text for text in pool.map(run, commands) if text]


def sources(*suffixes):
    """Files that git tracks, or would track, whose names end in one of the suffixes."""
    listed = output(["git", "ls-files", "--cached", "--others", "--exclude-standard"])
    return [path for path in listed.split("\n") if path.endswith(suffixes) and os.path.isfile(path)]


def read(path):
    """The text of a file, or nothing if there is none."""
    if not os.path.exists(path):
        return ""
    with open(path) as file:
        return file.read()


def engine():
    return sorted(glob.glob("src/*/*.c"))


def objects(folder, compiler, flags):
    """Compile the engine into build/check/FOLDER, or take what another gate made of the same; returns the paths of source and
    object."""
    folder = os.path.join("build/check", folder)
    record = folder + "/made_of"
    command = [compiler, *ENGINE_FLAGS, *flags]
    ages = ["%s %d" % (path, os.stat(path).st_mtime_ns)
            for path in sorted(glob.glob("src/*/*.[ch]") + glob.glob("include/*.h"))]
    made_of = "\n".join([" ".join(command), *ages])
    pairs = [(path, "%s/%s.o" % (folder, os.path.basename(path)[:-2])) for path in engine()]
    if read(record) == made_of:
        return pairs
    os.makedirs(folder, exist_ok=True)
    for old in glob.glob(folder + "/*"):
        os.remove(old)
    failed = complaints([[*command, "-c", path, "-o", made] for path, made in pairs])
    if failed:
        sys.exit("\n".join(failed))
    with open(record, "w") as file:
        file.write(made_of)
    return pairs


def sections(made):
    """Bytes of text, rodata, data and bss of objects for Arm, all together."""
    total = dict.fromkeys([".text", ".rodata", ".data", ".bss"], 0)
    for path in made:
        for name, size in re.findall(r"^(\.\w+)\S*\s+(\d+)",
                                     output(["arm-none-eabi-size", "-A", path]), re.M):
            if name in total:
                total[name] += int(size)
    return total.values()


def stage(path):
    """The stage of a source or header: the folder of src/ that it is in, or None."""
    parts = os.path.normpath(path).split(os.sep)
    return parts[1] if len(parts) == 3 and parts[0] == "src" and parts[1] in STAGES else None


def included(path, name):
    """The file of the engine that `path` includes as "name", or None."""
    for folder in (os.path.dirname(path), "include"):
        found = os.path.normpath(os.path.join(folder, name))
        if os.path.isfile(found) and found.split(os.sep)[0] in ("src", "include"):
            return found
    return None


def code(text):
    """A C text with comments and strings blanked out; lines keep their numbers."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())

    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def public_functions():
    """The header and name of each function that the public headers declare, in their order."""
    found = []
    for header in PUBLIC:
        with open(header) as file:
            names = re.findall(r"^(?!typedef )[a-z][\w \*]*?\b(carom_\w+)\(", code(file.read()), re.M)
        found += [(header, name) for name in names]
    return found


def version():
    """The version that carom_version.h states, as in 0.9.0."""
    with open("include/carom_version.h") as file:
        return ".".join(re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", file.read(), re.M))


def finish(failures, verdict):
    """Print the failures and end the gate; its last line begins with "pass:" if there are none."""
    for failure in failures:
        print("FAIL " + failure)
    print("%d failures" % len(failures) if failures else "pass: " + verdict)
    sys.exit(bool(failures))
