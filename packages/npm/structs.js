// SPDX-License-Identifier: MIT
// The structs of Carom's headers as they lie in the memory of a wasm32 module: types, then names. A pointer is a u32, an
// array is type:count, and a type may be a struct above. test/layout.js compares them with the headers.
const TEXT = {
    caps: "u32 bodies pairs contacts faces entries candidates joints extras hits",
    config:
        "caps caps, i64:3 gravity, bool sleep, u8 substep_cap sweep_cap, u32 ticks budget_ticks contact contact_user",
    mesh_raw: "u32 vertices faces vertex_count face_count, u8 quantum_bits kind",
    touch:
        "u16 a b face_a face_b, i64:3 point, i32:3 normal, i64 speed_q40, i32 restitution_q30, u32 friction_q16",
    filter: "u16 category mask, i16 group",
    body_def:
        "u32 mesh, bool stationary kinematic, i64:3 position, i32:4 rotation, i64:3 velocity spin, u32 mass_q20, " +
        "i32 restitution_q30, u32 friction_q16, filter filter, bool sensor, u8 one_way overlap, u32 user",
    body_state: "i64:3 position, i32:4 rotation, i64:3 velocity spin, bool asleep out, u8 overlap",
    pose: "i64:3 position, i32:4 rotation",
    matrix: "i32:9 r, i64:3 origin",
    event: "u8 kind, u16 a b details, i64 speed_q40 impulse_q40",
    hit: "i64:3 point, i32:3 normal, u16 face_a face_b",
    face_ref: "u16 body face",
    face_pair: "u16 a b",
    contact: "i64:3 point, i32:3 normal, i32 gap_q22, i64 impulse_q40, u16 a b",
    stats:
        "u32:9 ticks, u32 total_ticks over_stage substeps hits gathers refinements candidates roots contacts sweeps " +
        "impacts energy_rule cut_islands calmed",
    usage: "u32 name size used peak refused",
    material: "i32 restitution_q30, u32 friction_q16 rolling_q16, i64:3 surface_velocity",
    forces: "i64:3 force torque, i32 gravity_scale_q16 linear_damping_q30 angular_damping_q30",
    query_filter: "u16 mask flags, u32 wants context",
    ray: "i64:3 from way",
    ray_hit: "u16 body face, i32 t_q30, u32 t_rest, i64:3 point, i32:3 normal",
    query_mesh: "u32 mesh, i64:3 position, i32:4 rotation",
    mesh_way: "i64:3 way, i32:3 turn",
    mesh_hit: "u16 body face own_face, i32 t_q30, i64:3 position, i32:4 rotation, i64:3 point, i32:3 normal",
    closest: "i64 distance_q32, i64:6 point, i32:3 normal, u16:2 face",
    joint_drive:
        "bool limited, i64 lower_q32 upper_q32, bool motor, i64 motor_speed_q40 motor_most_q40, bool spring, " +
        "i64 rest_q32 stiffness_q40 damping_q40",
    joint_def:
        "u8 kind, bool touch, i32 a b, i64:3 anchor anchor_b, i32:3 axis, joint_drive drive, i64 most_impulse_q40",
    joint_state:
        "u8 kind, bool broken, i32 a b, i64:6 anchor, i32:3 axis, i64 coordinate_q32 speed_q40, i64:3 impulse moment, " +
        "i64 drive_q40, joint_drive drive",
};

const SCALARS = {
    bool: [1, (v, at) => v.getUint8(at) !== 0, (v, at, x) => v.setUint8(at, x ? 1 : 0)],
    u8: [1, (v, at) => v.getUint8(at), (v, at, x) => v.setUint8(at, x)],
    u16: [2, (v, at) => v.getUint16(at, true), (v, at, x) => v.setUint16(at, x, true)],
    i16: [2, (v, at) => v.getInt16(at, true), (v, at, x) => v.setInt16(at, x, true)],
    u32: [4, (v, at) => v.getUint32(at, true), (v, at, x) => v.setUint32(at, x, true)],
    i32: [4, (v, at) => v.getInt32(at, true), (v, at, x) => v.setInt32(at, x, true)],
    i64: [8, (v, at) => v.getBigInt64(at, true), (v, at, x) => v.setBigInt64(at, x, true)],
};

function scalar([size, read, write]) {
    return { size, align: size, read, write };
}

function array(type, count) {
    return {
        size: type.size * count,
        align: type.align,
        read: (v, at) => Array.from({ length: count }, (_, i) => type.read(v, at + i * type.size)),
        write: (v, at, values) => {
            for (let i = 0; i < count; i++) {
                type.write(v, at + i * type.size, values[i]);
            }
        },
    };
}

function struct(fields) {
    const align = Math.max(...fields.map((field) => field.type.align));
    const last = fields[fields.length - 1];
    return {
        fields,
        align,
        size: Math.ceil((last.at + last.type.size) / align) * align,
        read: (v, at) =>
            Object.fromEntries(fields.map((f) => [f.name, f.type.read(v, at + f.at)])),
        // missing fields stay as they are: zero in cleared memory
        write: (v, at, values) => {
            for (const name of Object.keys(values)) {
                const field = fields.find((f) => f.name === name);
                if (!field) {
                    throw new TypeError(`a struct has no field ${name}`);
                }
                field.type.write(v, at + field.at, values[name]);
            }
        },
    };
}

/** The structs by name: size, align, fields, read(DataView, address) and write(DataView, address, values). */
export const structs = {};

for (const [name, text] of Object.entries(TEXT)) {
    const fields = [];
    let at = 0;
    for (const group of text.split(", ")) {
        const [written, ...names] = group.split(" ");
        const [base, count] = written.split(":");
        const single = SCALARS[base] ? scalar(SCALARS[base]) : structs[base];
        const type = count ? array(single, Number(count)) : single;
        for (const field of names) {
            at = Math.ceil(at / type.align) * type.align;
            fields.push({ name: field, at, type });
            at += type.size;
        }
    }
    structs[name] = struct(fields);
}
