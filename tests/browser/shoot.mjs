// Takes a picture of a page made by the programs.
//   node shoot.mjs PAGE PNG COLOUR light|dark
import { openPage, startBrowser } from "./browser.mjs";

const [file, picture, colour, colorScheme] = process.argv.slice(2);
const browser = await startBrowser();
const { page } = await openPage(browser, file, { viewport: { width: 1400, height: 800 }, colorScheme });
await page.selectOption("#color", colour);
await page.evaluate(() => window.remeshPage.render());
await page.screenshot({ path: picture });
await browser.close();
