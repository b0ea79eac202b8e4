// SPDX-License-Identifier: MIT
//! The C interface of Carom: its functions, structs and constants as bindgen makes them, and as const functions the
//! macros that it cannot see. The headers in include/ say what everything does, units, formats and errors.
//!
//! Nothing is allocated: blocks of memory are the caller's, [`world_bytes`] and [`mesh_bytes`] say how large.
#![no_std]
#![allow(non_camel_case_types, non_upper_case_globals)]

/// The README's program is compiled with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The types of C that the bindings use, by bindgen's names.
mod c {
    pub use core::ffi::c_void;
    pub type c_int = i32;
    pub type c_uint = u32;
    // char has no sign on these
    #[cfg(any(target_arch = "arm", target_arch = "aarch64", target_arch = "powerpc", target_arch = "powerpc64",
              target_arch = "riscv32", target_arch = "riscv64", target_arch = "s390x"))]
    pub type c_char = u8;
    #[cfg(not(any(target_arch = "arm", target_arch = "aarch64", target_arch = "powerpc", target_arch = "powerpc64",
                  target_arch = "riscv32", target_arch = "riscv64", target_arch = "s390x")))]
    pub type c_char = i8;
}

mod bindings;
mod macros;

pub use bindings::*;
pub use macros::*;

/// A block of memory for a mesh or a world, aligned to 8.
#[repr(C, align(8))]
pub struct Block<const BYTES: usize>(pub [u8; BYTES]);

impl<const BYTES: usize> Block<BYTES> {
    pub const fn new() -> Self {
        Block([0; BYTES])
    }
    pub fn as_mut_ptr(&mut self) -> *mut core::ffi::c_void {
        self.0.as_mut_ptr().cast()
    }
}

impl<const BYTES: usize> Default for Block<BYTES> {
    fn default() -> Self {
        Self::new()
    }
}
