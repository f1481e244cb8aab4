// What the program has put into the page: a JSON text, and a block of bytes for each mesh.
import { NumberReader, TriangleMesh, unpackMesh } from "./packed_mesh";

export type Point = [number, number, number];

export interface Histogram { low: number; width: number; counts: number[] }
export interface Histograms { angle: Histogram; quality: Histogram; edge: Histogram; valence: Histogram }

export interface WorstFace { face: number; quality: number; min_angle_deg: number; corners: Point[] }

// The reports of docs/report.md; of these keys the page knows.
export type Report = Record<string, any>;

interface MeshDescription {
  name: string;
  vertices: number;
  faces: number;
  thinned_from?: number;
  low: Point;
  step: number;
  values: { key: string; low: number; high: number; has_growing_steps: boolean }[];
  labels?: { name: string; count: number; has_none: boolean };
  line_step: number;
  streams: [string, number][];
  gzip: boolean;
}

/** Of every page. */
export interface PageData {
  version: string;
  command: string;
  original: MeshDescription;
}

/** Of a remesh. */
export interface ReportData extends PageData {
  result: MeshDescription;
  evaluation: Report;
  farthest: { from_original: Point; from_result: Point } | null;
  histograms: { original: Histograms; result: Histograms };
  worst: WorstFace[];
  run: Report | null;
}

/** Of a diagram. */
export interface DiagramData extends PageData {
  diagram: {
    figures: Report;
    histograms: { area: Histogram; neighbours: Histogram };
    engine: string;
    certified_error: number | null;
    isoline_step: number;
    warnings: string[];
  };
}

export interface VertexValues { values: Float32Array; low: number; high: number }

/** A mesh to be drawn: see Frame. */
export interface PageMesh extends TriangleMesh {
  name: string;
  thinnedFrom: number;
  values: Map<string, VertexValues>;
  /** hasNone: label 0 stands for faces without one. */
  labels: { name: string; ofFaces: Uint32Array; hasNone: boolean } | null;
  /** Pairs of vertices. */
  creases: Uint32Array;
  /** Six coordinates for each piece of a line between cells. */
  cellLines: Float32Array;
  /** Six coordinates for each piece of a line of equal distance. */
  isolines: Float32Array;
  /** Three coordinates each. */
  sites: Float32Array;
  /** As cellLines, of sites that are lines. */
  siteLines: Float32Array;
}

export function readPageData(): ReportData | DiagramData {
  return JSON.parse(textOf("page-data")) as ReportData | DiagramData;
}

/**
 * What is drawn is in diagonals of the original and relative to a point of it: floats have few
 * digits, and coordinates may have any size.
 */
export interface Frame { origin: Point; diagonal: number }

export function frameOf({ low, step }: Pick<MeshDescription, "low" | "step">): Frame {
  const diagonal = step > 0 ? step * 2 ** 18 : 1;
  return { origin: low.map((x) => x + diagonal / 4) as Point, diagonal };
}

export function toDrawn(point: Point, frame: Frame): Point {
  return point.map((x, k) => (x - frame.origin[k]) / frame.diagonal) as Point;
}

export function fromDrawn(point: ArrayLike<number>, frame: Frame): Point {
  return [0, 1, 2].map((k) => point[k] * frame.diagonal + frame.origin[k]) as Point;
}

/** @param frame  of the original */
export async function readMesh(id: "original" | "result", description: MeshDescription, frame: Frame): Promise<PageMesh> {
  const bytes = await bytesOf(`${id}-mesh`, description.gzip);
  const streams = new Map<string, Uint8Array>();
  let at = 0;
  for (const [name, length] of description.streams) {
    streams.set(name, bytes.subarray(at, at + length));
    at += length;
  }
  const stream = (name: string) => streams.get(name) ?? new Uint8Array(0);
  const shift = toDrawn(description.low, frame);
  const mesh = unpackMesh({
    vertices: description.vertices, faces: description.faces, step: description.step / frame.diagonal,
    codes: stream("codes"), corners: stream("corners"), offsets: stream("offsets"),
  }, shift);
  const lineStep = description.line_step / frame.diagonal;
  const lines = (kind: string) => piecesOf(stream(`${kind}_lengths`), readPoints(stream(`${kind}_steps`), lineStep, shift));
  return {
    ...mesh,
    name: description.name,
    thinnedFrom: description.thinned_from ?? 0,
    values: new Map(description.values.map((v) => [v.key, readValues(stream(v.key), v)])),
    labels: description.labels ? {
      name: description.labels.name,
      ofFaces: readNumbers(stream("labels"), description.faces),
      hasNone: description.labels.has_none,
    } : null,
    creases: readCreases(stream("creases")),
    cellLines: lines("cell"),
    isolines: lines("isoline"),
    sites: readPoints(stream("site_steps"), lineStep, shift),
    siteLines: lines("site_line"),
  };
}

function textOf(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

async function bytesOf(id: string, isPacked: boolean): Promise<Uint8Array> {
  const text = atob(textOf(id));
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  if (!isPacked) return bytes;
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

function readValues(bytes: Uint8Array, told: MeshDescription["values"][number]): VertexValues {
  const { low, high, has_growing_steps: isGrowing } = told;
  const values = Float32Array.from(bytes, (byte) => {
    const share = byte / 255;
    return low + (high - low) * (isGrowing ? share * share : share);
  });
  return { values, low, high };
}

function readNumbers(bytes: Uint8Array, count: number): Uint32Array {
  const reader = new NumberReader(bytes);
  return Uint32Array.from({ length: count }, () => reader.next());
}

function readCreases(bytes: Uint8Array): Uint32Array {
  const reader = new NumberReader(bytes);
  const pairs: number[] = [];
  let low = 0;
  while (!reader.isAtEnd) {
    low += reader.next();
    pairs.push(low, low + reader.next());
  }
  return Uint32Array.from(pairs);
}

/** @param step  of the grid, which begins at `shift`. */
function readPoints(steps: Uint8Array, step: number, shift: readonly number[]): Float32Array {
  const reader = new NumberReader(steps);
  const grid = [0, 0, 0], points: number[] = [];
  while (!reader.isAtEnd) {
    for (let k = 0; k < 3; ++k) {
      grid[k] += reader.nextSigned();
      points.push(grid[k] * step + shift[k]);
    }
  }
  return Float32Array.from(points);
}

/** Of lines of so many points: six coordinates for each piece. */
function piecesOf(lengths: Uint8Array, points: Float32Array): Float32Array {
  const reader = new NumberReader(lengths);
  const pieces: number[] = [];
  let at = 0;
  while (!reader.isAtEnd) {
    const end = at + 3 * reader.next();
    for (; at + 3 < end; at += 3) pieces.push(...points.subarray(at, at + 6));
    at = end;
  }
  return Float32Array.from(pieces);
}
