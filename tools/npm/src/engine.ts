// Runs the WebAssembly module: requests into its memory, answers out of it. module/module.cpp is the
// other side.
import { ErrorName, RemeshError } from "./errors.js";

export type NumberArray =
  | Float64Array | Float32Array | Int32Array | Uint32Array | Int16Array | Uint16Array | Int8Array | Uint8Array;

/** A call: its name, what goes as JSON, and arrays. Can be sent to a worker. */
export interface Request {
  call: "remesh" | "voronoi" | "distances" | "creases" | "read" | "write";
  options: Record<string, unknown>;
  mesh?: Record<string, unknown>;
  arrays: Record<string, NumberArray>;
}

/** What a call returns: JSON, and arrays of its own. */
export interface Answer {
  json: Record<string, any>;
  arrays: Record<string, NumberArray>;
}

/** Gets the finished fraction of the whole call and the stage; false ends the call. */
export type Tell = (fraction: number, stage: string) => boolean;

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  allocate(size: number): number;
  release(at: number): void;
  call(text: number, length: number): number;
  answer(): number;
  forget(): void;
}

const arrayTypes = { Float64Array, Uint32Array, Int32Array, Uint8Array };

// Errors of the system calls that remain: there are no files, and no environment.
const noSuchFile = -44, notSupported = 52;

export class Engine {
  private readonly exports: Exports;
  private tell: Tell = () => true;

  constructor(module: WebAssembly.Module) {
    const instance = new WebAssembly.Instance(module, this.imports());
    this.exports = instance.exports as unknown as Exports;
    this.exports._initialize();
  }

  /** Bytes of the module's memory, which never shrinks. */
  get memory(): number { return this.exports.memory.buffer.byteLength; }

  /** @throws RemeshError */
  call(request: Request, tell: Tell): Answer {
    const used: number[] = [];
    this.tell = tell;
    try {
      const arrays: Record<string, { at: number; count: number }> = {};
      for (const [name, array] of Object.entries(request.arrays)) {
        arrays[name] = { at: this.place(array, used), count: array.length };
      }
      const text = new TextEncoder().encode(JSON.stringify({ ...request, arrays }));
      const length = this.exports.call(this.place(text, used), text.length);
      return this.read(length);
    } finally {
      for (const at of used) this.exports.release(at);
    }
  }

  private place(array: NumberArray, used: number[]): number {
    // Empty arrays have a place, too.
    const at = this.exports.allocate(array.byteLength + 8) >>> 0;
    if (at === 0) {
      throw new RemeshError("OutOfMemory", `there is no memory for an array of ${array.byteLength} bytes; ` +
        "use a coarser input");
    }
    used.push(at);
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    new Uint8Array(this.exports.memory.buffer, at, array.byteLength).set(bytes);
    return at;
  }

  private read(length: number): Answer {
    try {
      const { buffer } = this.exports.memory;
      const text = new TextDecoder().decode(new Uint8Array(buffer, this.exports.answer() >>> 0, length >>> 0));
      const { arrays: described, error, ...json } = JSON.parse(text);
      if (error) throw new RemeshError(error.name as ErrorName, error.message);
      const arrays: Record<string, NumberArray> = {};
      for (const [name, { type, at, count }] of Object.entries<any>(described)) {
        const ArrayType = arrayTypes[type as keyof typeof arrayTypes];
        arrays[name] = new ArrayType(buffer, count === 0 ? 0 : at, count).slice();
      }
      return { json, arrays };
    } finally {
      this.exports.forget();
    }
  }

  private imports(): WebAssembly.Imports {
    const bytes = () => new Uint8Array(this.exports.memory.buffer);
    const view = () => new DataView(this.exports.memory.buffer);
    const none = () => noSuchFile;
    return {
      env: {
        progress: (at: number, length: number, fraction: number) => {
          const stage = new TextDecoder().decode(bytes().subarray(at >>> 0, (at >>> 0) + length));
          return this.tell(fraction, stage) ? 1 : 0;
        },
        shortest_digits: (value: number, isFloat: number, at: number) => {
          const { digits, power } = shortestDigits(value, isFloat !== 0);
          for (let i = 0; i < digits.length; ++i) bytes()[(at >>> 0) + i] = digits.charCodeAt(i);
          return power * 32 + digits.length;
        },
        emscripten_notify_memory_growth: () => {},
        __syscall_fstat64: none, __syscall_stat64: none, __syscall_fstatat64: none, __syscall_lstat64: none,
        __syscall_poll: none,
      },
      wasi_snapshot_preview1: {
        clock_time_get: (_clock: number, _precision: bigint, at: number) => {
          view().setBigUint64(at >>> 0, BigInt(Math.round(performance.now() * 1e6)), true);
          return 0;
        },
        proc_exit: (code: number) => { throw new RemeshError("Error", `the module ended with code ${code}`); },
        environ_sizes_get: (count: number, size: number) => {
          view().setUint32(count >>> 0, 0, true);
          view().setUint32(size >>> 0, 0, true);
          return 0;
        },
        environ_get: () => 0,
        fd_close: () => notSupported, fd_fdstat_get: () => notSupported, fd_read: () => notSupported,
        fd_write: () => notSupported, fd_seek: () => notSupported,
      },
    };
  }
}

/**
 * The fewest digits that read back as the number, and the power of ten of the first one.
 * @param value  above 0
 */
export function shortestDigits(value: number, isFloat: boolean): { digits: string; power: number } {
  let text = value.toExponential();
  for (let precision = 0; isFloat && precision < 9; ++precision) {
    text = value.toExponential(precision);
    if (Math.fround(Number(text)) === value) break;
  }
  const [mantissa, power] = text.split("e");
  return { digits: mantissa.replace(".", "").replace(/0+$/, "") || "0", power: Number(power) };
}
