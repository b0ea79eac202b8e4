// SPDX-License-Identifier: MIT
// The meshes and the world of examples/hello.c, for tests.
import { load } from "carom";

export const SOLID = {
    vertices: Int16Array.of(99, 99, 99, 99, -99, -99, -99, 99, -99, -99, -99, 99),
    faces: [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2],
};
export const GROUND = {
    vertices: Int16Array.of(-9999, -9999, 0, 9999, -9999, 0, 0, 9999, 0),
    faces: [0, 1, 2],
    kind: "surface",
};

/* A world of some bodies with the ground, and `hello`'s body by default. */
export async function scene(caps, options = {}, source = undefined) {
    const carom = await load(source);
    const world = carom.world({ caps, ...options });
    const solid = carom.mesh(SOLID);
    world.add({ mesh: carom.mesh(GROUND), stationary: true, friction: 0.5 });
    return { carom, world, solid };
}

/** `hello` until its body sleeps. */
export async function hello(source = undefined) {
    const caps = { bodies: 2, pairs: 1, contacts: 16, faces: 16, entries: 32, candidates: 64, extras: 0, hits: 0 };
    const made = await scene(caps, {}, source);
    const { world, solid } = made;
    const body = world.add({ mesh: solid, position: [0, 0, 2], spin: [0.9, 0, 0], friction: 0.5 });
    for (let frame = 0; frame < 1000 && !world.state(body).asleep; frame++) {
        world.step();
    }
    return made;
}
