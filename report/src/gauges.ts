// Gauges and history as charts over time, with the curves that they are to be compared with.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { curveColour } from "./colours";
import { type Curve, type Run, type Table, columnsOf } from "./data";
import { chooser, cssColour, h } from "./dom";
import { prettyUnit, written } from "./numbers";

/** One line of a chart. */
interface Line {
  label: string;
  x: ArrayLike<number | null>;
  y: ArrayLike<number | null>;
  kind: "run" | Curve["kind"];
}

const DENSE = 150; // more points than this are a line of dots

/** How a line looks: those of runs solid, predictions dashed in the colour of text, references in dots of colour. */
function lookOf(line: Line, which: number): { stroke: string; width: number; dash?: number[]; points: uPlot.Series.Points } {
  if (line.kind === "run") return { stroke: curveColour(which), width: 1.6, points: { show: false } };
  if (line.kind === "prediction")
    return { stroke: cssColour("--ink-2"), width: 1.4, dash: [6, 4], points: { show: false } };
  const stroke = curveColour(which);
  if (line.x.length > DENSE) return { stroke, width: 2, dash: [2, 3], points: { show: false } };
  return { stroke, width: 1, dash: [1, 3], points: { show: true, size: 5, stroke, fill: stroke } };
}

const LEGEND_BORDER = { run: "solid", prediction: "dashed", reference: "dotted" };

function labelOf(table: Table, column: number): string {
  const c = table.columns[column];
  const unit = prettyUnit(c?.unit ?? "");
  return unit === "" ? (c?.name ?? "") : `${c?.name ?? ""} [${unit}]`;
}

function joined(lines: Line[]): uPlot.AlignedData {
  const finite = (v: number | null | undefined) => (v === null || v === undefined || Number.isNaN(v) ? null : v);
  const tables = lines.map((line) => {
    // Points at the same place, as a jump has them, must not be equal for uPlot to join.
    let before = -Infinity;
    const x = Array.from(line.x, (v) => {
      const next = finite(v) ?? before;
      before = next <= before ? before + 1e-9 * Math.max(1, Math.abs(before)) : next;
      return before;
    });
    return [x, Array.from(line.y, finite)] as uPlot.AlignedData;
  });
  return uPlot.join(
    tables,
    tables.map(() => [2, 2]), // what is not a number is a gap, also where others have points within it
  );
}

/** A chart that follows the width of its place, the theme, and the time of the field viewer. */
export class Chart {
  readonly element = h("div", { class: "chart" });
  private plot: uPlot | null = null;
  private lines: Line[] = [];
  private xTitle = "";
  private yTitle = "";
  private now: number | null = null;

  constructor(private readonly name: string) {
    new ResizeObserver(() => this.resize()).observe(this.element);
    document.addEventListener("recoil-theme", () => this.build());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.build());
  }

  set(lines: Line[], xTitle: string, yTitle: string): void {
    [this.lines, this.xTitle, this.yTitle] = [lines, xTitle, yTitle];
    this.build();
  }

  setNow(time: number): void {
    this.now = time;
    this.plot?.redraw(false);
  }

  private resize(): void {
    const width = this.element.clientWidth;
    if (width > 0 && this.plot) this.plot.setSize({ width, height: 260 });
    else if (width > 0) this.build();
  }

  private markNow(plot: uPlot): void {
    if (this.now === null || !this.xTitle.startsWith("time")) return;
    const x = plot.valToPos(this.now, "x", true);
    const { left, top, width, height } = plot.bbox;
    if (x < left || x > left + width) return;
    plot.ctx.save();
    plot.ctx.fillStyle = cssColour("--accent");
    plot.ctx.fillRect(x - 0.5, top, 1, height);
    plot.ctx.restore();
  }

  private build(): void {
    this.plot?.destroy();
    this.plot = null;
    const width = this.element.clientWidth;
    if (width === 0 || this.lines.length === 0) return;
    const ink = cssColour("--ink-2");
    const grid = { stroke: cssColour("--grid"), width: 1 };
    const axis = { stroke: ink, grid, ticks: { ...grid, size: 4 }, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif" };
    const options: uPlot.Options = {
      width,
      height: 260,
      scales: { x: { time: false } },
      cursor: { sync: { key: `${this.name} time` }, drag: { x: true, y: true, uni: 12 } },
      legend: {
        live: true,
        markers: { dash: (_: uPlot, k: number) => LEGEND_BORDER[this.lines[k - 1]?.kind ?? "run"] },
      },
      axes: [
        { ...axis, label: this.xTitle, labelSize: 18, size: 34 },
        { ...axis, label: this.yTitle, labelSize: 18, size: 58, values: (_, all) => all.map((v) => written(v)) },
      ],
      series: [
        { label: this.xTitle, value: (_, v) => written(v) },
        ...this.lines.map((line, k) => ({
          label: line.label,
          ...lookOf(line, k),
          spanGaps: false,
          value: (_: uPlot, v: number | null) => written(v),
        })),
      ],
      hooks: { draw: [(plot) => this.markNow(plot)] },
    };
    this.plot = new uPlot(options, joined(this.lines), this.element);
    this.plot.root.querySelector("table")?.setAttribute("aria-label", `${this.yTitle} at the cursor`);
    this.plot.root.querySelector("canvas")?.setAttribute("role", "img");
    this.plot.root.querySelector("canvas")?.setAttribute("aria-label", `${this.yTitle} over ${this.xTitle}`);
  }
}

/** The column of that name in the table of each run that has it. */
async function linesOf(tables: { run: string; table: Table }[], column: string): Promise<Line[]> {
  const lines: Line[] = [];
  for (const { run, table } of tables) {
    const k = table.columns.findIndex((c) => c.name === column);
    if (k < 0) continue;
    const columns = await columnsOf(table);
    lines.push({ label: run, x: columns[0] ?? [], y: columns[k] ?? [], kind: "run" });
  }
  return lines;
}

/** A chart of one column of a table, which is chosen above it. */
function tableChart(
  title: string,
  tables: { run: string; table: Table }[],
  curves: Curve[],
  first: string,
  charts: Chart[],
): HTMLElement {
  const table = tables[0]?.table;
  if (!table) return h("div");
  const chart = new Chart(table.name);
  charts.push(chart);
  const notes = h("p", { class: "note" });
  const show = async (column: string) => {
    const k = table.columns.findIndex((c) => c.name === column);
    const lines = await linesOf(tables, column);
    if (tables.length === 1 && lines[0]) lines[0].label = column;
    const here = curves.filter((c) => c.column === column);
    for (const c of here) lines.push({ label: `${c.label} (${c.kind})`, x: c.x, y: c.y, kind: c.kind });
    notes.textContent = here.map((c) => c.note ?? "").join(" ").trim();
    chart.set(lines, labelOf(table, 0), labelOf(table, k));
  };
  const options = table.columns.slice(1).map((c, k) => ({ value: c.name, text: labelOf(table, k + 1) }));
  const column = chooser("Column", options, first, (c) => void show(c));
  requestAnimationFrame(() => void show(first));
  return h(
    "article",
    { class: "card" },
    h("div", { class: "card-head" }, h("h3", {}, title), column.element),
    chart.element,
    notes,
  );
}

/** All gauges of a run; of other runs those of the same names are drawn with them. */
export function gaugeCharts(run: Run, others: Run[], charts: Chart[]): HTMLElement {
  const cards = run.gauges.map((gauge) => {
    const tables = [{ run: run.name, table: gauge as Table }];
    for (const other of others) {
      const same = other.gauges.find((g) => g.name === gauge.name);
      if (same) tables.push({ run: other.name, table: same });
    }
    const first = gauge.curves[0]?.column ?? gauge.columns[1]?.name ?? "";
    return tableChart(`${gauge.name}, ${gauge.kind.replace("-", " ")}`, tables, gauge.curves, first, charts);
  });
  return h("div", { class: "cards" }, ...cards);
}

export function historyChart(run: Run, others: Run[], charts: Chart[]): HTMLElement | null {
  if (!run.history) return null;
  const tables = [{ run: run.name, table: run.history }];
  for (const other of others) if (other.history) tables.push({ run: other.name, table: other.history });
  return tableChart("History", tables, [], "total.kinetic", charts);
}
