// SPDX-License-Identifier: MIT
// A world: metres, seconds, kilograms and radians outside, Carom's integers inside. A number is cut off to its format as by the macros of
// carom_fix.h, so that 9.81 here and CAROM_GRAVITY_MM_S2(9810, 60) there are the same bits.
import { convert, restore, FORMATS } from "./units.js";
import { structs } from "./structs.js";

const EVENTS = ["begin", "hit", "end", "rest", "out", "wake", "cut", "sensorBegin", "sensorEnd", "break", "blocked"];
const JOINTS = ["ball", "hinge", "slider", "distance", "fixed"];
const ONE_WAY = ["both", "x", "y", "z", "-x", "-y", "-z"];
const OVERLAP = ["refuse", "pushOut", "pass"];
const BACK = 1;
const SENSORS = 2;

/* The index of a name in a list, which is the value of the C enumeration. */
export function number(names, name) {
    const found = names.indexOf(name);
    if (found < 0) {
        throw new TypeError(`'${name}' is none of ${names.join(", ")}`);
    }
    return found;
}

/* The given capacities; the others follow from the number of bodies. */
function capacities({ bodies, ...given }) {
    const most = (count) => Math.min(count, 65535);
    return {
        bodies, pairs: most(8 * bodies), contacts: Math.min(16 * bodies + 16, 4096), faces: most(64 * bodies + 1024),
        entries: 0, candidates: most(256 * bodies + 1024), joints: 0, extras: bodies, hits: bodies, ...given,
    };
}

export class World {
    constructor(memory, place, options) {
        const { fps = 60, gravity = [0, 0, -9.81], sleep = true, contact, substepCap = 0, sweepCap = 0 } = options;
        this.memory = memory;
        this.place = place;
        this.fps = fps;
        this.contact = contact;
        this.caps = capacities(options.caps);
        this.contactRoom = memory.take(this.caps.contacts * structs.contact.size);
        const caps = memory.put("caps", this.caps);
        const bytes = memory.c.carom_world_bytes(caps);
        const out = memory.take(8);
        const block = memory.take(bytes);
        const config = memory.put("config", {
            caps: this.caps, gravity: convert("gravity", gravity, fps), sleep,
            substep_cap: substepCap, sweep_cap: sweepCap,
            contact: contact ? memory.c.glue_contact_function() : 0, contact_user: place,
        });
        memory.call("carom_world_init", block, bytes, config, out);
        this.out = out;
        this.at = memory.view().getUint32(out, true);
    }

    /** Call a function of the C interface whose first argument is the world. */
    call(name, ...given) {
        return this.memory.call(name, this.at, ...given);
    }

    /** SI values of a struct's fields as the integers of their formats; other fields stay as they are. */
    #raw(values) {
        const raw = {};
        for (const [name, value] of Object.entries(values)) {
            if (value !== undefined) {
                raw[name] = FORMATS[name] ? convert(name, value, this.fps) : value;
            }
        }
        return raw;
    }

    #si(values) {
        const si = {};
        for (const [name, value] of Object.entries(values)) {
            si[FORMATS[name]?.name ?? name] = FORMATS[name] ? restore(name, value, this.fps) : value;
        }
        return si;
    }

    add({ mesh, mass, restitution, friction, oneWay = "both", overlap = "refuse", ...rest }) {
        return this.call("carom_body_add", this.memory.put("body_def", this.#raw({
            mesh: mesh.at, mass_q20: mass, restitution_q30: restitution, friction_q16: friction,
            one_way: number(ONE_WAY, oneWay), overlap: number(OVERLAP, overlap), ...rest,
        })));
    }

    remove(body) {
        this.call("carom_body_remove", body);
    }

    #get(name, struct, ...given) {
        const at = this.memory.put(struct);
        this.call(name, ...given, at);
        return this.memory.get(struct, at);
    }

    /** The integers of a body's state, as carom_body_get returns them. */
    rawState(body) {
        return this.#get("carom_body_get", "body_state", body);
    }

    state(body) {
        const { overlap, ...state } = this.rawState(body);
        return this.#si(state);
    }

    set(body, { overlap = "refuse", ...values }) {
        const state = { ...this.rawState(body), ...this.#raw(values), overlap: number(OVERLAP, overlap) };
        this.call("carom_body_set", body, this.memory.put("body_state", state));
    }

    moveTo(body, { position, rotation }) {
        const state = this.rawState(body);
        const pose = { position: state.position, rotation: state.rotation, ...this.#raw({ position, rotation }) };
        this.call("carom_body_move_to", body, this.memory.put("pose", pose));
    }

    /** From the mesh's axes to the world's: 16 numbers by columns, as WebGL expects them. */
    matrix(body, out = new Float64Array(16)) {
        const { r, origin } = this.#get("carom_body_matrix", "matrix", body);
        for (let row = 0; row < 3; row++) {
            for (let column = 0; column < 3; column++) {
                out[4 * column + row] = r[3 * row + column] / 2 ** 30;
            }
            out[12 + row] = Number(origin[row]) / 2 ** 32;
            out[4 * row + 3] = 0;
        }
        out[15] = 1;
        return out;
    }

    #vector(name, value) {
        return this.memory.keepVector(convert(name, value, this.fps));
    }

    push(body, impulse, point) {
        const given = this.#vector("impulse", impulse);
        if (point) {
            this.call("carom_body_push", body, given, this.#vector("position", point));
        } else {
            this.call("carom_body_push_centre", body, given);
        }
    }

    setForce(body, force) {
        this.call("carom_body_set_force", body, this.#vector("force", force));
    }

    setGravity(gravity) {
        this.call("carom_world_set_gravity", this.#vector("gravity", gravity));
    }

    /* Move the vertices of a mesh of kind "moving", from the next step on. */
    moveSurface(body, mesh, vertices) {
        const places = mesh.quanta(vertices);
        if (places.length !== 3 * mesh.vertexCount) {
            throw new RangeError(`${mesh.vertexCount} vertices are wanted`);
        }
        mesh.room ??= this.memory.take(places.byteLength);
        new Int16Array(this.memory.c.memory.buffer, mesh.room, places.length).set(places);
        this.call("carom_surface_move", body, mesh.room);
    }

    step() {
        return this.call("carom_world_step");
    }

    #event(event, at) {
        const { kind, details, ...rest } = event;
        const found = { kind: EVENTS[kind], ...this.#si(rest) };
        if (details !== 0) {
            Object.assign(found, this.#si(this.#get("carom_event_hit", "hit", at)));
        }
        return found;
    }

    events() {
        const count = this.call("carom_events", this.out);
        const at = this.memory.view().getUint32(this.out, true);
        const { size } = structs.event;
        return this.memory.list("event", at, count).map((event, i) => this.#event(event, at + i * size));
    }

    contacts() {
        const count = this.call("carom_contacts", this.contactRoom, this.caps.contacts);
        return this.memory.list("contact", this.contactRoom, count).map((contact) => this.#si(contact));
    }

    castRay(from, way, { mask = 0, back = false, sensors = false, wants } = {}) {
        this.wants = wants;
        const filter = this.memory.put("query_filter", {
            mask, flags: (back ? BACK : 0) + (sensors ? SENSORS : 0),
            wants: wants ? this.memory.c.glue_wants_function() : 0, context: this.place,
        });
        const ray = this.memory.put("ray", this.#raw({ from, way }));
        const at = this.memory.put("ray_hit");
        if (this.call("carom_cast_ray", ray, filter, at) === 0) {
            return null;
        }
        const { t_rest, ...hit } = this.memory.get("ray_hit", at);
        return this.#si(hit);
    }

    #drive(drive) {
        const { lower, upper, motorSpeed, motorMost, rest, stiffness, damping, ...flags } = drive;
        return this.#raw({
            lower_q32: lower, upper_q32: upper, motor_speed_q40: motorSpeed, motor_most_q40: motorMost,
            rest_q32: rest, stiffness_q40: stiffness, damping_q40: damping, ...flags,
        });
    }

    addJoint({ kind, a, b = -1, drive = {}, anchorB, mostImpulse, ...rest }) {
        return this.call("carom_joint_add", this.memory.put("joint_def", this.#raw({
            kind: number(JOINTS, kind), a, b, drive: this.#drive(drive), anchor_b: anchorB,
            most_impulse_q40: mostImpulse, ...rest,
        })));
    }

    removeJoint(joint) {
        this.call("carom_joint_remove", joint);
    }

    driveJoint(joint, drive) {
        this.call("carom_joint_set", joint, this.memory.put("joint_drive", this.#drive(drive)));
    }

    joint(joint) {
        const state = this.#get("carom_joint_get", "joint_state", joint);
        const { coordinate, speed } = this.#si({
            coordinate_q32: state.coordinate_q32, speed_q40: state.speed_q40,
        });
        return { kind: JOINTS[state.kind], broken: state.broken, a: state.a, b: state.b, coordinate, speed };
    }

    stats() {
        return this.#get("carom_stats", "stats");
    }

    hash() {
        return BigInt.asUintN(64, this.memory.c.carom_world_hash(this.at));
    }

    save() {
        const size = this.call("carom_snapshot_size");
        if (size > (this.savedBytes ?? 0)) {
            this.saved = this.memory.take(size);
            this.savedBytes = size;
        }
        this.call("carom_snapshot_save", this.saved, size);
        return this.memory.bytes(this.saved, size).slice();
    }

    load(snapshot) {
        if (snapshot.length > (this.savedBytes ?? 0)) {
            this.saved = this.memory.take(snapshot.length);
            this.savedBytes = snapshot.length;
        }
        this.memory.bytes(this.saved, snapshot.length).set(snapshot);
        this.call("carom_snapshot_load", this.saved, snapshot.length);
    }

    /** config.contact: the function sees SI values and may change e and mu; false drops the contact. */
    askContact(at) {
        const raw = this.memory.get("touch", at);
        const touch = this.#si(raw);
        const keep = this.contact(touch) !== false;
        structs.touch.write(this.memory.view(), at, this.#raw({
            restitution_q30: touch.restitution, friction_q16: touch.friction,
        }));
        return keep ? 1 : 0;
    }

    askWants(body) {
        return this.wants(body) ? 1 : 0;
    }
}
