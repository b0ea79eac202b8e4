# SPDX-License-Identifier: MIT
"""Carom: rigid bodies of any triangle mesh, computed in integers, the same bits everywhere.

Arguments and results are in metres, seconds, kilograms and radians. A number is truncated to its fixed-point format, as by
the macros of carom_fix.h; vertices are rounded to quanta. `lib` and `ffi` are the whole C interface except drawing.
"""
from carom._engine import ffi, lib
from carom.mesh import Mesh
from carom.units import CaromError
from carom.world import Contact, Event, RayHit, World

VERSION = "%d.%d.%d" % (lib.carom_version() // 10000, lib.carom_version() // 100 % 100, lib.carom_version() % 100)
__all__ = ["CaromError", "Contact", "Event", "Mesh", "RayHit", "VERSION", "World", "ffi", "lib"]
