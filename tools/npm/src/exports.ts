export { RemeshError } from "./errors.js";
export type { ErrorName } from "./errors.js";
export type { Api, ReadOptions, Result, RunOptions, Voronoi, WriteOptions } from "./api.js";
export type { FileValues, Mesh, MeshInput, Numbers, Values } from "./mesh.js";
export type { CreaseOptions, DistanceOptions, Length, RemeshOptions, Sites } from "./options.js";
export type { NumberArray } from "./engine.js";
export type { Places } from "./browser.js";
