// Errors of a call. Their texts are those of the program, with the names of this package's options.

/** What kind of error it is: the `name` of a RemeshError. */
export type ErrorName =
  /** An option is out of its range, or an argument has the wrong type. */
  | "InvalidOption"
  /** The mesh cannot be used: not finite, not orientable, no face left, ... */
  | "InvalidInput"
  /** Given sites cannot be used on this mesh. */
  | "InvalidSites"
  /** What was asked for cannot be had on this input; nothing was made. */
  | "ConstraintUnmet"
  /** The bytes are no file of the format, or the format cannot hold the mesh. */
  | "FileError"
  /** More memory than the module or the system has. */
  | "OutOfMemory"
  /** `onProgress` returned false. */
  | "Cancelled"
  /** A fault of this package, or of the engine that runs it. */
  | "Error";

export class RemeshError extends Error {
  constructor(name: ErrorName, message: string) {
    super(message);
    this.name = name;
  }
}

export function refuse(message: string): never {
  throw new RemeshError("InvalidOption", message);
}
