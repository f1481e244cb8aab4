// What the tests of the package and the demo share.
import { existsSync, mkdirSync, rmSync } from "node:fs";

// Empties the folder of a test. Without one of the files it needs, the test is skipped aloud.
export function startIn(work, files, what) {
  if (!files.every((file) => existsSync(file))) {
    console.log(`SKIPPED: ${what} has not been built; run scripts/wasm`);
    process.exit(77);
  }
  rmSync(work, { recursive: true, force: true });
  mkdirSync(work, { recursive: true });
}

// Runs cases one after the other, and counts them.
export class Tally {
  passed = 0;
  failed = 0;

  async test(name, body) {
    try {
      await body();
      ++this.passed;
      console.log(`passed: ${name}`);
    } catch (error) {
      ++this.failed;
      console.log(`FAILED: ${name}\n${error.stack ?? error}`);
    }
  }
}
