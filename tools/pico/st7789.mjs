// SPDX-License-Identifier: MIT
// The picture of a display of 240 x 240 pixels with Sitronix' ST7789, from the bytes that it is sent.
//
// It models what a program needs that fills windows with pixels of 16 bits. Anything else is an error, and so is what the datasheet
// forbids: a command too soon after a reset or the end of sleep. The orientation of the panel in its module (MADCTL) is ignored: the
// first row is the upper one.

const SIDE = 240;
const LINES = 320; // lines of the controller's memory
const WAKE_NS = 5e6; // after a reset, and after the command that ends sleep

const SLEEP_OUT = 0x11, NORMAL = 0x13, INVERT = 0x21, DISPLAY_ON = 0x29, COLUMNS = 0x2a, ROWS = 0x2b;
const PIXELS = 0x2c, ORIENT = 0x36, FORMAT = 0x3a;
const PARAMETERS = new Map([[SLEEP_OUT, 0], [NORMAL, 0], [INVERT, 0], [DISPLAY_ON, 0], [COLUMNS, 4],
    [ROWS, 4], [PIXELS, Infinity], [ORIENT, 1], [FORMAT, 1]]);
const BITS_16 = 0x55;

export class Display {
    // now: the time in nanoseconds
    constructor(now) {
        this.now = now;
        this.memory = new Uint16Array(SIDE * LINES);
        this.reset();
    }

    reset() {
        this.ready = this.now() + WAKE_NS;
        this.awake = this.on = this.is16 = false;
        this.command = null;
        this.columns = [0, SIDE - 1];
        this.rows = [0, LINES - 1];
    }

    takeCommand(byte) {
        if (!PARAMETERS.has(byte) || this.now() < this.ready) {
            throw new Error(`display: command 0x${byte.toString(16)} is unknown or too early`);
        }
        if (this.command !== null && this.command !== PIXELS && this.parameters.length < PARAMETERS.get(this.command)) {
            throw new Error(`display: command 0x${this.command.toString(16)} lacks a parameter`);
        }
        this.command = byte;
        this.parameters = [];
        if (byte === SLEEP_OUT) {
            this.awake = true;
            this.ready = this.now() + WAKE_NS;
        } else if (byte === DISPLAY_ON) {
            this.on = true;
        } else if (byte === PIXELS) {
            [this.x, this.y] = [this.columns[0], this.rows[0]];
            this.half = null;
        }
    }

    takeData(byte) {
        if (this.command === PIXELS) {
            this.takePixel(byte);
            return;
        }
        const wanted = PARAMETERS.get(this.command);
        const given = this.parameters;
        given.push(byte);
        if (this.command === null || given.length > wanted) {
            throw new Error("display: a parameter that no command has");
        }
        if (given.length < wanted) {
            return;
        }
        if (this.command === COLUMNS) {
            this.columns = this.range(SIDE);
        } else if (this.command === ROWS) {
            this.rows = this.range(LINES);
        } else if (this.command === FORMAT) {
            this.is16 = byte === BITS_16;
        }
    }

    range(limit) {
        const [a, b, c, d] = this.parameters;
        const [first, last] = [a << 8 | b, c << 8 | d];
        if (first > last || last >= limit) {
            throw new Error(`display: a window from ${first} to ${last}`);
        }
        return [first, last];
    }

    // The upper half comes first; the window is filled from left to right and from the top down.
    takePixel(byte) {
        if (this.half === null) {
            this.half = byte;
            return;
        }
        this.memory[this.y * SIDE + this.x] = this.half << 8 | byte;
        this.half = null;
        if (this.x++ === this.columns[1]) {
            this.x = this.columns[0];
            this.y = this.y === this.rows[1] ? this.rows[0] : this.y + 1;
        }
    }

    // A PPM file of the visible picture, black if the display is off.
    picture() {
        const rgb = Buffer.alloc(3 * SIDE * SIDE);
        const shows = this.awake && this.on && this.is16;
        for (let i = 0; shows && i < SIDE * SIDE; i++) {
            const pixel = this.memory[i];
            rgb[3 * i] = (pixel >> 11) * 255 / 31;
            rgb[3 * i + 1] = (pixel >> 5 & 63) * 255 / 63;
            rgb[3 * i + 2] = (pixel & 31) * 255 / 31;
        }
        return Buffer.concat([Buffer.from(`P6 ${SIDE} ${SIDE} 255\n`), rgb]);
    }
}
