// A coarse stand-in for a dense mesh, drawn while the view moves where drawing is slow.
import type { TriangleMesh } from "./packed_mesh";

/** Meshes of fewer faces are always drawn themselves. */
export const mostFacesInMotion = 5_000;

const cellsAlongLongestSide = 20;

export interface CoarseMesh {
  /** Three points for each face. */
  positions: Float32Array;
  /** The face of the mesh that each face stands for. */
  faces: Uint32Array;
}

/** Vertices in one cell of a grid become one; faces that keep three corners stay, each once. */
export function coarseMesh(mesh: TriangleMesh): CoarseMesh {
  const cellOf = cellsOf(mesh.positions);
  const number = new Map<number, number>();  // By cell.
  const first: number[] = [];                // By number of a cell: a vertex.
  const numbers = Uint32Array.from(cellOf, (cell, v) => {
    const known = number.get(cell);
    if (known !== undefined) return known;
    number.set(cell, first.length);
    return first.push(v) - 1;
  });
  const taken = new Set<number>();
  const faces: number[] = [], points: number[] = [];
  for (let h = 0; h < mesh.corners.length; h += 3) {
    const a = numbers[mesh.corners[h]], b = numbers[mesh.corners[h + 1]], c = numbers[mesh.corners[h + 2]];
    if (a === b || b === c || c === a) continue;
    const low = Math.min(a, b, c), high = Math.max(a, b, c);
    const key = (low * first.length + (a + b + c - low - high)) * first.length + high;
    if (taken.has(key)) continue;
    taken.add(key);
    faces.push(h / 3);
    for (const cell of [a, b, c]) {
      const v = 3 * first[cell];
      points.push(mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]);
    }
  }
  return { positions: Float32Array.from(points), faces: Uint32Array.from(faces) };
}

function cellsOf(positions: Float32Array): Uint32Array {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const n = cellsAlongLongestSide;
  const size = Math.max(...high.map((x, k) => x - low[k])) / n || 1;
  return Uint32Array.from({ length: positions.length / 3 }, (_, v) => {
    const [x, y, z] = [0, 1, 2].map((k) => Math.floor((positions[3 * v + k] - low[k]) / size));
    return (x * (n + 1) + y) * (n + 1) + z;
  });
}
