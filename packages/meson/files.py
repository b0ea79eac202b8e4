#!/usr/bin/python3 -B
# SPDX-License-Identifier: MIT
"""Print the files of a pattern in the repository, a line each, without those of a second pattern."""
import glob
import os
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
found = set(glob.glob(sys.argv[1]))
for other in sys.argv[2:]:
    found -= set(glob.glob(other))
print("\n".join(sorted(found)))
