// Bundles the package into a folder, with its types and the module.
//   node build.mjs MODULE FOLDER
import { execFileSync } from "node:child_process";
import { copyFile, mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";

const folder = dirname(fileURLToPath(import.meta.url)), root = join(folder, "../..");
const [module, target] = process.argv.slice(2);
// The tools of the viewer, which are locked there.
const viewer = join(folder, "../viewer");
const require = createRequire(join(viewer, "package.json"));
const { build } = await import(pathToFileURL(require.resolve("esbuild")).href);

const mostBytes = 560_000;  // Of what a page loads, compressed.

await rm(target, { recursive: true, force: true });
await mkdir(target, { recursive: true });
const entries = ["index", "index.node", "direct", "direct.node", "worker", "worker.node"];
await build({
  entryPoints: entries.map((name) => join(folder, "src", `${name}.ts`)), outdir: target, bundle: true, minify: true,
  format: "esm", platform: "neutral", target: ["es2022"], external: ["node:*"], logLevel: "warning",
});
execFileSync(process.execPath, [join(viewer, "node_modules/typescript/bin/tsc"), "-p", folder, "--outDir", join(target, "types")],
             { stdio: "inherit" });
await copyFile(module, join(target, "remesh.wasm"));
await copyFile(join(root, "LICENSE"), join(target, "LICENSE"));
await copyFile(join(folder, "README.md"), join(target, "README.md"));
// Of what was compiled into the module.
const parts = ["libeigen3-dev", "libfast-float-dev", "nlohmann-json3-dev", "emscripten"];
const notices = await Promise.all(parts.map(async (name) =>
  `${name}\n\n${await readFile(`/usr/share/doc/${name}/copyright`, "utf8")}`));
await writeFile(join(target, "THIRD-PARTY"), notices.join(`\n${"=".repeat(80)}\n\n`));
const described = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
const version = /version = "(.*)"/.exec(await readFile(join(root, "libagvd/agvd/core/version.h"), "utf8"))[1];
await writeFile(join(target, "package.json"), JSON.stringify({ ...described, version }, null, 2) + "\n");

const packed = async (name) => {
  const bytes = await readFile(join(target, name));
  return brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length;
};
let sum = 0;
for (const name of ["remesh.wasm", "index.js", "worker.js"]) {
  const size = await packed(name);
  console.log(`${name}: ${size} bytes in brotli`);
  sum += size;
}
console.log(`together: ${sum} bytes of ${mostBytes}`);
if (sum > mostBytes) throw new Error(`the package takes ${sum} bytes in brotli, more than ${mostBytes}`);
