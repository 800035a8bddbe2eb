// One frame of a field on a canvas: in the plane as colours with outlines and contact, in 1d as a curve.

import { type Scale, curveColour, pictureOf } from "./colours";
import type { Frame, Variable } from "./data";
import { cssColour } from "./dom";
import type { Outline } from "./field_store";
import { type PixelLine, type PlacedName, placedNames } from "./name_places";
import { PlotArea, type Span, drawAxes, drawCategories, drawColourBar } from "./plot_area";

/** Everything that a picture shows. */
export interface FieldScene {
  frame: Frame;
  values: Float32Array;
  contact: Float32Array | null; // states of contact, one per cell
  outlines: Outline[];
  bodies: string[]; // names
  variable: Variable;
  scale: Scale;
  axes: string[];
  mirror: boolean;
  probe: { x: number; y: number } | null;
}

export const CONTACT_COLOURS = ["", "#1e8c54", "#e89214", "#d44034"];
export const CONTACT_NAMES = ["", "touching", "slipping", "opened"];

/** The cell that holds a place, or -1. */
export function cellAt(frame: Frame, x: number, y: number): number {
  const i = Math.floor((x - frame.x) / frame.dx);
  const j = frame.ny === 1 ? 0 : Math.floor((y - frame.y) / frame.dy);
  return i >= 0 && i < frame.nx && j >= 0 && j < frame.ny ? j * frame.nx + i : -1;
}

function drawImage(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): void {
  const { frame } = scene;
  const picture = pictureOf(scene.values, frame.nx, frame.ny, scene.scale);
  const width = frame.nx * frame.dx;
  const top = area.py(frame.y + frame.ny * frame.dy);
  const height = area.py(frame.y) - top;
  const pixels = area.px(frame.x + width) - area.px(frame.x);
  context.imageSmoothingEnabled = false;
  context.drawImage(picture, area.px(frame.x), top, pixels, height);
  if (!scene.mirror) return;
  context.save();
  context.translate(area.px(0), 0);
  context.scale(-1, 1);
  context.drawImage(picture, area.px(frame.x) - area.px(0), top, pixels, height);
  context.restore();
}

function drawOutlines(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): void {
  context.lineJoin = "round";
  const strokes: [string, number][] = [
    [cssColour("--card"), 3], // around the line, so that it shows on dark and on light values
    [cssColour("--ink"), 1.2],
  ];
  for (const sign of scene.mirror ? [1, -1] : [1])
    for (const line of scene.outlines) {
      context.beginPath();
      for (let k = 0; k < line.x.length; ++k)
        context.lineTo(area.px(sign * (line.x[k] ?? 0)), area.py(line.y[k] ?? 0));
      if (line.closed) context.closePath();
      for (const [colour, width] of strokes) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke();
      }
    }
}

/** The outlines of a body in pixels, on both sides of the axis where the picture is mirrored. */
function pixelLines(area: PlotArea, scene: FieldScene, body: number): PixelLine[] {
  const own = scene.outlines.filter((o) => o.body === body);
  return (scene.mirror ? [1, -1] : [1]).flatMap((sign) =>
    own.map((o) => ({
      closed: o.closed,
      x: Array.from(o.x, (x) => area.px(sign * x)),
      y: Array.from(o.y, (y) => area.py(y)),
    })),
  );
}

/** The names of the bodies, inside of each; a line leads to the body from a name that had no room there. */
function drawNames(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): PlacedName[] {
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 3;
  context.strokeStyle = cssColour("--card");
  context.fillStyle = cssColour("--ink");
  const named = scene.bodies.map((name, body) => ({
    name,
    width: context.measureText(name).width,
    height: 15,
    lines: pixelLines(area, scene, body),
  }));
  const placed = placedNames(named, area);
  for (const { name, x, y, inside } of placed) {
    if (inside[0] !== x || inside[1] !== y) drawLeader(context, [x, y], inside);
    context.strokeText(name, x, y);
    context.fillText(name, x, y);
  }
  return placed;
}

function drawLeader(context: CanvasRenderingContext2D, from: [number, number], to: [number, number]): void {
  context.save();
  context.strokeStyle = context.fillStyle;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  context.restore();
}

/** A mark on every cell whose surface touches, slips or has opened. */
function drawContact(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): void {
  const { contact, frame } = scene;
  if (!contact) return;
  const size = Math.max(2.5, Math.min(6, Math.abs(area.px(frame.dx) - area.px(0)) * 0.6));
  for (let cell = 0; cell < contact.length; ++cell) {
    const colour = CONTACT_COLOURS[contact[cell] ?? 0];
    if (!colour) continue;
    const x = frame.x + ((cell % frame.nx) + 0.5) * frame.dx;
    const y = frame.y + (Math.floor(cell / frame.nx) + 0.5) * frame.dy;
    context.fillStyle = colour;
    for (const sign of scene.mirror ? [1, -1] : [1])
      context.fillRect(area.px(sign * x) - size / 2, area.py(y) - size / 2, size, size);
  }
}

function drawProbe(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): void {
  if (!scene.probe) return;
  const x = area.px(scene.probe.x);
  context.strokeStyle = cssColour("--accent");
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x, area.top);
  context.lineTo(x, area.top + area.height);
  if (scene.frame.ny > 1) {
    context.moveTo(area.left, area.py(scene.probe.y));
    context.lineTo(area.left + area.width, area.py(scene.probe.y));
  }
  context.setLineDash([3, 3]);
  context.stroke();
  context.setLineDash([]);
}

function drawCurve(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): void {
  const { frame, values } = scene;
  for (const line of scene.outlines) {
    const x = area.px(line.x[0] ?? 0);
    context.fillStyle = curveColour(line.body);
    context.globalAlpha = 0.55;
    context.fillRect(x - 0.75, area.top, 1.5, area.height);
    context.globalAlpha = 1;
  }
  context.strokeStyle = cssColour("--ink");
  context.lineWidth = 1.6;
  context.beginPath();
  let drawing = false;
  for (let i = 0; i < frame.nx; ++i) {
    const v = values[i] ?? NaN;
    if (Number.isNaN(v)) {
      drawing = false;
      continue;
    }
    const x = area.px(frame.x + (i + 0.5) * frame.dx);
    if (drawing) context.lineTo(x, area.py(v));
    else context.moveTo(x, area.py(v));
    drawing = true;
  }
  context.stroke();
  if (area.y.from < 0 && area.y.to > 0) {
    context.fillStyle = cssColour("--line");
    context.fillRect(area.left, area.py(0), area.width, 1);
  }
}

/** Draws a scene. Returns where the names of bodies stand. */
export function drawField(context: CanvasRenderingContext2D, area: PlotArea, scene: FieldScene): PlacedName[] {
  const line = scene.frame.ny === 1;
  let names: PlacedName[] = [];
  context.save();
  area.clip(context);
  if (line) {
    drawCurve(context, area, scene);
  } else {
    drawImage(context, area, scene);
    drawOutlines(context, area, scene);
    drawContact(context, area, scene);
    names = drawNames(context, area, scene);
  }
  drawProbe(context, area, scene);
  context.restore();
  const [x, y] = scene.axes;
  drawAxes(context, area, [`${x ?? "x"} [mm]`, line ? scene.variable.label + scene.scale.note : `${y ?? "y"} [mm]`]);
  if (!line) drawKey(context, area, scene.variable, scene.scale);
  return names;
}

/** The meaning of the colours, to the right of the area. */
export function drawKey(
  context: CanvasRenderingContext2D,
  area: PlotArea,
  variable: Variable,
  scale: Scale,
): void {
  const left = area.left + area.width + 14;
  if (variable.categories) drawCategories(context, { left, top: area.top }, variable.categories);
  else
    drawColourBar(context, { left, top: area.top, height: area.height }, scale.colours, scale.range, variable.label + scale.note);
}

/** Round limits a little beyond a range, for the axis of a curve. */
export function roomy(range: Span): Span {
  const margin = 0.04 * (range.to - range.from || 1);
  return { from: range.from - margin, to: range.to + margin };
}

/** Room around the area: for labels and titles, and on the right for the colour bar. */
const MARGIN = { left: 56, top: 26, right: 100, bottom: 42 };
const LEAST_WIDTH = 220; // of the area, for the titles above it

/** The area for a curve over x, on a canvas of some width. */
export function curveArea(width: number, x: Span, range: Span): { area: PlotArea; height: number } {
  const { left, top, bottom } = MARGIN;
  const height = 330;
  return { area: new PlotArea(left, top, width - left - 16, height - top - bottom, x, roomy(range)), height };
}

/** The area for a plane at equal scales, at most so high; what is narrow has void on both sides. */
export function planeArea(width: number, most: number, x: Span, y: Span): { area: PlotArea; height: number } {
  const { left, top, right, bottom } = MARGIN;
  const room = width - left - right;
  const perMm = Math.min(room / (x.to - x.from), most / (y.to - y.from));
  const beside = Math.max(0, Math.min(LEAST_WIDTH, room) / perMm - (x.to - x.from)) / 2;
  const shown = { from: x.from - beside, to: x.to + beside };
  const area = new PlotArea(left, top, perMm * (shown.to - shown.from), perMm * (y.to - y.from), shown, y);
  return { area, height: Math.max(area.height, 110) + top + bottom };
}
