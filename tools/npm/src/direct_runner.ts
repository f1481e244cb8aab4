// Runs calls on the thread of the caller, which they block.
import { RunOptions, Runner } from "./api.js";
import { Answer, Engine, Request } from "./engine.js";
import { RemeshError } from "./errors.js";
import { describe } from "./worker_loop.js";

export class DirectRunner implements Runner {
  private engine: Engine | null = null;

  constructor(private readonly compile: () => Promise<WebAssembly.Module>) {}

  async start(): Promise<void> {
    this.engine ??= new Engine(await this.compile());
  }

  stop(): void { this.engine = null; }

  async run(request: Request, { onProgress, signal }: RunOptions): Promise<Answer> {
    await this.start();
    signal?.throwIfAborted();
    let failure: { error: unknown } | null = null;
    try {
      const answer = this.engine!.call(request, (fraction, stage) => {
        try {
          return onProgress?.(fraction, stage) !== false && !signal?.aborted;
        } catch (error) {
          failure = { error };
          return false;
        }
      });
      onProgress?.(1, "write");
      return answer;
    } catch (error) {
      if (failure) throw (failure as { error: unknown }).error;
      signal?.throwIfAborted();
      if (error instanceof RemeshError) throw error;
      this.engine = null;
      throw new RemeshError("Error", describe(error));
    }
  }
}
