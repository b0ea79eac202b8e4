// SPDX-License-Identifier: MIT
//! Compiles the engine with the C compiler alone: $CC or cc, $AR or ar, $CFLAGS.
use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

fn tool(variable: &str, otherwise: &str) -> String {
    println!("cargo:rerun-if-env-changed={variable}");
    env::var(variable).unwrap_or_else(|_| otherwise.to_string())
}

fn run(command: &mut Command) {
    let status = command.status().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(status.success(), "{command:?}: {status}");
}

/// The sources of the engine: src/STAGE/*.c, in the order of their names.
fn sources(engine: &Path) -> Vec<PathBuf> {
    let inside = |folder: PathBuf| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut found: Vec<PathBuf> = inside(engine.join("src"))
        .filter(|path| path.is_dir())
        .flat_map(inside)
        .filter(|path| path.extension().map_or(false, |suffix| suffix == "c"))
        .collect();
    found.sort();
    found
}

fn main() {
    // in a published crate the engine lies beside this file, in Carom's own tree two folders up
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap());
    let engine = if here.join("engine").is_dir() { here.join("engine") } else { here.join("../..") };
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap());
    let library = out.join("libcarom.a");
    let (cc, ar, flags) = (tool("CC", "cc"), tool("AR", "ar"), tool("CFLAGS", ""));
    let mut objects: Vec<OsString> = Vec::new();

    println!("cargo:rerun-if-changed={}", engine.join("src").display());
    println!("cargo:rerun-if-changed={}", engine.join("include").display());
    for source in sources(&engine) {
        let object = out.join(source.file_name().unwrap()).with_extension("o"); // no two have one name
        run(Command::new(&cc)
            .args(["-std=c11", "-O2", "-fPIC", "-ffunction-sections"])
            .args(flags.split_whitespace())
            .arg("-I")
            .arg(engine.join("include"))
            .arg("-c")
            .arg(&source)
            .arg("-o")
            .arg(&object));
        objects.push(object.into());
    }
    let _ = std::fs::remove_file(&library);
    run(Command::new(&ar).arg("rcs").arg(&library).args(&objects));
    println!("cargo:rustc-link-search=native={}", out.display());
    println!("cargo:rustc-link-lib=static=carom");
    println!("cargo:include={}", engine.join("include").display());
}
