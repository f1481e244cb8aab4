// The functions of the package, on whatever runs the module.
import { Answer, Request } from "./engine.js";
import { refuse, RemeshError } from "./errors.js";
import { addMesh, addShape, kindOf, Mesh, MeshInput, meshOf } from "./mesh.js";
import {
  addOptions, addSites, CreaseOptions, DistanceOptions, namesToTransfer, plain, RemeshOptions, requireObject, Sites,
} from "./options.js";

/** How a call runs. */
export interface RunOptions {
  /**
   * Gets the finished fraction of the whole call, which never falls, and the stage, some twenty times a second.
   * Returning false ends the call: Cancelled. What it throws ends the call, too, and comes out of it.
   */
  onProgress?: (fraction: number, stage: string) => unknown;
  /** Ends the call: it is rejected with the signal's reason (an AbortError). */
  signal?: AbortSignal;
}

export interface Result extends Mesh {
  /** For each vertex the face of the input on which it lies ... */
  sourceFace: Uint32Array;
  /** ... and its three coordinates there. */
  barycentric: Float64Array;
  /** With `region`: what stayed, ascending; the first ones of the result. */
  keptVertices: Uint32Array;
  keptFaces: Uint32Array;
  /** What was done and found: the keys of docs/report.md. */
  report: Record<string, any>;
  /** The texts of which the program would warn. */
  warnings: string[];
}

/** A diagram of k sites. */
export interface Voronoi {
  /** For each vertex of the mesh the nearest site, or -1 where none reaches. */
  labels: Int32Array;
  /** For each vertex the distance to it, or infinity. */
  distances: Float64Array;
  /** k x 3. */
  sitePositions: Float64Array;
  /** k: area of each cell; 0 of a site that owns nothing. */
  cellArea: Float64Array;
  /** k: Euler characteristic of each cell; 1: a disc. */
  cellEuler: Int32Array;
  /** Site s has the neighbours from neighbourOffsets[s] to neighbourOffsets[s + 1]. */
  neighbourOffsets: Uint32Array;
  neighbours: Int32Array;
  /** Points of all polylines between cells, three coordinates each. */
  points: Float64Array;
  /** The distance of each of these from its sites. */
  pointDistances: Float64Array;
  /** Polyline i has the points from lineOffsets[i] to lineOffsets[i + 1]; a closed one ends with its first. */
  lineOffsets: Uint32Array;
  /** Two for each polyline: the sites on its left and right; -1 on the right: the surface's boundary. */
  lineSites: Int32Array;
  /** Triangles of sites: one for each point where three cells meet. */
  dual: Uint32Array;
  /** No distance is longer than the exact one by more than this share of it. */
  certifiedError: number;
}

export interface ReadOptions {
  /** The name of the file, for texts, and for the format if none is given. */
  name?: string;
  /** "ply", "obj", "off", "stl", "vtk", "mesh", "glb", "gltf". */
  format?: string;
  /** Read a file that does not fit its header, and warn. */
  lenient?: boolean;
}

export interface WriteOptions {
  /** As for reading; the file is not written. ".gz" behind the format, or at the end of the name, compresses. */
  format?: string;
  name?: string;
}

/** Runs requests, one after the other. */
export interface Runner {
  run(request: Request, options: RunOptions): Promise<Answer>;
  /** Starts and compiles; calls after that begin at once. */
  start(): Promise<void>;
  stop(): void;
}

export interface Api {
  /**
   * Replaces a mesh by a clean one whose vertices are distributed as asked for: the dual of a geodesic Voronoi diagram,
   * with the topology of the repaired input. @throws RemeshError
   */
  remesh(mesh: MeshInput, options?: RemeshOptions, run?: RunOptions): Promise<Result>;
  /** The geodesic Voronoi diagram of sites. @throws RemeshError */
  voronoi(mesh: MeshInput, sites: Sites, options?: DistanceOptions, run?: RunOptions): Promise<Voronoi>;
  /** For each vertex the distance along the surface from the nearest site; infinity where none reaches. @throws RemeshError */
  geodesicDistance(mesh: MeshInput, sites: Sites, options?: DistanceOptions, run?: RunOptions): Promise<Float64Array>;
  /**
   * Two vertices for each edge of the mesh that is a crease for a result of n vertices. Boundaries are none.
   * @throws RemeshError
   */
  creases(mesh: MeshInput, options?: CreaseOptions, run?: RunOptions): Promise<Uint32Array>;
  /** The mesh in the bytes of a file, also of one compressed with gzip. @throws RemeshError */
  readMesh(bytes: Uint8Array | ArrayBuffer, options: ReadOptions, run?: RunOptions): Promise<Mesh & { warnings: string[] }>;
  /** The bytes of a file. `warnings` tell what the format cannot hold. @throws RemeshError */
  writeMesh(mesh: MeshInput, options: WriteOptions, run?: RunOptions): Promise<{ bytes: Uint8Array; warnings: string[] }>;
  /** Starts the module and warms it up on a small mesh: a first call is several times as slow as later ones. */
  prepare(): Promise<void>;
  /** Ends the worker and frees the memory; the next call starts anew. Calls that run are rejected. */
  stop(): void;
}

const gzip = ".gz";

async function through(stream: { readable: ReadableStream; writable: WritableStream }, bytes: Uint8Array): Promise<Uint8Array> {
  const result = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>);
  return new Uint8Array(await new Response(result).arrayBuffer());
}

async function unpacked(bytes: Uint8Array, name: string): Promise<Uint8Array> {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  try {
    return await through(new DecompressionStream("gzip"), bytes);
  } catch {
    throw new RemeshError("FileError", `${name}: the compressed data are damaged; export the file again`);
  }
}

const without = (text: string | undefined): string | undefined =>
  typeof text === "string" && text.toLowerCase().endsWith(gzip) ? text.slice(0, -gzip.length) : text;

function checkRun(run: unknown): void {
  requireObject(run, "the third argument");
  const { onProgress, signal } = run as RunOptions;
  if (onProgress !== undefined && typeof onProgress !== "function") {
    refuse(`onProgress is ${kindOf(onProgress)}; give a function of a fraction and a stage`);
  }
  if (signal !== undefined && typeof signal?.addEventListener !== "function") {
    refuse(`signal is ${kindOf(signal)}; give an AbortSignal`);
  }
  signal?.throwIfAborted();
}

const emptyRequest = (call: Request["call"]): Request => ({ call, options: {}, mesh: {}, arrays: {} });

export function makeApi(runner: Runner): Api {
  const distanceRequest = (call: "voronoi" | "distances", mesh: MeshInput, sites: Sites, options: DistanceOptions) => {
    requireObject(options, "the options");
    const request = emptyRequest(call);
    addShape(mesh, request);
    addSites(sites, request);
    request.options = plain(options);
    return request;
  };
  const api: Api = {
    async remesh(mesh, options = {}, run = {}) {
      requireObject(options, "the options");
      checkRun(run);
      const request = emptyRequest("remesh");
      const counts = addMesh(mesh, request);
      addOptions({ ...options, transfer: namesToTransfer(mesh, options.transfer) }, counts, request);
      const answer = await runner.run(request, run);
      const { sourceFace, barycentric, keptVertices, keptFaces } = answer.arrays as Record<string, any>;
      const made = meshOf(answer, "of type");
      if (mesh.positions instanceof Float32Array) made.positions = Float32Array.from(made.positions);
      const { report, warnings } = answer.json;
      return { ...made, sourceFace, barycentric, keptVertices, keptFaces, report, warnings } as Result;
    },

    async voronoi(mesh, sites, options = {}, run = {}) {
      checkRun(run);
      const { json, arrays } = await runner.run(distanceRequest("voronoi", mesh, sites, options), run);
      return { ...arrays, certifiedError: json.certifiedError ?? Infinity } as unknown as Voronoi;
    },

    async geodesicDistance(mesh, sites, options = {}, run = {}) {
      checkRun(run);
      const { arrays } = await runner.run(distanceRequest("distances", mesh, sites, options), run);
      return arrays.distances as Float64Array;
    },

    async creases(mesh, options = {}, run = {}) {
      requireObject(options, "the options");
      checkRun(run);
      const request = emptyRequest("creases");
      addShape(mesh, request);
      request.options = plain(options);
      const { arrays } = await runner.run(request, run);
      return arrays.creases as Uint32Array;
    },

    async readMesh(bytes, options, run = {}) {
      requireObject(options, "the options");
      checkRun(run);
      const given = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
      if (!(given instanceof Uint8Array)) refuse(`the bytes are ${kindOf(bytes)}; give a Uint8Array or an ArrayBuffer`);
      const request = emptyRequest("read");
      request.arrays.bytes = await unpacked(given, options.name ?? "the file");
      request.options = plain(options);
      if (request.arrays.bytes !== given) {
        Object.assign(request.options, plain({ name: without(options.name), format: without(options.format) }));
      }
      const answer = await runner.run(request, run);
      return { ...meshOf(answer, "all"), warnings: answer.json.warnings };
    },

    async writeMesh(mesh, options, run = {}) {
      requireObject(options, "the options");
      checkRun(run);
      const request = emptyRequest("write");
      addMesh(mesh, request);
      const target = options.format ?? options.name;
      request.options = plain({ ...options, name: without(options.name), format: without(options.format) });
      const answer = await runner.run(request, run);
      const bytes = answer.arrays.bytes as Uint8Array;
      const isPacked = typeof target === "string" && without(target) !== target;
      return { bytes: isPacked ? await through(new CompressionStream("gzip"), bytes) : bytes, warnings: answer.json.warnings };
    },

    async prepare() {
      await runner.start();
      const { positions, triangles } = smallMesh();
      for (let i = 0; i < 3; ++i) await api.remesh({ positions, triangles }, { n: 400, adaptive: i === 1 });
    },

    stop: () => runner.stop(),
  };
  return api;
}

/** A torus with a crease around it. */
function smallMesh(): { positions: Float64Array; triangles: Uint32Array } {
  const around = 72, across = 36;
  const positions: number[] = [], triangles: number[] = [];
  for (let i = 0; i < around; ++i) {
    for (let k = 0; k < across; ++k) {
      const u = 2 * Math.PI * i / around, v = 2 * Math.PI * k / across;
      const radius = 2 + Math.cos(v);
      positions.push(radius * Math.cos(u), radius * Math.sin(u), Math.min(Math.sin(v), 0.5));
      const at = (a: number, b: number) => (i + a) % around * across + (k + b) % across;
      triangles.push(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1));
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
