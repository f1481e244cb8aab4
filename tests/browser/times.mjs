// How long pages take in a browser that draws by software: to the first picture, and how many pictures they draw in two
// seconds while they are turned.
//   node times.mjs PAGE...
import { statSync } from "node:fs";
import { openPage, startBrowser } from "./browser.mjs";

const browser = await startBrowser();
for (const file of process.argv.slice(2)) {
  const { page, close } = await openPage(browser, file);
  const first = await page.evaluate(() => window.remeshPage.firstPicture);
  await page.waitForTimeout(500);
  const frames = await page.evaluate(() => new Promise((done) => {
    const count = () => window.remeshPage.state().frames;
    const before = count(), begin = performance.now();
    const step = () => {
      if (performance.now() - begin > 2000) return done(count() - before);
      document.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
      requestAnimationFrame(step);
    };
    step();
  }));
  const faces = await page.evaluate(() => JSON.parse(document.getElementById("page-data").textContent).original.faces);
  console.log(`${file}: ${faces} faces, ${statSync(file).size} bytes, first picture after ${(first / 1000).toFixed(2)} s, ` +
    `${frames} pictures in 2 s`);
  await close();
}
await browser.close();
