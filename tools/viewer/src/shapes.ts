// Figures of triangles, and the edges of a mesh. As in remesh/quality/evaluate.h.
import type { TriangleMesh } from "./packed_mesh";

export interface FaceShape { quality: number; angles: [number, number, number]; area: number; edges: [number, number, number] }

const degrees = 180 / Math.PI;

/** Angles in degrees; `edges[k]` runs from corner k. */
export function shapeOf(p: ArrayLike<number>[]): FaceShape {
  const side = [0, 1, 2].map((k) => [0, 1, 2].map((x) => p[(k + 1) % 3][x] - p[k][x]));
  const cross = [0, 1, 2].map((k) => side[0][(k + 1) % 3] * side[1][(k + 2) % 3]
                                   - side[0][(k + 2) % 3] * side[1][(k + 1) % 3]);
  const doubledArea = Math.hypot(...cross);
  const edges = side.map((s) => Math.hypot(...s)) as [number, number, number];
  const angles = [0, 1, 2].map((k) => {
    const into = side[(k + 2) % 3], out = side[k];
    const dot = -(into[0] * out[0] + into[1] * out[1] + into[2] * out[2]);
    return Math.atan2(doubledArea, dot) * degrees;
  }) as [number, number, number];
  const perimeter = edges[0] + edges[1] + edges[2];
  const quality = doubledArea > 0
    ? 6 / Math.sqrt(3) * doubledArea / (perimeter * Math.max(...edges)) : 0;
  return { quality, angles, area: doubledArea / 2, edges };
}

export function cornersOf(mesh: TriangleMesh, face: number): Float32Array[] {
  return [0, 1, 2].map((k) => {
    const v = 3 * mesh.corners[3 * face + k];
    return mesh.positions.subarray(v, v + 3);
  });
}

/** Q and the smallest angle of every face. */
export function faceShapes(mesh: TriangleMesh): { quality: Float32Array; angle: Float32Array } {
  const { positions: p, corners } = mesh;
  const numFaces = corners.length / 3;
  const quality = new Float32Array(numFaces), angle = new Float32Array(numFaces);
  const factor = 6 / Math.sqrt(3);
  for (let f = 0; f < numFaces; ++f) {
    const a = 3 * corners[3 * f], b = 3 * corners[3 * f + 1], c = 3 * corners[3 * f + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const wx = vx - ux, wy = vy - uy, wz = vz - uz;
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const doubled = Math.sqrt(nx * nx + ny * ny + nz * nz);
    const u = Math.sqrt(ux * ux + uy * uy + uz * uz), v = Math.sqrt(vx * vx + vy * vy + vz * vz);
    const w = Math.sqrt(wx * wx + wy * wy + wz * wz);
    const longest = Math.max(u, v, w), shortest = Math.min(u, v, w);
    quality[f] = doubled > 0 ? factor * doubled / ((u + v + w) * longest) : 0;
    // Opposite the shortest edge; the sine rule, as that angle is at most 60 degrees.
    const beside = u * v * w / Math.max(shortest, 1e-300);
    angle[f] = beside > 0 ? Math.asin(Math.min(1, doubled / beside)) * degrees : 0;
  }
  return { quality, angle };
}

export interface Edges {
  /** Pairs of vertices that one face alone joins. */
  boundary: Uint32Array;
  /** Of each face: its part between creases and boundaries. */
  patches: Uint32Array;
}

/** One sort of all sides of faces finds the boundary and the patches. */
export function findEdges(mesh: TriangleMesh, creases: Uint32Array): Edges {
  const { corners } = mesh;
  const numVertices = mesh.positions.length / 3;
  const isCrease = new Set<number>();
  for (let i = 0; i < creases.length; i += 2) isCrease.add(creases[i] * numVertices + creases[i + 1]);
  const firstSide = new Map<number, number>();
  const isShared = new Uint8Array(corners.length);
  const parts = new UnionFind(corners.length / 3);
  for (let h = 0; h < corners.length; ++h) {
    const a = corners[h], b = corners[h % 3 === 2 ? h - 2 : h + 1];
    const key = a < b ? a * numVertices + b : b * numVertices + a;
    const first = firstSide.get(key);
    if (first === undefined) {
      firstSide.set(key, h);
    } else {
      isShared[first] = 1;
      if (!isCrease.has(key)) parts.join(Math.floor(first / 3), Math.floor(h / 3));
    }
  }
  const boundary: number[] = [];
  for (const h of firstSide.values()) {
    if (isShared[h] === 0) boundary.push(corners[h], corners[h % 3 === 2 ? h - 2 : h + 1]);
  }
  return { boundary: Uint32Array.from(boundary), patches: parts.numbers() };
}

class UnionFind {
  private readonly parent: Uint32Array;
  constructor(size: number) { this.parent = Uint32Array.from({ length: size }, (_, i) => i); }

  private root(i: number): number {
    while (this.parent[i] !== i) {
      this.parent[i] = this.parent[this.parent[i]];
      i = this.parent[i];
    }
    return i;
  }

  join(i: number, j: number): void { this.parent[this.root(i)] = this.root(j); }

  /** Sets are numbered from 0 in the order of their first items. */
  numbers(): Uint32Array {
    const number = new Map<number, number>();
    return this.parent.map((_, i) => {
      const root = this.root(i);
      if (!number.has(root)) number.set(root, number.size);
      return number.get(root)!;
    });
  }
}
