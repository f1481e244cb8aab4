// The package in Debian's chromium, from a plain file server: the bytes of the program, and all cases.
//   node check_browser.mjs PACKAGE REMESH DATA MESHES WORK
import assert from "node:assert/strict";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { startBrowser } from "../browser/browser.mjs";
import { cases, workerCases } from "./cases.mjs";
import { nativeRuns } from "./native.mjs";
import { serve } from "./serve.mjs";
import { startIn, Tally } from "./tally.mjs";

const [folder, program, data, meshes, work] = process.argv.slice(2).map((path) => resolve(path));
startIn(work, [join(folder, "remesh.wasm"), program], "the npm package");
const browser = await startBrowser();
const { runs } = nativeRuns(program, [data, meshes], work);
const server = await serve({ "/package/": folder, "/data/": data, "/meshes/": meshes, "/work/": work, "/tests/": dirname(fileURLToPath(import.meta.url)) });
const page = await (await browser.newContext()).newPage();
const problems = [];
page.on("pageerror", (error) => problems.push(error.message));
page.on("console", (message) => { if (["error", "warning"].includes(message.type())) problems.push(message.text()); });
await page.goto(`${server.address}/tests/page.html`);

const tally = new Tally();

for (const { checksum, ...run } of runs) {
  await tally.test(`remesh ${run.mesh} ${run.words.join(" ")} out.${run.format}: the program's bytes`, async () => {
    assert.equal(await page.evaluate((run) => window.bytesOf(run), run), checksum);
  });
}
for (const name of Object.keys({ ...cases, ...workerCases })) {
  await tally.test(name, () => page.evaluate((name) => window.runCase(name), name));
}
await tally.test("the page has no other complaints", () => assert.deepEqual(problems, []));
await browser.close();
server.close();

const wanted = runs.length + Object.keys({ ...cases, ...workerCases }).length + 1;
assert.equal(tally.passed + tally.failed, wanted, "cases that ran");
assert.ok(wanted >= 28, "cases are missing");
console.log(`${tally.passed} of ${wanted} cases passed`);
process.exit(tally.failed > 0 ? 1 : 0);
