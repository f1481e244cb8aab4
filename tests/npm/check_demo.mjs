// The demo in Debian's chromium, opened from its folder: the bytes of the program, progress, stopping, files that are
// dropped or wrong, a phone in the dark.
//   node check_demo.mjs DEMO REMESH DATA WORK
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { compare, startBrowser, take } from "../browser/browser.mjs";
import { startIn, Tally } from "./tally.mjs";

const [demo, program, data, work] = process.argv.slice(2).map((path) => resolve(path));
startIn(work, [demo, program], "the demo");

async function open(browser, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 860 }, reducedMotion: "reduce", colorScheme: "light", ...options });
  const page = await context.newPage(), problems = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) problems.push(message.text()); });
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => {
    if (!/^(blob|data|about):/.test(request.url()) && request.url() !== pathToFileURL(demo).href) problems.push(`loads ${request.url()}`);
  });
  await page.goto(pathToFileURL(demo).href);
  await page.waitForSelector("#examples button");
  return { page, problems, close: () => context.close() };
}

const status = (page) => page.locator("#status").innerText();
const has = (page, pattern) => page.waitForFunction(([source]) => new RegExp(source).test(document.getElementById("status").textContent),
                                                    [pattern.source], { timeout: 60_000 });
const frameOf = (page) => page.frames().find((frame) => frame !== page.mainFrame());

async function shownCounts(page) {
  await page.waitForFunction(() => document.querySelector("iframe")?.contentWindow.remeshPage, null, { timeout: 30_000 });
  return frameOf(page).evaluate(() => [...document.querySelectorAll("#titles p")].map((title) => title.textContent));
}

async function download(page, format) {
  const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`[data-format="${format}"]`).click()]);
  const path = join(work, file.suggestedFilename());
  await file.saveAs(path);
  return { name: file.suggestedFilename(), bytes: readFileSync(path) };
}

function nativeBytes(input, format, ...words) {
  const output = join(work, `native.${format}`);
  const { status: code, stderr } = spawnSync(program, ["-q", "--force", input, output, ...words], { encoding: "utf8" });
  assert.equal(code, 0, stderr);
  return readFileSync(output);
}

const tests = {
  async "an example: progress, before and after, the program's bytes in four formats"(browser) {
    const { page, problems, close } = await open(browser);
    await page.getByRole("button", { name: "organic.ply" }).click();
    await has(page, /24,507 vertices, 49,026 faces/);
    assert.deepEqual(await shownCounts(page), ["Original49,026 faces"]);
    await page.evaluate(() => {
      window.seen = [];
      const bar = document.getElementById("progress");
      new MutationObserver(() => { if (!bar.hidden) window.seen.push(bar.value); })
        .observe(document.getElementById("status"), { childList: true, characterData: true, subtree: true });
    });
    await page.locator("#start").click();
    assert.ok(await page.locator("#progress").isVisible() && await page.locator("#stop").isVisible());
    await has(page, /^2,000 vertices, 4,012 faces in/);
    const seen = await page.evaluate(() => window.seen);
    assert.ok(seen.length > 8 && seen.every((x, i) => i === 0 || x >= seen[i - 1]), `progress: ${seen}`);
    assert.deepEqual(await shownCounts(page), ["Original49,026 faces", "Result4,012 faces"]);
    await page.screenshot({ path: join(work, "desktop.png") });
    for (const format of ["ply", "obj", "stl", "glb"]) {
      const { name, bytes } = await download(page, format);
      assert.equal(name, `organic-remesh.${format}`);
      assert.ok(bytes.equals(nativeBytes(join(data, "organic.ply"), format, "-n", "2000")), `${format} differs`);
    }
    const frame = frameOf(page);
    await frame.locator("#color").selectOption("quality");
    assert.equal(await frame.evaluate(() => window.remeshPage.state().mode), "quality");
    await frame.locator("#theme").click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    await page.screenshot({ path: join(work, "dark.png") });
    assert.deepEqual(problems, []);
    await close();
  },

  async "a run can be stopped, and the next one works"(browser) {
    const { page, problems, close } = await open(browser);
    await page.getByRole("button", { name: "organic.ply" }).click();
    await has(page, /24,507 vertices/);
    await page.fill("#n", "20000");
    await page.locator("#start").click();
    await has(page, /%: relax/);
    const before = Date.now();
    await page.locator("#stop").click();
    await has(page, /^Stopped/);
    assert.ok(Date.now() - before < 1000, "it took long");
    assert.ok(!(await page.locator("#stop").isVisible()) && !(await page.locator("#save").isVisible()));
    await page.fill("#n", "300");
    await page.locator("#start").click();
    await has(page, /^300 vertices/);
    assert.deepEqual(problems, []);
    await close();
  },

  async "a file of one's own, edge lengths, creases, on a phone in the dark"(browser) {
    const phone = { viewport: { width: 390, height: 780 }, isMobile: true, hasTouch: true, colorScheme: "dark", deviceScaleFactor: 2 };
    const { page, problems, close } = await open(browser, phone);
    await page.setInputFiles("#file", join(data, "part.off"));
    await has(page, /^part.off: 1,312 vertices, 2,660 faces/);
    await page.fill("#edgeLength", "3%");
    await page.check("#adaptive");
    await page.selectOption("#features", "30");
    await page.locator("#start").click();
    await has(page, /vertices, .* faces in/);
    const { bytes } = await download(page, "ply");
    const words = ["--edge-length", "3%", "--adaptive", "--features", "30"];
    assert.ok(bytes.equals(nativeBytes(join(data, "part.off"), "ply", ...words)), "other bytes");
    assert.equal((await shownCounts(page)).length, 2);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, "the page is too wide");
    const frame = frameOf(page);
    for (const pane of ["original", "result"]) await take(frame, pane, pane);
    await frame.locator("#lines + span").click();
    for (const pane of ["original", "result"]) {
      await take(frame, "without creases", pane);
      const { inside } = await compare(frame, pane, "without creases");
      assert.ok(inside > 0.005, `creases of the ${pane}: ${inside}`);
    }
    await frame.locator("#lines + span").click();
    await page.screenshot({ path: join(work, "phone.png"), fullPage: true });
    assert.deepEqual(problems, []);
    await close();
  },

  async "files that are no meshes and wrong options are told, and a dropped file is read"(browser) {
    const { page, problems, close } = await open(browser);
    const drop = (name, text) => page.evaluate(([name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], name));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }, [name, text]);
    await drop("<img src=x onerror=hacked=1>.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    await has(page, /onerror=hacked=1>.off: line 6: face 0 names vertex 7/);
    assert.ok(await page.locator("#start").isDisabled());
    await drop("a.dwg", "?");
    await has(page, /unknown extension '.dwg'/);
    await drop("square.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    await has(page, /^square.off: 4 vertices, 2 faces/);
    await page.fill("#n", "many");
    await page.locator("#start").click();
    await has(page, /^n is 'many'; use a whole number/);
    assert.equal(await page.evaluate(() => typeof hacked), "undefined");
    assert.equal(await page.locator("img").count(), 0);
    assert.deepEqual(problems, []);
    await close();
  },
};

const browser = await startBrowser();
const tally = new Tally();
for (const [name, body] of Object.entries(tests)) await tally.test(name, () => body(browser));
await browser.close();
assert.equal(Object.keys(tests).length, 4, "cases that ran");
console.log(`${tally.passed} of 4 cases passed`);
process.exit(tally.passed === 4 ? 0 : 1);
