# SPDX-License-Identifier: MIT
# What the application calls of the Pico SDK's CMake, in its place: the programs are of this machine.
function(pico_sdk_init)
    add_library(pico_stdlib INTERFACE)
    target_compile_options(pico_stdlib INTERFACE -Os)
endfunction()
function(pico_add_extra_outputs name)
endfunction()
