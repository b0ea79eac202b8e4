# SPDX-License-Identifier: MIT
"""Tests of the installed wheel."""
import os
import runpy
import subprocess
import sys

import numpy as np
import pytest

import carom

CORNERS = np.array([[99, 99, 99], [99, -99, -99], [-99, 99, -99], [-99, -99, 99]], np.int16)
SIDES = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
GROUND = np.array([[-9999, -9999, 0], [9999, -9999, 0], [0, 9999, 0]], np.int16)


def scene(**options):
    """A world whose ground is stationary triangle 0, and a tetrahedron to add."""
    world = carom.World(**{"bodies": 4, **options})
    world.add(carom.Mesh(GROUND, [[0, 1, 2]], kind="surface"), stationary=True, friction=0.5)
    return world, carom.Mesh(CORNERS, SIDES)


def run(world, frames):
    for _ in range(frames):
        world.step()


def test_hello_ends_in_the_hash_of_the_c_program(capsys):
    world = runpy.run_path("hello.py")["world"]
    capsys.readouterr()
    assert "hash %016x" % world.hash() == os.environ["CAROM_HASH"]


def test_free_fall():
    world, solid = scene(fps=100, gravity=(0, 0, -10))
    body = world.add(solid, position=(0, 0, 50), velocity=(3, 0, 0))
    run(world, 100)
    poses = world.poses()
    assert poses.position[body] == pytest.approx([3, 0, 45], abs=0.1)  # a frame's gravity acts at once
    assert poses.velocity[body] == pytest.approx([3, 0, -10], abs=1e-6)
    assert poses.position.dtype == np.float64
    raw = world.raw_poses()
    assert raw.position.dtype == np.int64 and raw.rotation.dtype == np.int32
    assert np.array_equal(raw.position / 2.0**32, poses.position)


def test_metres_and_quanta_are_one_mesh():
    quanta, metres = carom.Mesh(CORNERS, SIDES), carom.Mesh(CORNERS / 256.0, SIDES)
    assert np.array_equal(quanta.vertices, metres.vertices)
    # a regular tetrahedron in a cube takes a third of it
    assert quanta.volume == pytest.approx((2 * 99 / 256) ** 3 / 3, rel=1e-6)
    with pytest.raises(ValueError):
        carom.Mesh(CORNERS * 2.0, SIDES)
    with pytest.raises(ValueError):
        carom.Mesh(CORNERS, [[0, 1, 70000]])
    with pytest.raises(carom.CaromError) as refused:
        carom.Mesh(CORNERS, SIDES[:3])
    assert refused.value.code == carom.lib.CAROM_ERR_MESH_OPEN


def test_matrices_turn_vertices_as_quaternions_do():
    world, solid = scene(gravity=(0, 0, 0))
    body = world.add(solid, position=(1, 2, 3), spin=(0.7, -1.1, 2))
    run(world, 50)
    poses, matrix = world.poses(), world.matrices()[body]
    w, x, y, z = poses.rotation[body]
    for vertex in CORNERS / 256.0:
        axis = np.array([x, y, z])
        turned = vertex + 2 * np.cross(axis, np.cross(axis, vertex) + w * vertex)
        # the mesh's centre of mass is its origin: that of a regular tetrahedron
        assert (matrix @ [*vertex, 1])[:3] == pytest.approx(poses.position[body] + turned, abs=1e-6)


def test_free_numbers_are_nan():
    world, solid = scene()
    first = world.add(solid, position=(0, 0, 9))
    second = world.add(solid, position=(5, 0, 9))
    world.remove(first)
    assert np.all(np.isnan(world.poses().position[first]))
    assert np.all(np.isnan(world.matrices()[first]))
    assert not np.any(np.isnan(world.poses().position[second]))
    with pytest.raises(carom.CaromError):
        world.get(first)


def test_snapshot_brings_the_same_future_back():
    world, solid = scene()
    world.add(solid, position=(0, 0, 1), spin=(1, 2, 3))
    run(world, 20)
    snapshot, before = world.save(), world.hash()
    run(world, 20)
    after = world.hash()
    world.load(snapshot)
    assert world.hash() == before != after
    run(world, 20)
    assert world.hash() == after


def test_events_contacts_and_a_ray():
    world, solid = scene()
    body = world.add(solid, position=(1, 2, 1), friction=0.5)
    seen = []
    for _ in range(200):
        world.step()
        seen += world.events()
        for hit in (event for event in world.events() if event.kind == "hit"):
            assert {hit.a, hit.b} == {0, body} and hit.speed > 0 and hit.impulse > 0
            assert hit.point[2] == pytest.approx(0, abs=0.01)
            assert abs(hit.normal[2]) == pytest.approx(1)
            assert world.contacts()[0].point[2] == pytest.approx(0, abs=0.01)
    assert {"begin", "hit", "rest"} <= {event.kind for event in seen}
    above = [*world.poses().position[body][:2], 10]
    assert world.cast_ray(above, (0, 0, -20)).body == body
    assert world.cast_ray(above, (0, 0, -20), wants=lambda number: number == 0).body == 0
    assert world.cast_ray(above, (0, 0, 5)) is None


def test_contact_function_drops_and_may_fail():
    touched = []

    def drop(touch):
        touched.append(touch.speed_q40)
        return False

    world, solid = scene(contact=drop)
    body = world.add(solid, position=(0, 0, 1))
    run(world, 60)
    assert touched and world.poses().position[body, 2] < -1

    world, solid = scene(contact=lambda touch: 1 // 0)
    world.add(solid, position=(0, 0, 1))
    with pytest.raises(ZeroDivisionError):
        run(world, 60)


def test_pushes_forces_led_bodies_joints_and_moving_ground():
    world, solid = scene(gravity=(0, 0, 0), bodies=6, joints=1, entries=64)
    pushed = world.add(solid, position=(0, 0, 9), mass=2)
    led = world.add(solid, position=(5, 0, 9), kinematic=True)
    turned = world.add(solid, position=(-5, 0, 9), mass=1)
    hinge = world.add_joint("hinge", turned, anchor=(-5, 0, 9), axis=(0, 0, 1), motor=True, motor_speed=2,
                            motor_most=50)
    world.push(pushed, (4, 0, 0))
    world.set_force(pushed, (0, 6, 0))
    world.move_to(led, (5, 0.5, 9))
    world.step()
    poses = world.poses()
    assert poses.velocity[pushed] == pytest.approx([2, 3 / 60, 0], abs=1e-6)
    assert poses.position[led] == pytest.approx([5, 0.5, 9], abs=1e-6)
    assert world.joint(hinge)[1] == pytest.approx(2, abs=1e-3)
    assert poses.spin[turned, 2] == pytest.approx(2, abs=1e-3)
    world.set(pushed, position=(1, 1, 12))
    assert world.poses().position[pushed] == pytest.approx([1, 1, 12])
    sheet = world.add(carom.Mesh(GROUND, [[0, 1, 2]], kind="moving"), stationary=True, position=(0, 0, -20))
    world.move_surface(sheet, GROUND + np.array([0, 0, 64], np.int16))
    world.step()
    assert world.cast_ray((0, 0, -10), (0, 0, -20)).point[2] == pytest.approx(-19.75, abs=1e-6)


def test_a_field_that_is_not_there():
    world, solid = scene()
    with pytest.raises(AttributeError):
        world.add(solid, colour=3)


def test_hello_prints_the_same_in_a_program_of_its_own():
    said = subprocess.run([sys.executable, "hello.py"], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert said.startswith("frame 10: 1863 mm up\n")
