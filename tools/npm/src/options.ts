// Options of remesh(): what is an array goes beside those that go as JSON.
import { Request } from "./engine.js";
import { refuse } from "./errors.js";
import { Counts, isNumbers, kindOf, MeshInput, Numbers, requireCount, toDoubles, toIndices } from "./mesh.js";

/** Vertices (numbers), points (three coordinates each; the nearest points of the mesh count), or places on faces. */
export type Sites = Numbers | { points: Numbers } | { faces: Numbers; barycentric: Numbers };

/** A length in mesh units, or a percentage of the diagonal of the mesh, such as "2%". */
export type Length = number | string;

/** The options of the program, with its defaults. */
export interface RemeshOptions {
  /** Vertices of the result, or a percentage of the input's: 2000, "10%". */
  n?: number | string;
  /** Instead: faces of the result, up to a few where there is a boundary. */
  faces?: number;
  /** Instead: the mean edge of the result. */
  edgeLength?: Length;
  /** Instead: no point of the result lies farther from the input, and none of the input from the result. */
  maxDistance?: Length;
  /** More vertices where the surface is curved. */
  adaptive?: boolean;
  /** The length of edges at each vertex, or one for all, or the name of values of the mesh. */
  sizing?: Numbers | number | string;
  /** The length of edges at each face. */
  faceSizing?: Numbers | string;
  /** Vertices per area at each vertex, in any unit; or the name of values. */
  density?: Numbers | string;
  minEdge?: Length;
  maxEdge?: Length;
  /** Over a distance d edges grow by at most d times its logarithm: 1.3. */
  gradation?: number;
  /** Degrees, up to 30: no angle is smaller, but for those that creases of the input force. */
  minAngle?: number;
  /** Degrees, 90 and more: likewise, no angle is larger. */
  maxAngle?: number;
  /** No edge is longer; the result has as many more vertices as that takes. */
  longestEdge?: Length;
  /** Creases that become chains of edges: "auto", "off", or all above an angle in degrees. */
  features?: "auto" | "off" | number;
  /** Edges that are creases whatever their angle: two vertices each. */
  featureEdges?: Numbers;
  /** Labels of faces, whose borders are creases, or the name of such values of the mesh. */
  faceLabels?: Numbers | readonly string[] | string;
  junctions?: "apart" | "keep";
  boundary?: "keep" | "free";
  /** "exact": n vertices; "add": and those that the topology needs besides. */
  topology?: "exact" | "add";
  keepSlits?: boolean;
  /** Smaller components are dropped: a share of the area from 0 to 1. */
  dropComponents?: number;
  weld?: Length;
  /** Needs CGAL, which the package is without: all but 0 is refused. */
  fillHoles?: number;
  /** Faces to remesh: other than 0 for each, or the name of such values. All others stay bit for bit. */
  region?: Numbers | string;
  /** Vertices that stay where they are, bit for bit. */
  lock?: Numbers;
  lockBoundary?: boolean;
  /** ConstraintUnmet where the result is too coarse for creases, walls or components. */
  strict?: boolean;
  /** Values of the mesh that the result gets: all, none, or these. */
  transfer?: "all" | "none" | readonly string[];
  /** Sites to start from, instead of n. */
  sites?: Sites;
  keepSites?: boolean;
  init?: "blue-noise" | "farthest" | "random";
  relax?: number;
  /** Vertices of a tile, at most: large results are made in tiles; 0: in one piece. */
  tile?: number;
  fit?: boolean;
  maxError?: number;
  delaunay?: "intrinsic" | "extrinsic" | "off";
  seed?: number;
}

/** Of voronoi() and geodesicDistance(). */
export interface DistanceOptions {
  /** Distances are at most this share above exact; 0: exact. */
  maxError?: number;
  keepSlits?: boolean;
}

/** Of creases(). */
export interface CreaseOptions {
  /** Vertices of the result for which creases are found, or a percentage of the mesh's: 2000. */
  n?: RemeshOptions["n"];
  /** As for remesh(). */
  features?: RemeshOptions["features"];
}

/** As JSON holds them. It has no NaN and no functions: they go as texts, which the module refuses by name. */
export function plain(options: object): Record<string, unknown> {
  return JSON.parse(JSON.stringify(options, (_key, value) => {
    if (typeof value === "number" && !Number.isFinite(value)) return `(${value})`;
    if (typeof value === "function" || typeof value === "symbol" || typeof value === "bigint") return `(${typeof value})`;
    return value;
  }));
}

export function requireObject(value: unknown, name: string): void {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    refuse(`${name} is ${kindOf(value)}; give an object, such as { n: 2000 }`);
  }
}

export function addSites(sites: unknown, request: Request): void {
  const count = (array: ArrayLike<number>) => {
    if (array.length === 0) refuse("there is no site; give one or more");
  };
  const given = sites as { points?: unknown; faces?: unknown; barycentric?: unknown };
  if (isNumbers(sites)) {
    request.arrays.sites = toIndices(sites, "sites");
    count(request.arrays.sites);
  } else if (given?.points !== undefined) {
    const points = request.arrays["sites.points"] = toDoubles(given.points, "sites.points");
    count(points);
    if (points.length % 3 !== 0) refuse(`sites.points has ${points.length} numbers; give three for each site`);
  } else if (given?.faces !== undefined) {
    const faces = request.arrays["sites.faces"] = toIndices(given.faces, "sites.faces");
    const places = request.arrays["sites.barycentric"] = toDoubles(given.barycentric, "sites.barycentric");
    count(faces);
    if (places.length !== 3 * faces.length) {
      refuse(`sites.barycentric has ${places.length} numbers for ${faces.length} faces; give three for each`);
    }
  } else {
    refuse(`sites is ${kindOf(sites)}; give vertices, { points }, or { faces, barycentric }`);
  }
}

/** Values of elements, where they are not named. */
function addValues(name: "sizing" | "faceSizing" | "density" | "region" | "faceLabels", count: number, elements: string,
                   request: Request): void {
  const value = request.options[name];
  if (value === undefined || typeof value === "string") return;
  delete request.options[name];
  const isOneForAll = name === "sizing" && typeof value === "number";
  const array = isOneForAll ? new Float64Array(count).fill(value) : toDoubles(value, name);
  requireCount(array, count, name, elements);
  request.arrays[name] = array;
}

function labelsOf(labels: unknown): unknown {
  const isText = Array.isArray(labels) && labels.some((one) => typeof one === "string");
  return isText ? labels.map((one) => labels.indexOf(one)) : labels;
}

export function addOptions(options: RemeshOptions, counts: Counts, request: Request): void {
  const { sites, ...others } = options;
  request.options = { ...others, faceLabels: labelsOf(options.faceLabels) };
  for (const [name, value] of Object.entries(request.options)) {
    if (value === undefined) delete request.options[name];
  }
  for (const name of ["sizing", "density"] as const) addValues(name, counts.vertices, "vertices", request);
  for (const name of ["faceSizing", "region", "faceLabels"] as const) addValues(name, counts.faces, "faces", request);
  if (options.lock !== undefined) request.arrays.lock = toIndices(options.lock, "lock");
  if (options.featureEdges !== undefined) {
    const edges = request.arrays["given.featureEdges"] = toIndices(options.featureEdges, "featureEdges");
    if (edges.length % 2 !== 0) refuse(`featureEdges has ${edges.length} numbers; give two vertices for each edge`);
  }
  delete request.options.lock;
  delete request.options.featureEdges;
  request.options = plain(request.options);
  if (sites === undefined) return;
  for (const name of ["n", "faces", "edgeLength", "maxDistance"]) {
    if (request.options[name] !== undefined) {
      refuse(`${name} and sites each give the number of vertices; use one of them`);
    }
  }
  addSites(sites, request);
}

/** The names of the values that the result is to get; undefined: all. */
export function namesToTransfer(mesh: MeshInput, transfer: RemeshOptions["transfer"]): readonly string[] | undefined {
  if (transfer === undefined || transfer === "all") return undefined;
  if (transfer === "none") return [];
  if (!Array.isArray(transfer)) refuse(`transfer is ${kindOf(transfer)}; use 'all', 'none' or a list of names`);
  const there = [...Object.keys(mesh.vertexData ?? {}), ...Object.keys(mesh.faceData ?? {}), ...(mesh.uv ? ["uv"] : [])];
  for (const name of transfer) {
    if (!there.includes(name)) {
      refuse(`transfer: the mesh has no values ${kindOf(name)}; it has: ${there.join(", ") || "none"}`);
    }
  }
  return transfer;
}
