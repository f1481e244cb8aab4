// How long the package takes beside the program, one thread each, and how long it takes to start. The two take turns;
// both are processor times. Medians of nine runs, after four that warm the module up.
//   node times.mjs PACKAGE REMESH DATA MESHES
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, program, data, meshes] = process.argv.slice(2).map((path) => resolve(path));
const median = (numbers) => [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
const entry = (name) => JSON.stringify(pathToFileURL(join(folder, name)).href);

// From the beginning of the import until the first answer of the worker, and until the first small remesh, each time in a
// new process. Functions are compiled when they are first called.
const starts = Array.from({ length: 9 }, () => {
  const script = `const begin = performance.now();
    const { creases, remesh, stop } = await import(${entry("index.node.js")});
    const mesh = { positions: [0,0,0, 1,0,0, 0,1,0, 0,0,1], triangles: [0,2,1, 0,1,3, 1,2,3, 0,3,2] };
    await creases(mesh, { features: "off" });
    const started = performance.now();
    await remesh(mesh, { n: 8 });
    console.log(JSON.stringify([started - begin, performance.now() - begin]));
    stop();`;
  return JSON.parse(spawnSync(process.execPath, ["--input-type=module", "-e", script], { encoding: "utf8" }).stdout);
});
["start", "start, with a first small remesh"].forEach((name, i) => {
  const times = starts.map((both) => both[i]);
  console.log(`${name}: ${median(times).toFixed(0)} ms (least ${Math.min(...times).toFixed(0)})`);
});

const { remesh, readMesh } = await import(JSON.parse(entry("direct.node.js")));
console.log("mesh           program s  package s  ratio  first s");
for (const file of [join(data, "organic.ply"), join(meshes, "bunny.off"), join(meshes, "fandisk.off")]) {
  if (!existsSync(file)) {
    console.log(`SKIPPED: there is no ${file}`);
    continue;
  }
  const mesh = await readMesh(readFileSync(file), { name: file });
  const run = async () => {
    const before = process.cpuUsage().user;
    await remesh(mesh, { n: 2000 });
    return (process.cpuUsage().user - before) / 1e6;
  };
  const runProgram = () => {
    const script = 'TIMEFORMAT=%U; time "$@" -q -t 1 -n 2000 --to ply -o /dev/null';
    return Number(spawnSync("bash", ["-c", script, "bash", program, file], { encoding: "utf8" }).stderr);
  };
  const first = await run();
  for (let i = 0; i < 3; ++i) await run();
  const ofProgram = [], ofPackage = [];
  for (let i = 0; i < 9; ++i) {
    ofPackage.push(await run());
    ofProgram.push(runProgram());
  }
  const [a, b] = [median(ofProgram), median(ofPackage)];
  console.log(`${file.split("/").at(-1).padEnd(14)} ${a.toFixed(2).padStart(9)}  ${b.toFixed(2).padStart(9)}  ${(b / a).toFixed(2).padStart(5)}  ${first.toFixed(2).padStart(7)}`);
}
