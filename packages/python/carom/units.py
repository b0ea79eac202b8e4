# SPDX-License-Identifier: MIT
"""Conversion between the fixed-point numbers of Carom and those of Python; errors."""
import numpy as np

from carom._engine import ffi, lib

# The fractional bits of a format, and the power of seconds in its unit: 1 for a value per second, 2 for one per
# second squared.
POSITION = 32, 0
UNIT = 30, 0  # rotations, unit vectors, restitution, parts of a way
FRICTION = 16, 0
MASS = 20, 0
GAP = 22, 0
VELOCITY = 40, 1  # and spins, impulses, damping by speed
ACCELERATION = 40, 2  # and forces, torques, stiffness


class CaromError(Exception):
    """A negative result of Carom: `code` is an enum carom_error."""

    def __init__(self, code):
        super().__init__(ffi.string(lib.carom_result_text(code)).decode())
        self.code = code


def checked(result):
    """Return the result of a call, or raise its error."""
    if result < 0:
        raise CaromError(result)
    return result


def fixed(value, kind, fps=1):
    """An SI number, or several, as integers of a format, truncated towards zero."""
    bits, per = kind
    if np.ndim(value):
        return [fixed(each, kind, fps) for each in value]
    return int(float(value) * 2.0**bits / float(fps) ** per)


def real(value, kind, fps=1):
    """Integers of a format in SI, as float64."""
    bits, per = kind
    return np.asarray(value) * (2.0**-bits * float(fps) ** per)
