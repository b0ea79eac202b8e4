// SPDX-License-Identifier: MIT
// The types as a user sees them: compiled by tsc, never run. A line that must not compile is marked.
import { load, CaromError, World, type BodyOptions, type RayHit } from "carom";

const carom = await load(new URL("https://example.org/carom.wasm"));
const world: World = carom.world({ caps: { bodies: 2 }, contact: (touch) => touch.speed > 1 });
const mesh = carom.mesh({ vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces: [0, 1, 2], kind: "surface" });
const options: BodyOptions = { mesh, stationary: true, position: new Float64Array(3), filter: { mask: 1 } };
const body: number = world.add(options);
const matrix: Float32Array = world.matrix(body, new Float32Array(16));
const raw: bigint = world.rawState(body).position[2] + BigInt(matrix.length);
const hit: RayHit | null = world.castRay([0, 0, 9], [0, 0, -9], { back: true });
const code: number = new CaromError().code;
world.call("carom_body_set_damping", body, 0, Number(raw) + code + (hit?.t ?? 0));

// @ts-expect-error a body has a mesh
world.add({ position: [0, 0, 0] });
// @ts-expect-error no such kind
carom.mesh({ vertices: [], faces: [], kind: "soup" });
// @ts-expect-error a world is made by a Carom
new World();
// @ts-expect-error capacities are needed
carom.world({});
