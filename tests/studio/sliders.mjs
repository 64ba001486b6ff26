// The sliders of the studio in headless Chromium: a fitted model moves under the hand, and how long a move takes until it
// is seen. usage: node sliders.mjs DASHPOT [FOLDER_FOR_SCREENSHOTS]; exit 77: skipped.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {find_browser, kStudio, watch} from "../page/browser.mjs";
import {make_folder, remove_folder, start} from "./studio.mjs";

const kMoves = 100, kLongest = 50;  // ms

const [program, screenshots] = process.argv.slice(2);
const start_browser = await find_browser();

// A few recordings of the virtual bench, and three models fitted as the studio fits them.
const scratch = make_folder(), folder = join(scratch, "project");
const run = (...words) => execFileSync(program, words, {stdio: "ignore"});
run("bench", "--motions", "10x1,5x3", "--levels", "0,1,2", "--cycles", "2", "--sample-rate", "200", "--output", join(folder, "recordings"));
run("rank", folder, "--models", "bingham,tanh_kwok,bouc_wen", "--output", join(folder, "fits", "first"));
// And a family of four dampers.
const drawings = join(scratch, "drawings"), dampers = join(scratch, "dampers");
mkdirSync(drawings);
for (const gap of [1, 1.8]) for (const length of [6, 12])
  writeFileSync(join(drawings, `d_${gap}_${length}.yaml`), `name: d_${gap}_${length}\nfluid: 140CG\nbore_diameter: 30 mm\nrod_diameter: 10 mm\ngap: ${gap} mm\npole_length: ${length} mm\npassive_length: 0 mm\ncore_area: 150 mm^2\nfriction: 15 N\n`);
run("bench", "--family", drawings, "--levels", "0,0.5,1.5", "--motions", "20x0.6,8x2", "--cycles", "2", "--sample-rate", "30", "--velocity-sensor", "--zero-drift", "0", "--output", dampers);
run("rank", dampers, "--models", "family_physics", "--leave-out", "each=gap", "--starts", "1", "--force-offset", "none", "--output", join(folder, "fits", "dampers"));
const studio = await start(program, folder);
const context = await start_browser(join(scratch, "profile"));
const problems = [];
const page = await context.newPage();
watch(page, problems, kStudio);
page.setDefaultTimeout(30000);

const plot = (title) => page.locator("figure", {has: page.getByRole("heading", {name: title, exact: true})});
const handle = (name) => page.getByRole("slider", {name, exact: true});
const picture = () => plot("Force over velocity").locator("canvas").evaluate((canvas) => canvas.toDataURL());
async function moves(act, what) {
  const before = await picture();
  await act();
  await page.waitForTimeout(100);
  assert.notEqual(await picture(), before, `${what} is seen in the loop`);
}

// ms from a move of the handle to the first frame with another picture, many times.
const latencies = (name) => handle(name).evaluate(async (input, count) => {
  const canvas = document.querySelector("figure canvas"), ink = () => {
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 52) sum = (sum * 31 + data[i]) | 0;
    return sum;
  };
  const frame = () => new Promise((next) => requestAnimationFrame(next));
  const found = [];
  for (let k = 0; k < count; ++k) {
    const before = ink();
    await frame();
    const begin = performance.now();
    input.value = 120 + 160 * ((k * 37) % count) / count;
    input.dispatchEvent(new Event("input", {bubbles: true}));
    do await frame(); while (ink() === before && performance.now() - begin < 1000);
    found.push(performance.now() - begin);
  }
  return found;
}, kMoves);
const share = (values, part) => [...values].sort((a, b) => a - b)[Math.ceil(part * values.length) - 1];

try {
  await page.goto(studio.address);
  await page.waitForSelector("html[data-ready]");
  await page.getByRole("tab", {name: "Sliders"}).click();
  await page.getByRole("radio", {name: "first: bouc_wen"}).check();
  await handle("alpha_a").waitFor();
  const legend = plot("Force over velocity").locator(".legend");
  await legend.getByText("measured").waitFor();
  assert.match(await legend.textContent(), /measured.*90 % band.*as set/);
  // The sliders come to stand where the record has them, a moment after it is shown.
  await handle("Frequency").and(page.locator('[aria-valuetext="1 Hz"], [aria-valuetext="5 Hz"]')).waitFor();
  assert.equal(await page.locator(".beyond").textContent(), "", "the view opens within the data");

  // Every sort of slider, by the keyboard; what leaves the data is said; and back.
  const first = await picture();
  for (const [name, key, times] of [["Voltage", "ArrowRight", 20], ["Amplitude", "ArrowUp", 20], ["Frequency", "ArrowLeft", 20], ["alpha_b", "PageUp", 4]])
    await moves(async () => { await handle(name).focus(); for (let k = 0; k < times; ++k) await page.keyboard.press(key); }, name);
  if (screenshots) await page.screenshot({path: join(screenshots, "sliders.png")});
  await moves(async () => { await handle("Frequency").focus(); await page.keyboard.press("End"); }, "the greatest frequency");
  assert.match(await page.locator(".beyond").textContent(), /Outside the data: .*speed to \d+ mm\/s, recorded −[\d.]+ to [\d.]+\. /);
  if (screenshots) await page.screenshot({path: join(screenshots, "sliders-beyond.png")});
  await moves(() => page.getByRole("button", {name: "As identified", exact: true}).click(), "the reset");
  assert.equal(await picture(), first, "the reset brings the first picture back");
  assert.match(await page.locator(".command").textContent(), /dashpot export .*bouc_wen\.json --to js/);

  // What else the machine does slows most moves: a tenth of them must be quick.
  const found = await latencies("Amplitude");
  console.log(`a move is seen after ${share(found, 0.5).toFixed(0)} ms (median), ${share(found, 0.99).toFixed(0)} ms (99th percentile of ${kMoves})`);
  assert.ok(share(found, 0.1) <= kLongest, `a move is seen after ${found.map(Math.round)} ms`);

  // Another record moves the sliders; without one they stay within the data.
  await moves(() => page.getByLabel("Measured record").selectOption({index: 5}), "another record");
  await legend.getByText("measured").waitFor();
  await page.getByLabel("Measured record").selectOption({label: "no record"});
  await legend.getByText("measured").waitFor({state: "detached"});
  assert.equal(await page.locator(".beyond").textContent(), "");

  // A fit that begins where a hand has moved a law: the start is a model file, and the command line makes the same of it.
  await page.getByRole("radio", {name: "first: bingham"}).check();
  await page.getByRole("heading", {name: "Bingham", exact: true}).waitFor();
  assert.ok(await page.getByRole("button", {name: "Fit from here"}).isDisabled(), "there is nothing to fit from yet");
  await moves(() => handle("f_c_a").press("PageUp"), "f_c_a");
  const moved = await handle("f_c_a").getAttribute("aria-valuetext");
  await page.getByRole("button", {name: "Fit from here"}).click();
  const section = page.locator("section", {has: page.getByRole("heading", {name: "bingham from here"})});
  await section.getByText("done", {exact: true}).waitFor({timeout: 60000});
  assert.match(await section.locator(".command").textContent(), /dashpot rank .*--models bingham --from .*start\.json.* --starts 1/);
  const place = join(folder, "fits", "bingham from here"), own = join(scratch, "own");
  const first_of = (file) => JSON.parse(readFileSync(file, "utf8")).model.parameters.f_c.coefficients[0];
  assert.equal(`${+first_of(join(place, "start.json")).toPrecision(3)} N`, moved);
  assert.notEqual(first_of(join(place, "start.json")), first_of(join(folder, "fits", "first", "models", "bingham.json")));
  run("rank", folder, "--models", "bingham", "--from", join(place, "start.json"), "--starts", "1", "--output", own);
  const plain = (text) => text.replace(/"(command|created)":.*/g, "");
  assert.deepEqual(readdirSync(join(place, "models")), ["bingham.json"]);
  assert.equal(plain(readFileSync(join(own, "models", "bingham.json"), "utf8")), plain(readFileSync(join(place, "models", "bingham.json"), "utf8")));
  await page.getByRole("tab", {name: "Sliders"}).click();

  // A family: its damper's numbers, the physics beside it, and what lies beyond its dampers.
  await page.getByRole("radio", {name: "dampers: family_physics"}).check();
  await handle("gap").waitFor();
  assert.match(await legend.textContent(), /plate flow alone.*90 % band.*as set/);
  for (const name of ["gap", "pole length", "viscosity", "yield stress", "build"])
    await moves(async () => { await handle(name).focus(); for (let k = 0; k < 3; ++k) await page.keyboard.press("PageUp"); }, name);
  await moves(async () => { await handle("gap").focus(); await page.keyboard.press("Home"); }, "the least gap");
  assert.match(await page.locator(".beyond").textContent(), /gap 0\.6 mm, dampers of the fit 1 to 1\.8/);
  if (screenshots) await page.screenshot({path: join(screenshots, "sliders-family.png"), fullPage: true});

  // Another model; the sizes and themes that people have.
  await page.getByRole("radio", {name: "first: bingham"}).check();
  await page.getByRole("heading", {name: "Bingham", exact: true}).waitFor();
  await page.getByRole("radio", {name: "first: bouc_wen"}).check();
  await handle("alpha_a").waitFor();
  for (const [theme, width] of [["light", 1400], ["dark", 1400], ["light", 1056], ["light", 390], ["dark", 390]]) {
    await page.setViewportSize({width, height: 1000});
    await page.evaluate((name) => { if (document.documentElement.dataset.theme !== name) [...document.querySelectorAll("button")].find((b) => ["Light", "Dark"].includes(b.textContent)).click(); }, theme);
    await page.waitForTimeout(200);
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= window, `the page is ${content} px wide in a window of ${window}`);
    if (screenshots) await page.screenshot({path: join(screenshots, `sliders-${theme}-${width}.png`), fullPage: true});
  }

  assert.deepEqual(problems, []);
  console.log("the sliders work");
} finally {
  await context.close();
  await studio.end();
  remove_folder(scratch);
}
