// Meshes for the viewer of report pages.
import type { Content } from "../../viewer/src/app";
import { reportModes } from "../../viewer/src/colors";
import { Frame, frameOf, PageMesh, Point } from "../../viewer/src/page_data";

/** What the demo gives to the frame that shows it. */
export interface Shown {
  name: string;
  positions: Float64Array | Float32Array;
  triangles: Uint32Array;
  /** Two vertices for each edge that is a crease. */
  creases: Uint32Array;
}

export function contentOf(original: Shown, result: Shown): Content {
  const low: Point = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  original.positions.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const diagonal = Math.hypot(...low.map((x, k) => high[k] - x));
  // The step is that of the grid of a page.
  const frame = frameOf({ low, step: diagonal / 2 ** 18 });
  const meshes = { original: meshOf(original, frame), result: meshOf(result, frame) };
  return { meshes, frame, modes: reportModes, worst: [], layers: [] };
}

const none = new Float32Array(0);

function meshOf({ name, positions, triangles, creases }: Shown, frame: Frame): PageMesh {
  return {
    name, thinnedFrom: 0, values: new Map(), labels: null, cellLines: none, isolines: none, sites: none, siteLines: none,
    positions: Float32Array.from(positions, (x, i) => (x - frame.origin[i % 3]) / frame.diagonal),
    corners: triangles, creases,
  };
}
