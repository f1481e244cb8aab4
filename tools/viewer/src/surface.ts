// A mesh as objects of three.js: its faces, and its lines.
import {
  BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Group, Mesh, RawShaderMaterial, Sphere, Vector3,
} from "three";
import { CoarseMesh, coarseMesh, mostFacesInMotion } from "./coarse";
import { lineMaterial, lineMesh, setLineColor } from "./lines";
import type { PageMesh } from "./page_data";
import { pointMaterial, pointMesh } from "./points";
import { Edges, findEdges } from "./shapes";

// Corners of a face follow each other, so their numbers give barycentric coordinates.
const vertexShader = `
  in vec3 position;
  in vec4 color;
  uniform mat4 modelViewMatrix, projectionMatrix;
  out vec3 place;
  out vec3 weight;
  out vec3 paint;
  void main() {
    int corner = gl_VertexID % 3;
    weight = vec3(corner == 0, corner == 1, corner == 2);
    paint = color.rgb;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    place = seen.xyz;
    gl_Position = projectionMatrix * seen;
  }`;

// Flat shading by a light at the eye and one above. Lines fade where triangles are a few pixels
// large: otherwise lines would cover them.
const fragmentShader = `
  precision highp float;
  in vec3 place;
  in vec3 weight;
  in vec3 paint;
  uniform float wire;
  uniform float lit;
  out vec4 result;
  void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    vec3 eye = normalize(-place);
    float facing = abs(dot(normal, eye));
    float above = dot(normal, vec3(0.30, 0.80, 0.52));
    vec3 base = gl_FrontFacing ? paint : mix(paint, vec3(0.20, 0.33, 0.62), 0.75);
    vec3 shaded = base * (0.42 + 0.40 * facing + 0.22 * max(above, 0.0));
    base = mix(base, shaded, lit);
    if (wire > 0.0) {
      vec3 step = fwidth(weight);
      vec3 away = weight / max(step, vec3(1e-6));
      float line = 1.0 - smoothstep(0.3, 1.2, min(min(away.x, away.y), away.z));
      float widest = max(max(step.x, step.y), step.z);
      // Light lines on dark colours.
      float light = dot(base, vec3(0.3, 0.6, 0.1));
      vec3 ink = mix(vec3(0.72, 0.76, 0.82), vec3(0.05, 0.07, 0.12), smoothstep(0.14, 0.30, light));
      base = mix(base, ink, wire * line * clamp(0.30 / widest - 0.6, 0.08, 1.0));
    }
    result = vec4(base, 1.0);
  }`;

// CSS pixels.
const widths = { crease: 2, boundary: 2, cell: 1.3, isoline: 1, siteLine: 3 };
const siteSize = 7;

/** What is drawn on the faces of a diagram. */
export type Layer = "cell" | "isoline" | "site";
type Kind = "crease" | "boundary" | "siteLine" | Layer;
export type LineColors = Record<Kind, string>;

export class SurfaceView {
  readonly group = new Group();
  readonly sphere: Sphere;
  private readonly lineMaterials = {
    crease: lineMaterial(widths.crease), boundary: lineMaterial(widths.boundary), cell: lineMaterial(widths.cell),
    isoline: lineMaterial(widths.isoline), site: pointMaterial(siteSize), siteLine: lineMaterial(widths.siteLine),
  };
  private readonly lines = new Group();
  private readonly layers: Record<Layer, Group> = { cell: new Group(), isoline: new Group(), site: new Group() };
  private readonly geometry = new BufferGeometry();
  private readonly faces: Mesh;
  private coarse: { mesh: CoarseMesh; drawn: Mesh } | null = null;
  private colors = new Uint8Array(0);
  private foundEdges: Edges | null = null;
  private hasLines = false;

  constructor(readonly mesh: PageMesh, private readonly material: RawShaderMaterial) {
    const { positions, corners } = mesh;
    const spread = new Float32Array(3 * corners.length);
    for (let h = 0; h < corners.length; ++h) {
      const v = 3 * corners[h];
      spread[3 * h] = positions[v];
      spread[3 * h + 1] = positions[v + 1];
      spread[3 * h + 2] = positions[v + 2];
    }
    this.geometry.setAttribute("position", new BufferAttribute(spread, 3));
    this.sphere = sphereAround(positions);
    this.faces = new Mesh(this.geometry, this.material);
    this.faces.frustumCulled = false;
    this.group.add(this.faces, this.lines);
    for (const layer of Object.values(this.layers)) {
      layer.visible = false;
      this.group.add(layer);
    }
  }

  get edges(): Edges { return this.foundEdges ??= findEdges(this.mesh, this.mesh.creases); }

  /** @param colors  RGBA for each corner of each face. */
  setColors(colors: Uint8Array<ArrayBuffer>): void {
    this.colors = colors;
    this.geometry.setAttribute("color", new BufferAttribute(colors, 4, true));
    this.colorCoarse();
  }

  /** Whether a dense mesh is drawn by a coarse one. */
  setInMotion(isInMotion: boolean): void {
    const isCoarse = isInMotion && this.faceCount > mostFacesInMotion;
    if (isCoarse) this.prepareMotion();
    this.faces.visible = !isCoarse;
    if (this.coarse) this.coarse.drawn.visible = isCoarse;
  }

  get faceCount(): number { return this.mesh.corners.length / 3; }

  /** Makes the coarse mesh, if there has to be one, before the view moves for the first time. */
  prepareMotion(): void {
    if (this.coarse || this.faceCount <= mostFacesInMotion) return;
    const mesh = coarseMesh(this.mesh);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
    const material = this.material.clone();
    material.uniforms = { ...this.material.uniforms, wire: { value: 0 } };
    const drawn = new Mesh(geometry, material);
    drawn.frustumCulled = false;
    this.group.add(drawn);
    this.coarse = { mesh, drawn };
    this.colorCoarse();
  }

  private colorCoarse(): void {
    if (!this.coarse) return;
    const { faces } = this.coarse.mesh;
    const colors = new Uint8Array(12 * faces.length);
    faces.forEach((face, i) => colors.set(this.colors.subarray(12 * face, 12 * face + 12), 12 * i));
    this.coarse.drawn.geometry.setAttribute("color", new BufferAttribute(colors, 4, true));
  }

  /** Creases and the boundary; made when they are first shown. */
  showLines(isShown: boolean): void {
    this.lines.visible = isShown;
    if (!isShown || this.hasLines) return;
    this.hasLines = true;
    this.addLines(this.lines, this.piecesOf(this.mesh.creases), "crease");
    this.addLines(this.lines, this.piecesOf(this.edges.boundary), "boundary");
  }

  /** Made when it is first shown. */
  showLayer(kind: Layer, isShown: boolean): void {
    const layer = this.layers[kind];
    layer.visible = isShown;
    if (!isShown || layer.children.length > 0) return;
    if (kind === "cell") this.addLines(layer, this.mesh.cellLines, kind);
    if (kind === "isoline") this.addLines(layer, this.mesh.isolines, kind);
    if (kind !== "site") return;
    this.addLines(layer, this.mesh.siteLines, "siteLine");
    layer.add(pointMesh(this.mesh.sites, this.lineMaterials.site));
  }

  setLineColors(colors: LineColors): void {
    for (const kind of Object.keys(colors) as Kind[]) setLineColor(this.lineMaterials[kind], colors[kind]);
  }

  private piecesOf(pairs: Uint32Array): Float32Array {
    const pieces = new Float32Array(3 * pairs.length);
    for (let i = 0; i < pairs.length; ++i) {
      pieces.set(this.mesh.positions.subarray(3 * pairs[i], 3 * pairs[i] + 3), 3 * i);
    }
    return pieces;
  }

  private addLines(group: Group, pieces: Float32Array, kind: Kind): void {
    if (pieces.length > 0) group.add(lineMesh(pieces, this.lineMaterials[kind]));
  }
}

export function surfaceMaterial(): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, side: DoubleSide,
    uniforms: { wire: { value: 1 }, lit: { value: 1 } },
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2,
  });
}

function sphereAround(positions: Float32Array): Sphere {
  const low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
  const point = new Vector3();
  for (let i = 0; i < positions.length; i += 3) {
    point.fromArray(positions, i);
    low.min(point);
    high.max(point);
  }
  if (positions.length === 0) return new Sphere(new Vector3(), 1);
  return new Sphere(low.clone().add(high).multiplyScalar(0.5), Math.max(low.distanceTo(high) / 2, 1e-300));
}
