// Bodies in space as pixels: triangles behind a buffer of depths, in parallel projection. No WebGL: it is not there
// in every browser, and draws otherwise in each.

import type { Scale } from "./colours";
import type { Mesh, Vector } from "./surface_store";

/** From where bodies are looked at: z points up. */
export interface Look {
  right: Vector;
  up: Vector;
  toward: Vector; // the viewer
}

/** From a direction [degrees]: azimuth from x to y, elevation above the plane of x and y. */
export function lookFrom(azimuth: number, elevation: number): Look {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return {
    right: [-Math.sin(a), Math.cos(a), 0],
    up: [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
    toward: [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)],
  };
}

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export interface Screen {
  width: number; // pixels
  height: number;
  perMm: number;
  centre: Vector; // mm, in the middle of the screen
}

const GREY = 0xffa8a29a; // matter without a value: rigid bodies
const LIGHT: Vector = [-0.42, 0.56, 0.71]; // along right, up and toward, of length 1

/** What is nearest in each pixel. */
class Pixels {
  readonly depth: Float32Array; // mm towards the viewer; -Infinity: nothing
  readonly value: Float32Array;
  readonly light: Float32Array;

  constructor(readonly width: number, readonly height: number) {
    this.depth = new Float32Array(width * height).fill(-Infinity);
    this.value = new Float32Array(width * height);
    this.light = new Float32Array(width * height);
  }
}

/** Points as the screen has them. */
interface Seen {
  x: Float32Array; // pixels
  y: Float32Array;
  depth: Float32Array;
  light: Float32Array;
  values: Float32Array;
}

function seenOf(mesh: Mesh, values: Float32Array, look: Look, screen: Screen): Seen {
  const [px, py, pz] = mesh.points;
  const [nx, ny, nz] = mesh.normals;
  const n = px.length;
  const [x, y, depth, light] = [0, 1, 2, 3].map(() => new Float32Array(n)) as [
    Float32Array, Float32Array, Float32Array, Float32Array,
  ]; // prettier-ignore
  for (let k = 0; k < n; ++k) {
    const from: Vector = [px[k]! - screen.centre[0], py[k]! - screen.centre[1], pz[k]! - screen.centre[2]];
    const normal: Vector = [nx[k]!, ny[k]!, nz[k]!];
    x[k] = screen.width / 2 + screen.perMm * dot(from, look.right);
    y[k] = screen.height / 2 - screen.perMm * dot(from, look.up);
    depth[k] = dot(from, look.toward);
    const facing: Vector = [dot(normal, look.right), dot(normal, look.up), dot(normal, look.toward)];
    light[k] = 0.42 + 0.58 * Math.max(0, dot(facing, LIGHT));
  }
  return { x, y, depth, light, values };
}

function fill(pixels: Pixels, s: Seen, a: number, b: number, c: number): void {
  const [ax, ay, bx, by, cx, cy] = [s.x[a]!, s.y[a]!, s.x[b]!, s.y[b]!, s.x[c]!, s.y[c]!];
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (area >= 0) return; // rows go down: faces that look towards the viewer are clockwise
  const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
  const right = Math.min(pixels.width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
  const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
  const bottom = Math.min(pixels.height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
  for (let j = top; j <= bottom; ++j)
    for (let i = left; i <= right; ++i) {
      const [x, y] = [i + 0.5, j + 0.5];
      const wa = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area;
      const wb = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area;
      const wc = 1 - wa - wb;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const depth = wa * s.depth[a]! + wb * s.depth[b]! + wc * s.depth[c]!;
      const at = j * pixels.width + i;
      if (depth <= pixels.depth[at]!) continue;
      pixels.depth[at] = depth;
      pixels.value[at] = wa * s.values[a]! + wb * s.values[b]! + wc * s.values[c]!;
      pixels.light[at] = wa * s.light[a]! + wb * s.light[b]! + wc * s.light[c]!;
    }
}

function dimmed(colour: number, light: number): number {
  const part = (shift: number) => Math.min(255, Math.round(((colour >>> shift) & 255) * light)) << shift;
  return ((255 << 24) | part(16) | part(8) | part(0)) >>> 0;
}

/** Where the surface ends or jumps by more than `jump` to the right or below. */
function atEdge(pixels: Pixels, at: number, jump: number): boolean {
  const own = pixels.depth[at]!;
  const far = (other: number) => Math.abs(own - (pixels.depth[other] ?? own)) > jump;
  return far(at + 1) || far(at + pixels.width) || far(at - 1);
}

/** Draws a surface; nothing where there is none. */
export function drawSolid(mesh: Mesh, values: Float32Array, look: Look, screen: Screen, scale: Scale): ImageData {
  const pixels = new Pixels(screen.width, screen.height);
  const seen = seenOf(mesh, values, look, screen);
  const count = mesh.faces.length / 4;
  for (let f = 0; f < count; ++f) {
    const a = mesh.faces[f]!;
    const c = mesh.faces[f + 2 * count]!;
    fill(pixels, seen, a, mesh.faces[f + count]!, c);
    fill(pixels, seen, a, c, mesh.faces[f + 3 * count]!);
  }
  const image = new ImageData(screen.width, screen.height);
  const words = new Uint32Array(image.data.buffer);
  for (let at = 0; at < words.length; ++at) {
    if (pixels.depth[at] === -Infinity) continue;
    const value = pixels.value[at]!;
    const light = pixels.light[at]! * (atEdge(pixels, at, 3 * mesh.spacing) ? 0.45 : 1.12);
    words[at] = dimmed(Number.isNaN(value) ? GREY : scale.colourOf(value), light);
  }
  return image;
}
