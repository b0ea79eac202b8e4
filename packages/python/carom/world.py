# SPDX-License-Identifier: MIT
"""A world: bodies, steps, and the results of the last step."""
from typing import NamedTuple

import numpy as np

from carom._engine import ffi, lib
from carom.mesh import pointer
from carom.units import (ACCELERATION, FRICTION, GAP, MASS, POSITION, UNIT, VELOCITY, CaromError, checked, fixed,
                         real)

EVENTS = ["begin", "hit", "end", "rest", "out", "wake", "cut", "sensor_begin", "sensor_end", "break", "blocked"]
JOINTS = ["ball", "hinge", "slider", "distance", "fixed"]
ONE_WAY = ["both", "x", "y", "z", "-x", "-y", "-z"]
OVERLAP = ["refuse", "push_out", "pass"]
BACK, SENSORS = 1, 2

BODY = {  # numeric fields of a body's definition and state: the C name and the format
    "position": ("position", POSITION), "rotation": ("rotation", UNIT), "velocity": ("velocity", VELOCITY),
    "spin": ("spin", VELOCITY), "mass": ("mass_q20", MASS), "restitution": ("restitution_q30", UNIT),
    "friction": ("friction_q16", FRICTION),
}
DRIVE = {
    "lower": ("lower_q32", POSITION), "upper": ("upper_q32", POSITION), "rest": ("rest_q32", POSITION),
    "motor_speed": ("motor_speed_q40", VELOCITY), "motor_most": ("motor_most_q40", ACCELERATION),
    "stiffness": ("stiffness_q40", ACCELERATION), "damping": ("damping_q40", VELOCITY),
}


class Event(NamedTuple):
    """speed, m/s, impulse, N s, point, normal and faces belong to a hit; the last three are None if there was no room."""
    kind: str
    a: int
    b: int
    speed: float
    impulse: float
    point: object = None
    normal: object = None
    faces: object = None


class Contact(NamedTuple):
    """A contact of the last solve; the normal is from b into a."""
    a: int
    b: int
    point: object
    normal: object
    gap: float
    impulse: float


class RayHit(NamedTuple):
    """A face that a ray met, at part t of its way."""
    body: int
    face: int
    t: float
    point: object
    normal: object


class Poses(NamedTuple):
    """Rows by body number; NaN, or 0 in integers, for free numbers."""
    position: object
    rotation: object
    velocity: object
    spin: object


def capacities(bodies, given):
    """The given capacities; the others follow from the number of bodies."""
    return {"bodies": bodies, "pairs": min(8 * bodies, 65535), "contacts": min(16 * bodies + 16, 4096),
            "faces": min(64 * bodies + 1024, 65535), "entries": 0, "candidates": min(256 * bodies + 1024, 65535),
            "joints": 0, "extras": bodies, "hits": bodies, **given}


class World:
    """A world in a block of its own.

    bodies   how many it can hold; other capacities of carom_memory.h may be given by name
    gravity  m/s^2
    contact  a function of a struct carom_touch * that is asked about each contact; False drops it
    """

    def __init__(self, bodies, fps=60, gravity=(0, 0, -9.81), sleep=True, contact=None, substep_cap=0,
                 sweep_cap=0, **given):
        self.fps = fps
        self.contact = contact
        self.failed = None  # an exception of `contact` or `wants`, which C cannot pass on
        self.meshes = {}    # by body; they are kept because the world refers to them
        self.handle = ffi.new_handle(self)
        self.caps = capacities(bodies, given)
        config = ffi.new("struct carom_config *", {
            "caps": self.caps, "gravity": [fixed(gravity, ACCELERATION, fps)], "sleep": sleep,
            "substep_cap": substep_cap, "sweep_cap": sweep_cap,
            "contact": lib.contact_in_python if contact else ffi.NULL, "contact_user": self.handle})
        size = lib.carom_world_bytes(ffi.addressof(config, "caps"))
        self.block = ffi.new("uint64_t[]", size // 8)
        out = ffi.new("struct carom_world **")
        checked(lib.carom_world_init(self.block, size, config, out))
        self.c = out[0]
        self.state = ffi.new("struct carom_body_state *")

    def call(self, name, *given):
        """Call a function of the C interface whose first argument is the world."""
        result = checked(getattr(lib, name)(self.c, *given))
        if self.failed:
            failed, self.failed = self.failed, None
            raise failed
        return result

    def _fill(self, struct, fields, values):
        for name, value in values.items():
            field, kind = fields.get(name, (name, None))
            if kind is None:
                setattr(struct, field, value)
            elif np.ndim(value):
                getattr(struct, field).c = fixed(value, kind, self.fps)
            else:
                setattr(struct, field, fixed(value, kind, self.fps))

    def _vector(self, kind, values, format_):
        return ffi.new(kind + " *", [fixed(values, format_, self.fps)])

    # ---------------------------------------------------------------- bodies

    def add(self, mesh, one_way="both", overlap="refuse", filter=None, **values):
        """Add a body; returns its number. Values are the fields of struct carom_body_def in SI, without
        format suffixes."""
        definition = ffi.new("struct carom_body_def *", {
            "mesh": mesh.c, "one_way": ONE_WAY.index(one_way), "overlap": OVERLAP.index(overlap),
            "filter": filter or {}})
        self._fill(definition, BODY, values)
        body = self.call("carom_body_add", definition)
        self.meshes[body] = mesh
        return body

    def remove(self, body):
        self.call("carom_body_remove", body)
        self.meshes.pop(lib.carom_body_number(body))

    def get(self, body):
        """The struct carom_body_state of a body: integers."""
        self.call("carom_body_get", body, self.state)
        return self.state

    def asleep(self, body):
        return self.get(body).asleep

    def set(self, body, overlap="refuse", **values):
        """Place a body and wake it: position, rotation, velocity, spin; missing ones stay as they are."""
        state = self.get(body)
        self._fill(state, BODY, values)
        state.overlap = OVERLAP.index(overlap)
        self.call("carom_body_set", body, state)

    def move_to(self, body, position, rotation=(0, 0, 0, 0)):
        """Lead a kinematic body: it is there at the end of the next step."""
        pose = ffi.new("struct carom_pose *")
        self._fill(pose, BODY, {"position": position, "rotation": rotation})
        self.call("carom_body_move_to", body, pose)

    def push(self, body, impulse, point=None):
        """An impulse at once, N s, at a point of the world or through the centre of mass."""
        given = self._vector("carom_v3_q40", impulse, VELOCITY)
        if point is None:
            self.call("carom_body_push_centre", body, given)
        else:
            self.call("carom_body_push", body, given, self._vector("carom_v3_q32", point, POSITION))

    def set_force(self, body, force):
        """A force through the centre of mass until it is changed, N."""
        self.call("carom_body_set_force", body, self._vector("carom_v3_q40", force, ACCELERATION))

    def set_gravity(self, gravity):
        self.call("carom_world_set_gravity", self._vector("carom_v3_q40", gravity, ACCELERATION))

    def move_surface(self, body, vertices):
        """New vertices for the body's "moving" mesh, from the next step on."""
        mesh = self.meshes[body]
        places = mesh.quanta(vertices)
        if places.shape != mesh.vertices.shape:
            raise ValueError("vertices are %s" % (mesh.vertices.shape,))
        self.call("carom_surface_move", body, pointer("int16_t(*)[3]", places))

    # ------------------------------------------------------------------ poses

    def raw_poses(self):
        """Places and motions of all bodies, in Carom's integers: int64, and int32 for rotations."""
        count = lib.carom_body_count(self.c)
        poses = Poses(np.zeros((count, 3), np.int64), np.zeros((count, 4), np.int32),
                      np.zeros((count, 3), np.int64), np.zeros((count, 3), np.int64))
        for body in self.meshes:
            state = self.get(body)
            poses.position[body] = list(state.position.c)
            poses.rotation[body] = list(state.rotation.c)
            poses.velocity[body] = list(state.velocity.c)
            poses.spin[body] = list(state.spin.c)
        return poses

    def poses(self):
        """The same as float64: metres, quaternions w x y z, m/s and radians a second."""
        raw = self.raw_poses()
        kinds = [POSITION, UNIT, VELOCITY, VELOCITY]
        poses = Poses(*(real(rows, kind, self.fps) for rows, kind in zip(raw, kinds)))
        free = [body for body in range(len(raw.position)) if body not in self.meshes]
        for rows in poses:
            rows[free] = np.nan
        return poses

    def matrices(self):
        """From the axes of each body's mesh to the world's: n x 4 x 4, float64."""
        found = np.full((lib.carom_body_count(self.c), 4, 4), np.nan)
        matrix = ffi.new("struct carom_matrix *")
        for body in self.meshes:
            self.call("carom_body_matrix", body, matrix)
            found[body] = np.eye(4)
            found[body, :3, :3] = real([list(row) for row in matrix.r.c], UNIT)
            found[body, :3, 3] = real(list(matrix.origin.c), POSITION)
        return found

    # ------------------------------------------------------------------ steps

    def step(self):
        """One frame: 0, or a sum of enum carom_status."""
        return self.call("carom_world_step")

    def events(self):
        first = ffi.new("struct carom_event **")
        return [self._event(first[0] + i) for i in range(self.call("carom_events", first))]

    def _event(self, event):
        found = Event(EVENTS[event.kind], event.a, event.b, float(real(event.speed_q40, VELOCITY, self.fps)),
                      float(real(event.impulse_q40, VELOCITY, self.fps)))
        if event.details == 0:
            return found
        hit = ffi.new("struct carom_hit *")
        self.call("carom_event_hit", event, hit)
        return found._replace(point=real(list(hit.point.c), POSITION), normal=real(list(hit.normal.c), UNIT),
                              faces=(hit.face_a, hit.face_b))

    def contacts(self):
        room = ffi.new("struct carom_contact[]", self.caps["contacts"])
        count = self.call("carom_contacts", room, self.caps["contacts"])
        return [Contact(c.a, c.b, real(list(c.point.c), POSITION), real(list(c.normal.c), UNIT),
                        float(real(c.gap_q22, GAP)), float(real(c.impulse_q40, VELOCITY, self.fps)))
                for c in room[0:count]]

    def cast_ray(self, start, way, mask=0, back=False, sensors=False, wants=None):
        """The first face that a ray meets, or None. wants(body) chooses bodies."""
        ray = ffi.new("struct carom_ray *")
        self._fill(ray, {"start": ("from", POSITION), "way": ("way", POSITION)}, {"start": start, "way": way})
        self.wants = wants
        chosen = ffi.new("struct carom_query_filter *", {
            "mask": mask, "flags": (BACK if back else 0) + (SENSORS if sensors else 0),
            "wants": lib.wants_in_python if wants else ffi.NULL, "context": self.handle})
        hit = ffi.new("struct carom_ray_hit *")
        if self.call("carom_cast_ray", ray, chosen, hit) == 0:
            return None
        return RayHit(hit.body, hit.face, float(real(hit.t_q30, UNIT)), real(list(hit.point.c), POSITION),
                      real(list(hit.normal.c), UNIT))

    # ----------------------------------------------------------------- joints

    def add_joint(self, kind, a, anchor, b=-1, anchor_b=(0, 0, 0), axis=(0, 0, 0), touch=False, most_impulse=0,
                  **drive):
        """Add a joint; returns its number. The drive is struct carom_joint_drive in SI, without format
        suffixes."""
        definition = ffi.new("struct carom_joint_def *", {"kind": JOINTS.index(kind), "touch": touch, "a": a, "b": b})
        fields = {"anchor": ("anchor", POSITION), "anchor_b": ("anchor_b", POSITION), "axis": ("axis", UNIT),
                  "most_impulse": ("most_impulse_q40", VELOCITY)}
        self._fill(definition, fields, {"anchor": anchor, "anchor_b": anchor_b, "axis": axis,
                                        "most_impulse": most_impulse})
        self._fill(definition.drive, DRIVE, drive)
        return self.call("carom_joint_add", definition)

    def drive_joint(self, joint, **drive):
        given = ffi.new("struct carom_joint_drive *")
        self._fill(given, DRIVE, drive)
        self.call("carom_joint_set", joint, given)

    def joint(self, joint):
        """The coordinate of a joint, m or rad, and its change a second."""
        state = ffi.new("struct carom_joint_state *")
        self.call("carom_joint_get", joint, state)
        return (float(real(state.coordinate_q32, POSITION)), float(real(state.speed_q40, VELOCITY, self.fps)))

    # ------------------------------------------------------------- snapshots

    def hash(self):
        """64 bits, the same as of the same world on any other machine."""
        return lib.carom_world_hash(self.c)

    def save(self):
        out = ffi.new("uint8_t[]", self.call("carom_snapshot_size"))
        self.call("carom_snapshot_save", out, len(out))
        return bytes(ffi.buffer(out))

    def load(self, snapshot):
        self.call("carom_snapshot_load", ffi.from_buffer(snapshot), len(snapshot))


def keep(kind, failed, trace):
    """Keep an exception of a function that the engine calls: the call into the engine raises it when it
    returns."""
    world = trace.tb_frame.f_locals.get("world")
    if world is not None:
        world.failed = failed


@ffi.def_extern(error=True, onerror=keep)
def contact_in_python(user, touch):
    world = ffi.from_handle(user)
    return world.contact(touch) is not False


@ffi.def_extern(error=False, onerror=keep)
def wants_in_python(context, body):
    world = ffi.from_handle(context)
    return bool(world.wants(body))
