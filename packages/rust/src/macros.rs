// SPDX-License-Identifier: MIT
//! The macros of the headers that take arguments, as const functions; tests/macros.rs compares them with C.
use crate::bindings::*;
use core::mem::size_of;

const fn bytes_by_pointer(narrow: usize, wide: usize) -> usize {
    if size_of::<*const u8>() > 4 {
        wide
    } else {
        narrow
    }
}

const fn less(a: usize, b: usize) -> usize {
    if a < b {
        a
    } else {
        b
    }
}

const fn more(a: usize, b: usize) -> usize {
    if a > b {
        a
    } else {
        b
    }
}

/// CAROM_CAPS of all nine.
#[allow(clippy::too_many_arguments)]
pub const fn caps(
    bodies: u32, pairs: u32, contacts: u32, faces: u32, entries: u32, candidates: u32, joints: u32, extras: u32,
    hits: u32,
) -> carom_caps {
    carom_caps { bodies, pairs, contacts, faces, entries, candidates, joints, extras, hits }
}

/// CAROM_WORLD_BYTES: bytes of the block of a world.
pub const fn world_bytes(caps: &carom_caps) -> usize {
    let (b, p, c) = (caps.bodies as usize, caps.pairs as usize, caps.contacts as usize);
    let (f, e, n) = (caps.faces as usize, caps.entries as usize, caps.candidates as usize);
    let (j, x, h) = (caps.joints as usize, caps.extras as usize, caps.hits as usize);
    let heads = if e > 0 { 2048 } else { 0 };
    let drift = if e + x > 0 { 24 * c } else { 0 };
    let mixed = if x > 0 { 8 * c } else { 0 };
    let solve = c * bytes_by_pointer(200, 208) + less(p, c) * 64;
    let found = (2 * p + b + j) * size_of::<carom_event>();
    let sum = bytes_by_pointer(744, 992)
        + b * bytes_by_pointer(816, 824)
        + p * 64
        + c * bytes_by_pointer(224, 248)
        + f * 4
        + e * 8
        + heads
        + drift
        + mixed
        + n * 12
        + j * bytes_by_pointer(2192, 2216)
        + x * bytes_by_pointer(208, 216)
        + h * 40
        + more(solve, found + bytes_by_pointer(1880, 1952));

    (sum + 7) / 8 * 8
}

const fn array(count: usize, size: usize) -> usize {
    (count * size + 7) / 8 * 8
}

/// CAROM_MESH_BYTES: bytes of the block of a mesh.
pub const fn mesh_bytes(vertices: u32, faces: u32) -> usize {
    let (v, f) = (vertices as usize, faces as usize);
    let leaf_faces = CAROM_LEAF_FACES as usize;
    let edges = more(3 * f / 2, less(3 * f, 3 * v - 6));
    let leaves = (f + leaf_faces - 1) / leaf_faces * if v > CAROM_LEAF_VERTICES as usize { 2 } else { 1 };

    array(f, size_of::<carom_face>())
        + array(edges, size_of::<carom_edge>())
        + array(v + 1, 4)
        + array(2 * edges, 4)
        + array(leaves, size_of::<carom_leaf>())
        + array(f, 2)
        + array(less(3 * f, v * leaves), 2)
        + array(3 * f, 1)
        + array(less(1024, 2 * f / 3 + 1) + 1, 4)
        + array(8 * f, size_of::<carom_zref>())
}

/// CAROM_SURFACE_BYTES: bytes of the block of a moving surface.
pub const fn surface_bytes(vertices: u32, faces: u32) -> usize {
    mesh_bytes(vertices, faces) + (12 * vertices as usize + 80 + 7) / 8 * 8
}

/// CAROM_BLOB_BYTES: memory for carom_mesh_read.
pub const fn blob_bytes(vertices: u32, faces: u32) -> usize {
    6 * vertices as usize + 6 * faces as usize + 16
}

/// CAROM_RATIO: n / d with `bits` fractional bits, truncated.
pub const fn ratio(n: i64, d: i64, bits: u32) -> i64 {
    n * (1 << bits) / d
}

/// CAROM_POSITION_MM
pub const fn position_mm(mm: i64) -> i64 {
    ratio(mm, 1000, 32)
}

/// CAROM_VELOCITY_MM_S; CAROM_SPIN_MRAD_S of milliradians a second
pub const fn velocity_mm_s(mm_s: i64, fps: i64) -> i64 {
    ratio(mm_s, 1000 * fps, 40)
}

/// CAROM_SPIN_MRAD_S
pub const fn spin_mrad_s(mrad_s: i64, fps: i64) -> i64 {
    velocity_mm_s(mrad_s, fps)
}

/// CAROM_SPIN_DEG_S
pub const fn spin_deg_s(deg_s: i64, fps: i64) -> i64 {
    deg_q40(deg_s) / fps
}

/// CAROM_GRAVITY_MM_S2
pub const fn gravity_mm_s2(mm_s2: i64, fps: i64) -> i64 {
    ratio(mm_s2, 1000 * fps * fps, 40)
}

/// CAROM_ANGLE_MRAD
pub const fn angle_mrad(mrad: i64) -> i32 {
    ratio(mrad, 1000, 30) as i32
}

/// CAROM_ANGLE_DEG
pub const fn angle_deg(deg: i64) -> i32 {
    (deg_q40(deg) / 1024) as i32
}

/// CAROM_MASS_G
pub const fn mass_g(g: i64) -> u32 {
    ratio(g, 1000, 20) as u32
}

/// CAROM_FORCE_MN; CAROM_TORQUE_MN_M of millinewton metres
pub const fn force_mn(mn: i64, fps: i64) -> i64 {
    ratio(mn, 1000 * fps * fps, 40)
}

/// CAROM_IMPULSE_MN_S; CAROM_TWIST_MN_M_S of millinewton metre seconds
pub const fn impulse_mn_s(mn_s: i64, fps: i64) -> i64 {
    ratio(mn_s, 1000 * fps, 40)
}

/// pi / 180 is 0x477D1A894.A74E4570 2^-40
const fn deg_q40(deg: i64) -> i64 {
    deg * 0x477D1A894 + deg * 0xA74E4570 / (1 << 32)
}

/// CAROM_DRAW_BYTES: workspace that draws bodies with this total of vertices and faces in one part.
pub const fn draw_bytes(vertices: u32, faces: u32) -> usize {
    12288 + 10 * vertices as usize + 11 * faces as usize
}

/// CAROM_DRAW_BYTES_LEAST: workspace for the largest mesh.
pub const fn draw_bytes_least(vertices: u32, faces: u32) -> usize {
    12288 + 2 * vertices as usize + faces as usize / 8
}
