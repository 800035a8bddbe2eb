// Fields of a run, unpacked when they are needed and kept while there is room.

import { type Block, type Fields, type Frame, type Variable, integersOf } from "./data";

export interface Outline {
  body: number;
  closed: boolean;
  x: Float32Array; // mm
  y: Float32Array;
}

/** The frames that have cells: of a plane that no body crosses any more none has. All of them, where none has. */
export function withCells(frames: Frame[]): Frame[] {
  const some = frames.filter((frame) => frame.nx * frame.ny > 0);
  return some.length > 0 ? some : frames;
}

/** How many values are kept: 64 MB of single precision. */
const ROOM = 16e6;

export class FieldStore {
  private readonly kept = new Map<string, Promise<Float32Array>>();
  private readonly outlines = new Map<string, Promise<Outline[]>>();
  private values = 0;

  constructor(readonly fields: Fields) {}

  frame(plane: number, index: number): Frame {
    const frame = this.fields.planes[plane]?.frames[index];
    if (!frame) throw new Error(`there is no frame ${index}`);
    return frame;
  }

  frames(plane: number): Frame[] {
    return this.fields.planes[plane]?.frames ?? [];
  }

  variable(name: string): Variable {
    const found = this.fields.variables.find((v) => v.name === name);
    if (!found) throw new Error(`there is no field ${name}`);
    return found;
  }

  /** One value per cell, rows from below; NaN where there is no matter. */
  valuesOf(plane: number, index: number, name: string): Promise<Float32Array> {
    const key = `${plane} ${index} ${name}`;
    let found = this.kept.get(key);
    if (!found) {
      found = this.unpack(plane, index, name);
      this.kept.set(key, found);
      this.values += this.frame(plane, index).nx * this.frame(plane, index).ny;
      if (this.values > ROOM) this.forgetOldest(key);
    }
    return found;
  }

  private forgetOldest(newest: string): void {
    for (const key of [...this.kept.keys()]) {
      if (key === newest || this.values < ROOM / 2) break;
      const [plane, index] = key.split(" ").map(Number);
      const frame = this.frame(plane ?? 0, index ?? 0);
      this.values -= frame.nx * frame.ny;
      this.kept.delete(key);
    }
  }

  private async unpack(plane: number, index: number, name: string): Promise<Float32Array> {
    const parts = this.variable(name).parts;
    if (parts) return magnitude(await Promise.all(parts.map((p) => this.valuesOf(plane, index, p))));
    const at = this.fields.variables.filter((v) => !v.parts).findIndex((v) => v.name === name);
    const [block, lowest, step] = this.frame(plane, index).values[at] ?? [[0, 0] as Block, 0, 0];
    const codes = await integersOf(block);
    return Float32Array.from(codes, (c) => (c === 0 ? NaN : lowest + (c - 1) * step));
  }

  /** Between neighbouring values as they are stored; of a magnitude that of its coarsest part. */
  stepOf(plane: number, index: number, name: string): number {
    const parts = this.variable(name).parts;
    if (parts) return Math.max(...parts.map((p) => this.stepOf(plane, index, p)));
    const at = this.fields.variables.filter((v) => !v.parts).findIndex((v) => v.name === name);
    return this.frame(plane, index).values[at]?.[2] ?? 0;
  }

  outlinesOf(plane: number, index: number): Promise<Outline[]> {
    const key = `${plane} ${index}`;
    let found = this.outlines.get(key);
    if (!found) this.outlines.set(key, (found = this.unpackOutlines(this.frame(plane, index))));
    return found;
  }

  private async unpackOutlines(frame: Frame): Promise<Outline[]> {
    const all = await integersOf(frame.outlines);
    const parts = this.fields.outline_parts;
    const curves: Outline[] = [];
    for (let at = 0; at + 2 < all.length; ) {
      const n = all[at + 2] ?? 0;
      const begin = at + 3;
      curves.push({
        body: all[at] ?? 0,
        closed: all[at + 1] === 1,
        x: Float32Array.from(all.subarray(begin, begin + n), (v) => frame.x + (v / parts) * frame.dx),
        y: Float32Array.from(all.subarray(begin + n, begin + 2 * n), (v) => frame.y + (v / parts) * frame.dy),
      });
      at = begin + 2 * n;
    }
    return curves;
  }
}

function magnitude(parts: Float32Array[]): Float32Array {
  const sum = new Float32Array(parts[0]?.length ?? 0);
  for (const part of parts) for (let k = 0; k < sum.length; ++k) sum[k]! += part[k]! * part[k]!;
  return sum.map(Math.sqrt);
}
