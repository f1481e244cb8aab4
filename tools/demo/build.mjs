// Makes the demo: one page that holds the package, the viewer and the meshes of data/, and loads nothing.
//   node build.mjs PACKAGE DATA FILE
import { execFileSync } from "node:child_process";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";

const folder = dirname(fileURLToPath(import.meta.url)), viewer = join(folder, "../viewer");
const [packed, data, target] = process.argv.slice(2);
const require = createRequire(join(viewer, "package.json"));
const { build } = await import(pathToFileURL(require.resolve("esbuild")).href);

const examples = ["organic.ply", "part.off", "shell.obj", "parts.ply", "ring.obj", "slivers.off"];

execFileSync(process.execPath, [join(viewer, "node_modules/typescript/bin/tsc"), "-p", folder, "--noEmit"], { stdio: "inherit" });

async function bundle(file) {
  const result = await build({
    entryPoints: [file], bundle: true, minify: true, write: false, format: "iife", target: ["es2022"], charset: "ascii",
    legalComments: "none", logLevel: "error", nodePaths: [join(viewer, "node_modules")],
    define: { "import.meta.url": "document.baseURI" },
  });
  return result.outputFiles[0].text.trim();
}

/** Bytes as a block that no parser reads. */
const block = (id, bytes, more = "") =>
  `<script type="text/plain" id="${id}"${more}>${gzipSync(bytes, { level: 9 }).toString("base64")}</script>`;

const inline = (text) => text.replace(/<\/(script|style)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");

const page = (title, styles, body, script, blocks = []) => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>${title}</title>
<style>${styles.join("")}</style>
</head>
<body>
${body}
${blocks.join("\n")}
<script>${inline(script)}</script>
</body>
</html>
`;

const read = (path) => readFile(path, "utf8");
const viewerStyle = await bundle(join(viewer, "src/style.css"));
const licence = (await read(join(viewer, "node_modules/three/LICENSE"))).trim();
const frame = page("Meshes", [viewerStyle, await bundle(join(folder, "src/frame.css"))], await read(join(viewer, "src/index.html")),
                   await bundle(join(folder, "src/frame.ts")));
const blocks = [
  block("module", await readFile(join(packed, "remesh.wasm"))),
  block("worker", await bundle(join(folder, "../npm/src/worker.ts"))),
  block("frame", frame),
  ...await Promise.all(examples.map(async (name, i) =>
    block(`example-${i}`, await readFile(join(data, name)), ` data-example="${basename(name)}"`))),
];
const body = `<!-- This page contains three.js (threejs.org):\n\n${licence}\n-->\n${await read(join(folder, "src/index.html"))}`;
const text = page("Remesh in your browser", [viewerStyle, await bundle(join(folder, "src/style.css"))], body,
                  await bundle(join(folder, "src/main.ts")), blocks);
await mkdir(dirname(target), { recursive: true });
await writeFile(target, text);
console.log(`${target}: ${text.length} bytes`);
