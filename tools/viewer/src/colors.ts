// Colours of faces by what is shown, and the legend that explains them.
import type { PageMesh } from "./page_data";
import { Edges, faceShapes } from "./shapes";

export type ColorMode = "plain" | "quality" | "angle" | "distance" | "nearest" | "target" | "label" | "color" | "patch";

export interface NamedMode { mode: ColorMode; name: string }

export const reportModes: NamedMode[] = [
  { mode: "plain", name: "Plain" },
  { mode: "quality", name: "Quality Q" },
  { mode: "angle", name: "Smallest angle" },
  { mode: "distance", name: "Distance to the other" },
  { mode: "target", name: "Target length" },
  { mode: "label", name: "Label" },
  { mode: "color", name: "Colours of the vertices" },
  { mode: "patch", name: "Patch" },
];

export const diagramModes: NamedMode[] = [
  { mode: "label", name: "Cell" },
  { mode: "nearest", name: "Distance to the site" },
  { mode: "plain", name: "Plain" },
  { mode: "quality", name: "Quality Q" },
  { mode: "angle", name: "Smallest angle" },
];

export interface Scale {
  low: number;
  high: number;
  unit: string;
  title: string;
  /** Colours follow the square root: most distances are far below the largest. */
  isRoot?: boolean;
}

type Rgb = [number, number, number];

// Points of the colour map viridis (matplotlib, CC0), evenly spaced.
const viridis: Rgb[] = [
  "440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725",
].map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)) as Rgb);

const plain: Rgb = [214, 205, 190];

/** \param share  in [0, 1]. */
export function mapColor(share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (viridis.length - 1);
  const low = Math.min(viridis.length - 2, Math.floor(at)), part = at - low;
  return [0, 1, 2].map((k) => viridis[low][k] * (1 - part) + viridis[low + 1][k] * part) as Rgb;
}

export function mapGradient(): string {
  return `linear-gradient(90deg, ${viridis.map((c) => `rgb(${c.join(" ")})`).join(", ")})`;
}

// Hues a golden angle apart, in two lightnesses: neighbours differ.
function labelColor(label: number): Rgb {
  const hue = (label * 137.508 + 20) % 360, lightness = label % 2 === 0 ? 0.62 : 0.5;
  const amount = 0.48 * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((n) => {
    const k = (n + hue / 30) % 12;
    return 255 * (lightness - amount * Math.max(-1, Math.min(k - 3, 9 - k, 1)));
  }) as Rgb;
}

const tableSize = 256;
const mapTable = Uint8Array.from({ length: 3 * tableSize }, (_, i) =>
  Math.round(mapColor(Math.floor(i / 3) / (tableSize - 1))[i % 3]));

/** The scale of a mode, the same for both meshes; null: colours are names or all equal. */
export function scaleOf(mode: ColorMode, meshes: PageMesh[], diagonal: number): Scale | null {
  if (mode === "quality") return { low: 0, high: 1, unit: "", title: "Q, 1 is equilateral" };
  if (mode === "angle") return { low: 0, high: 60, unit: "°", title: "Smallest angle of a face" };
  const found = meshes.map((mesh) => mesh.values.get(mode)).filter((v) => v !== undefined);
  if (found.length === 0) return null;
  const high = Math.max(...found.map((v) => v.high));
  if (mode === "distance") {
    return { low: 0, high: high / diagonal * 100, unit: " %", title: "Distance, % of the diagonal", isRoot: true };
  }
  if (mode === "nearest") return { low: 0, high, unit: "", title: "Distance to the nearest site" };
  return { low: Math.min(...found.map((v) => v.low)), high, unit: "", title: "Target edge length" };
}

/** Whether a mode shows something of one of the meshes. */
export function hasMode(mode: ColorMode, meshes: PageMesh[]): boolean {
  if (mode === "label") return meshes.some((mesh) => mesh.labels !== null);
  if (mode === "color") return meshes.some((mesh) => mesh.values.has("red"));
  if (mode === "distance" || mode === "nearest" || mode === "target") return meshes.some((mesh) => mesh.values.has(mode));
  return true;
}

/** RGBA for each corner of each face. */
export function cornerColors(mode: ColorMode, mesh: PageMesh, edges: () => Edges, scale: Scale | null,
                             diagonal: number): Uint8Array<ArrayBuffer> {
  const colors = new Uint8Array(4 * mesh.corners.length).fill(255);
  const values = mesh.values.get(mode);
  if (mode === "quality" || mode === "angle") {
    fillByFace(colors, faceShapes(mesh)[mode], scale!);
  } else if (values && scale) {
    const unit = mode === "distance" ? 100 / diagonal : 1;
    fillByVertex(colors, mesh.corners, values.values, scale, unit);
  } else if (mode === "label" && mesh.labels) {
    fillByName(colors, mesh.labels.ofFaces, mesh.labels.hasNone);
  } else if (mode === "color" && mesh.values.has("red")) {
    ["red", "green", "blue"].forEach((part, k) => {
      const ofVertices = mesh.values.get(part)!.values;
      mesh.corners.forEach((vertex, corner) => { colors[4 * corner + k] = ofVertices[vertex]; });
    });
  } else if (mode === "patch") {
    fillByName(colors, edges().patches, false);
  } else {
    for (let i = 0; i < colors.length; i += 4) colors.set(plain, i);
  }
  return colors;
}

function put(colors: Uint8Array, corner: number, share: number): void {
  const at = 3 * Math.round(Math.min(1, Math.max(0, share)) * (tableSize - 1));
  colors[4 * corner] = mapTable[at];
  colors[4 * corner + 1] = mapTable[at + 1];
  colors[4 * corner + 2] = mapTable[at + 2];
}

function shareIn(scale: Scale, value: number): number {
  const share = scale.high > scale.low ? (value - scale.low) / (scale.high - scale.low) : 0;
  return scale.isRoot ? Math.sqrt(Math.max(0, share)) : share;
}

function fillByFace(colors: Uint8Array, values: Float32Array, scale: Scale): void {
  for (let h = 0; h < 3 * values.length; ++h) {
    put(colors, h, shareIn(scale, values[Math.floor(h / 3)]));
  }
}

function fillByVertex(colors: Uint8Array, corners: Uint32Array, values: Float32Array, scale: Scale,
                      unit: number): void {
  for (let h = 0; h < corners.length; ++h) put(colors, h, shareIn(scale, unit * values[corners[h]]));
}

/** @param hasNone  name 0 stands for faces without one */
function fillByName(colors: Uint8Array, names: Uint32Array, hasNone: boolean): void {
  const known = new Map<number, Rgb>(hasNone ? [[0, plain]] : []);
  for (let f = 0; f < names.length; ++f) {
    let color = known.get(names[f]);
    if (!color) known.set(names[f], color = labelColor(names[f]));
    for (let k = 0; k < 3; ++k) colors.set(color, 4 * (3 * f + k));
  }
}
