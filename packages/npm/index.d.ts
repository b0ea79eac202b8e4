// SPDX-License-Identifier: MIT
// Units: metres, seconds, kilograms, radians, newtons. A number is cut off to Carom's fixed-point format of its field.

/** x, y, z. */
export type Vector = ArrayLike<number> & Iterable<number>;
/** w, x, y, z, of length 1. */
export type Quaternion = ArrayLike<number> & Iterable<number>;

/** A result below zero: the enum carom_error of carom.h, and its text. */
export class CaromError extends Error {
    readonly code: number;
}

export interface MeshOptions {
    /** An Int16Array holds quanta, 2^-quantumBits m each; any other array holds metres, which are
     * rounded to quanta. */
    vertices: Int16Array | ArrayLike<number> | readonly (readonly number[])[];
    /** Three vertex numbers a face, counter-clockwise from outside. */
    faces: ArrayLike<number> | readonly (readonly number[])[];
    /** 7 to 20; 8 when it is left out, which reaches 128 m. */
    quantumBits?: number;
    /** "solid" is closed; "surface" is a height field; "moving" is a height field whose vertices
     * World.moveSurface moves. */
    kind?: "solid" | "surface" | "moving";
}

/** A mesh in the memory of a module, only for the worlds of that module. */
export interface Mesh {
    readonly vertexCount: number;
    readonly faceCount: number;
    readonly quantumBits: number;
}

/** Capacities, as in carom_memory.h. Missing ones follow from `bodies`. */
export interface Capacities {
    bodies: number;
    pairs?: number;
    contacts?: number;
    faces?: number;
    entries?: number;
    candidates?: number;
    joints?: number;
    extras?: number;
    hits?: number;
}

export interface Touch {
    readonly a: number;
    readonly b: number;
    readonly faceA: number;
    readonly faceB: number;
    readonly point: number[];
    /** From b into a. */
    readonly normal: number[];
    /** The speed at which they approach, m/s. */
    readonly speed: number;
    restitution: number;
    friction: number;
}

export interface WorldOptions {
    caps: Capacities;
    /** Steps a second; 60 when it is left out. */
    fps?: number;
    /** m/s^2; 9.81 downwards along z when it is left out. */
    gravity?: Vector;
    sleep?: boolean;
    substepCap?: number;
    sweepCap?: number;
    /** Asked about each contact; false drops it. The answer must depend only on the argument. */
    contact?: (touch: Touch) => boolean | void;
}

export type Overlap = "refuse" | "pushOut" | "pass";

export interface Filter {
    category: number;
    mask: number;
    group: number;
}

export interface BodyOptions {
    mesh: Mesh;
    stationary?: boolean;
    kinematic?: boolean;
    sensor?: boolean;
    position?: Vector;
    rotation?: Quaternion;
    velocity?: Vector;
    spin?: Vector;
    /** 0: the mesh's volume at 1 kg/m^3. */
    mass?: number;
    restitution?: number;
    friction?: number;
    filter?: Partial<Filter>;
    oneWay?: "both" | "x" | "y" | "z" | "-x" | "-y" | "-z";
    overlap?: Overlap;
}

export interface BodyState {
    position: number[];
    rotation: number[];
    velocity: number[];
    spin: number[];
    asleep: boolean;
    out: boolean;
}

/** The integers of struct carom_body_state. */
export interface RawBodyState {
    position: bigint[];
    rotation: number[];
    velocity: bigint[];
    spin: bigint[];
    asleep: boolean;
    out: boolean;
}

export interface Placing {
    position?: Vector;
    rotation?: Quaternion;
    velocity?: Vector;
    spin?: Vector;
    overlap?: Overlap;
}

export interface Event {
    kind: "begin" | "hit" | "end" | "rest" | "out" | "wake" | "cut" | "sensorBegin" | "sensorEnd" | "break" | "blocked";
    a: number;
    b: number;
    /** Approach of a hit: m/s. */
    speed: number;
    /** Impulse of a hit: N s. */
    impulse: number;
    /** Place and faces of a hit, if the world has room in `hits`. */
    point?: number[];
    normal?: number[];
    faceA?: number;
    faceB?: number;
}

export interface Contact {
    a: number;
    b: number;
    point: number[];
    normal: number[];
    gap: number;
    impulse: number;
}

export interface RayOptions {
    /** Only bodies whose category has a common bit with it; 0: all. */
    mask?: number;
    back?: boolean;
    sensors?: boolean;
    wants?: (body: number) => boolean;
}

export interface RayHit {
    body: number;
    face: number;
    /** The part of the way. */
    t: number;
    point: number[];
    normal: number[];
}

export interface Drive {
    limited?: boolean;
    lower?: number;
    upper?: number;
    motor?: boolean;
    motorSpeed?: number;
    motorMost?: number;
    spring?: boolean;
    rest?: number;
    stiffness?: number;
    damping?: number;
}

export interface JointOptions {
    kind: "ball" | "hinge" | "slider" | "distance" | "fixed";
    a: number;
    /** The world when it is left out. */
    b?: number;
    touch?: boolean;
    anchor: Vector;
    anchorB?: Vector;
    axis?: Vector;
    drive?: Drive;
    mostImpulse?: number;
}

export interface JointState {
    kind: JointOptions["kind"];
    broken: boolean;
    a: number;
    b: number;
    coordinate: number;
    speed: number;
}

export interface Stats {
    ticks: number[];
    total_ticks: number;
    over_stage: number;
    substeps: number;
    hits: number;
    gathers: number;
    refinements: number;
    candidates: number;
    roots: number;
    contacts: number;
    sweeps: number;
    impacts: number;
    energy_rule: number;
    cut_islands: number;
    calmed: number;
}

export class World {
    private constructor();
    readonly fps: number;
    /** The address of the struct carom_world, for `call`. */
    readonly at: number;
    /** The number of the new body. */
    add(body: BodyOptions): number;
    remove(body: number): void;
    state(body: number): BodyState;
    rawState(body: number): RawBodyState;
    /** Place a body and wake it; missing values stay as they are. */
    set(body: number, state: Placing): void;
    /** Lead a kinematic body: it is there at the end of the next step. */
    moveTo(body: number, pose: { position?: Vector; rotation?: Quaternion }): void;
    /** From the mesh's coordinates to the world's: 16 numbers by columns. */
    matrix(body: number): Float64Array;
    matrix<Out extends Float32Array | Float64Array | number[]>(body: number, out: Out): Out;
    /** An impulse at once, N s, at a point of the world or through the centre of mass. */
    push(body: number, impulse: Vector, point?: Vector): void;
    /** A force through the centre of mass until it is changed, N. */
    setForce(body: number, force: Vector): void;
    setGravity(gravity: Vector): void;
    moveSurface(body: number, mesh: Mesh, vertices: MeshOptions["vertices"]): void;
    /** One frame: 0, or a sum of enum carom_status. */
    step(): number;
    /** Counts of the last step. */
    events(): Event[];
    contacts(): Contact[];
    stats(): Stats;
    castRay(from: Vector, way: Vector, options?: RayOptions): RayHit | null;
    addJoint(joint: JointOptions): number;
    removeJoint(joint: number): void;
    driveJoint(joint: number, drive: Drive): void;
    joint(joint: number): JointState;
    /** 64 bits, the same as of the same world on any other machine. */
    hash(): bigint;
    save(): Uint8Array;
    load(snapshot: Uint8Array): void;
    /** A function of the C interface, with the world as its first argument; see Memory for structs. */
    call(name: string, ...given: (number | bigint)[]): number;
}

/** The module's memory, for functions of the C interface for which World has no method. */
export interface Memory {
    /** The exports of the module: all public functions of the engine except the drawing ones. */
    readonly c: WebAssembly.Exports;
    /** A block of zeros, aligned to 8. */
    take(bytes: number): number;
    /** A struct of the C interface, by its name without carom_, for the next call: its address. */
    put(name: string, values?: object): number;
    /** The struct at an address; int64 are bigint. */
    get(name: string, at: number): any;
    /** Call a function; throws CaromError for a result below zero. */
    call(name: string, ...given: (number | bigint)[]): number;
}

/** One module: its meshes and worlds. All of its memory is freed with it. */
export class Carom {
    constructor(module: WebAssembly.Module);
    readonly memory: Memory;
    mesh(options: MeshOptions): Mesh;
    world(options: WorldOptions): World;
}

/** Load the module: from the place of this package, or from a URL, bytes or a compiled module. */
export function load(source?: URL | string | BufferSource | WebAssembly.Module): Promise<Carom>;
