// Compiled against the types of the package: what users write compiles, mistakes do not.
import { geodesicDistance, readMesh, remesh, RemeshError, voronoi, writeMesh, type Mesh, type RemeshOptions } from "remesh-wasm";
import * as direct from "remesh-wasm/direct";

export async function use(bytes: Uint8Array, signal: AbortSignal): Promise<number> {
  const mesh: Mesh & { warnings: string[] } = await readMesh(bytes, { name: "a.ply" });
  const options: RemeshOptions = { n: "10%", adaptive: true, features: 30, region: Uint8Array.of(1), faceLabels: ["a", "b"] };
  const made = await remesh(mesh, options, { signal, onProgress: (fraction, stage) => console.log(fraction.toFixed(2), stage.length) });
  const { bytes: written } = await writeMesh(made, { format: "obj" });
  const distances: Float64Array = await geodesicDistance({ positions: [0, 0, 0], triangles: [] }, [0]);
  const labels: Int32Array = (await voronoi(mesh, { points: [0, 0, 0] }, { maxError: 0 })).labels;
  const same: typeof remesh = direct.remesh;
  // @ts-expect-error  there is no such option
  await same(mesh, { samples: 3 });
  // @ts-expect-error  there is no such choice
  await same(mesh, { boundary: "open" });
  // @ts-expect-error  sites are missing
  await voronoi(mesh);
  // @ts-expect-error  a mesh has triangles
  await remesh({ positions: [0, 0, 0] });
  return new RemeshError("FileError", "").name.length + written.length + distances.length + labels.length + made.sourceFace[0];
}
