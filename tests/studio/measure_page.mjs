// How quick the studio's page is in headless Chromium, and whether page and server grow: after 1000 interactions, and after
// the polls of a tab that stays open for 8 hours, time compressed. By hand: node measure_page.mjs DASHPOT
import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";
import {join} from "node:path";
import {chromium} from "playwright-core";
import {make_folder, remove_folder, start} from "./studio.mjs";

const kPollSeconds = 20.65, kPolls = Math.round(8 * 3600 / kPollSeconds);  // studio.js asks again 0.65 s after each wait of 20 s
const kFaster = 100;
const program = process.argv[2], scratch = make_folder(), folder = join(scratch, "project");
const share = (values, part) => [...values].sort((a, b) => a - b)[Math.ceil(part * values.length) - 1];
const said = (values) => `${share(values, 0.5).toFixed(0)} ms (median), ${share(values, 0.99).toFixed(0)} ms (99th percentile of ${values.length})`;

execFileSync(program, ["bench", "--motions", "15x1,10x2,5x3,2x5", "--levels", "0,0.5,1,1.5,2", "--cycles", "3", "--sample-rate", "500", "--output", join(folder, "recordings")], {stdio: "ignore"});
execFileSync(program, ["rank", folder, "--models", "bingham,tanh_kwok,bouc_wen", "--leave-out", "fraction=0.3", "--output", join(folder, "fits", "first")], {stdio: "ignore"});
const studio = await start(program, folder);
const context = await chromium.launchPersistentContext(join(scratch, "profile"), {executablePath: "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--js-flags=--expose-gc"], viewport: {width: 1400, height: 1000}});
const page = await context.newPage(), devtools = await context.newCDPSession(page);
await devtools.send("Performance.enable");
await page.addInitScript((faster) => {
  const real = window.setTimeout;
  window.setTimeout = (act, ms, ...more) => real(act, window.is_compressed ? ms / faster : ms, ...more);
}, kFaster);

// What is left when everything that can go is gone: of the page, and of the server.
async function memory() {
  for (let k = 0; k < 3; ++k) await devtools.send("HeapProfiler.collectGarbage");
  const metrics = Object.fromEntries((await devtools.send("Performance.getMetrics")).metrics.map(({name, value}) => [name, value]));
  const server = Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${studio.child.pid}/status`, "utf8"))[1]) / 1024;
  return `page ${(metrics.JSHeapUsedSize / 2 ** 20).toFixed(1)} MB, ${metrics.Nodes} nodes, ${metrics.JSEventListeners} listeners; server ${server.toFixed(1)} MB`;
}
const tab = (name) => page.getByRole("tab", {name}).click();
const drawn = (title) => page.locator("figure", {has: page.getByRole("heading", {name: title, exact: true})}).locator("canvas, svg").first().waitFor();

// A hundred moves of a slider, one each frame: what the page has until the next frame.
const frames = () => page.getByRole("slider", {name: "Amplitude"}).evaluate(async (input) => {
  const frame = () => new Promise((next) => requestAnimationFrame(next)), found = [];
  let last = await frame();
  for (let k = 0; k < 300; ++k) {
    input.value = 120 + (k * 37) % 160;
    input.dispatchEvent(new Event("input", {bubbles: true}));
    const now = await frame();
    found.push(now - last);
    last = now;
  }
  return found;
});

// One round of what a hand does: each view, a record, a model, a slider, a theme.
async function round(k) {
  await tab("Recordings");
  await page.locator(".list button").nth(k % 20).click();
  await drawn("Force over velocity");
  await tab("Compare");
  await drawn("Force in time");
  await tab("Sliders");
  await page.getByRole("radio").nth(k % 3).check();
  await page.getByRole("slider", {name: "Amplitude"}).press(k % 2 ? "ArrowRight" : "ArrowLeft");
  await page.getByRole("button", {name: "As identified", exact: true}).click();
  await tab("Machine");
  await drawn("Comfort against road holding");
  await page.getByRole("button", {name: k % 2 ? "Light" : "Dark"}).click();
}
const kPerRound = 9;

try {
  const begun = performance.now();
  await page.goto(studio.address);
  await drawn("Force over velocity");
  console.log(`first view of 20 records, from the address to the drawn loops, the recordings read by then: ${(performance.now() - begun).toFixed(0)} ms`);
  const views = await page.evaluate(async (count) => {
    const frame = () => new Promise((next) => requestAnimationFrame(next)), picture = () => document.querySelector("figure canvas")?.toDataURL(), found = [];
    for (let k = 1; k <= count; ++k) {
      const before = picture(), begin = performance.now();
      document.querySelectorAll(".list button")[k % 20].click();
      do await frame(); while (picture() === before && performance.now() - begin < 5000);
      found.push(performance.now() - begin);
    }
    return found;
  }, 100);
  console.log(`another record is on the screen after ${said(views)}`);
  await tab("Sliders");
  await page.getByRole("radio", {name: "first: bouc_wen"}).check();
  await page.getByRole("slider", {name: "alpha_a"}).waitFor();
  console.log(`a frame while a Bouc-Wen model is moved takes ${said(await frames())}`);

  for (let k = 0; k < 20; ++k) await round(k);
  console.log(`memory after ${20 * kPerRound} interactions: ${await memory()}`);
  for (let k = 20; k < 20 + Math.ceil(1000 / kPerRound); ++k) await round(k);
  console.log(`memory after ${(20 + Math.ceil(1000 / kPerRound)) * kPerRound} interactions: ${await memory()}`);

  // News at once instead of after 20 s, each of which makes the page ask for all fits again.
  let version = 1000, polls = 0;
  await tab("Fits");
  await page.route("**/api/changes*", (route) => { ++polls; route.fulfill({json: {version: ++version}}); });
  await page.evaluate(() => { window.is_compressed = true; });
  while (polls < kPolls) await new Promise((done) => setTimeout(done, 200));
  await page.unroute("**/api/changes*");
  console.log(`memory after ${polls} polls more, as in 8 hours: ${await memory()}`);
} finally {
  await context.close();
  await studio.end();
  remove_folder(scratch);
}
