# SPDX-License-Identifier: MIT
"""examples/hello.c in Python."""
import numpy as np

import carom

solid = carom.Mesh(np.array([[99, 99, 99], [99, -99, -99], [-99, 99, -99], [-99, -99, 99]], np.int16),
                   [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
flat = carom.Mesh(np.array([[-9999, -9999, 0], [9999, -9999, 0], [0, 9999, 0]], np.int16), [[0, 1, 2]],
                  kind="surface")
world = carom.World(bodies=2, fps=60, gravity=(0, 0, -9.81))
world.add(flat, stationary=True, friction=0.5)
body = world.add(solid, position=(0, 0, 2), spin=(0.9, 0, 0), friction=0.5)

frame = 0
while not world.asleep(body):
    world.step()
    frame += 1
    if frame % 10 == 0:
        print("frame %2d: %4d mm up" % (frame, np.floor(world.poses().position[body, 2] * 1000)))
