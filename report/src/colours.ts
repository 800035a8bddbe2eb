// Colours of fields: tables that recoil puts into the page, the same as in its pictures.

import type { Report, Variable } from "./data";
import { cssColour } from "./dom";
import type { NotedSpan, Span } from "./plot_area";

let tables: Report["colours"] | null = null;

export function useColours(colours: Report["colours"]): void {
  tables = colours;
}

/** Of curves, told apart by lightness as well; lighter where the page is dark. */
export function curveColour(which: number): string {
  const curves = tables?.curves ?? [];
  const colour = curves[which % Math.max(1, curves.length)] ?? "#0e62ae";
  return cssColour("--dark") === "1" ? `color-mix(in oklab, ${colour} 65%, white)` : colour;
}

/** 256 colours from the lowest value to the highest. */
function tableOf(name: "sequential" | "diverging"): string[] {
  const text = tables?.[name] ?? "";
  return Array.from({ length: text.length / 6 }, (_, k) => `#${text.slice(6 * k, 6 * k + 6)}`);
}

/** A colour as the canvas stores it: red in the lowest byte. */
function packed(colour: string): number {
  const rgb = parseInt(colour.slice(1), 16);
  return ((255 << 24) | ((rgb & 255) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
}

/** How the values of a field become colours. */
export interface Scale {
  range: Span;
  note: string; // behind the label: that the values are round-off only
  colours: string[]; // from below; of a field of names none
  colourOf: (value: number) => number;
}

export function scaleOf(variable: Variable, wanted: NotedSpan): Scale {
  if (variable.categories) {
    const known = new Map(variable.categories.map((c) => [c.value, packed(c.colour)]));
    return { range: wanted, note: "", colours: [], colourOf: (v) => known.get(v) ?? 0 };
  }
  const both = variable.signed && wanted.from < 0 && wanted.to > 0;
  const most = Math.max(Math.abs(wanted.from), Math.abs(wanted.to));
  let range = both ? { from: -most, to: most } : wanted;
  if (!(range.to > range.from)) range = { from: range.from - 0.5, to: range.to + 0.5 };
  const colours = tableOf(both ? "diverging" : "sequential");
  const words = Uint32Array.from(colours, packed);
  const last = words.length - 1;
  const factor = last / (range.to - range.from);
  const colourOf = (v: number) =>
    Number.isNaN(v) ? 0 : (words[Math.max(0, Math.min(last, Math.round((v - range.from) * factor)))] ?? 0);
  return { range, note: wanted.note, colours, colourOf };
}

/** Values as a picture of one pixel a value, the first row below. */
export function pictureOf(values: Float32Array, nx: number, ny: number, scale: Scale): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(1, nx);
  canvas.height = Math.max(1, ny);
  const context = canvas.getContext("2d");
  if (!context || nx * ny === 0) return canvas;
  const image = context.createImageData(nx, ny);
  const words = new Uint32Array(image.data.buffer);
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) words[(ny - 1 - j) * nx + i] = scale.colourOf(values[j * nx + i] ?? NaN);
  context.putImageData(image, 0, 0);
  return canvas;
}
