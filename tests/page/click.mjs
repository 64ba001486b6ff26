// Opens the example pages from files in headless Chromium and clicks through them.
// usage: node click.mjs EXAMPLE_PAGES_PROGRAM [FOLDER_FOR_SCREENSHOTS]; exit 77: skipped.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {find_browser, has_ink, watch} from "./browser.mjs";

const [program, screenshots] = process.argv.slice(2);
const start_browser = await find_browser();

const folder = mkdtempSync(join(tmpdir(), "dashpot-page-"));
execFileSync(program, [folder]);
const context = await start_browser(join(folder, "profile"));

// Keeps what plots write across: text, and how far it stands out of its canvas to the left and right, px.
function keep_what_is_written() {
  window.written = [];
  const write = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, x, ...rest) {
    const {a, b, e} = this.getTransform(), width = a * this.measureText(text).width;
    const left = e + a * x - width * ({center: 0.5, right: 1, end: 1}[this.textAlign] ?? 0);
    if (b === 0) window.written.push({text, out: Math.max(-left, left + width - this.canvas.width)});
    return write.call(this, text, x, ...rest);
  };
}

// A fresh page that fails the test on any script error and on any request that is not its own file.
async function open(name, options = {}) {
  const page = await context.newPage();
  await page.addInitScript(keep_what_is_written);
  const problems = [];
  watch(page, problems, /^file:\/\//);
  if (options.width) await page.setViewportSize({width: options.width, height: 900});
  await page.emulateMedia({colorScheme: options.scheme ?? "light"});
  await page.goto(pathToFileURL(join(folder, name)).href);
  await page.waitForSelector("html[data-ready]");
  await page.waitForSelector("canvas");
  return {page, done: async () => {
    const title = `${name} ${options.scheme ?? "light"} ${options.width ?? ""}`;
    if (screenshots) await page.screenshot({path: join(screenshots, `${title.trim().replaceAll(" ", "-")}.png`), fullPage: true});
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= window, `${title}: the page is ${content} px wide in a window of ${window}`);
    const remarks = page.locator("tbody tr > :nth-child(n + 4):last-child:not(.number)");
    const squeezed = await remarks.evaluateAll((cells) => cells.filter((cell) => cell.offsetWidth < 150).length);
    assert.equal(squeezed, 0, `${title}: remarks with a word per line`);
    const doubled = await page.locator("figure.plot h3").evaluateAll((titles) => titles.map((one) => one.textContent)
      .filter((text, k) => [...titles[k].closest("section").querySelectorAll("h3")].some((h3) => !h3.closest("figure") && h3.textContent === text)));
    assert.deepEqual(doubled, [], `${title}: the title of a figure stands above its plot once more`);
    const cut = await page.evaluate(() => window.written.filter(({out}) => out > 1).map(({text}) => text));
    assert.deepEqual([...new Set(cut)], [], `${title}: texts of a plot that are cut off`);
    const unnamed = await page.locator("figure.plot .canvas").evaluateAll((plots) => plots.filter((one) => !one.getAttribute("aria-label")).length);
    assert.equal(unnamed, 0, `${title}: plots that a screen reader cannot name`);
    assert.deepEqual(problems, [], title);
    await page.close();
  }};
}

const plot = (page, title) => page.locator("figure.plot", {has: page.getByRole("heading", {name: title, exact: true})});
const first_model = (page) => page.locator("#ranking tbody th").first().textContent();

async function ranking(page) {
  assert.match(await page.locator(".verdict").textContent(), /Modified Bouc-Wen.*worst record/);
  assert.equal(await first_model(page), "Modified Bouc-Wen (Spencer)");
  const esr = page.locator("#ranking thead button", {hasText: /^ESR %$/});
  await esr.click();
  await esr.click();
  assert.equal(await first_model(page), "Bingham", "sorted by falling ESR");
  assert.equal(await page.locator("#ranking th[aria-sort=descending]").count(), 1);
  assert.match(await page.locator("#ranking").textContent(), /1 diverged/);
}

async function choosing(page) {
  await page.locator("#ranking tbody tr", {hasText: "Hyperbolic"}).click();
  assert.equal(await page.locator("#model").inputValue(), "1", "a click on a row chooses its model");
  assert.match(await plot(page, "Force in time").locator(".legend").textContent(), /modelled, fit \d+\.\d %/);
  await page.locator("#model").focus();
  await page.keyboard.press("ArrowDown");
  assert.match(await page.locator("#overview h3", {hasText: "ESR in %"}).textContent(), /Bingham/, "the keyboard chooses too");
  await page.selectOption("#record", "20 mm 2 Hz 1.6 A");
  assert.match(await page.locator(".chosen").first().textContent(), /diverged at 1\.5/);
  assert.equal(await page.locator(".heat", {hasText: "diverged"}).count(), 1);
  await page.selectOption("#model", "0");
  for (const figure of await page.locator("figure.plot").all()) assert.ok(await has_ink(figure), await figure.textContent());
  assert.equal(await page.locator("figure.plot").count(), 8);
}

async function zooming(page) {
  const figure = plot(page, "Force in time"), reset = figure.getByRole("button", {name: "Reset view"});
  await figure.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await figure.locator(".u-over").boundingBox();
  await page.mouse.move(x + 0.5 * width, y + 0.5 * height);
  assert.match(await figure.locator(".readout").textContent(), /Time 1\.\d+ s.*measured.*modelled/);
  assert.ok(!await reset.isVisible());
  await page.mouse.move(x + 0.3 * width, y + 0.3 * height);
  await page.mouse.down();
  await page.mouse.move(x + 0.6 * width, y + 0.7 * height, {steps: 4});
  await page.mouse.up();
  assert.ok(await reset.isVisible(), "a drag zooms");
  await reset.click();
  assert.ok(!await reset.isVisible(), "reset shows everything");
  await figure.locator(".canvas").focus();
  await page.keyboard.press("+");
  assert.ok(await reset.isVisible(), "the keyboard zooms");
  await page.keyboard.press("0");
  assert.ok(!await reset.isVisible());
  const measured = figure.locator(".legend button", {hasText: "measured"});
  await measured.click();
  assert.equal(await measured.getAttribute("aria-pressed"), "false");
  await figure.locator(".legend button", {hasText: "measured"}).click();
}

async function theme(page) {
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.equal(await paper(), "rgb(255, 255, 255)");
  await page.getByRole("button", {name: "Dark"}).click();
  assert.equal(await paper(), "rgb(20, 23, 27)");
  await page.reload();
  await page.waitForSelector("html[data-ready]");
  assert.equal(await paper(), "rgb(20, 23, 27)", "the choice is remembered");
  await page.emulateMedia({media: "print"});
  assert.ok(!await page.locator(".choices select").first().isVisible(), "controls are not printed");
  const record = await page.locator("#record option:checked").textContent();
  assert.equal(await page.locator("#closer .printed").last().innerText(), record, "what they show is");
  await page.emulateMedia({media: "screen"});
  await page.getByRole("button", {name: "Light"}).click();
  await page.evaluate(() => localStorage.clear());
}

// Thirty models: all in the table, the best in the bars, any other one when it is chosen.
async function crowded({page, done}) {
  assert.equal(await page.locator("#ranking tbody tr").count(), 30);
  const bars = plot(page, "Error by speed").locator(".legend button");
  assert.equal(await bars.count(), 5);
  await page.locator("#ranking tbody tr").nth(20).click();
  assert.equal(await bars.count(), 6);
  assert.match(await bars.last().textContent(), /Model number 20/);
  await page.locator("#ranking thead button", {hasText: /^Bounded$/}).click();
  assert.match(await page.locator("#ranking tbody tr").first().textContent(), /yes, 1\.5/);
  await done();
}

// A search: every plot has ink, logarithmic axes read in numbers, the table sorts.
async function search({page, done}) {
  assert.match(await page.locator(".verdict").textContent(), /41 parameters.*smallest network within one standard error/);
  assert.equal(await page.locator("figure.plot").count(), 4);
  for (const figure of await page.locator("figure.plot").all()) assert.ok(await has_ink(figure), await figure.textContent());
  const figure = plot(page, "Error against parameters");
  await figure.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await figure.locator(".u-over").boundingBox();
  await page.mouse.move(x + 0.96 * width, y + 0.96 * height);
  assert.match(await figure.locator(".readout").textContent(), /trials, hidden=10.*Parameters 41.*ESR 2/);
  assert.match(await page.locator("#trials tbody tr").last().textContent(), /failed: <script>alert/, "text stays text");
  await page.locator("#trials thead button", {hasText: /^Par\.$/}).click();
  assert.match(await page.locator("#trials tbody tr").first().textContent(), /smallest, front/);
  await done();
}

// Models that run in the page: handles move by mouse and keyboard, loops follow, and what leaves the data is said.
async function sliders({page, done}) {
  const handle = (name) => page.getByRole("slider", {name, exact: true});
  const picture = (title) => plot(page, title).locator("canvas").evaluate((canvas) => canvas.toDataURL());
  const moves = async (act, what) => {
    const before = await picture("Force over velocity");
    await act();
    await page.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next))));
    assert.notEqual(await picture("Force over velocity"), before, `${what} is seen in the loop`);
  };
  for (const title of ["Force over velocity", "Force over displacement"]) assert.ok(await has_ink(plot(page, title)), title);
  assert.equal(await page.locator(".beyond").textContent(), "");
  const first = await picture("Force over velocity");
  for (const name of ["Current", "Amplitude", "Frequency", "alpha_a"])
    await moves(async () => { await handle(name).focus(); for (let k = 0; k < 20; ++k) await page.keyboard.press("ArrowLeft"); }, name);
  assert.match(await handle("Current").getAttribute("aria-valuetext"), /^0\.847 A$/);
  assert.match(await plot(page, "Force over velocity").locator(".legend").textContent(), /as identified.*as set/);
  await moves(async () => { await handle("Current").focus(); await page.keyboard.press("End"); }, "the greatest current");
  assert.match(await page.locator(".beyond").textContent(), /Outside the data: current 3 A, recorded 0 to 2\. /);
  await moves(() => page.getByRole("button", {name: "As identified", exact: true}).click(), "the reset");
  assert.equal(await page.locator(".beyond").textContent(), "");
  assert.equal(await picture("Force over velocity"), first, "the reset brings the first picture back");
  await moves(() => page.selectOption("#moved", "1"), "another model");
  assert.equal(await page.locator(".slider").count(), 3, "a network has no parameters to be set");
  assert.match(await page.locator("#sliders").textContent(), /Force −[\d.]+ to −?[\d.]+ N; [\d.]+ J (taken out|fed in) in a cycle/);
  await done();
}

// Over a record, whose motion the sliders take; without it they stand in the middle of the data.
async function over({page, done}) {
  const legend = plot(page, "Force over velocity").locator(".legend"), handle = (name) => page.getByRole("slider", {name, exact: true});
  assert.match(await legend.textContent(), /measured.*as set/);
  for (const [name, value] of [["Current", "1 A"], ["Amplitude", "10 mm"], ["Frequency", "2 Hz"]]) assert.equal(await handle(name).getAttribute("aria-valuetext"), value);
  await handle("alpha_a").press("PageUp");
  await page.waitForFunction(() => /measured.*as identified.*as set/.test(document.querySelector("#sliders .legend").textContent));
  await page.selectOption("#moved-over", "");
  await page.waitForFunction(() => !/measured/.test(document.querySelector("#sliders .legend").textContent));
  assert.notEqual(await handle("Frequency").getAttribute("aria-valuetext"), "2 Hz");
  await done();
}

try {
  const report = await open("report.html");
  for (const step of [ranking, choosing, zooming, theme]) await step(report.page);
  await report.done();
  for (const options of [{scheme: "dark"}, {width: 390}]) await (await open("report.html", options)).done();

  await crowded(await open("crowded.html"));

  await search(await open("search.html"));
  await (await open("search.html", {width: 390})).done();

  await sliders(await open("sliders.html"));
  await over(await open("over.html"));
  for (const options of [{scheme: "dark"}, {width: 1056}, {width: 390}]) await (await open("sliders.html", options)).done();

  const curve = await open("curve.html");
  assert.equal(await curve.page.getByRole("img", {name: "Force of a dashpot: force (N) over velocity (m/s)"}).count(), 1);
  const written = (await curve.page.evaluate(() => window.written)).map(({text}) => text);
  for (const text of ["2.0e−9", "4414.510"]) assert.ok(written.includes(text), `${text} among ${written}: ticks of a tiny axis are told apart`);
  await curve.done();
  await (await open("curve.html", {width: 390})).done();

  const inspect = await open("inspect.html");
  await inspect.page.selectOption("#record", "1");
  assert.match(await inspect.page.locator(".warnings").textContent(), /<script>alert/, "text stays text");
  assert.match(await plot(inspect.page, "Velocity").locator(".legend").textContent(), /derived from displacement/);
  await inspect.done();
  console.log("the pages work");
} finally {
  await context.close();
  rmSync(folder, {recursive: true, force: true});
}
