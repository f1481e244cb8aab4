// What the package must do, in Node as in a browser: each case gets the package and a reader of files.
// The two sides run the same file; what native programs gave stands in `expected`.

/** Runs of the program and of the package that must write the same bytes. */
export const sameBytes = [
  { mesh: "organic.ply", words: ["-n", "2000"], options: { n: 2000 }, format: "ply" },
  { mesh: "organic.ply", words: ["-n", "4000", "--tile", "1000"], options: { n: 4000, tile: 1000 }, format: "ply" },
  { mesh: "organic.ply", words: ["-n", "700", "--adaptive"], options: { n: 700, adaptive: true }, format: "obj" },
  { mesh: "organic.ply", words: ["--edge-length", "4%", "--init", "farthest"],
    options: { edgeLength: "4%", init: "farthest" }, format: "off" },
  { mesh: "part.off", words: ["-n", "2000"], options: { n: 2000 }, format: "ply" },
  { mesh: "part.off", words: ["--max-distance", "0.4%", "--features", "40"],
    options: { maxDistance: "0.4%", features: 40 }, format: "glb" },
  { mesh: "part.off", words: ["-n", "5%", "--topology", "add", "--features", "off"],
    options: { n: "5%", topology: "add", features: "off" }, format: "stl", transfer: "none" },
  { mesh: "parts.ply", words: ["-n", "1500"], options: { n: 1500 }, format: "ply" },
  { mesh: "plate.stl", words: ["-n", "400"], options: { n: 400 }, format: "mesh" },
  { mesh: "ring.obj", words: ["-n", "500"], options: { n: 500 }, format: "obj" },
  { mesh: "ring.obj", words: ["-n", "500", "--max-error", "0"], options: { n: 500, maxError: 0 }, format: "ply" },
  { mesh: "shell.obj", words: ["-n", "800", "--relax", "0"], options: { n: 800, relax: 0 }, format: "vtk" },
  { mesh: "slivers.off", words: ["-n", "600", "--seed", "7"], options: { n: 600, seed: 7 }, format: "gltf" },
  { mesh: "labelled.ply", words: ["-n", "300", "--keep-labels=part"], options: { n: 300, faceLabels: "part" }, format: "ply" },
  { mesh: "labelled.ply", words: ["-n", "60", "--region", "part"], options: { n: 60, region: "part" }, format: "ply" },
  { mesh: "labelled.ply", words: ["--sizing", "size"], options: { sizing: "size" }, format: "vtp" },
  { mesh: "bunny.off", words: ["-n", "2000"], options: { n: 2000 }, format: "ply", isReal: true },
  { mesh: "fandisk.off", words: ["-n", "2000"], options: { n: 2000 }, format: "ply", isReal: true },
];

/** A cube of quads with a label of faces, a size and colours of vertices. */
export function labelledPly() {
  const k = 6, points = [], rows = [], number = new Map();
  const at = (p) => {
    const key = p.join(" ");
    if (!number.has(key)) {
      number.set(key, points.length);
      points.push(`${key} ${0.3 + p[0] / 20} ${40 * p[0]} ${40 * p[1]} ${40 * p[2]}`);
    }
    return number.get(key);
  };
  [0, 1, 2].forEach((axis) => [0, k].forEach((side) => {
    for (let i = 0; i < k; ++i) {
      for (let j = 0; j < k; ++j) {
        const corner = (a, b) => {
          const p = [0, 0, 0];
          p[axis] = side;
          p[(axis + 1) % 3] = i + a;
          p[(axis + 2) % 3] = j + b;
          return at(p);
        };
        const quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        rows.push(`4 ${(side === 0 ? quad.reverse() : quad).join(" ")} ${axis === 2 && side > 0 ? 1 : 0}`);
      }
    }
  }));
  return ["ply", "format ascii 1.0", `element vertex ${points.length}`, "property double x", "property double y",
          "property double z", "property float size", "property uchar red", "property uchar green", "property uchar blue",
          `element face ${rows.length}`, "property list uchar int vertex_indices", "property int part", "end_header",
          ...points, ...rows, ""].join("\n");
}

function require(condition, text) {
  if (!condition) throw new Error(text);
}
const equal = (a, b, text) => require(Object.is(a, b), `${text}: ${a} is not ${b}`);
const near = (a, b, most, text) => require(Math.abs(a - b) <= most, `${text}: ${a} is not ${b}`);

async function refusal(promise) {
  try {
    await promise;
  } catch (error) {
    return error;
  }
  throw new Error("nothing was refused");
}

/** A flat square of k x k quads with side 1. */
export function square(k) {
  const positions = [], triangles = [];
  for (let i = 0; i <= k; ++i) for (let j = 0; j <= k; ++j) positions.push(i / k, j / k, 0);
  for (let i = 0; i < k; ++i) {
    for (let j = 0; j < k; ++j) {
      const a = i * (k + 1) + j, b = a + k + 1;
      triangles.push(a, b, b + 1, a, b + 1, a + 1);
    }
  }
  return { positions, triangles };
}

const never = { n: 4000, relax: 200 };  // Takes seconds.

const refusals = [
  [(r, m) => r.remesh(null), "InvalidOption", "the mesh is null; give an object with positions and triangles"],
  [(r, m) => r.remesh({}), "InvalidOption", "positions is undefined; give a typed array or a list of numbers"],
  [(r, m) => r.remesh({ ...m, positions: [1, "2"] }), "InvalidOption", "positions is a list whose element 1 is '2'; give"],
  [(r, m) => r.remesh({ ...m, positions: [1, 2] }), "InvalidInput", "positions has 2 numbers, which is no multiple of 3"],
  [(r, m) => r.remesh({ ...m, triangles: [0, 1, -2] }), "InvalidInput", "triangles[2] is -2; use whole numbers of 0 or more"],
  [(r, m) => r.remesh({ ...m, triangles: [0, 1, 2.5] }), "InvalidInput", "triangles[2] is 2.5; use whole numbers"],
  [(r, m) => r.remesh({ ...m, triangles: [0, 1, 999] }), "InvalidInput", "face 0 names vertex 999, but the mesh has only 121 vertices"],
  [(r, m) => r.remesh({ ...m, triangles: [] }), "InvalidInput", "no face"],
  [(r, m) => r.remesh({ ...m, positions: m.positions.map((x, i) => i === 4 ? NaN : x) }), "InvalidInput", "vertex 1 has a coordinate that is not finite"],
  [(r, m) => r.remesh({ ...m, vertexData: { a: new Float64Array(3) } }), "InvalidOption", "vertexData.a has 3 values, but there are 121 vertices"],
  [(r, m) => r.remesh({ ...m, uv: [1, 2] }), "InvalidInput", "uv has 2 numbers, but there are 200 faces; give six for each"],
  [(r, m) => r.remesh(m, 2000), "InvalidOption", "the options is number 2000; give an object, such as { n: 2000 }"],
  [(r, m) => r.remesh(m, { n: 0 }), "InvalidOption", "n is 0; use a whole number of 1 or more, or a percentage of the input's vertices"],
  [(r, m) => r.remesh(m, { n: NaN }), "InvalidOption", "n is NaN; use a whole number of 1 or more"],
  [(r, m) => r.remesh(m, { n: () => 3 }), "InvalidOption", "n is function; use a whole number of 1 or more"],
  [(r, m) => r.remesh(m, { n: 10, faces: 20 }), "InvalidOption", "n and faces each give the number of vertices; use one of them"],
  [(r, m) => r.remesh(m, { n: 10, sites: [1] }), "InvalidOption", "n and sites each give the number of vertices"],
  [(r, m) => r.remesh(m, { edgeLenght: 1 }), "InvalidOption", "there is no option 'edgeLenght'; did you mean 'edgeLength'?"],
  [(r, m) => r.remesh(m, { edgeLength: "-2%" }), "InvalidOption", "edgeLength is '-2%'; use a number above 0, or a percentage of the diagonal"],
  [(r, m) => r.remesh(m, { features: "sharp" }), "InvalidOption", "features is 'sharp'; use 'auto', 'off' or an angle in degrees"],
  [(r, m) => r.remesh(m, { features: 200 }), "InvalidOption", "200"],
  [(r, m) => r.remesh(m, { boundary: "open" }), "InvalidOption", "boundary is 'open'; use keep or free"],
  [(r, m) => r.remesh(m, { sizing: [1, 2] }), "InvalidOption", "sizing has 2 values, but there are 121 vertices; give one for each"],
  [(r, m) => r.remesh(m, { sizing: "size" }), "InvalidOption", "sizing: the mesh has no values of vertices 'size'"],
  [(r, m) => r.remesh(m, { minAngle: 40 }), "InvalidOption", "minAngle is 40"],
  [(r, m) => r.remesh(m, { n: 20, relax: 0, minAngle: 30 }), "ConstraintUnmet", "the smallest angle asked for is 30"],
  [(r, m) => r.remesh(m, { gradation: 2 }), "InvalidOption", "minEdge, maxEdge and gradation bound edges that differ"],
  [(r, m) => r.remesh(m, { transfer: ["a"] }), "InvalidOption", "transfer: the mesh has no values 'a'; it has: none"],
  [(r, m) => r.remesh(m, { lock: [500] }), "InvalidInput", "vertex 500 is to stay, but the mesh has only 121 vertices"],
  [(r, m) => r.remesh(m, { keepSites: true }), "InvalidOption", "keepSites needs sites"],
  [(r, m) => r.remesh(m, { maxError: 2 }), "InvalidOption", "use a number from 0 (exact) to below 1"],
  [(r, m) => r.remesh(m, { fillHoles: 20 }), "InvalidOption", "fillHoles needs CGAL, which this package is without"],
  [(r, m) => r.creases(m, { features: "sharp" }), "InvalidOption", "features is 'sharp'; use 'auto', 'off' or an angle in degrees"],
  [(r, m) => r.creases(m, { angle: 3 }), "InvalidOption", "there is no option 'angle'"],
  [(r, m) => r.remesh(m, { engine: "steiner" }), "InvalidOption", "there is no option 'engine'"],
  [(r, m) => r.remesh(m, {}, { onProgress: 3 }), "InvalidOption", "onProgress is number 3; give a function"],
  [(r, m) => r.remesh(m, {}, { signal: {} }), "InvalidOption", "signal is an object (Object); give an AbortSignal"],
  [(r, m) => r.voronoi(m, []), "InvalidOption", "there is no site; give one or more"],
  [(r, m) => r.voronoi(m, [121]), "InvalidSites", "site 0 names vertex 121, but the mesh has only 121 vertices"],
  [(r, m) => r.voronoi(m, { faces: [0], barycentric: [1, 1, 1, 1] }), "InvalidOption", "sites.barycentric has 4 numbers for 1 faces"],
  [(r, m) => r.voronoi(m, { faces: [700], barycentric: [1, 0, 0] }), "InvalidSites", "site 0 names a face that does not exist; use one of the 200 faces"],
  [(r, m) => r.geodesicDistance(m, "all"), "InvalidOption", "sites is 'all'; give vertices, { points }, or { faces, barycentric }"],
  [(r, m) => r.geodesicDistance(m, [0], { radius: 3 }), "InvalidOption", "there is no option 'radius'"],
  [(r, m) => r.readMesh("text", { name: "a.off" }), "InvalidOption", "the bytes are 'text'; give a Uint8Array or an ArrayBuffer"],
  [(r, m) => r.readMesh(new Uint8Array(0), { name: "a.off" }), "FileError", "a.off: the file is empty; export the file again"],
  [(r, m) => r.readMesh(new Uint8Array(9), { name: "a.xyz" }), "FileError", "a.xyz: unknown extension '.xyz'; use .ply, .obj"],
  [(r, m) => r.readMesh(new TextEncoder().encode("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), { name: "a.off" }), "InvalidInput",
   "a.off: line 6: face 0 names vertex 7, but the file has only 3 vertices"],
  [(r, m) => r.readMesh(new TextEncoder().encode("<VTKFile>"), { name: "a.vtp" }), "FileError", "built without expat; convert the file to .ply"],
  [(r, m) => r.readMesh(Uint8Array.of(0x1f, 0x8b, 1, 2, 3), { name: "a.ply.gz" }), "FileError", "a.ply.gz: the compressed data are damaged"],
  [(r, m) => r.writeMesh(m, { format: "3mf" }), "FileError", "built without zlib, which .3mf needs; write .ply"],
  [(r, m) => r.writeMesh(m, { format: "dwg" }), "FileError", "unknown format 'dwg'; use ply, obj"],
];

export const cases = {
  async "bad arguments are refused with clear texts"(r) {
    const mesh = square(10);
    for (const [call, name, text] of refusals) {
      const error = await refusal(call(r, mesh));
      require(error instanceof r.RemeshError, `${call}: ${error.stack ?? error}`);
      equal(error.name, name, error.message);
      require(error.message.includes(text), `${call}: '${error.message}' is not '${text}'`);
    }
  },

  async "too few vertices for the topology are refused with a number that works"(r, read) {
    const mesh = await r.readMesh(await read("organic.ply"), { name: "organic.ply" });
    const error = await refusal(r.remesh(mesh, { n: 5 }));
    equal(error.name, "ConstraintUnmet", error.message);
    const enough = Number(/use (\d+)/.exec(error.message)[1]);
    equal((await r.remesh(mesh, { n: enough })).positions.length, 3 * enough, "vertices");
  },

  async "distances and diagrams of a flat square are those of the plane"(r) {
    const k = 20, mesh = square(k), site = 7 * (k + 1) + 3, other = 15 * (k + 1) + 12;
    const to = (v, s) => Math.hypot(mesh.positions[3 * v] - mesh.positions[3 * s],
                                    mesh.positions[3 * v + 1] - mesh.positions[3 * s + 1]);
    const distances = await r.geodesicDistance(mesh, [site], { maxError: 0 });
    const sites = Uint32Array.of(site, other);
    const diagram = await r.voronoi(mesh, sites, { maxError: 0 });
    for (let v = 0; v < distances.length; ++v) {
      near(distances[v], to(v, site), 1e-12, `distance of ${v}`);
      near(diagram.distances[v], Math.min(to(v, site), to(v, other)), 1e-12, `distance of ${v} from both`);
      if (Math.abs(to(v, site) - to(v, other)) > 1e-9) {
        equal(diagram.labels[v], to(v, site) < to(v, other) ? 0 : 1, `label of ${v}`);
      }
    }
    near(diagram.cellArea[0] + diagram.cellArea[1], 1, 1e-12, "area");
    equal([...diagram.neighbours].join(), "1,0", "neighbours");
    const line = [...diagram.lineSites].findIndex((one, i) => i % 2 === 1 && one >= 0) >> 1;
    for (let i = diagram.lineOffsets[line]; i < diagram.lineOffsets[line + 1]; ++i) {
      const [x, y] = diagram.points.subarray(3 * i, 3 * i + 2);
      const from = (s) => Math.hypot(x - mesh.positions[3 * s], y - mesh.positions[3 * s + 1]);
      near(from(site), from(other), 1e-9, "a point between both");
      near(diagram.pointDistances[i], from(site), 1e-9, "its distance");
    }
    equal(diagram.certifiedError, 0, "certified error");
    const places = await r.voronoi(mesh, { points: [0.35, 0.15, 5] }, {});
    near(places.sitePositions[0], 0.35, 1e-12, "the nearest point");
    equal(places.sitePositions[2], 0, "its height");
    const onFace = await r.geodesicDistance(mesh, { faces: [0], barycentric: [0, 0, 1] }, { maxError: 0 });
    near(onFace[0], Math.SQRT2 / k, 1e-12, "from a corner of face 0");
  },

  async "creases are the edges that the rule tells, and none of the boundary"(r, read) {
    const flat = square(4);
    equal((await r.creases(flat)).length, 0, "a flat square");
    // Folded along the line x = 1/2.
    const folded = { ...flat, positions: flat.positions.map((x, i) => i % 3 === 2 ? Math.abs(flat.positions[i - 2] - 0.5) : x) };
    for (const features of [undefined, 30, "off"]) {
      const pairs = await r.creases(folded, { n: 100, features });
      equal(pairs.length, features === "off" ? 0 : 8, `numbers with features ${features}`);
      for (const v of pairs) equal(folded.positions[3 * v], 0.5, "x of a crease");
    }
    equal((await r.creases(folded, { features: 100 })).length, 0, "above 100 degrees");
    const part = await r.readMesh(await read("part.off"), { name: "part.off" });
    require((await r.creases(part, { n: 2000 })).length > 200, "too few creases of the part");
  },

  async "inputs of any type give the same result and do not change"(r) {
    const { positions, triangles } = square(12);
    const doubles = Float64Array.from(positions), before = doubles.slice();
    const whole = Float64Array.from([9, 9, ...positions, 9]);
    const wanted = await r.remesh({ positions, triangles }, { n: 60 });
    equal(wanted.positions.length, 180, "numbers");
    const others = [
      { positions: doubles, triangles: Uint32Array.from(triangles) },
      { positions: whole.subarray(2, 2 + positions.length), triangles: Int32Array.from(triangles) },
      { positions, triangles: Uint16Array.from(triangles) },
    ];
    for (const mesh of others) {
      const made = await r.remesh(mesh, { n: 60 });
      equal(made.positions.join(), wanted.positions.join(), "positions");
      equal(made.triangles.join(), wanted.triangles.join(), "triangles");
    }
    equal(doubles.join(), before.join(), "the input");
    const single = await r.remesh({ positions: Float32Array.from(positions), triangles }, { n: 60 });
    require(single.positions instanceof Float32Array, "float32 comes back as float32");
  },

  async "each vertex has a place on the input, and values are carried over"(r, read) {
    const mesh = await r.readMesh(await read("ring.obj"), { name: "ring.obj" });
    equal(mesh.uv.length, 2 * mesh.triangles.length, "texture coordinates");
    const height = mesh.positions.filter((_, i) => i % 3 === 2);
    const half = Int32Array.from({ length: mesh.triangles.length / 3 }, (_, f) => mesh.positions[3 * mesh.triangles[3 * f]] > 0 ? 7 : 5);
    const made = await r.remesh({ ...mesh, vertexData: { height }, faceData: { half } }, { n: 600 });
    const { sourceFace, barycentric, positions } = made;
    equal(sourceFace.length, 600, "places");
    for (let v = 0; v < 600; ++v) {
      for (let k = 0; k < 3; ++k) {
        let x = 0;
        for (let c = 0; c < 3; ++c) x += barycentric[3 * v + c] * mesh.positions[3 * mesh.triangles[3 * sourceFace[v] + c] + k];
        near(x, positions[3 * v + k], 0.02, `place of vertex ${v}`);
      }
      near(made.vertexData.height[v], positions[3 * v + 2], 0.02, `height of vertex ${v}`);
    }
    require(made.vertexData.height instanceof Float64Array && made.faceData.half instanceof Int32Array, "types");
    equal([...new Set(made.faceData.half)].sort().join(), "5,7", "labels");
    equal(made.uv.length, 2 * made.triangles.length, "texture coordinates of the result");
    equal(made.report.output_vertices, 600, "the report");
    const some = await r.remesh({ ...mesh, vertexData: { height }, faceData: { half } }, { n: 100, transfer: ["half"] });
    equal(Object.keys(some.vertexData).join() + Object.keys(some.faceData).join() + String(some.uv), "halfundefined", "some");
    const none = await r.remesh(mesh, { n: 100, transfer: "none" });
    equal(none.uv, undefined, "none");
  },

  async "vertices and faces that are to stay stay bit for bit"(r) {
    const mesh = square(16);
    const region = Uint8Array.from({ length: mesh.triangles.length / 3 }, (_, f) => f < 256 ? 1 : 0);
    const made = await r.remesh(mesh, { n: 60, region });
    equal(made.keptFaces.length, 256, "faces that stay");
    made.keptFaces.forEach((f, i) => {
      for (let c = 0; c < 3; ++c) {
        const then = mesh.triangles[3 * f + c], now = made.triangles[3 * i + c];
        for (let k = 0; k < 3; ++k) equal(made.positions[3 * now + k], mesh.positions[3 * then + k], "a corner");
      }
    });
    const locked = await r.remesh({ ...mesh, positions: mesh.positions.map((x, i) => i === 3 * 100 ? x + 0.01 : x) }, { n: 60, lock: [100] });
    const has = (x, y) => locked.positions.some((p, i) => i % 3 === 0 && p === x && locked.positions[i + 1] === y);
    require(has(mesh.positions[300] + 0.01, mesh.positions[301]), "the vertex is there");
  },

  async "every format that is written is read again with the same numbers"(r, read) {
    const mesh = await r.readMesh(await read("part.off"), { name: "part.off" });
    for (const format of ["ply", "obj", "off", "vtk", "mesh", "stl", "glb", "gltf"]) {
      const { bytes, warnings } = await r.writeMesh(mesh, { format });
      equal(warnings.length, 0, format);
      const again = await r.readMesh(bytes, { format });
      equal(again.triangles.length, mesh.triangles.length, `${format}: corners`);
      const isSingle = ["stl", "glb", "gltf"].includes(format);
      for (let i = 0; i < mesh.triangles.length; ++i) {
        for (let k = 0; k < 3; ++k) {
          const x = mesh.positions[3 * mesh.triangles[i] + k];
          equal(again.positions[3 * again.triangles[i] + k], isSingle ? Math.fround(x) : x, `${format}: corner ${i}`);
        }
      }
    }
    const packed = (await r.writeMesh(mesh, { name: "part.ply.gz" })).bytes;
    require(packed[0] === 0x1f && packed[1] === 0x8b, "gzip");
    equal((await r.readMesh(packed, { name: "part.ply.gz" })).positions.join(), mesh.positions.join(), "gzip");
    const lost = await r.writeMesh({ ...mesh, vertexData: { heat: new Float64Array(mesh.positions.length / 3) } }, { format: "stl" });
    require(lost.warnings.length === 1 && lost.warnings[0].includes("heat"), `no warning: ${lost.warnings}`);
  },

  async "progress never falls and ends with 1"(r, read) {
    const mesh = await r.readMesh(await read("part.off"), { name: "part.off" });
    const fractions = [], stages = new Set();
    await r.remesh(mesh, { n: 1000 }, { onProgress: (fraction, stage) => { fractions.push(fraction); stages.add(stage); } });
    require(fractions.length > 8, `only ${fractions.length} calls`);
    require(fractions.every((x, i) => i === 0 || x >= fractions[i - 1]), `falls: ${fractions}`);
    equal(fractions.at(-1), 1, "the last one");
    for (const stage of ["clean", "relax", "check", "write"]) require(stages.has(stage), `no stage ${stage}`);
  },

  async "a call can be ended, and the next one works"(r, read) {
    const mesh = await r.readMesh(await read("organic.ply"), { name: "organic.ply" });
    const controller = new AbortController();
    let abortedAt = 0;
    const onProgress = () => {
      if (abortedAt > 0) return;
      abortedAt = performance.now();
      controller.abort(new Error("enough"));
    };
    const error = await refusal(r.remesh(mesh, never, { signal: controller.signal, onProgress }));
    equal(error.message, "enough", "the reason");
    require(performance.now() - abortedAt < 1000, "it took long to end");
    equal((await r.remesh(square(5), { n: 20 })).positions.length, 60, "the next call");
    equal((await refusal(r.remesh(mesh, never, { onProgress: () => false }))).name, "Cancelled", "false");
    equal((await refusal(r.remesh(mesh, never, { onProgress: () => { throw new Error("mine"); } }))).message, "mine", "thrown");
    equal((await refusal(r.remesh(mesh, never, { signal: AbortSignal.abort() }))).name, "AbortError", "before");
    equal((await r.remesh(square(5), { n: 20 })).positions.length, 60, "the last call");
  },

  async "calls at once run one after the other, each with its own answer"(r) {
    const counts = [20, 30, 40, 50];
    const mesh = square(8);
    const made = await Promise.all(counts.map((n) => r.remesh(mesh, { n })));
    equal(made.map((one) => one.positions.length / 3).join(), counts.join(), "vertices");
  },
};

/** Of a worker only. */
export const workerCases = {
  async "a call that waits can be taken back, and stop() rejects what runs"(r, read) {
    const mesh = await r.readMesh(await read("organic.ply"), { name: "organic.ply" });
    const controller = new AbortController();
    const running = refusal(r.remesh(mesh, never));
    const waiting = refusal(r.remesh(square(5), { n: 20 }, { signal: controller.signal }));
    const last = refusal(r.remesh(square(5), { n: 20 }));
    controller.abort();
    equal((await waiting).name, "AbortError", "the waiting one");
    r.stop();
    equal((await running).name, "Cancelled", "the running one");
    equal((await last).name, "Cancelled", "the last one");
    equal((await r.remesh(square(5), { n: 20 })).positions.length, 60, "after stop()");
  },

  async "the caller's thread stays free"(r, read) {
    const mesh = await r.readMesh(await read("organic.ply"), { name: "organic.ply" });
    let ticks = 0;
    const timer = setInterval(() => ++ticks, 10);
    await r.remesh(mesh, { n: 1000 });
    clearInterval(timer);
    require(ticks > 10, `only ${ticks} ticks`);
  },
};
