# SPDX-License-Identifier: MIT
"""Meshes of numpy arrays."""
import numpy as np

from carom._engine import ffi, lib
from carom.units import checked

KINDS = {"solid": 0, "surface": 1, "moving": 1}


class Mesh:
    """An indexed mesh, for bodies of any world; a "moving" one for one body of one world.

    vertices      n x 3: int16 quanta of 2^-quantum_bits m as they are, or metres, which are rounded to quanta
    faces         m x 3 vertex numbers, counter-clockwise from outside
    quantum_bits  7 to 20; 8 reaches 128 m
    kind          "solid" is closed; "surface" a height field; "moving" one for World.move_surface
    """

    def __init__(self, vertices, faces, quantum_bits=8, kind="solid"):
        self.quantum_bits = quantum_bits
        self.vertices = self.quanta(vertices)
        faces = np.asarray(faces)
        if np.any((faces < 0) | (faces > 65535)):
            raise ValueError("vertex numbers are 0 to 65535")
        self.faces = np.ascontiguousarray(faces, dtype=np.uint16)
        if self.vertices.ndim != 2 or self.faces.ndim != 2 or \
                self.vertices.shape[1] != 3 or self.faces.shape[1] != 3:
            raise ValueError("vertices and faces are arrays of triples")
        raw = ffi.new("struct carom_mesh_raw *", {
            "vertices": pointer("int16_t(*)[3]", self.vertices),
            "faces": pointer("uint16_t(*)[3]", self.faces),
            "vertex_count": len(self.vertices), "face_count": len(self.faces),
            "quantum_bits": quantum_bits, "kind": KINDS[kind]})
        size = lib.carom_mesh_bytes(len(self.vertices), len(self.faces))
        if kind == "moving":
            size += (12 * len(self.vertices) + 80 + 7) // 8 * 8  # as CAROM_SURFACE_BYTES
        self.block = ffi.new("uint64_t[]", size // 8)
        self.c = ffi.new("struct carom_mesh *")
        build = lib.carom_surface_build if kind == "moving" else lib.carom_mesh_build
        checked(build(self.c, raw, self.block, size))

    def quanta(self, vertices):
        """Vertices as int16 quanta."""
        vertices = np.asarray(vertices)
        if vertices.dtype != np.int16:
            vertices = np.rint(np.asarray(vertices, dtype=np.float64) * 2.0**self.quantum_bits)
            if not np.all(np.abs(vertices) <= 32767):
                raise ValueError("a vertex is out of range at %d quantum bits" % self.quantum_bits)
        return np.ascontiguousarray(vertices, dtype=np.int16)

    @property
    def volume(self):
        """Volume in cubic metres; 0 of a surface."""
        return self.c.mass.volume_q32 * 2.0**-32


def pointer(kind, array):
    """A pointer to the numbers of an array, which the caller must keep."""
    return ffi.cast(kind, ffi.from_buffer(array))
