// Prints, as JSON, what the Khronos validator says of the GLB file named on the command line.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(new URL("../../web/package.json", import.meta.url));
const { validateBytes } = require("gltf-validator");

const bytes = new Uint8Array(readFileSync(process.argv[2]));
const report = await validateBytes(bytes, { maxIssues: 0 });
console.log(JSON.stringify(report.issues));
