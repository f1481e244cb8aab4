// What the program without CGAL writes for each run of `sameBytes`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { labelledPly, sameBytes } from "./cases.mjs";

export const checksum = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** @param folders  data/, and that of real meshes */
export function nativeRuns(program, folders, work) {
  writeFileSync(join(work, "labelled.ply"), labelledPly());
  const places = [...folders, work];
  const find = (name) => places.map((folder) => join(folder, name)).find((path) => existsSync(path));
  const missing = sameBytes.filter((one) => one.isReal && !find(one.mesh)).map((one) => one.mesh);
  if (missing.length > 0) console.log(`SKIPPED: ${missing.join(", ")}: not in ${folders.join(", ")}`);
  const runs = sameBytes.filter((one) => !missing.includes(one.mesh)).map((one) => {
    const output = join(work, `native.${one.format}`);
    const words = [...one.words, ...(one.transfer ? ["--transfer", one.transfer] : [])];
    const { status, stderr } = spawnSync(program, ["-q", "--force", "-t", "1", find(one.mesh), output, ...words], { encoding: "utf8" });
    assert.equal(status, 0, `${program} ${words.join(" ")}: ${stderr}`);
    return { ...one, words, checksum: checksum(readFileSync(output)) };
  });
  return { runs, read: (name) => readFileSync(find(name)) };
}
