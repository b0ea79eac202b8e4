// SPDX-License-Identifier: MIT
// The engine in the page: text and memory between JavaScript and the module.
function startModule(base64) {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const page = { ticks: () => Math.floor(performance.now() * 1000) | 0 };
    return WebAssembly.instantiate(bytes, { page }).then(({ instance }) => wrap(instance.exports));
}

function wrap(its) {
    const memory = (type, name, count) => new type(its.memory.buffer, its[name].value, count);
    const [textBytes, verticesMax, facesMax, pixelsMax, stageCount] = [0, 1, 2, 3, 4].map(its.page_room);

    function text(at) {
        if (!at) {
            return null;
        }
        const all = new Uint8Array(its.memory.buffer, at);
        return new TextDecoder().decode(all.subarray(0, all.indexOf(0)));
    }

    function give(words) {
        const all = new TextEncoder().encode(words + "\0");
        if (all.length > textBytes) {
            throw new Error("This link is too long.");
        }
        memory(Uint8Array, "page_text", textBytes).set(all);
        return its.page_text.value;
    }

    const checked = (result, what) => {
        if (result < 0) {
            throw new Error(`${what}: ${text(its.carom_result_text(result))}.`);
        }
        return result;
    };

    function openMesh({ vertices, faces }) {
        if (vertices.length > verticesMax || faces.length > facesMax) {
            throw new Error(`The mesh is too large: at most ${verticesMax} corners and ${facesMax} faces.`);
        }
        memory(Int16Array, "page_vertices", 3 * verticesMax).set(vertices.flat());
        memory(Uint16Array, "page_faces", 3 * facesMax).set(faces.flat());
        checked(its.page_open_mesh(vertices.length, faces.length), "The engine refuses this mesh");
    }

    const list = (of) => {
        const names = [];
        for (let i = 0, at; (at = of(i)); i++) {
            names.push(text(at));
        }
        return names;
    };
    const texts = list(its.scene_text);
    return {
        its, text, checked, openMesh, pixelsMax, stageCount,
        scenes: list(its.scene_name).map((name, i) => ({ name, text: texts[i] })),
        open: (name) => checked(its.view_open(give(name), 0), name),
        follow: (link) => checked(its.view_follow(give(link)), "This is no link of Carom's, or not all of one"),
        link: () => text((checked(its.view_link(its.page_text.value, textBytes), "No link"), its.page_text.value)),
        hash: () => BigInt.asUintN(64, its.view_hash()).toString(16).padStart(16, "0"),
        picture: (width, height) => new ImageData(memory(Uint8ClampedArray, "page_shown", 4 * width * height), width, height),
    };
}
