// Small parts of the viewer's controls.

import type { Variable } from "./data";
import { h } from "./dom";
import { CONTACT_COLOURS, CONTACT_NAMES } from "./field_picture";
import type { NotedSpan } from "./plot_area";

export const HELP =
  "Keys: \u2190 \u2192 frames, Home End, Space plays, [ ] fields, Shift with arrows moves the point, " +
  "+ \u2212 0 zoom. Drag zooms, a double click shows all, a click keeps the point.";

/** Which values the colours span. */
export type RangeMode = "typical" | "range" | "frame";

export const RANGE_MODES = [
  { value: "typical", text: "run, without outliers" },
  { value: "range", text: "run" },
  { value: "frame", text: "this frame" },
];

/** Values with seven digits cannot show smaller differences, of the largest. */
const DIGITS = 5e-7;

/** Noise must not look like physics: round-off spans no more than its part of the scale, one value half of itself. */
function honest(variable: Variable, from: number, to: number): NotedSpan {
  const noise = variable.round_off ?? 0;
  const most = Math.max(Math.abs(from), Math.abs(to));
  if (variable.categories || most === 0) return { from, to, note: "" };
  if (most <= noise) return { from: variable.signed || from < 0 ? -noise : 0, to: noise, note: ", round-off only" };
  if (to === from || to - from > Math.max(noise, DIGITS * most)) return { from, to, note: "" };
  const middle = 0.5 * (from + to);
  return { from: middle - 0.5 * Math.abs(middle), to: middle + 0.5 * Math.abs(middle), note: ", uniform" };
}

/** The values that colours or an axis span; 0 to 1 where there are none. */
export function rangeOf(variable: Variable, values: Float32Array, mode: RangeMode): NotedSpan {
  let [from, to] = variable[mode === "frame" ? "range" : mode];
  if (mode === "frame") {
    from = Infinity;
    to = -Infinity;
    for (const v of values) {
      if (v < from) from = v;
      if (v > to) to = v;
    }
  }
  return from === null || to === null || from > to ? { from: 0, to: 1, note: "" } : honest(variable, from, to);
}

/** Buttons for the field over time along a line through the point: 0 across, 1 upwards. */
export function overTimeButtons(axes: string[], press: (along: 0 | 1) => void): HTMLElement {
  const button = (along: 0 | 1) =>
    h(
      "button",
      { type: "button", click: () => press(along), "data-along": String(along) },
      `${axes[along] ?? ""}\u2013t`,
    );
  const attributes = { class: "field", role: "group", "aria-label": "Over time along a line through the point" };
  return h("span", attributes, h("span", {}, "Over time along"), button(0), button(1));
}

/** What the marks on surfaces mean. */
export function contactKey(): HTMLElement {
  const items = [1, 2, 3].map((k) =>
    h("li", {}, h("span", { class: "swatch", style: `background:${CONTACT_COLOURS[k] ?? ""}` }), CONTACT_NAMES[k]),
  );
  return h("ul", { class: "key", "aria-label": "Marks of contact" }, ...items);
}
