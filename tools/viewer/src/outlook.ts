// From where a triangle can be seen.
import { Vector3 } from "three";
import type { PageMesh } from "./page_data";
import { faceAlong } from "./pick";

const tilts = [0, 0.5, 0.9, 1.2];  // Radians from the normal.
const turns = 6;
const nearness = [14, 7, 4];  // In sizes of the triangle.

export interface Outlook { direction: Vector3; distance: number }

/**
 * The direction nearest to the normal, and the largest distance, from which nothing hides the
 * face, or at least its middle; along the normal if there is none.
 */
export function outlookOn(mesh: PageMesh, face: number, corners: Vector3[], up: Vector3): Outlook {
  const middle = corners[0].clone().add(corners[1]).add(corners[2]).divideScalar(3);
  const size = Math.max(...corners.map((p) => p.distanceTo(middle)));
  const normal = normalOf(corners);
  const directions = directionsAround(normal).filter((d) => Math.abs(d.dot(up)) < 0.98);
  const spots = [middle, ...corners.map((corner) => corner.clone().lerp(middle, 0.2))];
  for (const wanted of [spots, [middle]]) {
    for (const times of nearness) {
      const distance = Math.max(times * size, 0.004);
      for (const direction of directions) {
        const from = middle.clone().addScaledVector(direction, distance);
        const isSeen = (spot: Vector3) => faceAlong(mesh, from, spot.clone().sub(from)) === face;
        if (wanted.every(isSeen)) return { direction, distance };
      }
    }
  }
  return { direction: directions[0], distance: Math.max(nearness[0] * size, 0.02) };
}

function normalOf(corners: Vector3[]): Vector3 {
  const normal = corners[1].clone().sub(corners[0]).cross(corners[2].clone().sub(corners[0]));
  return normal.length() > 1e-16 ? normal.normalize() : new Vector3(0, 0, 1);
}

function directionsAround(normal: Vector3): Vector3[] {
  const least = Math.abs(normal.x) < 0.7 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  const side = new Vector3().crossVectors(normal, least).normalize();
  return tilts.flatMap((tilt) => Array.from({ length: tilt === 0 ? 1 : turns }, (_, i) =>
    normal.clone().applyAxisAngle(side.clone().applyAxisAngle(normal, i * 2 * Math.PI / turns), tilt)));
}
