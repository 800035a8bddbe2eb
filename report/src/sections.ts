// Parts of the page that are text and tables.

import type { Expectation, Material, Reason, Run, RunEvent, Summary } from "./data";
import { h, table } from "./dom";
import { prettyUnit, withUnit, written } from "./numbers";

const MARKS: Record<string, string> = { valid: "\u2713", doubtful: "!", stopped: "\u2715" };

/** The word of a run: that of its summary, else how it stands. */
export function verdictOf(run: Run): string {
  return run.summary?.verdict ?? (run.crash ? "stopped" : (run.status?.state ?? "not finished"));
}

function chip(run: Run): HTMLElement {
  const word = verdictOf(run);
  return h("span", { class: `chip ${word.replace(/\W/g, "-")}` }, `${MARKS[word] ?? "?"} ${word}`);
}

/** How many expectations failed, and of how many. */
function failures(run: Run): { failed: number; of: number } {
  const all = Object.values(run.summary?.expect ?? {});
  return { failed: all.filter((e) => !e.pass).length, of: all.length };
}

function failedText(failed: number, of: number): string {
  return `${failed} of ${of} expectation${of === 1 ? "" : "s"} failed`;
}

/** The verdict, and whether expectations failed. */
export function chips(run: Run): HTMLElement {
  const { failed, of } = failures(run);
  const badge = failed > 0 ? h("span", { class: "chip failed" }, `\u2715 ${failedText(failed, of)}`) : null;
  return h("span", { class: "chips" }, chip(run), badge);
}

/** What --set and its like have changed, as "mesh.finest = 0.1 mm". */
function changes(run: Run): HTMLElement | null {
  const written = run.changes.map((change) => {
    const at = change.indexOf("=");
    const value = change.slice(at + 1).trim();
    return `${change.slice(0, at).trim()} = ${value.replace(/^([-+]?[\d.]+(?:[eE][-+]?\d+)?)([A-Za-z\u00b5].*)$/, "$1 $2")}`;
  });
  return lines(written, "Changed on the command line:");
}

function quantity(value: number | boolean | null, unit: string | undefined): string {
  if (typeof value === "boolean") return value ? "yes" : "no";
  return withUnit(written(value, 5), unit ?? "1");
}

function bound(e: Expectation): string {
  const value = quantity(e.reference, e.unit);
  if (e.kind === "at-most") return `at most ${value}`;
  if (e.kind === "at-least") return `at least ${value}`;
  return e.tolerance ? `${value} \u00b1 ${withUnit(written(e.tolerance, 2), e.unit ?? "1")}` : value;
}

function errorOf(e: Expectation): string {
  if (typeof e.value !== "number" || typeof e.reference !== "number" || e.kind || e.reference === 0) return "";
  const percent = (100 * (e.value - e.reference)) / Math.abs(e.reference);
  const size = Math.abs(percent) < 10 ? written(Math.abs(percent), 2) : Math.abs(percent).toFixed(0);
  return `${percent < 0 ? "\u2212" : percent > 0 ? "+" : ""}${size}\u00a0%`;
}

function expectations(run: Run): HTMLElement | null {
  const all = run.summary?.expect ?? {};
  const names = Object.keys(all);
  if (names.length === 0) return null;
  const { failed, of } = failures(run);
  const rows = names.map((name) => {
    const e = all[name] as Expectation;
    const mark = h("span", { class: e.pass ? "pass" : "fail" }, e.pass ? "\u2713 pass" : "\u2715 fail");
    const source = [e.source, e.why, e.problem].filter(Boolean).join("; ");
    return [mark, h("code", {}, name), quantity(e.value, e.unit), bound(e), errorOf(e), source];
  });
  const head = failed > 0 ? failedText(failed, of) : of === 1 ? "The expectation is met" : `All ${of} expectations met`;
  return h(
    "details",
    failed > 0 ? { open: true } : {},
    h("summary", {}, head),
    table("Expectations", ["", "Quantity", "Run", "Expected", "Error", "Source"], rows, [2, 3, 4]),
  );
}

function reasons(all: Reason[]): HTMLElement | null {
  if (all.length === 0) return null;
  return h("ul", { class: "reasons" }, ...all.map((r) => h("li", {}, r.text)));
}

function lines(all: string[], title: string): HTMLElement | null {
  if (all.length === 0) return null;
  if (all.length === 1) return h("p", { class: "remarks" }, h("strong", {}, `${title} `), all[0] ?? "");
  return h(
    "div",
    { class: "remarks" },
    h("strong", {}, title),
    h("ul", {}, ...all.map((line) => h("li", {}, line))),
  );
}

/** Numbers of a run in one row. */
export function facts(run: Run): HTMLElement {
  const s = run.summary;
  const items: [string, string][] = [
    ["Geometry", run.geometry],
    ["Cells", `${written(run.cell_mm)} mm`],
    ["Scheme", run.scheme],
    ["Time", `${written(s?.time_us ?? run.status?.time_us)} of ${written(run.end_us)} \u00b5s`],
    ["Steps", String(s?.steps ?? run.status?.step ?? "\u2013")],
  ];
  if (s) {
    if (s.cells > 0) items.push(["Cells with matter", s.cells.toLocaleString("en")]); // not counted after an error
    items.push(["Wall time", `${written(s.wall_s, 3)} s`]);
    if (s.rate_mcell_stage_per_s) items.push(["Rate", `${written(s.rate_mcell_stage_per_s, 3)} Mcell stages/s`]);
    items.push(["Recoil", s.version]);
  }
  return h("dl", { class: "facts" }, ...items.map(([k, v]) => h("div", {}, h("dt", {}, k), h("dd", {}, v))));
}

/** Whether the run can be trusted, and why not. */
export function verdict(run: Run): HTMLElement {
  const s = run.summary;
  const limited = Object.entries(s?.floors ?? {}).filter(([, n]) => n !== 0);
  return h(
    "div",
    {},
    facts(run),
    changes(run),
    s ? reasons(s.reasons) : null,
    run.crash ? h("pre", { class: "crash", tabindex: "0" }, run.crash) : null,
    s?.cures ? lines(s.cures, "What helps.") : null,
    s ? lines(s.remarks, "Remarks.") : null,
    s ? lines(s.not_judged, "Not judged.") : null,
    expectations(run),
    limited.length > 0
      ? h(
          "details",
          {},
          h("summary", {}, `Limited or replaced: ${limited.length} ${limited.length === 1 ? "kind" : "kinds"}`),
          table("Counters", ["What", "Times"], limited.map(([k, n]) => [k, n.toLocaleString("en")]), [1]),
        )
      : null,
    run.predicted.trim() === ""
      ? null
      : h("details", {}, h("summary", {}, "Predicted before the run"), h("pre", { tabindex: "0" }, run.predicted)),
  );
}

/** What happened; a time leads to the picture of it. */
export function events(all: RunEvent[], show: ((time: number) => void) | null): HTMLElement {
  if (all.length === 0) return h("p", { class: "note" }, "No body touched another.");
  const time = (e: RunEvent) => {
    const text = `${written(e.t, 5)} \u00b5s`;
    const at = e.t;
    return show && at !== null ? h("button", { type: "button", class: "link", click: () => show(at) }, text) : text;
  };
  const rows = all.map((e) => [time(e), e.event, e.bodies, e.place, e.detail]);
  return table("Events", ["Time", "Event", "Bodies", "Place [mm]", "Detail"], rows, [0]);
}

/** The fragments at the end, where any body is in more than one piece. */
export function fragments(all: Run["fragments"]): HTMLElement | null {
  const column = (name: string) => all.columns.findIndex((c) => c.split(" [")[0] === name);
  const bodies = all.rows.map((row) => row[column("body")]);
  if (new Set(bodies).size === bodies.length) return null;
  const shown = all.columns
    .map((_, k) => k)
    .filter((k) => /^(fragment|body|kind|mass|position|velocity|diameter)/.test(all.columns[k] ?? ""));
  const cell = (text: string) => (text === "" || Number.isNaN(Number(text)) ? text : written(Number(text), 4));
  const rows = all.rows.map((row) => shown.map((k) => cell(row[k] ?? "")));
  const numbers = shown.map((_, k) => k).filter((k) => k !== 1 && k !== 2);
  return h(
    "div",
    {},
    table("Fragments at the end", shown.map((k) => all.columns[k] ?? ""), rows, numbers),
    all.left_out > 0 ? h("p", { class: "note" }, `${all.left_out} lighter ones are in fragments.csv.`) : null,
  );
}

export function budgets(summary: Summary): HTMLElement {
  const rows = Object.entries(summary.budgets).map(([name, d]) => [
    name,
    written(d.mass, 2),
    written(d.momentum, 2),
    written(d.energy, 2),
    written(summary.centre_of_mass?.[name]?.off_mm, 2),
  ]);
  const columns = ["Body", "Mass", "Momentum", "Energy", "Centre of mass off [mm]"];
  return table("Largest drift of the balances", columns, rows, [1, 2, 3, 4]);
}

export function materials(run: Run): HTMLElement {
  const card = (m: Material) =>
    h(
      "article",
      { class: "card" },
      h("h3", {}, m.title || m.name),
      h("p", { class: "note" }, `${m.name}: ${m.bodies.join(", ")}. Sources: ${m.cite.join(", ") || "none named"}.`),
      m.doubt === "" ? null : h("p", { class: "reasons" }, m.doubt),
      ...m.tables
        .filter((t) => t.constants.length > 0)
        .map((t) =>
          h(
            "div",
            {},
            h("h4", {}, `${t.name}: ${t.kind}`),
            table(
              t.name,
              ["Constant", "Value", "Unit", ""],
              t.constants.map((c) => [
                c.name,
                typeof c.value === "number" ? written(c.value, 6) : c.value,
                prettyUnit(c.unit),
                c.doc,
              ]),
              [1],
            ),
          ),
        ),
    );
  return h("div", { class: "cards" }, ...run.materials.map(card));
}

export function sources(run: Run): HTMLElement | null {
  if (run.sources.length === 0) return null;
  const items = run.sources.map((s) => h("li", {}, h("code", {}, s.key), ` ${s.text}`));
  return h("div", {}, h("h3", {}, "Sources"), h("ul", { class: "sources" }, ...items));
}

export function caseText(run: Run): HTMLElement {
  return h(
    "div",
    {},
    changes(run),
    h("pre", { tabindex: "0", "aria-label": "The case" }, run.case),
    h(
      "details",
      {},
      h("summary", {}, "Every value, defaults as well, in SI"),
      h("pre", { tabindex: "0", "aria-label": "The resolved case" }, run.resolved),
    ),
  );
}

/** Numbers of several runs side by side. */
export function comparison(runs: Run[]): HTMLElement {
  const row = (name: string, of: (r: Run) => Node | string): (Node | string)[] => [name, ...runs.map(of)];
  const rows = [
    row("verdict", chips),
    row("cells [mm]", (r) => written(r.cell_mm)),
    row("scheme", (r) => r.scheme),
    row("steps", (r) => String(r.summary?.steps ?? "\u2013")),
    row("cells with matter", (r) => r.summary?.cells ? r.summary.cells.toLocaleString("en") : "\u2013"),
    row("wall time [s]", (r) => written(r.summary?.wall_s, 3)),
    row("drift of energy", (r) => written(r.summary?.budgets["total"]?.energy, 2)),
  ];
  const gauges = new Set(runs.flatMap((r) => Object.keys(r.summary?.gauges ?? {})));
  for (const g of gauges) {
    const any = runs.map((r) => r.summary?.gauges[g]).find((x) => x);
    const name = `${g} ${any?.column ?? ""}`;
    rows.push(row(`${name}, peak [${prettyUnit(any?.unit ?? "")}]`, (r) => written(r.summary?.gauges[g]?.peak, 5)));
    rows.push(row(`${name}, arrival [\u00b5s]`, (r) => written(r.summary?.gauges[g]?.arrival_us, 5)));
  }
  for (const q of new Set(runs.flatMap((r) => Object.keys(r.summary?.expect ?? {}))))
    rows.push(row(q, (r) => {
      const e = r.summary?.expect[q];
      return e ? `${quantity(e.value, e.unit)} ${e.pass ? "\u2713" : "\u2715"}` : "\u2013";
    }));
  const columns = runs.map((_, k) => k + 1);
  return table("Runs side by side", ["", ...runs.map((r) => r.name)], rows, columns);
}
