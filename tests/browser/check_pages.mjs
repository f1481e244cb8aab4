// Report pages in a real browser: every control does what it says, read back from the state of the
// page and from its pixels; figures are those of remesh-eval; names of files inject nothing.
//   node check_pages.mjs REMESH REMESH_EVAL AGVD DATA WORK
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { compare, openPage, startBrowser, state, take } from "./browser.mjs";

const [remesh, remeshEval, agvd, data, work] = process.argv.slice(2);
const at = (name) => join(work, name);

function run(program, words) {
  const { status, stderr } = spawnSync(program, words, { encoding: "utf8" });
  assert.equal(status, 0, stderr);
}

// The page of a remesh, and the report of remesh-eval on the same meshes.
function makePage(input, name, ...options) {
  const output = at(`${name}.ply`), html = at(`${name}.html`), report = at(`${name}.json`);
  run(remesh, ["-q", input, output, "--html", html, ...options]);
  run(remeshEval, [input, output, "--report", report]);
  return { html, output, evaluation: JSON.parse(readFileSync(report, "utf8")) };
}

const tests = [];
const test = (name, body) => tests.push({ name, body });
const changes = ({ inside }) => assert.ok(inside > 0.05, `only ${inside} of the mesh changed`);
const same = ({ inside, outside }) => assert.deepEqual([inside, outside], [0, 0]);

const offered = (page) => page.locator("#color option").evaluateAll((all) => all.map((one) => one.value));

async function checkColors(page, modes) {
  await take(page, "plain", "result");
  assert.deepEqual(await offered(page), ["plain", ...modes]);
  for (const mode of modes) {
    await page.selectOption("#color", mode);
    assert.equal((await state(page)).mode, mode);
    await take(page, mode, "result");
    const difference = await compare(page, "plain", mode);
    changes(difference);
    assert.equal(difference.outside, 0, `${mode} changes what is no mesh`);
    const hasScale = !["label", "color", "patch"].includes(mode);
    assert.equal(await page.locator("#legend").isVisible(), hasScale);
  }
  for (const mode of modes.slice(1)) changes(await compare(page, modes[0], mode));
  await page.selectOption("#color", "plain");
  await take(page, "again", "result");
  same(await compare(page, "plain", "again"));
}

async function checkSwitch(page, id, key, least) {
  await take(page, "on", "result");
  await page.locator(`#${id} + span`).click();
  assert.equal((await state(page))[id], false);
  await take(page, "off", "result");
  const { inside } = await compare(page, "on", "off");
  assert.ok(inside > least, `${id}: ${inside}`);
  await page.keyboard.press(key);
  assert.equal((await state(page))[id], true);
  assert.equal(await page.locator(`#${id}`).isChecked(), true);
  await take(page, "on again", "result");
  same(await compare(page, "on", "on again"));
}

async function checkPanes(page) {
  const wide = (await state(page)).places.find((one) => one.id === "result").width;
  await page.locator("#pane-original + span").click();
  assert.deepEqual((await state(page)).panes, ["result"]);
  assert.ok((await state(page)).places[0].width > 1.8 * wide);
  await page.keyboard.press("2");  // The last one stays.
  assert.deepEqual((await state(page)).panes, ["result"]);
  await page.keyboard.press("1");
  assert.deepEqual((await state(page)).panes, ["original", "result"]);
  await page.keyboard.press("3");
  assert.deepEqual((await state(page)).panes, ["original", "result", "cells"]);
  await take(page, "without lines", "original");
  await take(page, "with lines", "cells");
  const { inside, outside } = await compare(page, "without lines", "with lines");
  assert.ok(inside > 0.05 && outside < 0.01, `the cells are no lines on the original: ${inside} ${outside}`);
  await page.locator("#pane-cells + span").click();
  assert.deepEqual((await state(page)).panes, ["original", "result"]);
}

async function checkCamera(page) {
  const before = await state(page);
  await take(page, "original", "original");
  await take(page, "result", "result");
  const box = await page.locator("#canvas").boundingBox();
  await page.mouse.move(box.x + 0.75 * box.width, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.85 * box.width, box.y + 0.55 * box.height, { steps: 3 });
  await page.mouse.up();
  assert.notDeepEqual((await state(page)).camera, before.camera);
  for (const pane of ["original", "result"]) {
    await take(page, "turned", pane);
    changes(await compare(page, pane, "turned"));
  }
  await page.locator("#reset").click();
  assert.deepEqual((await state(page)).camera, before.camera);
  for (const key of ["ArrowLeft", "ArrowUp", "+", "-"]) {
    const { camera } = await state(page);
    await page.keyboard.press(key);
    assert.notDeepEqual((await state(page)).camera, camera, key);
  }
  await page.keyboard.press("r");
}

const near = (a, b, most, text) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) <= most, `${text}: ${a} ${b}`));

async function checkWorst(page, evaluation) {
  const told = JSON.parse(await page.locator("#page-data").textContent());
  const { result } = evaluation;
  await page.locator('[data-worst="0"]').click();
  const now = await state(page);
  assert.equal(now.worst, 0);
  assert.equal(now.picked.figures.quality, result.min_quality);
  const middle = [0, 1, 2].map((k) => told.worst[0].corners.reduce((sum, p) => sum + p[k] / 3, 0));
  const diagonal = told.original.step * 2 ** 18;
  near(now.target, middle, 1e-6 * diagonal, "target");
  // The triangle is in the middle of its pane now: a click finds it.
  const box = await page.locator("#canvas").boundingBox();
  const place = now.places.find((one) => one.id === "result");
  await page.keyboard.press("Escape");
  assert.equal((await state(page)).picked, null);
  await page.mouse.click(box.x + place.x + place.width / 2, box.y + place.y + place.height / 2);
  const { picked } = await state(page);
  assert.deepEqual([picked.side, picked.figures], ["result", now.picked.figures]);
  assert.ok((await page.locator("#picked").textContent()).includes(`face ${told.worst[0].face.toLocaleString("en")}`));
  const least = Math.min(...told.worst.map((one) => one.min_angle_deg));
  if (least === result.min_angle_deg) assert.ok(told.worst.some((one) => one.min_angle_deg === least));
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  assert.equal((await state(page)).worst, 1);
  await page.keyboard.press("p");
  assert.equal((await state(page)).worst, 0);
  await page.keyboard.press("r");
}

// The colour in the middle of the worst triangle is that of its value, but for the light.
async function checkColorsOfValues(page, modes) {
  await page.keyboard.press("w");
  await page.locator('[data-worst="0"]').click();
  const { figures } = (await state(page)).picked;
  const values = { quality: figures.quality, angle: figures.minAngle, distance: figures.distance, target: figures.target };
  const gradient = await page.locator("#legend-bar").evaluate((bar) => bar.style.background);
  const map = [...gradient.matchAll(/rgb\((\d+),? (\d+),? (\d+)\)/g)].map((match) => match.slice(1).map(Number));
  for (const mode of modes) {
    await page.selectOption("#color", mode);
    const { scale } = await state(page);
    const linear = (values[mode] - scale.low) / (scale.high - scale.low);
    const at = (scale.isRoot ? Math.sqrt(linear) : linear) * (map.length - 1), low = Math.min(Math.floor(at), map.length - 2);
    const wanted = map[low].map((x, k) => x + (map[low + 1][k] - x) * (at - low));
    await take(page, mode, "result");
    const seen = await page.evaluate((mode) => {
      const { data, width, height } = window.pictures[mode];
      return [...data.slice(4 * (Math.round(height / 2) * width + Math.round(width / 2)))].slice(0, 3);
    }, mode);
    const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
    const cosine = dot(seen, wanted) / Math.sqrt(dot(seen, seen) * dot(wanted, wanted));
    assert.ok(cosine > 0.995, `${mode}: ${seen}, not ${wanted.map(Math.round)}`);
  }
  await page.selectOption("#color", "plain");
  await page.keyboard.press("w");
  await page.keyboard.press("r");
}

async function checkFarthest(page, evaluation) {
  if (evaluation.distance.samples_per_surface === null) return;  // Without CGAL.
  const { farthest, original } = JSON.parse(await page.locator("#page-data").textContent());
  for (const side of ["original", "result"]) {
    await page.locator(`[data-farthest="${side}"]`).click();
    near((await state(page)).target, farthest[`from_${side}`], 1e-6 * original.step * 2 ** 18, side);
  }
  await page.keyboard.press("r");
}

async function checkFigures(page, evaluation) {
  const text = await page.locator("#figures").innerText();
  const digits = (value, count) => Number.isInteger(value) ? value.toLocaleString("en") : String(Number(value.toPrecision(count)));
  const { result, distance } = evaluation;
  for (const value of [result.vertices, result.faces, result.mean_quality, result.min_angle_deg]) {
    assert.ok(text.includes(digits(value, 4)), `${value} is not in the figures`);
  }
  const most = distance.two_sided.max_percent_of_diagonal;
  if (most !== null) assert.ok(text.includes(digits(most, 3)), "the largest distance");
  assert.equal(await page.locator(".histogram").count(), 4);
  const told = JSON.parse(await page.locator("#page-data").textContent());
  const sum = (histogram) => histogram.counts.reduce((a, b) => a + b, 0);
  const { result: of } = told.histograms;
  assert.deepEqual([sum(of.angle), sum(of.quality), sum(of.edge)], [3 * result.faces, result.faces, result.edges]);
}

async function checkTheme(page) {
  await take(page, "light", "result");
  await page.locator("#theme").click();
  assert.equal(await page.locator("html").getAttribute("data-theme"), "dark");
  await take(page, "dark", "result");
  assert.ok((await compare(page, "light", "dark")).outside > 0.9);
  await page.keyboard.press("t");
  assert.equal((await state(page)).theme, "light");
}

test("a free form with target lengths", async (browser) => {
  const { html, evaluation } = makePage(join(data, "organic.ply"), "organic", "-n", "640", "--adaptive");
  const { page, problems, close } = await openPage(browser, html);
  await checkColors(page, ["quality", "angle", "distance", "target", "patch"]);
  await checkSwitch(page, "wire", "w", 0.05);
  await checkPanes(page);
  await checkCamera(page);
  await checkWorst(page, evaluation);
  await checkColorsOfValues(page, ["quality", "angle", "distance", "target"]);
  await checkFarthest(page, evaluation);
  await checkFigures(page, evaluation);
  await checkTheme(page);
  await page.keyboard.press("c");
  assert.equal((await state(page)).mode, "quality");
  await page.keyboard.press("?");
  assert.ok(await page.locator("#keys").isVisible());
  assert.deepEqual(problems, []);
  await close();
});

test("a part with creases, on a phone in the dark", async (browser) => {
  const { html, evaluation } = makePage(join(data, "part.off"), "part", "-n", "800");
  const phone = { viewport: { width: 380, height: 760 }, isMobile: true, hasTouch: true, colorScheme: "dark", deviceScaleFactor: 2 };
  const { page, problems, close } = await openPage(browser, html, phone);
  assert.equal((await state(page)).theme, "dark");
  const [first, second] = (await state(page)).places;
  assert.ok(second.y >= first.y + first.height && second.x === 0, "the panes are one below the other");
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 380, "the page is too wide");
  await checkSwitch(page, "lines", "l", 0.005);
  await checkWorst(page, evaluation);
  await checkFigures(page, evaluation);
  assert.deepEqual(problems, []);
  await close();
});

// Each switch of a layer changes what it should: a share of the pixels of the mesh.
async function checkLayers(page, wanted) {
  for (const [layer, key, isShown, least, most] of wanted) {
    assert.equal((await state(page)).layers.includes(layer), isShown, layer);
    await take(page, "before", "original");
    await page.locator(`#layer-${layer} + span`).click();
    assert.equal((await state(page)).layers.includes(layer), !isShown, layer);
    await take(page, "after", "original");
    const { inside, outside } = await compare(page, "before", "after");
    assert.ok(inside > least && inside < most && outside < 0.02, `${layer}: ${inside} ${outside}`);
    await page.keyboard.press(key);
    assert.equal(await page.locator(`#layer-${layer}`).isChecked(), isShown, layer);
    await take(page, "again", "original");
    same(await compare(page, "before", "again"));
  }
}

test("a diagram", async (browser) => {
  const html = at("diagram.html");
  run(agvd, ["diagram", "-q", join(data, "organic.ply"), "-n", "60", "--html", html]);
  const { page, problems, close } = await openPage(browser, html);
  assert.deepEqual(await offered(page), ["label", "nearest", "plain", "quality", "angle"]);
  assert.equal((await state(page)).mode, "label");
  await checkLayers(page, [["cell", "b", true, 0.01, 0.3], ["site", "s", true, 0.001, 0.1], ["isoline", "i", false, 0.02, 0.6]]);
  await take(page, "label", "original");
  for (const mode of ["nearest", "plain"]) {
    await page.selectOption("#color", mode);
    await take(page, mode, "original");
    changes(await compare(page, "label", mode));
  }
  const { diagram } = JSON.parse(await page.locator("#page-data").textContent());
  const text = await page.locator("#figures").innerText();
  assert.equal(diagram.figures.sites, 60);
  for (const key of ["voronoi_vertices", "voronoi_edges"]) assert.ok(text.includes(diagram.figures[key].toLocaleString("en")), key);
  assert.ok((await page.locator("#command").textContent()).startsWith("agvd diagram "));
  assert.equal(await page.locator(".histogram").count(), 2);
  // A click tells the distance of a face, and the last pane stays.
  const box = await page.locator("#canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + 0.35 * box.height);
  const { picked } = await state(page);
  if (picked) assert.ok(picked.figures.nearest >= 0 && picked.figures.nearest <= diagram.figures.largest_distance_mesh_units);
  await page.keyboard.press("1");
  assert.deepEqual((await state(page)).panes, ["original"]);
  assert.deepEqual(problems, []);
  await close();
});

// A PLY whose faces have labels in a property of this name.
function labelledPly(property) {
  const points = ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"];
  const quads = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
  return ["ply", "format ascii 1.0", `element vertex ${points.length}`, "property double x", "property double y",
          "property double z", `element face ${quads.length}`, "property list uchar int vertex_indices",
          `property int ${property}`, "end_header", ...points,
          ...quads.map((quad, i) => `4 ${quad.join(" ")} ${i}`), ""].join("\n");
}

test("colours of vertices", async (browser) => {
  const input = at("coloured.ply");
  const points = ["0 0 0 255 0 0", "1 0 0 255 0 0", "0 1 0 255 0 0", "0 0 1 255 0 0"];
  writeFileSync(input, ["ply", "format ascii 1.0", "element vertex 4", "property double x", "property double y",
    "property double z", "property uchar red", "property uchar green", "property uchar blue", "element face 4",
    "property list uchar int vertex_indices", "end_header", ...points,
    "3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3", ""].join("\n"));
  const { html } = makePage(input, "coloured out", "-n", "100");
  const { page, problems, close } = await openPage(browser, html);
  await checkColors(page, ["quality", "angle", "distance", "color", "patch"]);
  await page.selectOption("#color", "color");
  await take(page, "color", "result");
  const [red, green, blue] = await page.evaluate(() => {
    const { data, width, height } = window.pictures.color;
    const middle = 4 * (Math.floor(height / 2) * width + Math.floor(width / 2));
    return [...data.subarray(middle, middle + 3)];
  });
  assert.ok(red > 80 && green < red / 4 && blue < red / 4, `${red} ${green} ${blue}`);
  assert.deepEqual(problems, []);
  await close();
});

// Paths, file and property names that end the element they stand in, or begin others.
const hostile = [
  ["folder<", "script ><img src=x onerror=hacked=1>", "</script/x><script>hacked=2</script><b>"],
  ["folder", "<!--<script x>hacked=3", "<!--<script/x>"],
];
for (const [folder, name, property] of hostile) test(`a file ${folder}/${name}, with ${property}`, async (browser) => {
  mkdirSync(at(folder));
  const input = join(at(folder), `${name}.ply`);
  writeFileSync(input, labelledPly(property));
  const { html, evaluation, output } = makePage(input, `out ${name}`, "-n", "300");
  const { page, problems, close } = await openPage(browser, html);
  await checkColors(page, ["quality", "angle", "distance", "label", "patch"]);
  await checkFigures(page, evaluation);
  assert.equal(await page.evaluate(() => typeof hacked), "undefined");
  assert.equal(await page.locator("img, b, iframe, object, embed").count(), 0);
  assert.equal(await page.locator("#original-name").textContent(), `${name}.ply`);
  assert.ok((await page.locator("#command").textContent()).includes(name));
  assert.deepEqual(problems, []);
  await close();
  const judged = at("judged.html");
  run(remeshEval, [input, output, "--html", judged]);
  const second = await openPage(browser, judged);
  assert.equal((await state(second.page)).panes.length, 2);
  assert.equal(await second.page.evaluate(() => typeof hacked), "undefined");
  assert.deepEqual(second.problems, []);
  await second.close();
  const drawn = at("diagram of it.html");
  run(agvd, ["diagram", "-q", input, "-n", "6", "--html", drawn]);
  const third = await openPage(browser, drawn);
  assert.equal(await third.page.locator("#original-name").textContent(), `${name}.ply`);
  assert.equal(await third.page.evaluate(() => typeof hacked), "undefined");
  assert.deepEqual(third.problems, []);
  await third.close();
});

const browser = await startBrowser();
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
let failures = 0;
for (const { name, body } of tests) {
  try {
    await body(browser);
    console.log(`passed: ${name}`);
  } catch (error) {
    ++failures;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
}
await browser.close();
process.exit(failures > 0 ? 1 : 0);
