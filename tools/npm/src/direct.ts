// The package for browsers: calls run on the thread of the caller.
import { makeApi } from "./api.js";
import { compile, places, type Places } from "./browser.js";
import { DirectRunner } from "./direct_runner.js";

export * from "./exports.js";
export const { remesh, voronoi, geodesicDistance, creases, readMesh, writeMesh, prepare, stop } =
  makeApi(new DirectRunner(compile));

/** Says where the files of the package are, before the first call. */
export function configure(given: Places): void { Object.assign(places, given); }
