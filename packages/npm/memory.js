// SPDX-License-Identifier: MIT
// The memory of the module: blocks for meshes and worlds, structs as arguments and results, errors.
import { structs } from "./structs.js";

const PAGE = 65536;
const SCRATCH = 4096; // for arguments and results of one call

/* A negative result of Carom: an enum carom_error of carom.h, and its text. */
export class CaromError extends Error {
    constructor(code, text) {
        super(text);
        this.name = "CaromError";
        this.code = code;
    }
}

export class Memory {
    constructor(exports) {
        this.c = exports;
        this.top = Math.ceil(exports.__heap_base.value / 8) * 8;
        this.scratch = this.take(SCRATCH);
        this.used = 0;
    }

    /* A block of zeros, aligned to 8. It is freed only with the whole module. */
    take(bytes) {
        const at = this.top;
        const top = at + Math.ceil(bytes / 8) * 8;
        const missing = top - this.c.memory.buffer.byteLength;
        if (missing > 0) {
            this.c.memory.grow(Math.ceil(missing / PAGE));
        }
        this.top = top;
        return at;
    }

    view() {
        return new DataView(this.c.memory.buffer);
    }

    bytes(at, length) {
        return new Uint8Array(this.c.memory.buffer, at, length);
    }

    /** Copy a typed array into a block of its own. */
    keep(values) {
        const at = this.take(values.byteLength);
        this.bytes(at, values.byteLength).set(
            new Uint8Array(values.buffer, values.byteOffset, values.byteLength));
        return at;
    }

    /* A struct for one call: its address. The next call reuses its memory. */
    put(name, values = {}) {
        const type = structs[name];
        const at = this.scratch + this.used;
        this.used += Math.ceil(type.size / 8) * 8;
        if (this.used > SCRATCH) {
            throw new RangeError("too many structs in one call");
        }
        this.bytes(at, type.size).fill(0);
        type.write(this.view(), at, values);
        return at;
    }

    /** A vector of three int64 for one call. */
    keepVector(values) {
        return this.put("ray", { from: values });
    }

    get(name, at) {
        return structs[name].read(this.view(), at);
    }

    /* Several structs side by side. */
    list(name, at, count) {
        return Array.from({ length: count }, (_, i) => this.get(name, at + i * structs[name].size));
    }

    text(at) {
        const bytes = new Uint8Array(this.c.memory.buffer, at);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    }

    /* Call a function of the C interface; a negative result becomes an error. */
    call(name, ...given) {
        const result = this.c[name](...given);
        this.used = 0;
        if (result < 0) {
            throw new CaromError(result, `${name}: ${this.text(this.c.carom_result_text(result))}`);
        }
        return result;
    }
}
