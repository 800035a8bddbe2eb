// The page of a report: which parts it has, for one run or for several.

import { useColours } from "./colours";
import { type Report, type Run, readReport } from "./data";
import { chooser, h, section } from "./dom";
import { type Chart, gaugeCharts, historyChart } from "./gauges";
import { budgets, caseText, chips, comparison, events, fragments, materials, sources, verdict } from "./sections";
import { SolidView } from "./solid_view";
import "./style.css";
import { Viewer } from "./viewer";

function themeButton(): HTMLElement {
  const root = document.documentElement;
  const dark = () =>
    root.dataset["theme"] ? root.dataset["theme"] === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const button = h("button", {
    type: "button",
    click: () => {
      root.dataset["theme"] = dark() ? "light" : "dark";
      button.textContent = dark() ? "Light" : "Dark";
      document.dispatchEvent(new Event("recoil-theme"));
    },
  });
  button.textContent = dark() ? "Light" : "Dark";
  return button;
}

/** All parts that show one run; gauges of the others are drawn with its own. */
function partsOf(run: Run, others: Run[]): HTMLElement[] {
  const viewer = run.fields ? new Viewer(run) : null;
  const solid = run.fields && run.surfaces ? new SolidView(run.fields, run.surfaces) : null;
  const charts: Chart[] = [];
  const show = viewer
    ? (time: number) => {
        viewer.showTime(time);
        document.getElementById("fields")?.scrollIntoView({ behavior: "smooth" });
      }
    : null;
  const history = historyChart(run, others, charts);
  const pieces = fragments(run.fragments);
  const parts = [
    section("verdict", "Verdict", verdict(run)),
    section(
      "fields",
      "Fields",
      viewer?.element ?? h("p", { class: "note" }, "This run has written no fields: see [output.fields] of the case."),
    ),
    solid ? section("solid", "In space", solid.element) : null,
    run.gauges.length > 0 ? section("gauges", "Gauges", gaugeCharts(run, others, charts)) : null,
    section("events", "Events", events(run.events, show)),
    pieces ? section("fragments", "Fragments", pieces) : null,
    section("budgets", "Balances", run.summary ? budgets(run.summary) : null, history),
    section("materials", "Materials", materials(run), sources(run)),
    section("case", "Case", caseText(run)),
  ].filter((part) => part !== null);
  viewer?.onTime((time) => charts.forEach((chart) => chart.setNow(time)));
  if (solid) viewer?.onTime((time) => solid.showTime(time));
  if (viewer) requestAnimationFrame(() => viewer.show(0));
  return parts;
}

function links(parts: HTMLElement[]): HTMLElement {
  const items = parts.map((p) => h("a", { href: `#${p.id}` }, p.querySelector("h2")?.textContent ?? p.id));
  return h("nav", { "aria-label": "Parts" }, ...items);
}

function build(report: Report): void {
  const main = document.getElementById("report");
  const first = report.runs[0];
  if (!main || !first) return;
  const several = report.runs.length > 1;
  document.title = several ? `Recoil: ${report.runs.length} runs` : `${first.title} \u2013 Recoil`;
  const body = h("div");
  const nav = h("div");
  const title = h("h1");
  const state = h("span");
  const showRun = (name: string) => {
    const run = report.runs.find((r) => r.name === name) ?? first;
    const parts = partsOf(run, report.runs.filter((r) => r !== run));
    const compare = several ? [section("runs", "Runs side by side", comparison(report.runs))] : [];
    title.textContent = run.title;
    state.replaceChildren(chips(run));
    body.replaceChildren(...compare, ...parts);
    nav.replaceChildren(links([...compare, ...parts]));
  };
  const options = report.runs.map((r) => ({ value: r.name, text: r.name }));
  const choice = several ? chooser("Run", options, first.name, showRun).element : null;
  main.before(h("header", {}, h("div", { class: "head" }, title, state, choice, themeButton()), nav));
  main.replaceChildren(body, h("footer", {}, `Recoil ${report.version}. This page loads nothing from elsewhere.`));
  showRun(first.name);
}

const report = readReport();
if (report) {
  useColours(report.colours);
  build(report);
}
