// How long a report page takes in Debian's chromium: node measure.mjs PAGE...
// RECOIL_PAGE_FOLDER holds node_modules with playwright-core. Prints the size, the time to the first picture (a page each of
// five, the first one apart) and that of a frame, from the move of the slider to its picture.

import { statSync } from "node:fs";
import { resolve } from "node:path";

import { frameTimes, launched, opened } from "./browser.mjs";

const middle = (times) => times.toSorted((a, b) => a - b)[Math.floor(times.length / 2)];

for (const file of process.argv.slice(2).map((name) => resolve(name))) {
  const browser = await launched();
  const loads = [];
  let frames = [];
  for (let k = 0; k < 5; ++k) {
    const begun = performance.now();
    const { page } = await opened(browser, file);
    loads.push(performance.now() - begun);
    const last = Number(await page.getByRole("slider", { name: "Time" }).getAttribute("max"));
    if (k === 4) frames = await frameTimes(page, Array.from({ length: last }, (_, n) => n));
    await page.close();
  }
  await browser.close();
  const size = (statSync(file).size / 1e6).toFixed(2);
  const [first, ...later] = loads;
  console.log(`${file}: ${size} MB, first picture ${first.toFixed(0)} ms (${middle(later).toFixed(0)} ms again), a frame of`);
  if (frames.length === 0) console.log("  none: there is one frame only");
  else console.log(`  ${frames.length}: ${middle(frames).toFixed(1)} ms in the middle, ${Math.max(...frames).toFixed(1)} ms at most`);
}
