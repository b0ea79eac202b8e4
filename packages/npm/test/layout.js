// SPDX-License-Identifier: MIT
// Write a C file that compiles for wasm32 only if structs.js lays every struct out as the headers do.
import { structs } from "../structs.js";

const INCLUDES = ["carom_body.h", "carom_joint.h", "carom_query.h"];
const lines = INCLUDES.map((name) => `#include "${name}"`);

function hold(condition) {
    lines.push(`_Static_assert(${condition}, "structs.js");`);
}

for (const [name, { size, fields }] of Object.entries(structs)) {
    hold(`sizeof(struct carom_${name}) == ${size}`);
    for (const field of fields) {
        hold(`offsetof(struct carom_${name}, ${field.name}) == ${field.at}`);
        hold(`sizeof ((struct carom_${name} *)0)->${field.name} == ${field.type.size}`);
    }
}
console.log(lines.join("\n"));
