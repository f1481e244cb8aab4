// Marks a triangle or a point of a mesh, in front of everything.
import { Group, Vector3 } from "three";
import { lineMaterial, lineMesh, setLineColor } from "./lines";

export class Marker {
  readonly group = new Group();
  private readonly material = lineMaterial(3, true);

  setColor(color: string): void { setLineColor(this.material, color); }

  clear(): void { this.group.clear(); }

  /** Three corners. */
  markTriangle(corners: ArrayLike<number>[]): void {
    const [a, b, c] = corners;
    this.draw([a, b, b, c, c, a]);
  }

  /** A cross of three lines. @param size  half their length. */
  markPoint(point: Vector3, size: number): void {
    const ends: number[][] = [];
    for (const axis of [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)]) {
      ends.push(point.clone().addScaledVector(axis, size).toArray(),
                point.clone().addScaledVector(axis, -size).toArray());
    }
    this.draw(ends);
  }

  private draw(points: ArrayLike<number>[]): void {
    this.clear();
    const lines = lineMesh(Float32Array.from(points.flatMap((p) => [p[0], p[1], p[2]])), this.material);
    lines.renderOrder = 1;
    this.group.add(lines);
  }
}
