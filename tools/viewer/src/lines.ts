// Lines of a width in pixels, as strips of two triangles. Not instanced: drawn by a processor, each
// instance costs as much as a mesh.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GLSL3, Mesh, RawShaderMaterial, Vector2 } from "three";

const vertexShader = `
  in vec3 position;
  in vec3 other;
  in float side;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform vec2 viewport;
  uniform float width;
  void main() {
    vec4 here = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    vec4 there = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
    vec2 along = (there.xy * here.w - here.xy * there.w) * viewport * sign(there.w);
    vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
    here.xy += side * width * across / viewport * here.w;
    here.z -= 2e-5 * here.w;
    gl_Position = here;
  }`;

const fragmentShader = `
  precision highp float;
  uniform vec3 color;
  out vec4 result;
  void main() { result = vec4(color, 1.0); }`;

/** In CSS pixels; of the pane that is drawn. */
export const viewport = { value: new Vector2(1, 1) };

/** Pixels of the canvas for each of CSS. */
export const pixelRatio = { value: 1 };

/** @param isInFront  lines are drawn over everything. */
export function lineMaterial(width: number, isInFront = false): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, side: DoubleSide,
    uniforms: { viewport, width: { value: width }, color: { value: [0, 0, 0] } },
    depthTest: !isInFront, depthWrite: !isInFront, transparent: isInFront,
  });
}

export function setLineColor(material: RawShaderMaterial, color: string): void {
  // As the page has it, without the conversion to linear light.
  const { r, g, b } = new Color().setStyle(color, "");
  material.uniforms.color.value = [r, g, b];
}

/** @param pieces  six coordinates for each. */
export function lineMesh(pieces: Float32Array, material: RawShaderMaterial): Mesh {
  const count = pieces.length / 6;
  const position = new Float32Array(12 * count), other = new Float32Array(12 * count);
  const side = new Float32Array(4 * count), corners = new Uint32Array(6 * count);
  for (let i = 0; i < count; ++i) {
    const from = pieces.subarray(6 * i, 6 * i + 3), to = pieces.subarray(6 * i + 3, 6 * i + 6);
    [from, from, to, to].forEach((end, k) => position.set(end, 12 * i + 3 * k));
    [to, to, from, from].forEach((end, k) => other.set(end, 12 * i + 3 * k));
    side.set([1, -1, -1, 1], 4 * i);
    corners.set([0, 1, 2, 2, 1, 3].map((k) => 4 * i + k), 6 * i);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(position, 3));
  geometry.setAttribute("other", new BufferAttribute(other, 3));
  geometry.setAttribute("side", new BufferAttribute(side, 1));
  geometry.setIndex(new BufferAttribute(corners, 1));
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}
