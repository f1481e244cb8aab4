// Meshes for the viewer of report pages.
import { Frame, PageData, PageMesh } from "../../viewer/src/page_data";

/** What the demo gives to the frame that shows it. */
export interface Shown {
  name: string;
  positions: Float64Array | Float32Array;
  triangles: Uint32Array;
}

export function dataOf(original: Shown, result: Shown): { data: PageData; meshes: Record<"original" | "result", PageMesh> } {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  original.positions.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const diagonal = Math.hypot(...low.map((x, k) => high[k] - x));
  // frameOf() of page_data.ts: the step is that of its grid.
  const step = diagonal / 2 ** 18;
  const frame: Frame = { origin: low.map((x) => x + diagonal / 4) as Frame["origin"], diagonal: diagonal || 1 };
  const meshes = { original: meshOf(original, frame), result: meshOf(result, frame) };
  const described = ({ name }: Shown) => ({ name, low, step });
  return { data: { original: described(original), result: described(result), worst: [] } as unknown as PageData, meshes };
}

function meshOf({ name, positions, triangles }: Shown, frame: Frame): PageMesh {
  return {
    name, thinnedFrom: 0, values: new Map(), labels: null, cellLines: new Float32Array(0),
    positions: Float32Array.from(positions, (x, i) => (x - frame.origin[i % 3]) / frame.diagonal),
    corners: triangles, creases: new Uint32Array(0),
  };
}
