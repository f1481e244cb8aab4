// Meshes of callers as requests, and answers as meshes. module/mesh_message.cpp is the other side.
import { Answer, NumberArray, Request } from "./engine.js";
import { refuse, RemeshError } from "./errors.js";

/** Numbers, in any typed array or a list. */
export type Numbers = NumberArray | readonly number[];

/** Values of vertices or faces. The type of the array is the type in files. */
export type Values = NumberArray | {
  values: NumberArray;
  /** Of labels with names, such as materials: value i is called names[i]. */
  names?: string[];
  /** A part of a colour, from 0 to 1, of a text format. */
  isIntensity?: boolean;
  /** The type in files, if the array has more digits: those of a text. */
  type?: "float32";
};

/** What remesh() and the like take. Nothing of it is changed. */
export interface MeshInput {
  /** Three coordinates for each vertex. */
  positions: Numbers;
  /** Three vertices for each face, counted from 0. */
  triangles: Numbers;
  /** By name: one value for each vertex. Integers are labels, but for red, green, blue and alpha. */
  vertexData?: Record<string, Values>;
  /** By name: one value for each face. */
  faceData?: Record<string, Values>;
  /** Texture coordinates: six for each face, u and v of its corners; NaN where a corner has none. */
  uv?: Numbers;
  /** What only files have, for the next file. */
  file?: FileValues;
}

/** What readMesh() and remesh() return. */
export interface Mesh extends MeshInput {
  positions: Float64Array | Float32Array;
  triangles: Uint32Array;
  vertexData: Record<string, Values>;
  faceData: Record<string, Values>;
  uv?: Float64Array;
}

/** Of a file, kept for writing. Treat it as opaque. */
export interface FileValues {
  json: Record<string, unknown>;
  arrays: Record<string, NumberArray>;
}

const arrayTypes = {
  int8: Int8Array, uint8: Uint8Array, int16: Int16Array, uint16: Uint16Array,
  int32: Int32Array, uint32: Uint32Array, float32: Float32Array, float64: Float64Array,
};

const typeOf = (array: NumberArray): string =>
  Object.entries(arrayTypes).find(([, ArrayType]) => array instanceof ArrayType)![0];

export function isNumbers(value: unknown): value is Numbers {
  return isTyped(value) || (Array.isArray(value) && value.every((one) => typeof one === "number"));
}

const isTyped = (value: unknown): value is NumberArray =>
  Object.values(arrayTypes).some((ArrayType) => value instanceof ArrayType);

/** @param name  of the argument, for texts */
export function toDoubles(value: unknown, name: string): Float64Array {
  if (value instanceof Float64Array) return value;
  if (!isNumbers(value)) refuse(`${name} is ${kindOf(value)}; give a typed array or a list of numbers`);
  return Float64Array.from(value);
}

/** Whole numbers of 0 or more. */
export function toIndices(value: unknown, name: string): Uint32Array {
  if (value instanceof Uint32Array) return value;
  if (!isNumbers(value)) refuse(`${name} is ${kindOf(value)}; give a typed array or a list of whole numbers`);
  const wrong = value instanceof Uint16Array || value instanceof Uint8Array ? -1 : firstWrong(value);
  if (wrong >= 0) {
    throw new RemeshError("InvalidInput", `${name}[${wrong}] is ${value[wrong]}; use whole numbers of 0 or more`);
  }
  return Uint32Array.from(value);
}

function firstWrong(values: Numbers): number {
  for (let i = 0; i < values.length; ++i) {
    if (!(Number.isInteger(values[i]) && values[i] >= 0 && values[i] < 2 ** 32)) return i;
  }
  return -1;
}

export function kindOf(value: unknown): string {
  if (value === null || value === undefined) return String(value);
  if (Array.isArray(value)) {
    const index = value.findIndex((one) => typeof one !== "number");
    return `a list whose element ${index} is ${kindOf(value[index])}`;
  }
  if (typeof value === "string") return `'${value}'`;
  return typeof value === "object" ? `an object (${value.constructor?.name ?? "Object"})` : `${typeof value} ${String(value)}`;
}

/** Elements of the array in rows, such as three for each vertex. */
function requireRows(array: NumberArray, width: number, name: string, element: string): void {
  if (array.length % width === 0) return;
  throw new RemeshError("InvalidInput",
    `${name} has ${array.length} numbers, which is no multiple of ${width}; give ${width} for each ${element}`);
}

export function requireCount(array: NumberArray, count: number, name: string, element: string): void {
  if (array.length === count) return;
  throw new RemeshError("InvalidOption",
    `${name} has ${array.length} values, but there are ${count} ${element}; give one for each`);
}

export interface Counts { vertices: number; faces: number }

/** The mesh alone. */
export function addShape(mesh: MeshInput, request: Request): Counts {
  if (typeof mesh !== "object" || mesh === null) {
    refuse(`the mesh is ${kindOf(mesh)}; give an object with positions and triangles`);
  }
  const positions = toDoubles(mesh.positions, "positions");
  const triangles = toIndices(mesh.triangles, "triangles");
  requireRows(positions, 3, "positions", "vertex");
  requireRows(triangles, 3, "triangles", "face");
  Object.assign(request.arrays, { positions, triangles });
  return { vertices: positions.length / 3, faces: triangles.length / 3 };
}

/** The mesh with all its values. */
export function addMesh(mesh: MeshInput, request: Request): Counts {
  const counts = addShape(mesh, request);
  request.mesh = {
    ...mesh.file?.json,
    vertexData: addValues(mesh.vertexData, "vertexData", counts.vertices, request),
    faceData: addValues(mesh.faceData, "faceData", counts.faces, request),
  };
  Object.assign(request.arrays, mesh.file?.arrays);
  // The faces are no longer those of the file.
  if (request.arrays.facePolygon?.length !== counts.faces) delete request.arrays.facePolygon;
  if (mesh.uv !== undefined) {
    const uv = toDoubles(mesh.uv, "uv");
    if (uv.length !== 6 * counts.faces) {
      throw new RemeshError("InvalidInput",
        `uv has ${uv.length} numbers, but there are ${counts.faces} faces; give six for each`);
    }
    request.arrays.uv = uv;
  }
  return counts;
}

function addValues(data: Record<string, Values> | undefined, kind: string, count: number, request: Request): unknown[] {
  return Object.entries(data ?? {}).map(([name, given], i) => {
    const { values, ...told } = isTyped(given) ? { values: given } : given;
    if (!isTyped(values)) refuse(`${kind}.${name} is ${kindOf(values)}; give a typed array`);
    requireCount(values, count, `${kind}.${name}`, kind === "vertexData" ? "vertices" : "faces");
    request.arrays[`${kind}.${i}`] = toDoubles(values, name);
    return { name, type: typeOf(values), ...told };
  });
}

/** The mesh of an answer. */
export function meshOf({ json, arrays }: Answer, digits: "all" | "of type"): Mesh {
  const { vertexData, faceData, ...told } = json.mesh;
  const { positions, triangles, uv } = arrays;
  const kept = Object.entries(arrays).filter(([name]) => /^(image\.|facePolygon|featureEdges|lockedEdges|locked$)/.test(name));
  return {
    positions: positions as Float64Array, triangles: triangles as Uint32Array,
    vertexData: valuesOf(vertexData, "vertexData", arrays, digits), faceData: valuesOf(faceData, "faceData", arrays, digits),
    ...(uv && { uv: uv as Float64Array }),
    file: { json: told, arrays: Object.fromEntries(kept) },
  };
}

function valuesOf(described: any[], kind: string, arrays: Answer["arrays"], digits: "all" | "of type"): Record<string, Values> {
  return Object.fromEntries(described.map(({ name, type, ...told }, i) => {
    const ArrayType = arrayTypes[type as keyof typeof arrayTypes];
    const given = arrays[`${kind}.${i}`] as Float64Array;
    if (digits === "all" && type === "float32" && !given.every((x) => Object.is(x, Math.fround(x)))) {
      return [name, { values: given, type, ...told }];
    }
    const values = given instanceof ArrayType ? given : ArrayType.from(given);
    return [name, Object.keys(told).length > 0 ? { values, ...told } : values];
  }));
}
