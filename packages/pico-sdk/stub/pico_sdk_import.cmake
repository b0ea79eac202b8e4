# SPDX-License-Identifier: MIT
# Stubs of the functions of the Pico SDK's CMake that the application calls. The programs run on this machine.
function(pico_sdk_init)
    add_library(pico_stdlib INTERFACE)
    target_compile_options(pico_stdlib INTERFACE -Os)
endfunction()
function(pico_add_extra_outputs name)
endfunction()
