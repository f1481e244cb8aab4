// Bundles the viewer and writes it as a C++ source.
//   node build.mjs [FILE]    without FILE: only checks that it can be bundled
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const folder = dirname(fileURLToPath(import.meta.url));

async function bundle(file) {
  const result = await build({
    entryPoints: [join(folder, "src", file)], bundle: true, minify: true, write: false, format: "iife",
    target: ["es2022"], charset: "ascii", legalComments: "none", logLevel: "warning",
  });
  return result.outputFiles[0].text.trim();
}

// What would end the element, or let the parser of HTML read it in another way.
function requireInline(text, name) {
  if (/<\/(script|style)|<!--|<script/i.test(text)) throw new Error(`${name} cannot stand in a page`);
  return text;
}

const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

// A literal of C++, in pieces.
function literal(text) {
  const pieces = [];
  for (let at = 0; at < text.length; at += 4000) {
    const piece = text.slice(at, at + 4000);
    pieces.push(`"${piece.replace(/[\\"?]/g, "\\$&").replace(/\n/g, "\\n")}"`);
  }
  return pieces.join("\n    ");
}

const script = requireInline(await bundle("main.ts"), "the script");
const style = requireInline(await bundle("style.css"), "the style");
const body = (await readFile(join(folder, "src/index.html"), "utf8")).trim();
const licence = (await readFile(join(folder, "node_modules/three/LICENSE"), "utf8")).trim();
if (licence.includes("--")) throw new Error("the licence of three cannot stand in a comment");
// Nothing is loaded, and no other script runs, whatever the data hold.
const policy = `default-src 'none'; script-src ${hashOf(script)}; style-src ${hashOf(style)}; img-src data: blob:`;
const head = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="remesh">
<title>Remesh report</title>
<style>${style}</style>
</head>
<body>
${body}
<noscript>This page needs JavaScript.</noscript>
`;
const tail = `<!-- This page contains three.js (threejs.org):

${licence}
-->
<script>${script}</script>
</body>
</html>
`;
const size = head.length + tail.length;
if (size > 700_000) throw new Error(`the page takes ${size} bytes without meshes, more than 700 kB`);
if (process.argv[2]) {
  await writeFile(process.argv[2], `// Written by tools/viewer/build.mjs.
#include "page/viewer.h"

namespace page {

Viewer viewer() {
    static constexpr char head[] =
    ${literal(head)};
    static constexpr char tail[] =
    ${literal(tail)};
    return {{head, sizeof head - 1}, {tail, sizeof tail - 1}};
}

}  // namespace page
`);
}
console.log(`viewer: ${size} bytes`);
