// The parts of Node.
import { readFile } from "node:fs/promises";
import { Worker } from "node:worker_threads";
import type { Places } from "./browser.js";
import { Host, Message, WorkerHandle } from "./worker_runner.js";

export const places: Places = {};

export async function compile(): Promise<WebAssembly.Module> {
  const { wasm } = places;
  if (wasm instanceof WebAssembly.Module) return wasm;
  const isBytes = wasm instanceof ArrayBuffer || wasm instanceof Uint8Array;
  const bytes = isBytes ? wasm : await readFile(wasm ?? new URL("./remesh.wasm", import.meta.url));
  return WebAssembly.compile(bytes as BufferSource);
}

function startWorker(): WorkerHandle {
  const worker = new Worker(new URL("./worker.node.js", import.meta.url), {
    execArgv: [],  // Those of the process may not suit it.
  });
  return {
    post: (message) => worker.postMessage(message),
    onMessage: (listen) => worker.on("message", (message: Message) => listen(message)),
    onFailure: (listen) => {
      worker.on("error", (error: Error) => listen(`the worker failed (${error.message})`));
      worker.on("exit", () => listen("the worker ended"));
    },
    end: () => void worker.terminate(),
    hold: (isHeld) => isHeld ? worker.ref() : worker.unref(),
  };
}

export const host: Host = { compile, startWorker };
