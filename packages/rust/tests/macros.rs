// SPDX-License-Identifier: MIT
//! The const functions equal the macros of the headers: a C program prints the macros for the same arguments.
use carom_sys::*;
use std::fmt::Write;
use std::mem::{align_of, size_of};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The output of tests/macros.c, compiled with the engine's headers.
fn said_by_c() -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let own = here.join("engine/include");
    let include = if own.is_dir() { own } else { here.join("../../include") };
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("macros");
    let cc = std::env::var("CC").unwrap_or_else(|_| "cc".to_string());
    let status = Command::new(cc)
        .args(["-std=c11", "-I"])
        .arg(include)
        .arg(here.join("tests/macros.c"))
        .arg("-o")
        .arg(&program)
        .status()
        .unwrap();
    assert!(status.success());
    String::from_utf8(Command::new(program).output().unwrap().stdout).unwrap()
}

fn say(out: &mut String, value: i64) {
    writeln!(out, "{value}").unwrap();
}

fn say_meshes(out: &mut String) {
    const COUNTS: [u32; 10] = [3, 4, 8, 32, 33, 100, 940, 1876, 20000, 65535];
    for v in COUNTS {
        for f in COUNTS {
            for of in [mesh_bytes, surface_bytes, blob_bytes, draw_bytes, draw_bytes_least] {
                say(out, of(v, f) as i64);
            }
        }
    }
}

fn say_worlds(out: &mut String) {
    const FEW: [u32; 9] = [1, 1, 1, 1, 0, 1, 0, 0, 0];
    const MANY: [u32; 9] = [100, 333, 77, 1000, 64, 2047, 9, 15, 21];
    for choice in 0..512 {
        let n = |i: usize| if choice >> i & 1 == 1 { MANY[i] } else { FEW[i] };
        let caps = caps(n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8));
        say(out, world_bytes(&caps) as i64);
    }
}

fn say_units(out: &mut String) {
    for number in [0, 1, -1, 90, -359, 9810, -9810, 1234567] {
        say(out, position_mm(number));
        for fps in [1, 25, 60, 1000] {
            for of in [velocity_mm_s, spin_mrad_s, spin_deg_s, gravity_mm_s2, force_mn, impulse_mn_s] {
                say(out, of(number, fps));
            }
        }
    }
    for small in (-110..=110).step_by(11) {
        say(out, angle_mrad(small * 10).into());
        say(out, angle_deg(small).into());
        say(out, ratio(small, 7, 30));
    }
    say(out, mass_g(70).into());
    say(out, mass_g(1000000).into());
}

#[test]
fn const_functions_are_the_macros_of_c() {
    let mut out = String::new();
    say_meshes(&mut out);
    say_worlds(&mut out);
    say_units(&mut out);
    macro_rules! say_size {
        ($($name:ident)*) => {
            $(writeln!(out, "struct {} {} {}", stringify!($name), size_of::<$name>(), align_of::<$name>()).unwrap();)*
        };
    }
    say_size!(carom_mesh carom_config carom_body_def carom_body_state carom_event carom_contact carom_touch
              carom_stats carom_usage carom_joint_def carom_joint_state carom_ray_hit carom_mesh_hit
              carom_cast_workspace carom_closest carom_material carom_forces carom_picture carom_debug);
    let said = said_by_c();
    assert!(said.lines().count() > 1000);
    for (number, (c, rust)) in said.lines().zip(out.lines()).enumerate() {
        assert_eq!(c, rust, "line {}", number + 1);
    }
    assert_eq!(said.lines().count(), out.lines().count());
}

#[test]
fn the_library_says_the_version_of_the_crate() {
    let version = unsafe { carom_version() };
    let text = format!("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
    assert_eq!(text, env!("CARGO_PKG_VERSION"));
}

#[test]
fn the_library_says_the_same_sizes() {
    let caps = caps(5, 9, 33, 100, 64, 200, 3, 4, 7);
    unsafe {
        assert_eq!(carom_world_bytes(&caps), world_bytes(&caps));
        assert_eq!(carom_mesh_bytes(940, 1876), mesh_bytes(940, 1876));
    }
}
