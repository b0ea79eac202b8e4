/* SPDX-License-Identifier: MIT */
/*
 * mesh_rom - an indexed mesh as C: constant arrays and the struct carom_mesh that refers to them,
 * for a board without memory for indexing meshes. carom_mesh_build makes the index on the host.
 */
#ifndef CAROM_TOOLS_MESH_ROM_HPP
#define CAROM_TOOLS_MESH_ROM_HPP

#include <string>
#include <vector>

#include "carom.h"

namespace rom
{

/* Index a raw mesh in `memory`; returns the result of carom_mesh_build. */
int index(carom_mesh &mesh, const carom_mesh_raw &raw, std::vector<uint64_t> &memory);

/*
 * Definitions of the mesh's arrays and, under its name, of the mesh itself.
 *   is_static  the mesh is for this source file only
 */
std::string c_source(const carom_mesh &mesh, const std::string &name, bool is_static);

} // namespace rom

#endif
