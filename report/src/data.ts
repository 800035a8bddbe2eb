// What recoil puts into the page (src/app/report/*.cpp): JSON, and packed numbers in one long text.

/** Where packed numbers begin in the text, and how many characters they take. */
export type Block = [number, number];

export interface Column {
  name: string;
  unit: string;
}

export interface Curve {
  kind: "reference" | "prediction";
  label: string;
  column: string;
  x: (number | null)[];
  y: (number | null)[];
  note?: string;
}

export interface Table {
  name: string;
  rows: number;
  columns: Column[];
  values: Block;
}

export interface Gauge extends Table {
  kind: string;
  curves: Curve[];
}

export interface RunEvent {
  t: number | null;
  event: string;
  bodies: string;
  place: string;
  detail: string;
}

export interface Category {
  value: number;
  name: string;
  colour: string;
}

export interface Variable {
  name: string;
  label: string;
  signed: boolean;
  round_off?: number; // below which differences are noise
  range: [number | null, number | null];
  typical: [number | null, number | null];
  categories?: Category[];
  parts?: string[]; // a magnitude: the components that are stored
}

export interface Frame {
  t: number; // us
  nx: number;
  ny: number;
  x: number; // mm, lower left corner
  y: number;
  dx: number; // mm, of a cell
  dy: number;
  outlines: Block;
  values: [Block, number, number][]; // packed numbers, value of 1, step
}

export interface Plane {
  name: string;
  axes: string[];
  frames: Frame[];
}

export interface Fields {
  bits: number;
  dumps: number;
  omission: string;
  bodies: string[];
  outline_parts: number;
  variables: Variable[];
  planes: Plane[];
}

/** The surfaces of the bodies in space: points in parts of a spacing from a corner, faces of four of them. */
export interface SurfaceFrame {
  t: number; // us
  spacing: number; // mm
  corner: [number, number, number]; // mm
  points: Block; // all x, all y, all z
  faces: Block; // all first points, all second ones, ...
  values: [Block, number, number][]; // of the fields at the points, as those of a Frame
}

export interface Surfaces {
  fields: string[];
  point_parts: number;
  box: [number[], number[]]; // around all frames, mm
  frames: SurfaceFrame[];
}

export interface Expectation {
  value: number | boolean | null;
  reference: number | boolean | null;
  kind?: "at-most" | "at-least";
  tolerance?: number | null;
  unit?: string;
  pass: boolean;
  problem?: string;
  source?: string;
  why?: string;
}

export interface Reason {
  what: string;
  body: string;
  text: string;
}

export interface Drift {
  mass: number | null;
  momentum: number | null;
  energy: number | null;
}

export interface Summary {
  version: string;
  case: string;
  exit: number;
  verdict: string;
  reasons: Reason[];
  cures?: string[];
  not_judged: string[];
  remarks: string[];
  time_us: number | null;
  steps: number;
  cells: number;
  wall_s: number | null;
  cpu_s: number | null;
  rate_mcell_stage_per_s: number | null;
  budgets: Record<string, Drift>;
  centre_of_mass?: Record<string, { off_mm: number | null; way_mm: number | null; time_us: number | null }>;
  gauges: Record<
    string,
    { column: string; unit: string; peak: number | null; time_of_peak_us: number | null; arrival_us: number | null }
  >;
  floors: Record<string, number>;
  expect: Record<string, Expectation>;
}

export interface Constant {
  name: string;
  value: number | string;
  unit: string;
  doc: string;
}

export interface Material {
  name: string;
  title: string;
  doubt: string;
  cite: string[];
  bodies: string[];
  tables: { name: string; kind: string; constants: Constant[] }[];
}

export interface Source {
  key: string;
  text: string;
  bibtex: string;
}

export interface Run {
  name: string;
  title: string;
  geometry: "1d" | "spherical" | "planar" | "axisymmetric" | "3d";
  axes: string[];
  cell_mm: number;
  end_us: number;
  scheme: string;
  summary: Summary | null;
  status: { state: string; time_us: number | null; step: number } | null;
  crash: string | null;
  predicted: string;
  case: string;
  resolved: string;
  changes: string[]; // of the command line, PATH=VALUE
  events: RunEvent[];
  fragments: { columns: string[]; rows: string[][]; left_out: number };
  bodies: { name: string; material: string }[];
  gauges: Gauge[];
  history?: Table;
  materials: Material[];
  sources: Source[];
  fields: Fields | null;
  surfaces: Surfaces | null;
}

export interface Report {
  format: number;
  version: string;
  colours: { sequential: string; diverging: string; heat: string; grey: string; curves: string[] };
  runs: Run[];
}

function textOf(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

/** The report, or null in a page that nothing was put into. */
export function readReport(): Report | null {
  const text = textOf("recoil-data").trim();
  return text === "" ? null : (JSON.parse(text) as Report);
}

let blocks: string | null = null;

async function inflated(block: Block): Promise<Uint8Array> {
  blocks ??= textOf("recoil-blocks");
  const binary = atob(blocks.slice(block[0], block[0] + block[1]));
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; ++k) bytes[k] = binary.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Whole numbers as packed_integers() of recoil writes them: differences, zigzag, groups of 7 bits. */
export async function integersOf(block: Block): Promise<Int32Array> {
  const bytes = await inflated(block);
  const values = new Int32Array(bytes.length);
  let n = 0;
  let value = 0;
  let sum = 0;
  let place = 1;
  for (const byte of bytes) {
    sum += (byte & 127) * place;
    place *= 128;
    if (byte > 127) continue;
    value += sum % 2 === 1 ? -(sum + 1) / 2 : sum / 2;
    values[n++] = value;
    sum = 0;
    place = 1;
  }
  return values.subarray(0, n);
}

export async function floatsOf(block: Block): Promise<Float32Array> {
  const bytes = await inflated(block);
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
}

/** The columns of a table. */
export async function columnsOf(table: Table): Promise<Float32Array[]> {
  const all = await floatsOf(table.values);
  return table.columns.map((_, k) => all.subarray(k * table.rows, (k + 1) * table.rows));
}
