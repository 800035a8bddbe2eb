// A rectangle of a canvas with axes: places on it, frame, ticks, colour bar.

import { cssColour } from "./dom";
import { atStep, ticks } from "./numbers";

export interface Span {
  from: number;
  to: number;
}

/** With what is to be said of it behind the label. */
export interface NotedSpan extends Span {
  note: string;
}

/** Where data lies on the canvas, in CSS pixels. */
export class PlotArea {
  constructor(
    readonly left: number,
    readonly top: number,
    readonly width: number,
    readonly height: number,
    readonly x: Span,
    readonly y: Span,
  ) {}

  px(x: number): number {
    return this.left + ((x - this.x.from) / (this.x.to - this.x.from)) * this.width;
  }
  py(y: number): number {
    return this.top + (1 - (y - this.y.from) / (this.y.to - this.y.from)) * this.height;
  }
  dataX(px: number): number {
    return this.x.from + ((px - this.left) / this.width) * (this.x.to - this.x.from);
  }
  dataY(py: number): number {
    return this.y.from + (1 - (py - this.top) / this.height) * (this.y.to - this.y.from);
  }
  holds(px: number, py: number): boolean {
    return px >= this.left && px <= this.left + this.width && py >= this.top && py <= this.top + this.height;
  }
  clip(context: CanvasRenderingContext2D): void {
    context.beginPath();
    context.rect(this.left, this.top, this.width, this.height);
    context.clip();
  }
}

export const FONT = "12px system-ui, sans-serif";

/** Makes a canvas as large as its place on the page wants it, sharp on fine screens. */
export function prepared(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D {
  const scale = window.devicePixelRatio || 1;
  const columns = Math.round(width * scale);
  const rows = Math.round(height * scale);
  if (canvas.width !== columns || canvas.height !== rows) {
    canvas.width = columns;
    canvas.height = rows;
    canvas.style.height = `${height}px`;
  }
  const context = canvas.getContext("2d");
  if (!context) throw new Error("this browser draws no canvas");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = FONT;
  return context;
}

export function drawAxes(context: CanvasRenderingContext2D, area: PlotArea, titles: [string, string]): void {
  const ink = cssColour("--ink-2");
  context.save();
  context.strokeStyle = cssColour("--line");
  context.fillStyle = ink;
  context.lineWidth = 1;
  context.strokeRect(area.left + 0.5, area.top + 0.5, area.width - 1, area.height - 1);
  const xs = ticks(area.x.from, area.x.to, area.width / 80);
  const ys = ticks(area.y.from, area.y.to, area.height / 50);
  const bottom = area.top + area.height;
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const x of xs.values) {
    context.fillRect(area.px(x), bottom, 1, 4);
    context.fillText(atStep(x, xs.step), area.px(x), bottom + 6);
  }
  context.fillText(titles[0], area.left + area.width / 2, bottom + 21);
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const y of ys.values) {
    context.fillRect(area.left - 4, area.py(y), 4, 1);
    context.fillText(atStep(y, ys.step), area.left - 7, area.py(y));
  }
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillText(titles[1], Math.max(0, area.left - 40), area.top - 5);
  context.restore();
}

/** A bar of the colours with the values of its ticks. */
export function drawColourBar(
  context: CanvasRenderingContext2D,
  place: { left: number; top: number; height: number },
  colours: string[],
  range: Span,
  title: string,
): void {
  const width = 14;
  context.save();
  const step = place.height / colours.length;
  colours.forEach((colour, k) => {
    context.fillStyle = colour;
    context.fillRect(place.left, place.top + place.height - (k + 1) * step, width, step + 0.6);
  });
  context.fillStyle = cssColour("--ink-2");
  context.textBaseline = "middle";
  const marks = ticks(range.from, range.to, place.height / 45);
  const bar = new PlotArea(place.left, place.top, width, place.height, { from: 0, to: 1 }, range);
  for (const v of marks.values) {
    context.fillRect(place.left + width, bar.py(v), 4, 1);
    context.fillText(atStep(v, marks.step), place.left + width + 7, bar.py(v));
  }
  context.textBaseline = "bottom";
  context.textAlign = "right";
  context.fillText(title, place.left + 62, place.top - 5);
  context.restore();
}

/** The names of a field that has only a few values, with their colours. */
export function drawCategories(
  context: CanvasRenderingContext2D,
  place: { left: number; top: number },
  categories: { name: string; colour: string }[],
): void {
  context.save();
  context.textBaseline = "middle";
  categories.forEach((c, k) => {
    const y = place.top + 8 + 20 * k;
    context.fillStyle = c.colour;
    context.fillRect(place.left, y - 6, 12, 12);
    context.fillStyle = cssColour("--ink-2");
    context.fillText(c.name, place.left + 18, y);
  });
  context.restore();
}
