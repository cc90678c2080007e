// Renders scenes in the WebAssembly module and prints the fingerprint of each: `cargo xtask reproduce --target wasm`.
//
// node reproduce.mjs MODULE LONGER_SIDE SCENES_FOLDER SCENE ...

import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, posix } from "node:path";

const [module, longerSide, root, ...scenes] = process.argv.slice(2);
const compiled = new WebAssembly.Module(readFileSync(module));

/** The files below a folder, by names relative to it with `/` between folders. */
function* filesBelow(folder, prefix = "") {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const name = posix.join(prefix, entry.name);
    if (entry.isDirectory()) yield* filesBelow(join(folder, entry.name), name);
    else yield [name, readFileSync(join(folder, entry.name))];
  }
}

/** An instance that has the files below a folder. */
function instanceFor(folder) {
  const durer = new WebAssembly.Instance(compiled, {}).exports;
  const give = (...parts) => {
    const bytes = Buffer.concat(parts);
    const at = durer.input(bytes.length);
    // Memory may have grown, so its view is made anew.
    new Uint8Array(durer.memory.buffer).set(bytes, at);
  };
  for (const [name, content] of filesBelow(folder)) {
    give(Buffer.from(name), content);
    durer.add_file(Buffer.byteLength(name));
  }
  return (scene) => {
    give(Buffer.from(scene));
    const isFine = durer.fingerprint(Number(longerSide));
    const text = Buffer.from(durer.memory.buffer, durer.output(), durer.output_length()).toString();
    if (!isFine) throw new Error(`${scene}: ${text}`);
    return text;
  };
}

const instances = new Map();
for (const scene of scenes) {
  const folder = dirname(scene);
  if (!instances.has(folder)) instances.set(folder, instanceFor(join(root, folder)));
  console.log(`${scene} ${instances.get(folder)(posix.basename(scene))}`);
}
