#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Run a program of a Raspberry Pi Pico in rp2040js: tools/pico/run.mjs IMAGE.elf [ARGUMENT...]
//
// The image is the .uf2 file beside the .elf. rp2040js has no boot ROM, so this does its work: it checks the loader's check sum,
// copies the loader into RAM and begins there. The arguments are written into the room that port/bare/arguments.c leaves for them.
// The output of UART 0 goes to stdout, up to EOT and the exit status. Two arguments are also this program's own:
//
//   pictures=DIRECTORY  write the display as DIRECTORY/frame-0001.ppm when the program asks for it
//   press=N:KEYS,...    hold KEYS (a sum of the pad's bits) from the N-th such picture on
//
// A register that rp2040js does not know ends the run, and so do bytes that the display does not understand.

import { createRequire } from "module";
import fs from "fs";
import path from "path";
import { fileURLToPath } from "url";
import { Display } from "./st7789.mjs";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));
const { RP2040 } = createRequire(path.join(ROOT, "build/npm/pico/"))("rp2040js");

const BLOCK = 512, PAYLOAD_AT = 32, FLASH = 0x10000000;
const LOADER = 252, LOADER_RUNS_AT = 0x20041f00;
const ARGUMENTS_AT = 0x140, ARGUMENTS_ROOM = 256;
const PIN_DATA = 8, PIN_SELECT = 9, PIN_RESET = 12;
const KEY_PINS = [15, 17, 19, 21, 20, 16, 2, 18]; // by bit of the pad
const DISPLAY_HZ_MAX = 62.5e6;
const EOT = 4, NEVER_ENDED = 124;

function die(text) {
    console.error(`pico: ${text}`);
    process.exit(NEVER_ENDED);
}

// ------------------------------------------------------------------ the image

function readImage(file, flash) {
    const uf2 = fs.readFileSync(file.replace(/\.elf$/, ".uf2"));
    for (let at = 0; at < uf2.length; at += BLOCK) {
        const address = uf2.readUInt32LE(at + 12), bytes = uf2.readUInt32LE(at + 16);
        flash.set(uf2.subarray(at + PAYLOAD_AT, at + PAYLOAD_AT + bytes), address - FLASH);
    }
}

function checkSum(bytes) {
    let crc = 0xffffffff;
    for (const byte of bytes) {
        crc ^= byte << 24;
        for (let bit = 0; bit < 8; bit++) {
            crc = crc << 1 ^ (crc < 0 ? 0x04c11db7 : 0);
        }
    }
    return crc >>> 0;
}

// Do what the boot ROM does with the flash.
function boot(mcu) {
    const loader = mcu.flash.subarray(0, LOADER);
    if (checkSum(loader) !== mcu.flashView.getUint32(LOADER, true)) {
        die("the loader's check sum is wrong");
    }
    mcu.sram.set(loader, LOADER_RUNS_AT - 0x20000000);
    mcu.core.PC = LOADER_RUNS_AT;
}

function writeArguments(flash, words) {
    const line = Buffer.from(words.map(word => word + " ").join(""));
    if (line.length >= ARGUMENTS_ROOM) {
        die("the arguments are too long");
    }
    flash.fill(0, ARGUMENTS_AT, ARGUMENTS_AT + ARGUMENTS_ROOM);
    flash.set(line, ARGUMENTS_AT);
}

// ------------------------------------------------------------------ what is connected

// The display: words of the serial bus, each on its way for as long as its bits take.
function connectDisplay(mcu) {
    const spi = mcu.spi[1], display = new Display(() => mcu.clock.nanos);
    const arrived = mcu.clock.createAlarm(() => spi.completeTransmit(0));
    const pin = n => mcu.sio.gpioValue >> n & 1;
    mcu.gpio[PIN_RESET].addListener(() => display.reset());
    spi.onTransmit = word => {
        if (spi.clockFrequency > DISPLAY_HZ_MAX || pin(PIN_SELECT) || !pin(PIN_RESET)) {
            die("the display is sent a word too fast, not selected or not awake");
        }
        for (let shift = spi.dataBits - 8; shift >= 0; shift -= 8) {
            const byte = word >> shift & 255;
            pin(PIN_DATA) ? display.takeData(byte) : display.takeCommand(byte);
        }
        arrived.schedule(spi.dataBits / spi.clockFrequency * 1e9);
    };
    return display;
}

// The held keys: those of the last entry whose picture has arrived.
function hold(mcu, presses, pictures) {
    let keys = 0;
    for (const entry of presses ? presses.split(",") : []) {
        const [from, value] = entry.split(":").map(Number);
        keys = from <= pictures ? value : keys;
    }
    KEY_PINS.forEach((pin, i) => mcu.gpio[pin].setInputValue(!(keys >> i & 1)));
}

// The console: acts at the end of a line, and at the end of the program.
function connectConsole(mcu, takeLine, end) {
    let line = "", ended = false;
    mcu.uart[0].onByte = byte => {
        if (ended) {
            end(byte);
        } else if (byte === EOT) {
            ended = true;
            if (line) {
                takeLine(line);
            }
        } else if (byte === 10) {
            takeLine(line + "\n");
            line = "";
        } else {
            line += String.fromCharCode(byte);
        }
    };
}

function main(image, words) {
    const mcu = new RP2040(), { core, clock } = mcu;
    const option = name => words.find(word => word.startsWith(name + "="))?.slice(name.length + 1);
    let status = null, pictures = 0, cycle = 1e9 / mcu.clkSys;

    mcu.logger = { debug() {}, info() {}, warn: (where, what) => die(`${where}: ${what}`),
        error: (where, what) => die(`${where}: ${what}`) };
    mcu.onBreak = () => die("a breakpoint");
    mcu.addClockListener(hertz => { cycle = 1e9 / hertz; });
    readImage(image, mcu.flash);
    writeArguments(mcu.flash, [image, ...words]);
    const display = connectDisplay(mcu);
    hold(mcu, option("press"), 0);
    connectConsole(mcu, line => {
        if (line !== "picture\n") {
            fs.writeSync(1, line);
            return;
        }
        pictures++;
        hold(mcu, option("press"), pictures);
        if (option("pictures")) {
            const name = `frame-${String(pictures).padStart(4, "0")}.ppm`;
            fs.writeFileSync(path.join(option("pictures"), name), display.picture());
        }
    }, byte => { status = byte; });
    boot(mcu);
    while (status === null) {
        clock.tick(core.executeInstruction() * cycle);
    }
    process.exit(status);
}

if (process.argv.length < 3) {
    die("usage: run.mjs IMAGE.elf [ARGUMENT...]");
}
main(process.argv[2], process.argv.slice(3));
