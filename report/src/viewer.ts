// The viewer of fields: controls, the picture, what is read off it, and the x-t diagram.

import { type Scale, scaleOf } from "./colours";
import type { Frame, Run, Variable } from "./data";
import { HELP, RANGE_MODES, type RangeMode, contactKey, overTimeButtons, rangeOf } from "./controls";
import { chooser, h } from "./dom";
import { type FieldScene, curveArea, drawField, planeArea } from "./field_picture";
import { FieldStore, withCells } from "./field_store";
import { type LineOverTime, drawOverTime, lineOverTime } from "./line_over_time";
import { atStep, clamp, ticks } from "./numbers";
import { PlotArea, type Span, prepared } from "./plot_area";
import { Readout } from "./readout";

export class Viewer {
  readonly element: HTMLElement;
  private readonly store: FieldStore;
  private readonly canvas = h("canvas", { tabindex: "0", role: "img", "data-part": "field" });
  private readonly timeCanvas = h("canvas", { role: "img", "data-part": "over-time" });
  private readonly timeBox: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly timeText = h("output", { class: "time" });
  private readonly spoken = h("div", { class: "hidden", "aria-live": "polite" });
  private readonly readout: Readout;
  private readonly playButton = h("button", { type: "button", click: () => this.play(!this.playing) });
  private readonly fieldSelect: HTMLSelectElement;
  private readonly listeners: ((time: number) => void)[] = [];
  private area = new PlotArea(0, 0, 1, 1, { from: 0, to: 1 }, { from: 0, to: 1 });
  private plane = 0;
  private index = 0;
  private name: string;
  private mode: RangeMode = "typical";
  private window: { x: Span; y: Span } | null = null;
  private probe: { x: number; y: number } | null = null;
  private kept = false; // the point stays where it is
  private playing = false;
  private turn = 0; // counts requests, so that late answers are dropped
  private line: LineOverTime | null = null;
  private along: 0 | 1 = 1;
  private dragFrom: { x: number; y: number } | null = null;

  constructor(private readonly run: Run) {
    if (!run.fields) throw new Error("a run without fields has no viewer");
    this.store = new FieldStore(run.fields);
    this.readout = new Readout(this.store);
    const names = run.fields.variables.map((v) => v.name);
    this.name = names.includes("pressure") ? "pressure" : (names[0] ?? "");
    this.slider = h("input", {
      type: "range",
      min: "0",
      max: String(this.frames().length - 1),
      value: "0",
      "aria-label": "Time",
      input: () => this.show(Number(this.slider.value)),
    });
    const field = chooser(
      "Field",
      run.fields.variables.map((v) => ({ value: v.name, text: v.label })),
      this.name,
      (name) => this.choose(name),
    );
    this.fieldSelect = field.select;
    this.timeBox = h("div", { class: "over-time" }, h("h3", {}, ""), this.timeCanvas);
    this.timeBox.hidden = true;
    this.element = this.layout(field.element);
    this.listen();
    this.play(false);
  }

  private layout(field: HTMLElement): HTMLElement {
    const fields = this.run.fields;
    const range = chooser("Colours span", RANGE_MODES, this.mode, (m) => {
      this.mode = m as RangeMode;
      void this.draw();
    });
    const planes = (fields?.planes ?? []).map((p, k) => ({ value: String(k), text: p.name }));
    const plane = chooser("Slice", planes, "0", (k) => this.cut(Number(k)));
    if (planes.length < 2) plane.element.hidden = true;
    const flat = !this.isLine;
    const overTime = flat && this.frames().length > 2 ? overTimeButtons(this.axes(), (k) => void this.overTime(k)) : null;
    const marks = flat && this.contactName() ? contactKey() : null;
    const notes = [
      `Values are stored in ${fields?.bits ?? 0} bits between the least and the largest of each frame.`,
      fields?.omission ? `Shown: ${fields.omission}.` : "",
    ];
    return h(
      "div",
      { class: "viewer" },
      h("div", { class: "toolbar" }, field, plane.element, range.element, overTime),
      h(
        "div",
        { class: "stage" },
        h("div", { class: "picture" }, this.canvas),
        h("aside", { "aria-label": "Values at the point" }, this.readout.element, marks),
      ),
      h("div", { class: "timeline" }, this.playButton, this.slider, this.timeText),
      h("p", { class: "note" }, `${HELP} ${notes.join(" ")}`),
      this.spoken,
      this.timeBox,
    );
  }

  /** Calls back with the time of every frame shown [us]. */
  onTime(listener: (time: number) => void): void {
    this.listeners.push(listener);
  }

  private frames(): Frame[] {
    return this.store.frames(this.plane);
  }

  private axes(): string[] {
    return this.run.fields?.planes[this.plane]?.axes ?? this.run.axes;
  }

  private variable(): Variable {
    return this.store.variable(this.name);
  }

  private get isLine(): boolean {
    return this.run.axes.length === 1;
  }

  private mirror(): boolean {
    return this.run.geometry === "axisymmetric";
  }

  private contactName(): string | null {
    const names = this.run.fields?.variables.map((v) => v.name) ?? [];
    return ["contact-state", "contact"].find((n) => names.includes(n)) ?? null;
  }

  /** Shows the frame nearest to a time [us]. */
  showTime(time: number): void {
    const distance = this.frames().map((f) => Math.abs(f.t - time));
    this.show(distance.indexOf(Math.min(...distance)));
  }

  show(index: number): void {
    this.index = clamp(index, 0, this.frames().length - 1);
    void this.draw();
  }

  private choose(name: string): void {
    this.name = name;
    this.fieldSelect.value = name;
    void this.draw().then(() => (this.line ? this.overTime(this.along) : undefined));
  }

  private cut(plane: number): void {
    this.plane = plane;
    this.window = null;
    this.probe = null;
    this.line = null;
    this.timeBox.hidden = true;
    for (const along of [0, 1]) {
      const button = this.element.querySelector(`button[data-along="${along}"]`);
      if (button) button.textContent = `${this.axes()[along] ?? ""}\u2013t`;
    }
    void this.draw();
  }

  private play(on: boolean): void {
    this.playing = on;
    this.playButton.textContent = on ? "Pause" : "Play";
    if (on) void this.playOn();
  }

  private async playOn(): Promise<void> {
    if (this.index + 1 >= this.frames().length) this.index = -1;
    while (this.playing && this.index + 1 < this.frames().length) {
      const begun = performance.now();
      this.index += 1;
      await this.draw();
      const left = Math.max(0, 60 - (performance.now() - begun));
      await new Promise((done) => setTimeout(done, left));
    }
    this.play(false);
    void this.draw();
  }

  /** What the axes span: the zoom, or all that any frame shows. */
  private extent(): { x: Span; y: Span } {
    if (this.window) return this.window;
    const frames = withCells(this.frames());
    const right = Math.max(...frames.map((f) => f.x + f.nx * f.dx));
    const left = Math.min(...frames.map((f) => f.x));
    return {
      x: { from: this.mirror() ? -right : left, to: right },
      y: { from: Math.min(...frames.map((f) => f.y)), to: Math.max(...frames.map((f) => f.y + f.ny * f.dy)) },
    };
  }

  private place(width: number, scale: Scale): { area: PlotArea; height: number } {
    const { x, y } = this.extent();
    if (this.isLine) return curveArea(width, x, scale.range);
    return planeArea(width, Math.max(260, Math.min(680, window.innerHeight * 0.7)), x, y);
  }

  private scale(values: Float32Array): Scale {
    const variable = this.variable();
    const line = this.isLine ? { ...variable, signed: false } : variable;
    return scaleOf(line, rangeOf(variable, values, this.mode));
  }

  async draw(): Promise<void> {
    const turn = ++this.turn;
    const begun = performance.now();
    const [plane, index] = [this.plane, this.index];
    const contactName = this.isLine ? null : this.contactName();
    const [values, outlines, marks] = await Promise.all([
      this.store.valuesOf(plane, index, this.name),
      this.store.outlinesOf(plane, index),
      contactName ? this.store.valuesOf(plane, index, contactName) : null,
    ]);
    if (turn !== this.turn || !this.canvas.isConnected) return;
    const contact = contactName === "contact" && marks ? marks.map((v) => (v > 0 ? 1 : 0)) : marks;
    const scale = this.scale(values);
    const scene: FieldScene = {
      frame: this.store.frame(plane, index),
      values,
      contact,
      outlines,
      bodies: this.store.fields.bodies,
      variable: this.variable(),
      scale,
      axes: this.axes(),
      mirror: this.mirror(),
      probe: this.probe,
    };
    this.paint(scene);
    this.canvas.dataset["ms"] = (performance.now() - begun).toFixed(1);
    this.canvas.dataset["shown"] = `${plane} ${index} ${this.name}`;
    this.tell(scene);
  }

  private paint(scene: FieldScene): void {
    const width = this.canvas.parentElement?.clientWidth ?? 800;
    const { area, height } = this.place(width, scene.scale);
    this.area = area;
    this.canvas.dataset["area"] = JSON.stringify(area);
    const context = prepared(this.canvas, width, height);
    this.canvas.dataset["names"] = JSON.stringify(drawField(context, area, scene));
    if (this.line) this.paintOverTime(scene);
  }

  private paintOverTime(scene: FieldScene): void {
    if (!this.line) return;
    const size = { width: this.timeCanvas.parentElement?.clientWidth ?? 800, height: 400 };
    const span = rangeOf(scene.variable, this.line.values, this.mode);
    const context = prepared(this.timeCanvas, size.width, size.height);
    drawOverTime(context, size, this.line, scene.variable, scaleOf(scene.variable, span), scene.frame.t);
    const title = `${scene.variable.label}${span.note} along ${this.line.axis}${this.line.where ? `, ${this.line.where}` : ""}`;
    const heading = this.timeBox.querySelector("h3");
    if (heading) heading.textContent = title;
    this.timeCanvas.setAttribute("aria-label", `${title}, over time`);
  }

  /** The field along a line through the point, over time. */
  private async overTime(along: 0 | 1): Promise<void> {
    const { x, y } = this.extent();
    const through = this.probe ?? { x: this.mirror() ? 0 : 0.5 * (x.from + x.to), y: 0.5 * (y.from + y.to) };
    const place = along === 0 ? through.y : this.mirror() ? Math.abs(through.x) : through.x;
    this.along = along;
    this.line = await lineOverTime(this.store, this.plane, this.name, along, place, this.axes());
    this.timeBox.hidden = false;
    await this.draw();
  }

  private tell(scene: FieldScene): void {
    const { frame, variable } = scene;
    this.slider.value = String(this.index);
    const times = this.frames();
    const step = ticks(times[0]?.t ?? 0, times[times.length - 1]?.t ?? 1, 2000).step;
    this.timeText.textContent = `${atStep(frame.t, step)} \u00b5s, ${this.index + 1} of ${times.length}`;
    this.slider.setAttribute("aria-valuetext", `${atStep(frame.t, step)} microseconds`);
    this.canvas.setAttribute("aria-label", `${variable.label}${scene.scale.note} at ${atStep(frame.t, step)} microseconds`);
    for (const listener of this.listeners) listener(frame.t);
    void this.tellPoint();
  }

  private tellPoint(): Promise<void> {
    const names = this.playing ? [this.name] : this.store.fields.variables.map((v) => v.name);
    const { plane, index, name, probe } = this;
    return this.readout.show({ plane, index, names, current: name, probe, mirror: this.mirror(), axes: this.axes() });
  }

  private listen(): void {
    this.canvas.addEventListener("pointermove", (e) => this.point(e));
    this.canvas.addEventListener("pointerleave", () => this.leave());
    this.canvas.addEventListener("pointerdown", (e) => {
      this.dragFrom = { x: this.area.dataX(e.offsetX), y: this.area.dataY(e.offsetY) };
    });
    this.canvas.addEventListener("pointerup", (e) => this.drop(e));
    this.canvas.addEventListener("dblclick", () => this.zoom(0));
    this.element.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => void this.draw()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => void this.draw());
    document.addEventListener("recoil-theme", () => void this.draw());
    if (this.isLine && this.frames().length > 2) void this.overTime(0);
  }

  private point(e: PointerEvent): void {
    if (this.kept) return;
    const inside = this.area.holds(e.offsetX, e.offsetY);
    this.probe = inside ? { x: this.area.dataX(e.offsetX), y: this.area.dataY(e.offsetY) } : null;
    void this.draw();
  }

  private leave(): void {
    if (this.kept) return;
    this.probe = null;
    void this.draw();
  }

  /** The end of a drag zooms to its box; a click keeps the point, or lets it go. */
  private drop(e: PointerEvent): void {
    const from = this.dragFrom;
    this.dragFrom = null;
    if (!from) return;
    const to = { x: this.area.dataX(e.offsetX), y: this.area.dataY(e.offsetY) };
    const far = Math.abs(this.area.px(from.x) - e.offsetX) > 8 && Math.abs(this.area.py(from.y) - e.offsetY) > 8;
    if (far && !this.isLine) {
      this.window = {
        x: { from: Math.min(from.x, to.x), to: Math.max(from.x, to.x) },
        y: { from: Math.min(from.y, to.y), to: Math.max(from.y, to.y) },
      };
    } else {
      this.kept = !this.kept;
      if (!this.kept) this.point(e);
    }
    void this.draw();
  }

  /** @param factor 0 shows all. */
  private zoom(factor: number): void {
    const { x, y } = this.extent();
    const about = (s: Span, c: number) => ({ from: c + (s.from - c) * factor, to: c + (s.to - c) * factor });
    const c = this.probe ?? { x: 0.5 * (x.from + x.to), y: 0.5 * (y.from + y.to) };
    this.window = factor === 0 || this.isLine ? null : { x: about(x, c.x), y: about(y, c.y) };
    void this.draw();
  }

  private movePoint(dx: number, dy: number): void {
    const frame = this.store.frame(this.plane, this.index);
    const { x, y } = this.extent();
    const p = this.probe ?? { x: 0.5 * (x.from + x.to), y: 0.5 * (y.from + y.to) };
    this.probe = {
      x: clamp(p.x + dx * frame.dx, x.from, x.to),
      y: clamp(p.y + dy * frame.dy, y.from, y.to),
    };
    this.kept = true;
    void this.draw()
      .then(() => this.tellPoint())
      .then(() => (this.spoken.textContent = this.readout.element.textContent));
  }

  private nextField(by: number): void {
    const names = this.run.fields?.variables.map((v) => v.name) ?? [];
    this.choose(names[(names.indexOf(this.name) + by + names.length) % names.length] ?? this.name);
  }

  private key(e: KeyboardEvent): void {
    if (e.target instanceof HTMLSelectElement || e.ctrlKey || e.metaKey || e.altKey) return;
    const own = e.target === this.canvas;
    if (!own && (e.target === this.slider || e.target instanceof HTMLButtonElement)) return;
    const moves: Record<string, () => void> = e.shiftKey
      ? {
          ArrowLeft: () => this.movePoint(-1, 0),
          ArrowRight: () => this.movePoint(1, 0),
          ArrowUp: () => this.movePoint(0, 1),
          ArrowDown: () => this.movePoint(0, -1),
        }
      : {
          ArrowLeft: () => this.show(this.index - 1),
          ArrowRight: () => this.show(this.index + 1),
          Home: () => this.show(0),
          End: () => this.show(this.frames().length - 1),
          " ": () => this.play(!this.playing),
          "[": () => this.nextField(-1),
          "]": () => this.nextField(1),
          "-": () => this.zoom(1.6),
          "0": () => this.zoom(0),
        };
    moves["+"] = () => this.zoom(1 / 1.6);
    moves["Escape"] = () => {
      this.kept = false;
      this.leave();
    };
    const move = moves[e.key];
    if (!move) return;
    e.preventDefault();
    move();
  }
}
