// What tests and measurements of report pages have in common: Debian's chromium, a page in it, its time slider.
// RECOIL_PAGE_FOLDER holds node_modules with playwright-core.

import { createRequire } from "node:module";

const { chromium } = createRequire(`${process.env.RECOIL_PAGE_FOLDER}/package.json`)("playwright-core");
export const FIELD = "canvas[data-part=field]";
const SWITCHES = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"];
const QUIET = ["--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const launched = () => chromium.launch({ executablePath: "/usr/bin/chromium", args: [...SWITCHES, ...QUIET] });

/** Opens a page; `complaints` gathers what must not be: errors, warnings, requests. */
export async function opened(browser, file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  const complaints = [];
  page.on("console", (m) => complaints.push(`console ${m.type()}: ${m.text()}`));
  page.on("pageerror", (e) => complaints.push(`error: ${e.message}`));
  page.on("request", (r) => {
    if (r.url() !== `file://${file}` && !r.url().startsWith("data:")) complaints.push(`request: ${r.url()}`);
  });
  await page.goto(`file://${file}`);
  await page.waitForSelector(`${FIELD}[data-shown]`);
  return { page, complaints };
}

export const waitShown = (page, text) => page.waitForSelector(`${FIELD}[data-shown="${text}"]`, { timeout: 10000 });

export async function slide(page, index) {
  await page.getByRole("slider", { name: "Time" }).fill(String(index));
}

/** The least and largest time of several frames from its choice to its drawing [ms]. */
export async function frameTimes(page, indices) {
  const times = [];
  for (const k of indices) {
    await slide(page, k);
    await waitShown(page, `0 ${k} pressure`);
    times.push(Number(await page.locator(FIELD).getAttribute("data-ms")));
  }
  return times.sort((a, b) => a - b);
}
