// Points as discs of a size in pixels.
import { BufferAttribute, BufferGeometry, GLSL3, Points, RawShaderMaterial } from "three";
import { pixelRatio } from "./lines";

// Points lie on the surface, which must not cut them.
const vertexShader = `
  in vec3 position;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform float size, pixelRatio;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_Position.z -= 4e-3 * gl_Position.w;
    gl_PointSize = size * pixelRatio;
  }`;

const fragmentShader = `
  precision highp float;
  uniform vec3 color;
  out vec4 result;
  void main() {
    if (length(gl_PointCoord - 0.5) > 0.5) discard;
    result = vec4(color, 1.0);
  }`;

/** @param size  CSS pixels. */
export function pointMaterial(size: number): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader,
    uniforms: { size: { value: size }, pixelRatio, color: { value: [0, 0, 0] } },
  });
}

/** @param points  three coordinates for each. */
export function pointMesh(points: Float32Array, material: RawShaderMaterial): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  const mesh = new Points(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}
