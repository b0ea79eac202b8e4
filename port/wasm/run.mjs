#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Run a program for WebAssembly: node run.mjs PROGRAM ARGUMENT...
import { readFileSync, writeSync } from "node:fs";

const [image, ...rest] = process.argv.slice(2);
const given = [image, ...rest];
let line = "";
let memory;

class Exit extends Error {
    constructor(status) {
        super("exit");
        this.status = status;
    }
}

function flush() {
    writeSync(1, line);
    line = "";
}

function text(at) {
    const bytes = new Uint8Array(memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

const port = {
    putc(c) {
        line += String.fromCharCode(c);
        if (c === 10) {
            flush();
        }
    },
    exit(status) {
        throw new Exit(status);
    },
    arg(n, at, max) {
        const bytes = n < given.length ? new TextEncoder().encode(given[n] + "\0") : null;
        if (!bytes || bytes.length > max) {
            return -1;
        }
        new Uint8Array(memory.buffer).set(bytes, at);
        return bytes.length - 1;
    },
    read(name, at, max) {
        try {
            const bytes = readFileSync(text(name)).subarray(0, max);
            new Uint8Array(memory.buffer).set(bytes, at);
            return bytes.length;
        } catch {
            return -1;
        }
    },
};

const module = new WebAssembly.Module(readFileSync(image));
const { exports } = new WebAssembly.Instance(module, { port });
memory = exports.memory;
try {
    process.exitCode = exports.main();
} catch (error) {
    if (!(error instanceof Exit)) {
        throw error;
    }
    process.exitCode = error.status;
}
flush();
