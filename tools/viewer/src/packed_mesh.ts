// Reads what tools/page/packed_mesh.cpp writes; the format is explained in packed_mesh.h.

/** Positions are those of the file within 3.4e-6 of the diagonal. */
export interface TriangleMesh {
  /** Three for each vertex. */
  positions: Float32Array;
  /** Three for each face. */
  corners: Uint32Array;
}

export interface PackedMesh {
  vertices: number;
  faces: number;
  step: number;
  codes: Uint8Array;
  corners: Uint8Array;
  offsets: Uint8Array;
}

const none = 0xffffffff;
enum Code { None, New, Next, Before, Other, Alone }

/** Reads numbers of seven bits to a byte. */
export class NumberReader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  get isAtEnd(): boolean { return this.at >= this.bytes.length; }

  next(): number {
    let number = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.bytes[this.at++];
      number += (byte & 127) * scale;
      if (byte < 128) return number;
    }
  }

  nextSigned(): number { return signed(this.next()); }
}

function signed(zigzag: number): number {
  return zigzag % 2 === 0 ? zigzag / 2 : -(zigzag + 1) / 2;
}

/** @param shift  where the grid begins. */
export function unpackMesh(packed: PackedMesh, shift: readonly number[]): TriangleMesh {
  return new Unpacker(packed).unpack(shift);
}

class Unpacker {
  private readonly grid: Int32Array;
  private readonly corners: Uint32Array;
  private readonly reader: NumberReader;
  private numVertices = 0;
  private numFaces = 0;
  // Of gates: start, end, the corner beyond, whether it is open.
  private readonly from: Uint32Array;
  private readonly to: Uint32Array;
  private readonly opposite: Uint32Array;
  private readonly isOpen: Uint8Array;
  private numGates = 0;
  // By vertex: the last gate that starts, that ends there.
  private readonly starting: Uint32Array;
  private readonly ending: Uint32Array;

  constructor(private readonly packed: PackedMesh) {
    const { vertices, faces } = packed;
    this.grid = new Int32Array(3 * vertices);
    this.corners = new Uint32Array(3 * faces);
    this.reader = new NumberReader(packed.corners);
    this.from = new Uint32Array(3 * faces);
    this.to = new Uint32Array(3 * faces);
    this.opposite = new Uint32Array(3 * faces);
    this.isOpen = new Uint8Array(3 * faces);
    this.starting = new Uint32Array(vertices).fill(none);
    this.ending = new Uint32Array(vertices).fill(none);
  }

  unpack(shift: readonly number[]): TriangleMesh {
    const { codes, step } = this.packed;
    let gate = 0;
    for (let i = 0; i < codes.length; ++i) {
      if (codes[i] === Code.Alone) {
        this.placeAlone();
        continue;
      }
      while (this.isOpen[gate] === 0) ++gate;
      this.isOpen[gate] = 0;
      if (codes[i] !== Code.None) this.placeAcross(gate, codes[i]);
      ++gate;
    }
    const positions = new Float32Array(this.grid.length);
    for (let i = 0; i < positions.length; ++i) {
      positions[i] = this.grid[i] * step + shift[i % 3];
    }
    return { positions, corners: this.corners };
  }

  private addVertex(x: number, y: number, z: number): number {
    const vertex = this.numVertices++;
    this.grid[3 * vertex] = x + this.offset(vertex, 0);
    this.grid[3 * vertex + 1] = y + this.offset(vertex, 1);
    this.grid[3 * vertex + 2] = z + this.offset(vertex, 2);
    return vertex;
  }

  private offset(vertex: number, axis: number): number {
    const { offsets, vertices } = this.packed;
    const at = axis * vertices + vertex, plane = 3 * vertices;
    return signed(offsets[at] | offsets[at + plane] << 8 | offsets[at + 2 * plane] << 16);
  }

  private namedCorner(): number {
    const back = this.reader.next();
    if (back > 0) return this.numVertices - back;
    const last = 3 * (this.numVertices - 1);
    return last < 0 ? this.addVertex(0, 0, 0)
                    : this.addVertex(this.grid[last], this.grid[last + 1], this.grid[last + 2]);
  }

  private open(a: number, b: number, opposite: number): void {
    const gate = this.numGates++;
    this.from[gate] = a;
    this.to[gate] = b;
    this.opposite[gate] = opposite;
    this.isOpen[gate] = 1;
    this.starting[a] = gate;
    this.ending[b] = gate;
  }

  private close(gate: number, a: number, b: number): boolean {
    if (gate === none || this.isOpen[gate] === 0) return false;
    if (this.from[gate] !== a || this.to[gate] !== b) return false;
    this.isOpen[gate] = 0;
    return true;
  }

  private place(a: number, b: number, c: number): void {
    const at = 3 * this.numFaces++;
    this.corners[at] = a;
    this.corners[at + 1] = b;
    this.corners[at + 2] = c;
  }

  private placeAlone(): void {
    const a = this.namedCorner(), b = this.namedCorner(), c = this.namedCorner();
    this.place(a, b, c);
    this.open(b, a, c);
    this.open(c, b, a);
    this.open(a, c, b);
  }

  private placeAcross(gate: number, code: Code): void {
    const a = this.from[gate], b = this.to[gate];
    const x = this.thirdCorner(code, a, b, this.opposite[gate]);
    this.place(a, b, x);
    if (!this.close(this.starting[b], b, x)) this.open(x, b, a);
    if (!this.close(this.ending[a], x, a)) this.open(a, x, b);
  }

  private thirdCorner(code: Code, a: number, b: number, o: number): number {
    if (code === Code.Next) return this.to[this.starting[b]];
    if (code === Code.Before) return this.from[this.ending[a]];
    if (code === Code.Other) return this.namedCorner();
    const g = this.grid;
    return this.addVertex(g[3 * a] + g[3 * b] - g[3 * o],
                          g[3 * a + 1] + g[3 * b + 1] - g[3 * o + 1],
                          g[3 * a + 2] + g[3 * b + 2] - g[3 * o + 2]);
  }
}
