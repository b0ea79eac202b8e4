/* SPDX-License-Identifier: MIT */
/* The headers that src/bindings.rs translates to Rust. */
#include "carom_version.h"
#include "carom_body.h"
#include "carom_debug.h"
#include "carom_joint.h"
#include "carom_query.h"
