// The parts of a browser, or of Deno.
import { Host, Message, WorkerHandle } from "./worker_runner.js";
import { RemeshError } from "./errors.js";

/** Where the files of the package are, if not beside this one. */
export interface Places {
  /** The module: its address, its bytes, or itself. */
  wasm?: string | URL | ArrayBuffer | Uint8Array | WebAssembly.Module;
  /** Starts the package's worker.js. */
  worker?: () => Worker;
}

export const places: Places = {};

export async function compile(): Promise<WebAssembly.Module> {
  const { wasm } = places;
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || wasm instanceof Uint8Array) return WebAssembly.compile(wasm as BufferSource);
  const address = wasm ?? new URL("./remesh.wasm", import.meta.url);
  const response = await fetch(address).catch((error: unknown) => {
    throw new RemeshError("Error", `${String(address)} cannot be loaded (${String(error)}); serve remesh.wasm there, or ` +
      "name its place: configure({ wasm })");
  });
  if (!response.ok) {
    throw new RemeshError("Error", `${String(address)} cannot be loaded (status ${response.status}); serve remesh.wasm ` +
      "there, or name its place: configure({ wasm })");
  }
  // Servers that do not know the type of .wasm are common.
  const isTyped = response.headers.get("content-type")?.startsWith("application/wasm");
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

function startWorker(): WorkerHandle {
  const worker = places.worker?.() ?? new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  return {
    post: (message) => worker.postMessage(message),
    onMessage: (listen) => worker.addEventListener("message", ({ data }: MessageEvent<Message>) => listen(data)),
    onFailure: (listen) => worker.addEventListener("error", (event) => {
      event.preventDefault();
      listen(`the worker failed (${event.message || "its file cannot be loaded"}); serve worker.js beside index.js, ` +
        "start it yourself: configure({ worker }), or import remesh-wasm/direct");
    }),
    end: () => worker.terminate(),
    hold: () => {},
  };
}

export const host: Host = { compile, startWorker };
