// What a worker does: gets the module, then requests.
import { Engine, Request } from "./engine.js";
import { RemeshError } from "./errors.js";
import type { Message } from "./worker_runner.js";

export type Incoming = { module: WebAssembly.Module } | { request: Request };

/** @param post  sends a message and gives away the buffers */
export function makeListener(post: (message: Message, transfer?: ArrayBuffer[]) => void): (incoming: Incoming) => void {
  let engine: Engine | null = null;
  return (incoming) => {
    try {
      if ("module" in incoming) {
        engine = new Engine(incoming.module);
        return post({ kind: "ready" });
      }
      const answer = engine!.call(incoming.request, (fraction, stage) => {
        post({ kind: "progress", fraction, stage });
        return true;
      });
      const buffers = Object.values(answer.arrays).map((array) => array.buffer as ArrayBuffer);
      post({ kind: "answer", answer, memory: engine!.memory }, [...new Set(buffers)]);
    } catch (error) {
      post(error instanceof RemeshError
        ? { kind: "error", name: error.name as any, message: error.message, isBroken: false }
        : { kind: "error", name: "Error", message: describe(error), isBroken: true });
    }
  };
}

/** Of what is no error of the module, but of the engine that runs it. */
export function describe(error: unknown): string {
  const text = error instanceof Error ? `${error.name}: ${error.message}` : String(error);
  return `the module failed (${text}); this is a fault of remesh-wasm or of the JavaScript engine`;
}
