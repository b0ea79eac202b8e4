/* SPDX-License-Identifier: MIT */
/* edits - changes to the bytes of a file, as chance wants, and its check sum made right again. */
#ifndef CAROM_TESTS_EDITS_H
#define CAROM_TESTS_EDITS_H

#include "carom_mesh.h"
#include "chance.h"

/* Change up to four places before `size`. Lengths stay. */
void edit_bytes(struct chance *c, uint8_t *bytes, size_t size);
/* Make the check sum at the end of a recording that of all bytes before. bytes_mend() is for snapshots and blobs. */
void edit_mend32(uint8_t *bytes, size_t size);

/* Write the blob of a mesh as SPEC.md, 3.3 lays it down, into EDIT_BLOB_BYTES; returns its size. */
#define EDIT_BLOB_BYTES(vertices, faces) (24 + 6 * ((vertices) + (faces)))
size_t edit_write_blob(const struct carom_mesh_raw *raw, uint8_t *blob);

#endif
