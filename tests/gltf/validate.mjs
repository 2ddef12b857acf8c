// Runs the Khronos validator on the given .glb files; fails at any error or warning.
import { readFile } from "node:fs/promises";
import process from "node:process";

const kSkipped = 77;
let validator;
try {
  validator = (await import("gltf-validator")).default;
} catch {
  console.log("skipped: gltf-validator is not installed; ./run test installs it");
  process.exit(kSkipped);
}

let failed = false;
for (const file of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(await readFile(file)));
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos`);
  for (const message of issues.messages) console.log(`  ${message.code} ${message.pointer}: ${message.message}`);
  failed ||= issues.numErrors + issues.numWarnings > 0;
}
process.exit(failed ? 1 : 0);
