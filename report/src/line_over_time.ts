// A field along a line over time: the x-t diagram.

import { type Scale, pictureOf } from "./colours";
import type { Variable } from "./data";
import { cssColour } from "./dom";
import { drawKey } from "./field_picture";
import { type FieldStore, withCells } from "./field_store";
import { PlotArea, drawAxes } from "./plot_area";

export interface LineOverTime {
  axis: string;
  where: string; // the place of the line across, for people
  from: number; // mm
  step: number;
  count: number;
  times: number[]; // us
  values: Float32Array; // count for every time
  surfaces: { x: number; t: number }[]; // where bodies end
}

/** Reads a line of every frame. @param along 0: horizontal through y = place, 1: vertical through x = place. */
export async function lineOverTime(
  store: FieldStore,
  plane: number,
  name: string,
  along: 0 | 1,
  place: number,
  axes: string[],
): Promise<LineOverTime> {
  const frames = store.frames(plane);
  const shown = withCells(frames);
  const step = along === 0 ? (shown[0]?.dx ?? 1) : (shown[0]?.dy ?? 1);
  const begins = frames.map((f) => (along === 0 ? f.x : f.y));
  const ends = shown.map((f) => (along === 0 ? f.x + f.nx * f.dx : f.y + f.ny * f.dy));
  const from = Math.min(...shown.map((f) => (along === 0 ? f.x : f.y)));
  const count = Math.round((Math.max(...ends) - from) / step);
  const values = new Float32Array(count * frames.length).fill(NaN);
  const surfaces: { x: number; t: number }[] = [];
  for (const [n, frame] of frames.entries()) {
    if (frame.nx === 0) continue;
    const all = await store.valuesOf(plane, n, name);
    const offset = Math.round(((begins[n] ?? 0) - from) / step);
    const across = along === 0 ? (place - frame.y) / frame.dy : (place - frame.x) / frame.dx;
    const k = frame.ny === 1 ? 0 : Math.floor(across);
    if (k < 0 || k >= (along === 0 ? frame.ny : frame.nx)) continue;
    const length = along === 0 ? frame.nx : frame.ny;
    for (let i = 0; i < length; ++i)
      values[n * count + offset + i] = all[along === 0 ? k * frame.nx + i : i * frame.nx + k] ?? NaN;
    if (frame.ny === 1)
      for (const line of await store.outlinesOf(plane, n)) surfaces.push({ x: line.x[0] ?? NaN, t: frame.t });
  }
  const where = shown[0]?.ny === 1 ? "" : `${axes[1 - along] ?? ""} = ${place.toPrecision(4)} mm`;
  return { axis: axes[along] ?? "x", where, from, step, count, times: frames.map((f) => f.t), values, surfaces };
}

/** Draws it: place to the right, time upwards; each frame fills the time around it. */
export function drawOverTime(
  context: CanvasRenderingContext2D,
  size: { width: number; height: number },
  line: LineOverTime,
  variable: Variable,
  scale: Scale,
  now: number,
): PlotArea {
  const { times } = line;
  const x = { from: line.from, to: line.from + line.count * line.step };
  const y = { from: times[0] ?? 0, to: times[times.length - 1] ?? 1 };
  const area = new PlotArea(56, 26, size.width - 56 - 100, size.height - 26 - 42, x, y);
  const picture = pictureOf(line.values, line.count, times.length, scale);
  context.save();
  area.clip(context);
  context.imageSmoothingEnabled = false;
  times.forEach((t, n) => {
    const low = n === 0 ? t : 0.5 * (t + (times[n - 1] ?? t));
    const high = n + 1 === times.length ? t : 0.5 * (t + (times[n + 1] ?? t));
    const top = area.py(high);
    const height = area.py(low) - top;
    context.drawImage(picture, 0, times.length - 1 - n, line.count, 1, area.left, top, area.width, height + 0.6);
  });
  context.fillStyle = cssColour("--ink");
  for (const s of line.surfaces) context.fillRect(area.px(s.x) - 0.8, area.py(s.t) - 1.4, 1.6, 2.8);
  context.fillStyle = cssColour("--accent");
  context.fillRect(area.left, area.py(now) - 0.5, area.width, 1);
  context.restore();
  drawAxes(context, area, [`${line.axis} [mm]`, "time [\u00b5s]"]);
  drawKey(context, area, variable, scale);
  return area;
}
