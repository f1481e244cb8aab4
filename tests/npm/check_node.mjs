// The package in Node: the bytes of the program, in a worker and on this thread, and all cases.
//   node check_node.mjs PACKAGE REMESH DATA MESHES WORK
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { cases, workerCases } from "./cases.mjs";
import { checksum, nativeRuns } from "./native.mjs";
import { startIn, Tally } from "./tally.mjs";

const [folder, program, data, meshes, work] = process.argv.slice(2).map((path) => resolve(path));
startIn(work, [join(folder, "remesh.wasm"), program], "the npm package");
const { runs, read } = nativeRuns(program, [data, meshes], work);

const tally = new Tally();

for (const entry of ["index.node.js", "direct.node.js"]) {
  const remesh = await import(pathToFileURL(join(folder, entry)).href);
  for (const { mesh, words, options, format, transfer, checksum: wanted } of runs) {
    await tally.test(`${entry}: remesh ${mesh} ${words.join(" ")} out.${format}: the program's bytes`, async () => {
      const input = await remesh.readMesh(read(mesh), { name: mesh });
      const made = await remesh.remesh(input, { ...options, ...(transfer && { transfer }) });
      const { bytes } = await remesh.writeMesh(made, { format });
      assert.equal(checksum(bytes), wanted);
    });
  }
  for (const [name, body] of Object.entries({ ...cases, ...(entry.startsWith("index") && workerCases) })) {
    await tally.test(`${entry}: ${name}`, () => body(remesh, read));
  }
  remesh.stop();
}

await tally.test("the process ends by itself", () => {
  const script = `import { prepare } from ${JSON.stringify(pathToFileURL(join(folder, "index.node.js")).href)}; await prepare();`;
  const { status, error } = spawnSync(process.execPath, ["--input-type=module", "-e", script], { timeout: 60_000 });
  assert.deepEqual([status, error], [0, undefined]);
});

// As npm installs it.
mkdirSync(join(work, "node_modules"));
symlinkSync(folder, join(work, "node_modules/remesh-wasm"));

await tally.test("the types fit", () => {
  copyFileSync(new URL("types.ts", import.meta.url), join(work, "types.ts"));
  writeFileSync(join(work, "tsconfig.json"), JSON.stringify({
    compilerOptions: { strict: true, noEmit: true, target: "ES2022", module: "nodenext", lib: ["ES2023", "DOM"], types: [] }, files: ["types.ts"],
  }));
  writeFileSync(join(work, "package.json"), '{ "type": "module" }');
  const tsc = fileURLToPath(new URL("../../tools/viewer/node_modules/typescript/bin/tsc", import.meta.url));
  const { status, stdout } = spawnSync(process.execPath, [tsc, "-p", work], { encoding: "utf8" });
  assert.equal(status, 0, stdout);
});

// The examples of the document, each a program of its own.
const documented = [...readFileSync(new URL("../../docs/javascript.md", import.meta.url), "utf8").matchAll(/```js\n(.*?)```/gs)];
for (const [i, [, example]] of documented.entries()) {
  await tally.test(`example ${i + 1} of docs/javascript.md`, () => {
    const file = join(work, `example${i}.mjs`);
    writeFileSync(file, example);
    const { status, stdout, stderr } = spawnSync(process.execPath, [file], { encoding: "utf8", cwd: join(data, ".."), timeout: 60_000 });
    assert.equal(status, 0, stderr);
    const comments = [...example.matchAll(/console.log\(.*\/\/ (.*)/g)].map((match) => match[1]);
    for (const comment of comments) assert.ok(stdout.includes(comment.split(",")[0]), `'${comment}' is not in '${stdout}'`);
  });
}

const wanted = 2 * runs.length + 2 * Object.keys(cases).length + Object.keys(workerCases).length + 2 + documented.length;
assert.equal(tally.passed + tally.failed, wanted, "cases that ran");
assert.ok(runs.length >= 15 && documented.length >= 3 && Object.keys(cases).length >= 10, "cases are missing");
console.log(`${tally.passed} of ${wanted} cases passed`);
process.exit(tally.failed > 0 ? 1 : 0);
