// A real browser with software rendering, and how pictures of a page are compared.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const viewer = join(dirname(fileURLToPath(import.meta.url)), "../../tools/viewer");

// Exit code of ctest's SKIP_RETURN_CODE.
function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

function findChromium() {
  const names = [process.env.CHROMIUM, "chromium", "chromium-browser", "google-chrome"].filter(Boolean);
  const found = names.find((name) => existsSync(name) || spawnSync("which", [name]).status === 0);
  return found ?? skip("no chromium was found (Debian: apt-get install chromium), or set CHROMIUM");
}

export async function startBrowser() {
  const executablePath = spawnSync("which", [findChromium()]).stdout.toString().trim() || process.env.CHROMIUM;
  if (!existsSync(join(viewer, "node_modules/playwright-core"))) {
    skip("playwright-core is missing; run npm ci in tools/viewer");
  }
  const { chromium } = createRequire(join(viewer, "package.json"))("playwright-core");
  return chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
}

/** Opens a page made by the programs; complaints of its console and loads of anything else go to `problems`. */
export async function openPage(browser, file, options = {}) {
  const problems = [];
  const context = await browser.newContext({
    viewport: { width: 1200, height: 800 }, reducedMotion: "reduce", colorScheme: "light", ...options,
  });
  const page = await context.newPage();
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => { problems.push("dialog"); return dialog.dismiss(); });
  const url = pathToFileURL(file).href;
  page.on("request", (request) => {
    if (request.url() !== url && !request.url().startsWith("blob:")) problems.push(`loads ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => window.remeshPage, null, { timeout: 30_000 });
  return { page, problems, close: () => context.close() };
}

export const state = (page) => page.evaluate(() => window.remeshPage.state());

/** Keeps the picture of a pane under a name. */
export function take(page, name, pane) {
  return page.evaluate(([name, pane]) => {
    window.remeshPage.render();
    const canvas = document.getElementById("canvas");
    const place = window.remeshPage.state().places.find((one) => one.id === pane);
    const copy = document.createElement("canvas");
    copy.width = place.width;
    copy.height = place.height;
    const scale = canvas.width / canvas.clientWidth;
    const context = copy.getContext("2d");
    context.drawImage(canvas, place.x * scale, place.y * scale, place.width * scale, place.height * scale,
                      0, 0, place.width, place.height);
    window.pictures ??= {};
    window.pictures[name] = context.getImageData(0, 0, place.width, place.height);
  }, [name, pane]);
}

/** The share of the pixels that differ, of those inside the mesh of `first`, and of those outside. */
export function compare(page, first, second) {
  return page.evaluate(([first, second]) => {
    const a = window.pictures[first].data, b = window.pictures[second].data;
    if (a.length !== b.length) return { inside: 1, outside: 1 };
    const pixel = (data, i) => data[i] << 16 | data[i + 1] << 8 | data[i + 2];
    const outside = pixel(a, 0);
    const changed = { in: 0, out: 0 }, all = { in: 1e-9, out: 1e-9 };
    for (let i = 0; i < a.length; i += 4) {
      const where = pixel(a, i) === outside ? "out" : "in";
      ++all[where];
      if (pixel(a, i) !== pixel(b, i)) ++changed[where];
    }
    return { inside: changed.in / all.in, outside: changed.out / all.out };
  }, [first, second]);
}
