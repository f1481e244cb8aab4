// Runs calls in a worker, so that the caller's thread stays free. One worker is kept; a call that is ended ends its
// worker, and the next one starts at once: compiled code belongs to the module, which stays.
import { RunOptions, Runner } from "./api.js";
import { Answer, Request } from "./engine.js";
import { ErrorName, RemeshError } from "./errors.js";

/** What a worker tells. */
export type Message =
  | { kind: "ready" }
  | { kind: "progress"; fraction: number; stage: string }
  | { kind: "answer"; answer: Answer; memory: number }
  | { kind: "error"; name: ErrorName; message: string; isBroken: boolean };

/** A worker of a browser or of Node. */
export interface WorkerHandle {
  post(message: unknown): void;
  onMessage(listen: (message: Message) => void): void;
  /** @param listen  gets a text if the worker ends by itself */
  onFailure(listen: (text: string) => void): void;
  end(): void;
  /** Whether the process waits for it. */
  hold(isHeld: boolean): void;
}

export interface Host {
  compile(): Promise<WebAssembly.Module>;
  startWorker(): WorkerHandle;
}

interface Job {
  request: Request;
  options: RunOptions;
  resolve(answer: Answer): void;
  reject(reason: unknown): void;
  /** Forgets the signal. */
  release(): void;
}

/** A module's memory never shrinks: above this a worker is not kept. */
const mostMemory = 256 * 2 ** 20;

export class WorkerRunner implements Runner {
  private module: Promise<WebAssembly.Module> | null = null;
  /** The worker, once it is there. */
  private worker: WorkerHandle | null = null;
  private starting: Promise<WorkerHandle> | null = null;
  private current: Job | null = null;
  private readonly waiting: Job[] = [];

  constructor(private readonly host: Host) {}

  async start(): Promise<void> { await this.ready(); }

  stop(): void {
    this.dropWorker();
    this.module = null;
    const jobs = [...(this.current ? [this.current] : []), ...this.waiting.splice(0)];
    this.current = null;
    for (const job of jobs) this.settle(job, () => job.reject(new RemeshError("Cancelled", "stop() was called")));
  }

  run(request: Request, options: RunOptions): Promise<Answer> {
    return new Promise((resolve, reject) => {
      const { signal } = options;
      const onAbort = () => this.cancel(job, signal!.reason);
      const job: Job = {
        request, options, resolve, reject, release: () => signal?.removeEventListener("abort", onAbort),
      };
      signal?.addEventListener("abort", onAbort, { once: true });
      this.waiting.push(job);
      void this.next();
    });
  }

  private load(): Promise<WebAssembly.Module> {
    this.module ??= this.host.compile().catch((error: unknown) => {
      this.module = null;
      throw error;
    });
    return this.module;
  }

  private ready(): Promise<WorkerHandle> {
    if (this.starting) return this.starting;
    const starting: Promise<WorkerHandle> = this.begin(() => this.starting === starting);
    this.starting = starting;
    starting.catch(() => { if (this.starting === starting) this.starting = null; });
    return starting;
  }

  /** @param isWanted  false if it was dropped in between */
  private async begin(isWanted: () => boolean): Promise<WorkerHandle> {
    // The worker starts while the module is compiled.
    const loading = this.load(), worker = this.host.startWorker();
    worker.onMessage((message) => this.listen(worker, message));
    worker.onFailure((text) => this.fail(worker, new RemeshError("Error", text)));
    worker.hold(false);
    try {
      worker.post({ module: await loading });
    } catch (error) {
      worker.end();
      throw error;
    }
    if (isWanted()) this.worker = worker;
    return worker;
  }

  private async next(): Promise<void> {
    if (this.current || this.waiting.length === 0) return;
    const job = this.current = this.waiting.shift()!;
    try {
      const worker = await this.ready();
      if (this.current !== job) return;  // It was ended in between.
      worker.hold(true);
      worker.post({ request: withOwnBuffers(job.request) });
    } catch (error) {
      if (this.current === job) this.finish(() => job.reject(error));
    }
  }

  private listen(worker: WorkerHandle, message: Message): void {
    const job = this.current;
    if (worker !== this.worker || !job) return;
    if (message.kind === "progress") {
      this.tell(job, message.fraction, message.stage);
    } else if (message.kind === "answer") {
      if (message.memory > mostMemory) this.dropWorker();
      this.tell(job, 1, "write");
      if (this.current === job) this.finish(() => job.resolve(message.answer));
    } else if (message.kind === "error") {
      if (message.isBroken) this.dropWorker();
      this.finish(() => job.reject(new RemeshError(message.name, message.message)));
    }
  }

  private tell(job: Job, fraction: number, stage: string): void {
    try {
      if (job.options.onProgress?.(fraction, stage) !== false) return;
      this.cancel(job, new RemeshError("Cancelled", "stopped by onProgress"));
    } catch (error) {
      this.cancel(job, error);
    }
  }

  private cancel(job: Job, reason: unknown): void {
    if (this.current === job) {
      this.dropWorker();
      this.finish(() => job.reject(reason));
      // The next call finds a worker.
      if (!this.current) void this.start().catch(() => {});
      return;
    }
    const at = this.waiting.indexOf(job);
    if (at < 0) return;
    this.waiting.splice(at, 1);
    this.settle(job, () => job.reject(reason));
  }

  private fail(worker: WorkerHandle, error: RemeshError): void {
    if (worker !== this.worker) return;
    this.dropWorker();
    const job = this.current;
    if (job) this.finish(() => job.reject(error));
  }

  private dropWorker(): void {
    this.starting?.then((worker) => worker.end(), () => {});
    this.starting = null;
    this.worker = null;
  }

  private finish(settle: () => void): void {
    const job = this.current!;
    this.current = null;
    this.worker?.hold(false);
    this.settle(job, settle);
    void this.next();
  }

  private settle(job: Job, settle: () => void): void {
    job.release();
    settle();
  }
}

/** A view of a larger buffer would be sent with all of it. */
function withOwnBuffers(request: Request): Request {
  const arrays = Object.entries(request.arrays).map(([name, array]) =>
    [name, array.byteLength < array.buffer.byteLength ? array.slice() : array]);
  return { ...request, arrays: Object.fromEntries(arrays) };
}
