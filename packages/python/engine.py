# SPDX-License-Identifier: MIT
"""carom._engine: the sources of Carom as a module of cffi. Its declarations are made from the headers."""
import glob
import os
import re
import shlex
import subprocess
import tempfile

from cffi import FFI

HEADERS = ["carom_version.h", "carom_body.h", "carom_joint.h", "carom_query.h"]
INCLUDES = "".join('#include "%s"\n' % header for header in HEADERS)
# Python functions that the engine calls: for carom_config.contact and carom_query_filter.wants.
CALLED = """
extern "Python" bool contact_in_python(void *user, struct carom_touch *touch);
extern "Python" bool wants_in_python(void *context, int body);
"""


def declarations():
    """The declarations of the headers, without the C library's types, assertions and bodies of inline functions."""
    with tempfile.TemporaryDirectory() as empty:
        for name in ["limits.h", "stdbool.h", "stddef.h", "stdint.h"]:
            open(os.path.join(empty, name), "w").close()
        compiler = shlex.split(os.environ.get("CC", "cc"))
        text = subprocess.run([*compiler, "-E", "-P", "-nostdinc", "-I" + empty, "-Iinclude", "-xc", "-"],
                              input=INCLUDES, stdout=subprocess.PIPE, check=True, text=True).stdout
    text = re.sub(r"^inline [^;{]*\{.*?^\}$", "", text, flags=re.M | re.S)
    text = re.sub(r"_Static_assert\(.*?\"\);", "", text, flags=re.S)
    # The C compiler counts a workspace's words: their number depends on the pointer's size
    text = re.sub(r"(\buint64_t words)\[[^\]]*\]", r"\1[...]", text)
    # cffi cannot write a pointer to an array of constants; the C compiler is told to ignore the
    # difference
    return re.sub(r"const (\w+)\s*\(\s*\*(\w+)\)\[3\]", r"\1 (*\2)[3]", text)


ffi = FFI()
ffi.cdef(declarations() + CALLED)
ffi.set_source("carom._engine", INCLUDES, include_dirs=["include"],
               sources=sorted(path for path in glob.glob("src/*/*.c") if "/draw/" not in path),
               extra_compile_args=["-std=c11", "-O2", "-Wno-incompatible-pointer-types",
                                   "-Wno-discarded-array-qualifiers"])
