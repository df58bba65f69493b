// The Khronos validator's report of a file. Usage: node validate_gltf.mjs FILE; prints JSON.
import fs from "node:fs";
import validator from "gltf-validator";

const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])), { maxIssues: 20 });
console.log(JSON.stringify({ issues: report.issues, info: report.info }));
