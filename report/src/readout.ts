// The values of a frame at a point.

import type { Variable } from "./data";
import { h } from "./dom";
import { cellAt } from "./field_picture";
import type { FieldStore } from "./field_store";
import { atStep, prettyUnit, written } from "./numbers";

/** What is read, and where. */
export interface Reading {
  plane: number;
  index: number; // of the frame
  names: string[]; // of the fields
  current: string; // the one that the picture shows
  probe: { x: number; y: number } | null; // mm
  mirror: boolean;
  axes: string[];
}

export class Readout {
  readonly element = h("div", { class: "readout" });
  private turn = 0;

  constructor(private readonly store: FieldStore) {}

  /** Shows a reading, unless a later one has come before its fields are unpacked. */
  async show(reading: Reading): Promise<void> {
    const turn = ++this.turn;
    if (!reading.probe) {
      this.element.replaceChildren(h("p", { class: "note" }, "Point at the picture to read its values."));
      return;
    }
    const { x, y } = reading.probe;
    const frame = this.store.frame(reading.plane, reading.index);
    const cell = cellAt(frame, reading.mirror ? Math.abs(x) : x, y);
    const rows: HTMLElement[] = [];
    for (const name of reading.names) {
      const values = await this.store.valuesOf(reading.plane, reading.index, name);
      const text = this.valueText(reading, this.store.variable(name), values[cell] ?? NaN);
      const attributes: Record<string, string> = name === reading.current ? { class: "current" } : {};
      const cells = [h("th", { scope: "row" }, name), h("td", { class: "number", "data-field": name }, text)];
      if (text !== null) rows.push(h("tr", attributes, ...cells));
    }
    if (turn !== this.turn) return;
    const [a, b] = reading.axes;
    const place = frame.ny === 1 ? `${a} ${written(x)} mm` : `${a} ${written(x)}, ${b} ${written(y)} mm`;
    this.element.replaceChildren(
      h("p", { class: "place", "data-part": "place" }, place),
      rows.length > 0
        ? h("table", { "aria-label": "Values at the point" }, h("tbody", {}, ...rows))
        : h("p", { class: "note" }, "no matter"),
    );
  }

  /** A value with its unit; null where there is nothing to say. */
  private valueText(reading: Reading, v: Variable, value: number): string | null {
    if (Number.isNaN(value)) return null;
    if (v.categories) return v.categories.find((c) => c.value === value)?.name ?? String(value);
    const unit = /\[(.*)\]/.exec(v.label)?.[1] ?? "";
    const step = this.store.stepOf(reading.plane, reading.index, v.name);
    return `${atStep(value, step > 0 ? step : Math.abs(value) * 1e-4)} ${prettyUnit(unit)}`.trim();
  }
}
