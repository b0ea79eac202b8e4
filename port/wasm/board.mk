# SPDX-License-Identifier: MIT
# WebAssembly without a library, in node. It shows no scenes: `make replay` and `make matrix` run programs there.
NEED := clang lld llvm node
HOSTED := 1
CROSS := llvm-
COMPILER := clang --target=wasm32
PORT := port/wasm/wasm.c port/nolibc/string.c
FAMILY_CFLAGS := -ffreestanding -Iport/nolibc
FAMILY_LDFLAGS := -nostdlib -Wl,--no-entry,--export=main,-z,stack-size=262144
RUNNER := port/wasm/run.mjs
