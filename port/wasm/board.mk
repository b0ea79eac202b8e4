# SPDX-License-Identifier: MIT
# WebAssembly without a library, in node. It shows no scenes: `make replay` and `make matrix` run programs there.
NEED := clang lld llvm node
HOSTED := 1
CROSS := llvm-
COMPILER := clang --target=wasm32
PORT := port/wasm/wasm.c port/nolibc/string.c
SHADOWS := 1
SMOOTH := 1
FAMILY_CFLAGS := -ffreestanding -Iport/nolibc
FAMILY_LDFLAGS := -nostdlib -Wl,--no-entry,--export=main,-z,stack-size=262144
RUNNER := port/wasm/run.mjs
# The page of `make web`: the functions that it calls besides those of page.c, and its memory.
PAGE_EXPORTS := view_open view_restart view_toggles view_usual view_orbit view_pan view_zoom view_home view_keys view_grab view_drag \
    view_drop view_pause view_single view_slow view_frame view_step_count view_hash view_scene view_says view_link \
    view_follow scene_name scene_text carom_result_text carom_stage_name \
    page_text page_vertices page_faces page_shown page_room page_open_mesh page_size page_draw page_took page_is_game
