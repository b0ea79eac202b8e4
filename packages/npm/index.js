// SPDX-License-Identifier: MIT
// Carom as a WebAssembly module, for node and browsers.
import { Memory } from "./memory.js";
import { World, number } from "./world.js";

export { CaromError } from "./memory.js";
export { World } from "./world.js";

const KINDS = ["solid", "surface"];

/** A mesh in the memory of a module. */
class Mesh {
    constructor(memory, { vertices, faces, quantumBits = 8, kind = "solid" }) {
        this.quantumBits = quantumBits;
        const moving = kind === "moving";
        const places = this.quanta(vertices);
        const corners = Uint16Array.from(faces.flat?.() ?? faces);
        this.vertexCount = places.length / 3;
        this.faceCount = corners.length / 3;
        const raw = memory.put("mesh_raw", {
            vertices: memory.keep(places),
            faces: memory.keep(corners),
            vertex_count: this.vertexCount,
            face_count: this.faceCount,
            quantum_bits: quantumBits,
            kind: moving ? 1 : number(KINDS, kind),
        });
        let bytes = memory.c.carom_mesh_bytes(this.vertexCount, this.faceCount);
        if (moving) {
            bytes += Math.ceil((12 * this.vertexCount + 80) / 8) * 8; // as CAROM_SURFACE_BYTES
        }
        this.at = memory.take(memory.c.glue_mesh_struct_bytes());
        memory.call(moving ? "carom_surface_build" : "carom_mesh_build",
            this.at, raw, memory.take(bytes), bytes);
    }

    /** Vertices as int16 quanta: an Int16Array holds quanta already; other arrays hold metres,
     * which are rounded. */
    quanta(vertices) {
        if (vertices instanceof Int16Array) {
            return vertices;
        }
        const metres = Array.from(vertices.flat?.() ?? vertices);
        return Int16Array.from(metres, (metre) => {
            const quantum = Math.round(metre * 2 ** this.quantumBits);
            if (!(Math.abs(quantum) <= 32767)) {
                throw new RangeError(`${metre} m is out of range at ${this.quantumBits} quantum bits`);
            }
            return quantum;
        });
    }
}

/* One module with its own memory: meshes, and the worlds that use them. */
export class Carom {
    constructor(module) {
        this.worlds = [];
        const imports = {
            contact: (user, touch) => this.worlds[user].askContact(touch),
            wants: (context, body) => this.worlds[context].askWants(body),
        };
        const { exports } = new WebAssembly.Instance(module, { carom: imports });
        this.memory = new Memory(exports);
    }

    mesh(options) {
        return new Mesh(this.memory, options);
    }

    world(options) {
        const world = new World(this.memory, this.worlds.length, options);
        this.worlds.push(world);
        return world;
    }
}

async function compile(source) {
    if (source instanceof WebAssembly.Module) {
        return source;
    }
    if (source instanceof URL || typeof source === "string") {
        const url = new URL(source, import.meta.url);
        if (url.protocol !== "file:") {
            const response = await fetch(url);
            if (!response.ok) {
                throw new Error(`${url}: ${response.status} ${response.statusText}`);
            }
            return WebAssembly.compile(await response.arrayBuffer());
        }
        const { readFile } = await import("node:fs/promises");
        return WebAssembly.compile(await readFile(url));
    }
    return WebAssembly.compile(source);
}

/* Load the module: from the place of this file, or from a URL, bytes or a compiled module. */
export async function load(source = new URL("./carom.wasm", import.meta.url)) {
    return new Carom(await compile(source));
}
