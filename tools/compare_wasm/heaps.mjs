// SPDX-License-Identifier: MIT
// Heaps of boxes through Carom, Rapier and Jolt, each as WebAssembly, step by step in turns:
//
//   node heaps.mjs CAROM.wasm LAYOUT...
//
// `carom-heaps layout` prints a layout. Unit boxes of mass 1 over a plane at z = 0, gravity 9.81 m/s^2, 60 steps a second,
// friction 0.5, no restitution, nobody sleeps; otherwise each library has its default settings. Rows to the console:
// PHASE,CONTENDER,MILLISECONDS, the median of the steps of that phase in all layouts, and end,CONTENDER,HEIGHT, the mean height
// of the boxes.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const STEP = 1 / 60, GRAVITY = -9.81, FRICTION = 0.5;
const PHASES = [["falling", 60], ["settling", 60], ["resting", 60]];

const require = createRequire(process.cwd() + "/build/npm/compare_wasm/");
const rapier = require("@dimforge/rapier3d-deterministic-compat");
const { default: initJolt } = await import(pathToFileURL(require.resolve("jolt-physics")));
const [image, ...layouts] = process.argv.slice(2);
const carom = new WebAssembly.Module(readFileSync(image));
await rapier.init();
const jolt = await initJolt();

function expect(result) {
    if (result < 0) {
        throw new Error("carom: " + result);
    }
    return result;
}

function makeCarom(boxes) {
    const { exports } = new WebAssembly.Instance(carom);
    expect(exports.begin());
    boxes.forEach((box) => expect(exports.add(...box)));
    return {
        name: "carom",
        step: () => expect(exports.step()),
        height: (i) => exports.height(i),
    };
}

function makeRapier(boxes) {
    const world = new rapier.World({ x: 0, y: 0, z: GRAVITY });
    world.timestep = STEP;
    // the half-space z <= 0
    world.createCollider(new rapier.ColliderDesc(new rapier.HalfSpace({ x: 0, y: 0, z: 1 }))
        .setFriction(FRICTION));
    const bodies = boxes.map(([x, y, z, qw, qx, qy, qz]) => {
        const body = world.createRigidBody(rapier.RigidBodyDesc.dynamic().setTranslation(x, y, z)
            .setRotation({ w: qw, x: qx, y: qy, z: qz }).setCanSleep(false));
        world.createCollider(
            rapier.ColliderDesc.cuboid(0.5, 0.5, 0.5).setMass(1).setFriction(FRICTION), body);
        return body;
    });
    return {
        name: "rapier",
        step: () => world.step(),
        height: (i) => bodies[i].translation().z,
        free: () => world.free(),
    };
}

function joltSystem() {
    const settings = new jolt.JoltSettings();
    const pairs = new jolt.ObjectLayerPairFilterTable(2);
    const layers = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
    pairs.EnableCollision(0, 1);
    pairs.EnableCollision(1, 1);
    layers.MapObjectToBroadPhaseLayer(0, new jolt.BroadPhaseLayer(0));
    layers.MapObjectToBroadPhaseLayer(1, new jolt.BroadPhaseLayer(1));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter =
        new jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
    const made = new jolt.JoltInterface(settings);
    made.GetPhysicsSystem().SetGravity(new jolt.Vec3(0, 0, GRAVITY));
    return made;
}

function makeJolt(boxes) {
    const made = joltSystem();
    const bodies = made.GetPhysicsSystem().GetBodyInterface();
    // this engine has no infinite plane, so the ground is a slab of 64 x 64 x 2
    const add = (shape, at, turn, type, layer) => {
        const settings = new jolt.BodyCreationSettings(shape, new jolt.RVec3(...at),
            new jolt.Quat(...turn), type, layer);
        settings.mFriction = FRICTION;
        settings.mRestitution = 0;
        settings.mAllowSleeping = false;
        settings.mOverrideMassProperties = jolt.EOverrideMassProperties_CalculateInertia;
        settings.mMassPropertiesOverride.mMass = 1;
        const body = bodies.CreateBody(settings);
        bodies.AddBody(body.GetID(), jolt.EActivation_Activate);
        return body;
    };
    const slab = new jolt.BoxShape(new jolt.Vec3(32, 32, 1));
    add(slab, [0, 0, -1], [0, 0, 0, 1], jolt.EMotionType_Static, 0);
    const box = new jolt.BoxShape(new jolt.Vec3(0.5, 0.5, 0.5));
    const all = boxes.map(([x, y, z, qw, qx, qy, qz]) =>
        add(box, [x, y, z], [qx, qy, qz, qw], jolt.EMotionType_Dynamic, 1));
    return {
        name: "jolt",
        step: () => made.Step(STEP, 1),
        height: (i) => all[i].GetPosition().GetZ(),
        free: () => jolt.destroy(made),
    };
}

function median(numbers) {
    const sorted = [...numbers].sort((a, b) => a - b);
    return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
}

const times = {}, heights = {};

function play(boxes, keep) {
    const heaps = [makeCarom(boxes), makeRapier(boxes), makeJolt(boxes)];
    for (const [phase, steps] of PHASES) {
        for (let step = 0; step < steps; step++) {
            for (const heap of heaps) {
                const start = performance.now();
                heap.step();
                const took = performance.now() - start;
                if (keep) {
                    ((times[phase] ??= {})[heap.name] ??= []).push(took);
                }
            }
        }
    }
    for (const heap of heaps) {
        const sum = boxes.reduce((total, _, i) => total + heap.height(i), 0);
        if (keep) {
            (heights[heap.name] ??= []).push(sum / boxes.length);
        }
        heap.free?.();
    }
}

const heaps = layouts.map((path) => readFileSync(path, "utf8").trim().split("\n")
    .map((line) => line.split(",").map(Number)));
play(heaps[0], false); // warm up: the machine compiles code only after it has run often
heaps.forEach((boxes) => play(boxes, true));
for (const [phase, by] of Object.entries(times)) {
    for (const [name, all] of Object.entries(by)) {
        console.log("%s,%s,%s", phase, name, median(all).toFixed(4));
    }
}
for (const [name, all] of Object.entries(heights)) {
    console.log("end,%s,%s", name, median(all).toFixed(3));
}
