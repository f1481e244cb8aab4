// The page around the package: a mesh in, options, before and after, files out. It is one file and loads nothing.
import { byId, element, inDigits } from "../../viewer/src/dom";
import { configure, creases, readMesh, remesh, RemeshError, prepare, writeMesh } from "../../npm/src/index";
import type { Mesh, RemeshOptions } from "../../npm/src/index";
import type { Shown } from "./shown";

const formats = ["ply", "obj", "stl", "glb"];

/** Of a block of the page: base64 of bytes compressed with gzip. */
async function bytesOf(id: string): Promise<Uint8Array> {
  const text = atob(byId(id).textContent!.trim());
  const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const textOf = async (id: string) => new TextDecoder().decode(await bytesOf(id));

interface Named { name: string; mesh: Mesh; creases: Uint32Array }

class Demo {
  private input: Named | null = null;
  private result: Named | null = null;
  private controller: AbortController | null = null;
  private loads = 0;
  private frameText = "";

  async start(): Promise<void> {
    this.frameText = await textOf("frame");
    const worker = URL.createObjectURL(new Blob([await textOf("worker")], { type: "text/javascript" }));
    configure({ wasm: await bytesOf("module"), worker: () => new Worker(worker) });
    this.bind();
    await prepare();
  }

  private bind(): void {
    const file = byId<HTMLInputElement>("file"), drop = byId("drop");
    file.addEventListener("change", () => { if (file.files?.[0]) void this.load(file.files[0].name, file.files[0].arrayBuffer()); });
    for (const kind of ["dragover", "dragleave", "drop"]) {
      document.addEventListener(kind, (event) => {
        event.preventDefault();
        drop.classList.toggle("over", kind === "dragover");
      });
    }
    document.addEventListener("drop", (event) => {
      const dropped = event.dataTransfer?.files[0];
      if (dropped) void this.load(dropped.name, dropped.arrayBuffer());
    });
    drop.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") file.click(); });
    for (const example of document.querySelectorAll<HTMLElement>("[data-example]")) {
      const name = example.dataset.example!;
      const button = element("button", { type: "button", class: "link" }, name);
      button.addEventListener("click", () => void this.load(name, bytesOf(example.id)));
      byId("examples").append(button, " ");
    }
    byId("controls").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.run();
    });
    for (const name of ["n", "edgeLength"]) {
      byId(name).addEventListener("focus", () => { document.querySelector<HTMLInputElement>(`[value="${name}"]`)!.checked = true; });
    }
    byId("stop").addEventListener("click", () => this.controller?.abort());
    for (const format of formats) {
      const button = element("button", { type: "button", "data-format": format }, format.toUpperCase());
      button.addEventListener("click", () => void this.save(format));
      byId("downloads").append(button);
    }
  }

  private say(text: string, isBad = false): void {
    byId("status").textContent = text;
    byId("status").classList.toggle("bad", isBad);
  }

  private fail(error: unknown): void {
    this.say(error instanceof Error ? error.message : String(error), true);
  }

  private async load(name: string, bytes: Promise<ArrayBuffer | Uint8Array>): Promise<void> {
    this.controller?.abort();
    const load = ++this.loads;
    this.say(`Reading ${name} …`);
    try {
      const mesh = await readMesh(await bytes, { name });
      if (load !== this.loads) return;
      this.input = { name, mesh, creases: new Uint32Array(0) };
      this.result = null;
      byId("save").hidden = true;
      byId<HTMLButtonElement>("start").disabled = false;
      const text = `${name}: ${inDigits(mesh.positions.length / 3)} vertices, ${inDigits(mesh.triangles.length / 3)} faces.`;
      this.say([text, ...mesh.warnings].join(" "));
      this.show();
    } catch (error) {
      if (load === this.loads) this.fail(error);
    }
  }

  private options(): RemeshOptions {
    const by = document.querySelector<HTMLInputElement>("[name=by]:checked")!.value as "n" | "edgeLength";
    const text = byId<HTMLInputElement>(by).value.trim();
    // What is no number goes as it is: the package says what is wrong.
    const number = text !== "" && Number.isFinite(Number(text)) ? Number(text) : text;
    const features = byId<HTMLSelectElement>("features").value;
    return {
      [by]: number, adaptive: byId<HTMLInputElement>("adaptive").checked,
      features: features === "auto" || features === "off" ? features : Number(features),
    };
  }

  private async run(): Promise<void> {
    const { input } = this;
    if (!input || this.controller) return;
    const { name, mesh } = input;
    const controller = this.controller = new AbortController();
    this.setRunning(true);
    const begin = performance.now();
    try {
      const { signal } = controller, options = this.options();
      const made = await remesh(mesh, options, {
        signal,
        onProgress: (fraction, stage) => {
          byId<HTMLProgressElement>("progress").value = fraction;
          this.say(`${Math.round(100 * fraction)} %: ${stage}`);
        },
      });
      const seconds = (performance.now() - begin) / 1000;
      const rule = { n: made.positions.length / 3, features: options.features };
      input.creases = await creases(mesh, rule, { signal });
      this.result = {
        name: `${name.replace(/(\.gz)?$/i, "").replace(/\.[^.]*$/, "")}-remesh`, mesh: made,
        creases: await creases(made, rule, { signal }),
      };
      this.say([`${inDigits(made.positions.length / 3)} vertices, ${inDigits(made.triangles.length / 3)} faces in ` +
        `${seconds.toFixed(1)} s.`, ...made.warnings].join(" "));
      byId("save").hidden = false;
      this.show();
    } catch (error) {
      if (controller.signal.aborted) this.say("Stopped.");
      else this.fail(error instanceof RemeshError ? error : new Error(`This is a fault of the page: ${String(error)}`));
    } finally {
      this.controller = null;
      this.setRunning(false);
    }
  }

  private setRunning(isRunning: boolean): void {
    byId("stop").hidden = !isRunning;
    byId<HTMLButtonElement>("start").disabled = isRunning;
    byId("progress").hidden = !isRunning;
    byId<HTMLProgressElement>("progress").value = 0;
  }

  private async save(format: string): Promise<void> {
    if (!this.result) return;
    try {
      const name = `${this.result.name}.${format}`;
      const { bytes, warnings } = await writeMesh(this.result.mesh, { name });
      const address = URL.createObjectURL(new Blob([bytes as BlobPart]));
      element("a", { href: address, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(address), 60_000);
      this.say([`${name}: ${inDigits(bytes.length)} bytes.`, ...warnings].join(" "), false);
    } catch (error) {
      this.fail(error);
    }
  }

  /** In a frame of its own, so that what it takes is freed with it. */
  private show(): void {
    const shown = ({ name, mesh, creases }: Named): Shown =>
      ({ name, positions: mesh.positions, triangles: mesh.triangles, creases });
    const { input, result } = this;
    const frame = element("iframe", { title: "Original and result", srcdoc: this.frameText });
    frame.addEventListener("load", () => {
      const inner = frame.contentWindow!, root = document.documentElement, innerRoot = inner.document.documentElement;
      inner.showMeshes(shown(input!), result && shown(result), root.dataset.theme ?? "light");
      new MutationObserver(() => { root.dataset.theme = innerRoot.dataset.theme; })
        .observe(innerRoot, { attributeFilter: ["data-theme"] });
    });
    byId("shown").replaceChildren(frame);
  }
}

const isDark = window.matchMedia("(prefers-color-scheme: dark)");
document.documentElement.dataset.theme = isDark.matches ? "dark" : "light";
new Demo().start().catch((error: unknown) => {
  byId("status").textContent = `The page cannot run: ${String(error)}`;
  throw error;
});
