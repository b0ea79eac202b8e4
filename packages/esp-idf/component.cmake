# SPDX-License-Identifier: MIT
# Carom as a component of ESP-IDF. Its build reads the component twice, the first time with this function only.
file(GLOB carom_folders LIST_DIRECTORIES true RELATIVE ${COMPONENT_DIR} ${COMPONENT_DIR}/src/*)
list(FILTER carom_folders EXCLUDE REGEX "\\.")
idf_component_register(SRC_DIRS ${carom_folders} INCLUDE_DIRS include)
