// SPDX-License-Identifier: MIT
//! examples/hello.c in Rust. With an argument it also prints the hash of its world.
use carom_sys::*;
use std::mem::{size_of_val, zeroed};
use std::ptr::{addr_of_mut, null_mut};

// A tetrahedron and a triangle to fall on, counter-clockwise from outside; 256 quanta a metre.
static CORNERS: [[i16; 3]; 4] = [[99, 99, 99], [99, -99, -99], [-99, 99, -99], [-99, -99, 99]];
static SIDES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
static FAR_CORNERS: [[i16; 3]; 3] = [[-9999, -9999, 0], [9999, -9999, 0], [0, 9999, 0]];

// bodies, pairs, contacts, faces, entries, candidates, joints, extras, hits
const CAPS: carom_caps = caps(2, 1, 16, 16, 32, 64, 0, 0, 0);

fn raw(vertices: &'static [[i16; 3]], faces: &'static [[u16; 3]], kind: carom_mesh_kind) -> carom_mesh_raw {
    carom_mesh_raw {
        vertices: vertices.as_ptr(),
        faces: faces.as_ptr(),
        vertex_count: vertices.len() as u32,
        face_count: faces.len() as u32,
        quantum_bits: 8,
        kind: kind as u8,
    }
}

fn checked(result: i32) -> i32 {
    assert!(result >= 0, "Carom says {result}");
    result
}

fn main() {
    let mut blocks = [Block::<{ mesh_bytes(4, 4) }>::new(), Block::new()];
    let mut block = Block::<{ world_bytes(&CAPS) }>::new();

    // SAFETY: the blocks and meshes stay where they are, longer than the world; zero is a value of each struct
    unsafe {
        let mut meshes: [carom_mesh; 2] = zeroed();
        let raws = [raw(&FAR_CORNERS, &SIDES[..1], CAROM_SURFACE), raw(&CORNERS, &SIDES, CAROM_SOLID)];
        for (i, raw) in raws.iter().enumerate() {
            let bytes = size_of_val(&blocks[i]);
            checked(carom_mesh_build(&mut meshes[i], raw, blocks[i].as_mut_ptr(), bytes));
        }
        let mut config: carom_config = zeroed();
        config.caps = CAPS;
        config.gravity.c[2] = gravity_mm_s2(-9810, 60);
        config.sleep = true;
        let mut world: *mut carom_world = null_mut();
        checked(carom_world_init(block.as_mut_ptr(), size_of_val(&block), &config, addr_of_mut!(world)));

        let mut ground: carom_body_def = zeroed();
        ground.mesh = &meshes[0];
        ground.stationary = true;
        ground.friction_q16 = 1 << 15;
        let mut falling: carom_body_def = zeroed();
        falling.mesh = &meshes[1];
        falling.position.c[2] = position_mm(2000);
        falling.spin.c[0] = spin_mrad_s(900, 60);
        falling.friction_q16 = 1 << 15;
        checked(carom_body_add(world, &ground));
        let body = checked(carom_body_add(world, &falling));

        let mut state: carom_body_state = zeroed();
        let mut frame = 0;
        while !state.asleep && carom_world_step(world) >= 0 {
            frame += 1;
            checked(carom_body_get(world, body, &mut state));
            if frame % 10 == 0 {
                println!("frame {:2}: {:4} mm up", frame, state.position.c[2] * 1000 >> 32);
            }
        }
        if std::env::args().len() > 1 {
            println!("hash {:016x}", carom_world_hash(world));
        }
    }
}
