/* SPDX-License-Identifier: MIT */
/* Two callbacks and a size, which a WebAssembly module needs besides the public functions. */
#include "carom_query.h"

#define IMPORT(name) __attribute__((import_module("carom"), import_name(#name)))
#define EXPORT(name) __attribute__((export_name(#name))) name

IMPORT(contact) bool glue_contact(void *user, struct carom_touch *touch);
IMPORT(wants) bool glue_wants(void *context, int body);

/* For config.contact: calls the function that the module received for the world of this number. */
carom_contact_function *EXPORT(glue_contact_function)(void)
{
    return glue_contact;
}

/* For the `wants` of a struct carom_query_filter. */
bool (*EXPORT(glue_wants_function)(void))(void *context, int body)
{
    return glue_wants;
}

size_t EXPORT(glue_mesh_struct_bytes)(void)
{
    return sizeof(struct carom_mesh);
}
