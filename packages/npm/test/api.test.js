// SPDX-License-Identifier: MIT
// Tests of the package as it is installed; run by node --test.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import test from "node:test";
import { CaromError } from "carom";
import { GROUND, SOLID, hello, scene } from "./worlds.js";

const WASM = new URL(import.meta.resolve("carom/carom.wasm"));
const near = (value, wanted, off) => assert.ok(Math.abs(value - wanted) <= off, `${value}, not ${wanted}`);

test("a body in the air obeys free fall", async () => {
    const { world, solid } = await scene({ bodies: 2 }, { fps: 100, gravity: [0, 0, -10] });
    const body = world.add({ mesh: solid, position: [0, 0, 50], velocity: [3, 0, 0] });
    for (let frame = 0; frame < 100; frame++) {
        world.step();
    }
    const { position, velocity } = world.state(body);
    near(position[0], 3, 1e-6);
    near(position[2], 45, 0.1); // a frame's gravity acts at once: within g t / fps
    near(velocity[2], -10, 1e-6);
});

test("metres and quanta make the same mesh", async () => {
    const { world, carom } = await scene({ bodies: 3 });
    const metres = Array.from(SOLID.vertices, (quantum) => quantum / 256);
    const a = world.add({ mesh: carom.mesh({ ...SOLID, vertices: metres }), position: [0, 0, 2] });
    const b = world.add({ mesh: carom.mesh(SOLID), position: [9, 0, 2] });
    for (let frame = 0; frame < 60; frame++) {
        world.step();
    }
    assert.equal(world.rawState(a).position[2], world.rawState(b).position[2]);
});

test("a refusal is an error with a code", async () => {
    const { world, carom, solid } = await scene({ bodies: 2 });
    assert.throws(() => carom.mesh({ ...SOLID, faces: [0, 1, 2] }), CaromError);
    world.add({ mesh: solid, position: [0, 0, 5] });
    assert.throws(() => world.add({ mesh: solid, position: [0, 0, 9] }), (error) => error.code === -6);
    assert.throws(() => world.add({ mesh: solid, position: [NaN, 0, 9] }), RangeError);
    assert.throws(() => carom.mesh({ ...SOLID, vertices: [200, 0, 0] }), RangeError);
    assert.throws(() => world.add({ mesh: solid, colour: "red" }), TypeError);
});

test("a snapshot brings the same future back", async () => {
    const { world, solid } = await scene({ bodies: 2 });
    world.add({ mesh: solid, position: [0, 0, 1], spin: [1, 2, 3] });
    for (let frame = 0; frame < 20; frame++) {
        world.step();
    }
    const before = world.hash();
    const snapshot = world.save();
    for (let frame = 0; frame < 20; frame++) {
        world.step();
    }
    const after = world.hash();
    world.load(snapshot);
    assert.equal(world.hash(), before);
    for (let frame = 0; frame < 20; frame++) {
        world.step();
    }
    assert.equal(world.hash(), after);
    assert.notEqual(before, after);
});

test("events, contacts and a ray find the body on the ground", async () => {
    const { world, solid } = await scene({ bodies: 2 });
    const body = world.add({ mesh: solid, position: [1, 2, 1], friction: 0.5 });
    const seen = [];
    for (let frame = 0; frame < 200; frame++) {
        world.step();
        seen.push(...world.events());
        if (seen.at(-1)?.kind === "hit") {
            const { a, b, speed, impulse, point, normal } = seen.at(-1);
            assert.deepEqual([a, b].sort(), [0, body]);
            near(point[2], 0, 0.01);
            near(Math.abs(normal[2]), 1, 1e-6);
            assert.ok(speed > 0 && impulse > 0);
            assert.ok(world.contacts().length > 0);
        }
    }
    const kinds = new Set(seen.map((event) => event.kind));
    assert.ok(kinds.has("begin") && kinds.has("hit") && kinds.has("rest"), [...kinds].join());
    const { position } = world.state(body);
    const from = [position[0], position[1], 10];
    const hit = world.castRay(from, [0, 0, -20]);
    assert.equal(hit.body, body);
    near(hit.point[0], position[0], 1e-6);
    assert.equal(world.castRay(from, [0, 0, -20], { wants: (number) => number === 0 }).body, 0);
    assert.equal(world.castRay([0, 0, 10], [0, 0, 5]), null);
    assert.ok(world.stats().substeps >= 1);
});

test("a contact function drops contacts", async () => {
    const touched = [];
    const contact = (touch) => {
        touched.push(touch);
        return false;
    };
    const { world, solid } = await scene({ bodies: 2 }, { contact });
    const body = world.add({ mesh: solid, position: [0, 0, 1] });
    for (let frame = 0; frame < 60; frame++) {
        world.step();
    }
    assert.ok(touched.length > 0 && touched[0].speed > 0);
    assert.ok(world.state(body).position[2] < -1);
});

test("a hinge turns by its motor", async () => {
    const { world, solid } = await scene({ bodies: 2, joints: 1 }, { gravity: [0, 0, 0] });
    const a = world.add({ mesh: solid, position: [0, 0, 9], mass: 1 });
    const joint = world.addJoint({
        kind: "hinge", a, anchor: [0, 0, 9], axis: [0, 0, 1], drive: { motor: true, motorSpeed: 2, motorMost: 50 },
    });
    for (let frame = 0; frame < 30; frame++) {
        world.step();
    }
    near(world.joint(joint).speed, 2, 1e-3);
    near(world.state(a).spin[2], 2, 1e-3);
    world.driveJoint(joint, {});
    world.removeJoint(joint);
    assert.throws(() => world.joint(joint), CaromError);
});

test("pushes, forces, kinematic bodies and moving ground", async () => {
    const { world, solid, carom } = await scene({ bodies: 4, entries: 64 }, { gravity: [0, 0, 0] });
    const pushed = world.add({ mesh: solid, position: [0, 0, 9], mass: 2 });
    const led = world.add({ mesh: solid, position: [5, 0, 9], kinematic: true });
    world.push(pushed, [4, 0, 0]);
    near(world.state(pushed).velocity[0], 2, 1e-6);
    world.setForce(pushed, [0, 6, 0]);
    world.moveTo(led, { position: [5, 0.5, 9] });
    world.step();
    near(world.state(pushed).velocity[1], 3 / 60, 1e-6);
    near(world.state(led).position[1], 0.5, 1e-6);
    world.set(pushed, { position: [1, 1, 12], velocity: [0, 0, 0] });
    const matrix = world.matrix(pushed);
    near(matrix[14], 12, 1e-6);
    near(matrix[0], 1, 1e-6);
    const sheet = carom.mesh({ ...GROUND, kind: "moving" });
    const ground = world.add({ mesh: sheet, stationary: true, position: [0, 0, -20] });
    world.moveSurface(ground, sheet, GROUND.vertices.map((quantum, i) => quantum + (i % 3 === 2 ? 64 : 0)));
    world.step();
    near(world.castRay([0, 0, -10], [0, 0, -20]).point[2], -19.75, 1e-6);
});

test("loads by fetch, as in a browser", async () => {
    const server = createServer(async (_, answer) => {
        answer.setHeader("Content-Type", "application/wasm");
        answer.end(await readFile(fileURLToPath(WASM)));
    });
    await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
    try {
        const there = `http://127.0.0.1:${server.address().port}/carom.wasm`;
        const [fetched, read] = [await hello(there), await hello()];
        assert.equal(fetched.world.hash(), read.world.hash());
    } finally {
        server.close();
    }
});
