# SPDX-License-Identifier: MIT
# Carom for the Pico SDK: include() this file after pico_sdk_init(), and link carom, or carom_draw, which brings it. These are INTERFACE libraries,
# as the SDK's own: their sources are compiled with the options of the program that links them.
get_filename_component(CAROM_ROOT ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
file(GLOB carom_sources CONFIGURE_DEPENDS ${CAROM_ROOT}/src/*/*.c)
file(GLOB carom_draw_sources CONFIGURE_DEPENDS ${CAROM_ROOT}/src/draw/*.c)
list(REMOVE_ITEM carom_sources ${carom_draw_sources})

add_library(carom INTERFACE)
target_sources(carom INTERFACE ${carom_sources})
target_include_directories(carom INTERFACE ${CAROM_ROOT}/include)

add_library(carom_draw INTERFACE)
target_sources(carom_draw INTERFACE ${carom_draw_sources})
target_link_libraries(carom_draw INTERFACE carom)
