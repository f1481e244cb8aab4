// The package for browsers: calls run in a worker.
import { makeApi } from "./api.js";
import { host, places, type Places } from "./browser.js";
import { WorkerRunner } from "./worker_runner.js";

export * from "./exports.js";
export const { remesh, voronoi, geodesicDistance, creases, readMesh, writeMesh, prepare, stop } =
  makeApi(new WorkerRunner(host));

/** Says where the files of the package are, before the first call. */
export function configure(given: Places): void { Object.assign(places, given); }
