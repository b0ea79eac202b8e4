# SPDX-License-Identifier: MIT
"""The parts that pyproject.toml cannot state: the version, which include/carom_version.h has, and the engine."""
import re

from setuptools import setup

with open("include/carom_version.h") as file:
    parts = re.findall(r"^#define CAROM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", file.read(), re.M)
setup(version=".".join(parts), cffi_modules=["engine.py:ffi"])
