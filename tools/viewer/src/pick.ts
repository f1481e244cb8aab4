// Finds the face that a ray meets first, and shows its figures.
import { Vector3 } from "three";
import { element, inDigits, table } from "./dom";
import { Frame, fromDrawn, PageMesh, toDrawn, WorstFace } from "./page_data";
import { cornersOf, shapeOf } from "./shapes";

/** \return the number of the face in the mesh of the page; -1: none. */
export function faceAlong(mesh: PageMesh, origin: Vector3, direction: Vector3): number {
  const { positions: p, corners } = mesh;
  const { x: ox, y: oy, z: oz } = origin, { x: dx, y: dy, z: dz } = direction;
  let nearest = Infinity, face = -1;
  for (let h = 0; h < corners.length; h += 3) {
    const a = 3 * corners[h], b = 3 * corners[h + 1], c = 3 * corners[h + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const qx = dy * vz - dz * vy, qy = dz * vx - dx * vz, qz = dx * vy - dy * vx;
    const volume = ux * qx + uy * qy + uz * qz;
    if (volume === 0) continue;
    const sx = ox - p[a], sy = oy - p[a + 1], sz = oz - p[a + 2];
    const s = (sx * qx + sy * qy + sz * qz) / volume;
    if (s < 0 || s > 1) continue;
    const rx = sy * uz - sz * uy, ry = sz * ux - sx * uz, rz = sx * uy - sy * ux;
    const t = (dx * rx + dy * ry + dz * rz) / volume;
    if (t < 0 || s + t > 1) continue;
    const distance = (vx * rx + vy * ry + vz * rz) / volume;
    if (distance > 0 && distance < nearest) {
      nearest = distance;
      face = h / 3;
    }
  }
  return face;
}

/** The face whose corners are nearest to these points. */
export function faceAt(mesh: PageMesh, points: ArrayLike<number>[]): number {
  const middle = [0, 1, 2].map((x) => points.reduce((sum, p) => sum + p[x], 0));
  const { positions: p, corners } = mesh;
  let nearest = Infinity, face = -1;
  for (let h = 0; h < corners.length; h += 3) {
    let distance = 0;
    for (let x = 0; x < 3; ++x) {
      const sum = p[3 * corners[h] + x] + p[3 * corners[h + 1] + x] + p[3 * corners[h + 2] + x];
      distance += (sum - middle[x]) ** 2;
    }
    if (distance < nearest) {
      nearest = distance;
      face = h / 3;
    }
  }
  return face;
}

/** Figures of a face. */
export interface FaceFigures {
  /** Its number in the file, if that is known. */
  face: number | null;
  quality: number;
  minAngle: number;
  angles: number[];
  edges: number[];
  area: number;
  /** To the other mesh, in percent of the diagonal: the mean of the corners. */
  distance: number | null;
  /** Target length, likewise. */
  target: number | null;
  /** To the nearest site, likewise. */
  nearest: number | null;
}

/** Those of the worst faces come from the program, in full precision. */
export function figuresOf(mesh: PageMesh, face: number, frame: Frame, worst: WorstFace[]): FaceFigures {
  const corners = cornersOf(mesh, face);
  const known = worst.find((one) => isSame(one.corners.map((c) => toDrawn(c, frame)), corners));
  const points = known ? known.corners : corners.map((c) => fromDrawn(c, frame));
  const { quality, angles, edges, area } = shapeOf(points);
  return {
    face: known?.face ?? null, angles, edges, area,
    distance: meanOf(mesh, face, "distance", 100 / frame.diagonal), target: meanOf(mesh, face, "target", 1),
    nearest: meanOf(mesh, face, "nearest", 1),
    quality: known?.quality ?? quality, minAngle: known?.min_angle_deg ?? Math.min(...angles),
  };
}

function meanOf(mesh: PageMesh, face: number, key: string, unit: number): number | null {
  const values = mesh.values.get(key)?.values;
  if (!values) return null;
  return [0, 1, 2].reduce((sum, k) => sum + unit / 3 * values[mesh.corners[3 * face + k]], 0);
}

function isSame(points: ArrayLike<number>[], corners: ArrayLike<number>[]): boolean {
  const near = (p: ArrayLike<number>, q: ArrayLike<number>) =>
    Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < 1e-5;
  return points.every((p) => corners.some((q) => near(p, q))) &&
         corners.every((q) => points.some((p) => near(p, q)));
}

/** Texts about a face. */
export function figureTable(title: string, figures: FaceFigures): HTMLElement {
  const list = (values: number[], digits: number, unit: string) =>
    values.map((v) => inDigits(v, digits) + unit).join("  ");
  return element("div", {},
    element("h3", {}, figures.face === null ? title : `${title}, face ${inDigits(figures.face)}`),
    table([], [
      ["Q", inDigits(figures.quality, 3)],
      ["Smallest angle", `${inDigits(figures.minAngle, 3)}°`],
      ["Angles", list(figures.angles, 3, "°")],
      ["Edges", list(figures.edges, 3, "")],
      ["Area", inDigits(figures.area, 3)],
      ...(figures.distance === null ? [] : [["Distance", `${inDigits(figures.distance, 3)} %`]]),
      ...(figures.nearest === null ? [] : [["Distance to the site", inDigits(figures.nearest, 3)]]),
      ...(figures.target === null ? [] : [["Target length", inDigits(figures.target, 3)]]),
    ]));
}
