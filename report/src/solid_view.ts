// The bodies of a 3d run in space, turned by hand, at the time of the fields.

import { scaleOf } from "./colours";
import { rangeOf } from "./controls";
import type { Fields, Surfaces, Variable } from "./data";
import { chooser, cssColour, h } from "./dom";
import { drawKey } from "./field_picture";
import { clamp, written } from "./numbers";
import { PlotArea, prepared } from "./plot_area";
import { type Look, type Screen, dot, drawSolid, lookFrom } from "./solid_picture";
import { SurfaceStore, type Vector } from "./surface_store";

const HELP =
  "Drag turns the bodies; so do the arrow keys on the picture, by 5 degrees. + \u2212 0 zoom. The time is that of the slider " +
  "of the fields. Values are those half a cell below the surface; rigid bodies have none and are grey.";
const KEY_WIDTH = 100;

export class SolidView {
  readonly element: HTMLElement;
  private readonly store: SurfaceStore;
  private readonly canvas = h("canvas", { tabindex: "0", role: "img", "data-part": "solid" });
  private readonly turnSlider = this.angle("Turn", -180, 180, (value) => (this.azimuth = value));
  private readonly tiltSlider = this.angle("Tilt", -90, 90, (value) => (this.elevation = value));
  private readonly timeText = h("output", { class: "time" });
  private azimuth = -55; // degrees, as in `recoil plot --view`
  private elevation = 24;
  private zoom = 1;
  private index = 0;
  private name: string;
  private request = 0; // counts requests, so that late answers are dropped
  private dragged: { x: number; y: number } | null = null;

  constructor(
    private readonly fields: Fields,
    surfaces: Surfaces,
  ) {
    this.store = new SurfaceStore(surfaces);
    this.name = surfaces.fields[0] ?? "";
    const options = surfaces.fields.map((name) => ({ value: name, text: this.variable(name).label }));
    const field = chooser("Coloured by", options, this.name, (name) => {
      this.name = name;
      void this.draw();
    });
    const angles = [this.turnSlider, this.tiltSlider].map((slider) =>
      h("label", { class: "field" }, h("span", {}, slider.title), slider),
    );
    this.element = h(
      "div",
      { class: "viewer" },
      h("div", { class: "toolbar" }, field.element, ...angles, this.timeText),
      h("div", { class: "picture solid" }, this.canvas),
      h("p", { class: "note" }, `${HELP} ${surfaces.frames.length} of ${fields.dumps} dumps are shown.`),
    );
    this.listen();
  }

  private angle(name: string, min: number, max: number, set: (value: number) => void): HTMLInputElement {
    const slider: HTMLInputElement = h("input", {
      type: "range",
      min: String(min),
      max: String(max),
      title: name,
      input: () => {
        set(Number(slider.value));
        void this.draw();
      },
    });
    return slider;
  }

  private variable(name: string): Variable {
    const found = this.fields.variables.find((v) => v.name === name);
    return found ?? { name, label: name, signed: false, range: [null, null], typical: [null, null] };
  }

  /** Shows the surface nearest to a time [us]. */
  showTime(time: number): void {
    const distance = this.store.surfaces.frames.map((f) => Math.abs(f.t - time));
    const index = distance.indexOf(Math.min(...distance));
    if (index === this.index && this.canvas.dataset["shown"]) return;
    this.index = index;
    void this.draw();
  }

  async draw(): Promise<void> {
    const request = ++this.request;
    const [mesh, values] = await Promise.all([
      this.store.meshOf(this.index),
      this.store.valuesOf(this.index, this.name),
    ]);
    if (request !== this.request || !this.canvas.isConnected) return;
    const begun = performance.now();
    const variable = this.variable(this.name);
    const scale = scaleOf(variable, rangeOf(variable, values, "typical"));
    const width = this.canvas.parentElement?.clientWidth ?? 800;
    const height = clamp(0.6 * width, 260, Math.min(520, window.innerHeight * 0.7));
    const context = prepared(this.canvas, width, height);
    const look = lookFrom(this.azimuth, this.elevation);
    const [columns, rows] = [Math.round(width - KEY_WIDTH), Math.round(height)];
    const screen = this.screen(columns, rows);
    const image = document.createElement("canvas");
    image.width = columns;
    image.height = rows;
    image.getContext("2d")?.putImageData(drawSolid(mesh, values, look, screen, scale), 0, 0);
    context.drawImage(image, 0, 0, columns, rows);
    const none = { from: 0, to: 1 };
    drawKey(context, new PlotArea(0, 26, columns - 14, rows - 60, none, none), variable, scale);
    drawTripod(context, look, rows);
    this.canvas.dataset["perMm"] = String(screen.perMm);
    this.tell(variable);
    this.canvas.dataset["ms"] = (performance.now() - begun).toFixed(1);
  }

  /** All that any frame shows, from any side. */
  private screen(width: number, height: number): Screen {
    const [low, high] = this.store.surfaces.box;
    const at = (d: number) => 0.5 * ((low[d] ?? 0) + (high[d] ?? 0));
    const across = Math.hypot(...[0, 1, 2].map((d) => (high[d] ?? 0) - (low[d] ?? 0)));
    return { width, height, perMm: (this.zoom * Math.min(width, height)) / across, centre: [at(0), at(1), at(2)] };
  }

  private tell(variable: Variable): void {
    const time = `${written(this.store.frame(this.index).t)} \u00b5s`;
    this.timeText.textContent = time;
    this.turnSlider.value = String(this.azimuth);
    this.tiltSlider.value = String(this.elevation);
    const from = `seen from ${this.azimuth.toFixed(0)} degrees, ${this.elevation.toFixed(0)} degrees above`;
    this.canvas.setAttribute("aria-label", `Bodies in space, ${variable.label} at ${time}, ${from}`);
    this.canvas.dataset["shown"] = `${this.index} ${this.name} ${this.azimuth.toFixed(0)} ${this.elevation.toFixed(0)}`;
  }

  private turn(by: number, tilt: number): void {
    this.azimuth = ((this.azimuth + by + 540) % 360) - 180;
    this.elevation = clamp(this.elevation + tilt, -90, 90);
    void this.draw();
  }

  private listen(): void {
    this.canvas.addEventListener("pointerdown", (e) => {
      this.dragged = { x: e.clientX, y: e.clientY };
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener("pointerup", () => (this.dragged = null));
    this.canvas.addEventListener("pointermove", (e) => {
      if (!this.dragged) return;
      const [x, y] = [e.clientX - this.dragged.x, e.clientY - this.dragged.y];
      this.dragged = { x: e.clientX, y: e.clientY };
      this.turn(-0.5 * x, 0.5 * y);
    });
    this.canvas.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => void this.draw()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => void this.draw());
    document.addEventListener("recoil-theme", () => void this.draw());
  }

  private zoomBy(factor: number): void {
    this.zoom = factor === 0 ? 1 : clamp(this.zoom * factor, 0.2, 20);
    void this.draw();
  }

  private key(e: KeyboardEvent): void {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => this.turn(-5, 0),
      ArrowRight: () => this.turn(5, 0),
      ArrowUp: () => this.turn(0, 5),
      ArrowDown: () => this.turn(0, -5),
      "+": () => this.zoomBy(1.25),
      "-": () => this.zoomBy(0.8),
      "0": () => this.zoomBy(0),
    };
    const move = moves[e.key];
    if (!move) return;
    e.preventDefault();
    move();
  }
}

/** The directions of the axes, below on the left. */
function drawTripod(context: CanvasRenderingContext2D, look: Look, height: number): void {
  const [x, y, length] = [40, height - 40, 26];
  context.save();
  const axes: [string, Vector][] = [
    ["x", [1, 0, 0]],
    ["y", [0, 1, 0]],
    ["z", [0, 0, 1]],
  ];
  context.strokeStyle = cssColour("--ink-2");
  context.fillStyle = cssColour("--ink-2");
  context.lineWidth = 1.3;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const [name, axis] of axes) {
    const [dx, dy] = [length * dot(axis, look.right), -length * dot(axis, look.up)];
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + dx, y + dy);
    context.stroke();
    if (Math.hypot(dx, dy) > 6) context.fillText(name, x + 1.35 * dx, y + 1.35 * dy);
  }
  context.restore();
}
