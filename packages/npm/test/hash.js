// SPDX-License-Identifier: MIT
// The world of examples/hello.c after its last step: its hash, for comparison with the C program's.
import { hello } from "./worlds.js";

const { world } = await hello();
console.log(`hash ${world.hash().toString(16).padStart(16, "0")}`);
