// Small parts of the viewer's controls.

import type { Variable } from "./data";
import { h } from "./dom";
import { CONTACT_COLOURS, CONTACT_NAMES } from "./field_picture";
import type { Span } from "./plot_area";

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

/** The values that colours or an axis span; 0 to 1 where there are none. */
export function rangeOf(variable: Variable, values: Float32Array, mode: RangeMode): Span {
  let [from, to] = variable[mode === "frame" ? "range" : mode];
  if (mode === "frame") {
    from = Infinity;
    to = -Infinity;
    for (const v of values) {
      if (v < from) from = v;
      if (v > to) to = v;
    }
  }
  return from === null || to === null || from > to ? { from: 0, to: 1 } : { from, to };
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
