// SPDX-License-Identifier: MIT
// The fixed-point fields of Carom's structs: fractional bits, and the power of seconds in their unit.

/*
 * name of a field in SI; bits; per: 1 for a value per second, 2 for one per second squared; wide:
 * int64.
 */
export const FORMATS = {
    position: { bits: 32, per: 0, wide: true },
    from: { bits: 32, per: 0, wide: true },
    way: { bits: 32, per: 0, wide: true },
    point: { bits: 32, per: 0, wide: true },
    anchor: { bits: 32, per: 0, wide: true },
    anchor_b: { bits: 32, per: 0, wide: true },
    rotation: { bits: 30, per: 0 },
    normal: { bits: 30, per: 0 },
    axis: { bits: 30, per: 0 },
    velocity: { bits: 40, per: 1, wide: true },
    spin: { bits: 40, per: 1, wide: true },
    impulse: { bits: 40, per: 1, wide: true },
    gravity: { bits: 40, per: 2, wide: true },
    force: { bits: 40, per: 2, wide: true },
    mass_q20: { name: "mass", bits: 20, per: 0 },
    restitution_q30: { name: "restitution", bits: 30, per: 0 },
    friction_q16: { name: "friction", bits: 16, per: 0 },
    gap_q22: { name: "gap", bits: 22, per: 0 },
    t_q30: { name: "t", bits: 30, per: 0 },
    speed_q40: { name: "speed", bits: 40, per: 1, wide: true },
    impulse_q40: { name: "impulse", bits: 40, per: 1, wide: true },
    most_impulse_q40: { name: "mostImpulse", bits: 40, per: 1, wide: true },
    face_a: { name: "faceA", bits: 0, per: 0 },
    face_b: { name: "faceB", bits: 0, per: 0 },
    coordinate_q32: { name: "coordinate", bits: 32, per: 0, wide: true },
    lower_q32: { name: "lower", bits: 32, per: 0, wide: true },
    upper_q32: { name: "upper", bits: 32, per: 0, wide: true },
    rest_q32: { name: "rest", bits: 32, per: 0, wide: true },
    motor_speed_q40: { name: "motorSpeed", bits: 40, per: 1, wide: true },
    motor_most_q40: { name: "motorMost", bits: 40, per: 2, wide: true },
    stiffness_q40: { name: "stiffness", bits: 40, per: 2, wide: true },
    damping_q40: { name: "damping", bits: 40, per: 1, wide: true },
};

/**
 * An SI value, or an array of them, as the integers of a field: truncated, as by the macros of
 * carom_fix.h.
 */
export function convert(name, value, fps) {
    if (typeof value !== "number") {
        return Array.from(value, (each) => convert(name, each, fps));
    }
    const { bits, per, wide } = FORMATS[name];
    const whole = Math.trunc((value * 2 ** bits) / fps ** per);
    if (!Number.isFinite(whole) || Math.abs(whole) >= 2 ** (wide ? 63 : 32)) {
        throw new RangeError(`${name}: ${value} is out of range`);
    }
    return wide ? BigInt(whole) : whole;
}

/** The reverse. */
export function restore(name, value, fps) {
    if (Array.isArray(value)) {
        return value.map((each) => restore(name, each, fps));
    }
    const { bits, per } = FORMATS[name];
    return (Number(value) / 2 ** bits) * fps ** per;
}
