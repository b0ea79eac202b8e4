// SPDX-License-Identifier: MIT
// Meshes from files: corners as numbers, faces as triangles, converted to int16 for the engine.
"use strict";

const MESH_REACH = 30000; // int16 value for half of the largest side

function triangulate(ring, faces) {
    for (let i = 2; i < ring.length; i++) {
        faces.push([ring[0], ring[i - 1], ring[i]]);
    }
}

function readObj(text) {
    const corners = [], faces = [];
    text.split("\n").forEach((line, n) => {
        const [word, ...rest] = line.trim().split(/\s+/);
        if (word === "v") {
            corners.push(rest.slice(0, 3).map(Number));
        } else if (word === "f") {
            const ring = rest.map((each) => parseInt(each, 10)).map((i) => (i < 0 ? corners.length + i : i - 1));
            if (ring.length < 3 || ring.some((i) => !(i >= 0))) {
                throw new Error(`Line ${n + 1} is no face: ${line.trim().slice(0, 40)}`);
            }
            triangulate(ring, faces);
        }
    });
    return { corners, faces };
}

function readStl(buffer) {
    const corners = [], faces = [], view = new DataView(buffer);
    const count = buffer.byteLength >= 84 ? view.getUint32(80, true) : 0;
    if (count && buffer.byteLength === 84 + 50 * count) {
        for (let f = 0; f < count; f++) {
            for (let k = 0; k < 3; k++) {
                const at = 84 + 50 * f + 12 + 12 * k;
                corners.push([0, 4, 8].map((o) => view.getFloat32(at + o, true)));
            }
        }
    } else {
        for (const [, x, y, z] of new TextDecoder().decode(buffer).matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g)) {
            corners.push([x, y, z].map(Number));
        }
    }
    for (let i = 0; i + 2 < corners.length; i += 3) {
        faces.push([i, i + 1, i + 2]);
    }
    return { corners, faces };
}

// The same mesh in int16, with equal corners united, and without triangles that lose a corner by
// that.
function quantize({ corners, faces }) {
    if (faces.length === 0) {
        throw new Error("There are no faces in this file.");
    }
    if (corners.some((c) => c.length < 3 || !c.every(Number.isFinite))) {
        throw new Error("A corner in this file is not three numbers.");
    }
    if (faces.some((f) => f.some((i) => i >= corners.length))) {
        throw new Error("A face in this file names a corner that is not there.");
    }
    const range = [0, 1, 2].map((k) => corners.reduce(([a, b], c) => [Math.min(a, c[k]), Math.max(b, c[k])], [Infinity, -Infinity]));
    const scale = (2 * MESH_REACH) / Math.max(...range.map(([a, b]) => b - a));
    const numbers = new Map(), vertices = [], number = [];
    corners.forEach((c, i) => {
        const q = c.map((x, k) => Math.round((x - (range[k][0] + range[k][1]) / 2) * scale)), name = q.join();
        if (!numbers.has(name)) {
            numbers.set(name, vertices.length);
            vertices.push(q);
        }
        number[i] = numbers.get(name);
    });
    const kept = faces.map((f) => f.map((i) => number[i])).filter(([a, b, c]) => a !== b && b !== c && c !== a);
    return { vertices, faces: kept };
}

function openEdges(faces) {
    const edges = new Set(faces.flatMap(([a, b, c]) => [a + " " + b, b + " " + c, c + " " + a]));
    return [...edges].filter((each) => !edges.has(each.split(" ").reverse().join(" "))).length;
}

function volume({ vertices, faces }) {
    return faces.reduce((sum, f) => {
        const [a, b, c] = f.map((i) => vertices[i]);
        return sum + a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }, 0);
}

function readMesh(name, buffer) {
    const mesh = quantize(/\.stl$/i.test(name) ? readStl(buffer) : readObj(new TextDecoder().decode(buffer)));
    const open = openEdges(mesh.faces);
    if (open > 0) {
        throw new Error(`The mesh is open: ${open} edges lack a face on one side. A body must be closed.`);
    }
    if (volume(mesh) < 0) {
        mesh.faces.forEach((f) => f.reverse());
    }
    return mesh;
}
