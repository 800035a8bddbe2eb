// Surfaces of bodies in space, unpacked when they are needed.

import { type SurfaceFrame, type Surfaces, integersOf } from "./data";

export type Vector = [number, number, number];

/** A closed surface; all places in mm. */
export interface Mesh {
  points: [Float32Array, Float32Array, Float32Array];
  normals: [Float32Array, Float32Array, Float32Array]; // of length 1, outwards
  faces: Int32Array; // all first points, all second ones, ...
  spacing: number;
}

export class SurfaceStore {
  private readonly meshes = new Map<number, Promise<Mesh>>();
  private readonly values = new Map<string, Promise<Float32Array>>();

  constructor(readonly surfaces: Surfaces) {}

  frame(index: number): SurfaceFrame {
    const frame = this.surfaces.frames[index];
    if (!frame) throw new Error(`there is no surface ${index}`);
    return frame;
  }

  meshOf(index: number): Promise<Mesh> {
    let found = this.meshes.get(index);
    if (!found) this.meshes.set(index, (found = this.unpack(this.frame(index))));
    return found;
  }

  /** One value for each point; NaN on rigid bodies. */
  valuesOf(index: number, name: string): Promise<Float32Array> {
    const key = `${index} ${name}`;
    let found = this.values.get(key);
    if (!found) this.values.set(key, (found = this.unpackValues(index, name)));
    return found;
  }

  private async unpackValues(index: number, name: string): Promise<Float32Array> {
    const found = this.frame(index).values[this.surfaces.fields.indexOf(name)];
    if (!found) return new Float32Array();
    const [block, lowest, step] = found;
    return Float32Array.from(await integersOf(block), (c) => (c === 0 ? NaN : lowest + (c - 1) * step));
  }

  private async unpack(frame: SurfaceFrame): Promise<Mesh> {
    const [all, faces] = await Promise.all([integersOf(frame.points), integersOf(frame.faces)]);
    const n = all.length / 3;
    const unit = frame.spacing / this.surfaces.point_parts;
    const along = (d: number) => Float32Array.from(all.subarray(d * n, (d + 1) * n), (v) => frame.corner[d]! + v * unit);
    const points: Mesh["points"] = [along(0), along(1), along(2)];
    return { points, normals: normalsOf(points, faces), faces, spacing: frame.spacing };
  }
}

/** The mean of those of the faces around a point, by their areas. */
function normalsOf(points: Mesh["points"], faces: Int32Array): Mesh["normals"] {
  const [x, y, z] = points;
  const normals: Mesh["normals"] = [new Float32Array(x.length), new Float32Array(x.length), new Float32Array(x.length)];
  const [nx, ny, nz] = normals;
  const count = faces.length / 4;
  for (let f = 0; f < count; ++f) {
    const [a, b, c, d] = [faces[f]!, faces[f + count]!, faces[f + 2 * count]!, faces[f + 3 * count]!];
    const [px, py, pz] = [x[c]! - x[a]!, y[c]! - y[a]!, z[c]! - z[a]!];
    const [qx, qy, qz] = [x[d]! - x[b]!, y[d]! - y[b]!, z[d]! - z[b]!];
    for (const n of [a, b, c, d]) {
      nx[n]! += py * qz - pz * qy;
      ny[n]! += pz * qx - px * qz;
      nz[n]! += px * qy - py * qx;
    }
  }
  for (let n = 0; n < x.length; ++n) {
    const length = Math.hypot(nx[n]!, ny[n]!, nz[n]!) || 1;
    nx[n]! /= length;
    ny[n]! /= length;
    nz[n]! /= length;
  }
  return normals;
}
