// One story in headless Chromium, from an empty project: recordings are dropped in, a unit is corrected, models are
// fitted and compared; the studio ends with a fit running and finds everything again.
// usage: node story.mjs DASHPOT [FOLDER_FOR_SCREENSHOTS]; exit 77: skipped.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {make_folder, remove_folder, start} from "./studio.mjs";

const kChromium = "/usr/bin/chromium";
const kFlags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

const [program, screenshots] = process.argv.slice(2);
const playwright = await import("playwright-core").catch(() => skip("playwright-core is not in node_modules; run 'npm ci --ignore-scripts'"));
if (!existsSync(kChromium)) skip(`${kChromium} is missing; install chromium`);

// Twenty recordings of the virtual bench, one of which lies about its unit, and a messy folder.
const scratch = make_folder(), folder = join(scratch, "project"), bench = join(scratch, "bench");
execFileSync(program, ["bench", "--motions", "15x1,10x2,5x3,2x5", "--levels", "0,0.5,1,1.5,2", "--cycles", "3", "--sample-rate", "500", "--output", bench], {stdio: "ignore"});
const files = readdirSync(bench).filter((name) => name.endsWith(".csv"));
assert.equal(files.length, 20);
const kFour = ["bingham", "tanh_kwok", "bouc_wen", "biviscous"];
const lying = "5_mm_3_Hz_1_V.csv";
writeFileSync(join(bench, lying), readFileSync(join(bench, lying), "utf8").replace("F_N", "F_kN"));
const messy = join(scratch, "messy");
mkdirSync(messy);
writeFileSync(join(messy, "notes.txt"), "bring the spanner");
writeFileSync(join(messy, "broken.csv"), "t_s,x_mm,F_N\n0,1,2\n0.1,abc,3\n0.2,1,2\n");

let studio = await start(program, folder);
const context = await playwright.chromium.launchPersistentContext(join(scratch, "profile"),
  {executablePath: kChromium, args: kFlags, viewport: {width: 1280, height: 900}, colorScheme: "light"});
const problems = [];
async function open(address) {
  const page = await context.newPage();
  page.on("pageerror", (error) => problems.push(error.stack));
  page.on("console", (message) => { if (message.type() === "error" && !/401|ERR_CONNECTION/.test(message.text())) problems.push(message.text()); });
  page.on("request", (request) => { if (!/^(http:\/\/127\.0\.0\.1:|data:|blob:)/.test(request.url())) problems.push(`asked for ${request.url()}`); });
  page.setDefaultTimeout(60000);
  await page.goto(address);
  await page.waitForSelector("html[data-ready]");
  return page;
}
const shoot = async (page, name) => { if (screenshots) await page.screenshot({path: join(screenshots, `${name}.png`)}); };
const tab = (page, name) => page.getByRole("tab", {name}).click();
const plot = (page, title) => page.locator("figure", {has: page.getByRole("heading", {name: title, exact: true})});

// Whether a curve was drawn: axes and grid are grey, curves are coloured.
const has_ink = (figure) => figure.locator("canvas").evaluate((canvas) => {
  const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let coloured = 0;
  for (let i = 0; i < data.length; i += 4) {
    const rgb = [data[i], data[i + 1], data[i + 2]];
    if (data[i + 3] > 128 && Math.max(...rgb) - Math.min(...rgb) > 60) coloured++;
  }
  return coloured > 150;
});
const until_ink = async (figure) => {
  await figure.locator("canvas").waitFor();
  for (let k = 0; k < 60; ++k) {
    if (await has_ink(figure)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  assert.fail(`no curve in ${await figure.textContent()}`);
};

async function recordings(page) {
  assert.match(await page.locator(".empty").textContent(), /Drop recordings/);
  await shoot(page, "1-empty");
  await page.setInputFiles("#files", [...files.map((name) => join(bench, name)), join(messy, "notes.txt"), join(messy, "broken.csv")]);
  await page.locator(".list li").nth(19).waitFor();
  assert.equal(await page.locator(".list li").count(), 20);
  assert.match(await page.locator(".side").textContent(), /broken\.csv.*abc/s, "what could not be read is said, with its place");
  for (const title of ["Displacement", "Force", "Force over velocity", "Force over displacement"]) await until_ink(plot(page, title));
  await shoot(page, "2-recordings");
}

async function correction(page) {
  await page.locator(".list button", {hasText: "5_mm_3_Hz_1_V"}).click();
  const greatest = async () => {
    await until_ink(plot(page, "Force over velocity"));
    return page.evaluate(() => fetch("/api/recordings").then((r) => r.json()).then((k) => k.columns.find((c) => c.file.endsWith("5_mm_3_Hz_1_V.csv") && c.channel === "force").factor));
  };
  assert.equal(Math.abs(await greatest()), 1000);
  await page.getByLabel("Unit of F_kN").fill("bananas");
  await page.getByRole("button", {name: "Correct"}).click();
  assert.match(await page.locator("[role=alert]").textContent(), /bananas/);
  assert.ok(!existsSync(join(folder, "dataset.yaml")), "a wrong correction changes nothing");
  await page.getByLabel("Unit of F_kN").fill("N");
  assert.match(await page.locator("form .command").textContent(), /--correct recordings\/5_mm_3_Hz_1_V\.csv --set force\.unit=N/);
  await shoot(page, "3-correction");
  await page.getByRole("button", {name: "Correct"}).click();
  await page.locator("form .command").waitFor({state: "detached"});
  assert.equal(Math.abs(await greatest()), 1);
}

// The command that the page shows makes the same file, to the bit.
function same_dataset_file() {
  const theirs = join(scratch, "theirs");
  mkdirSync(join(theirs, "recordings"), {recursive: true});
  for (const name of readdirSync(join(folder, "recordings"))) writeFileSync(join(theirs, "recordings", name), readFileSync(join(folder, "recordings", name)));
  try {
    execFileSync(program, ["inspect", theirs, "--quiet", "--correct", `recordings/${lying}`, "--set", "force.unit=N"], {stdio: "pipe"});
  } catch (error) { assert.equal(error.status, 4, String(error.stderr)); }
  const text = readFileSync(join(theirs, "dataset.yaml"), "utf8").replace("name: theirs", "name: project").replace('name: "theirs"', 'name: "project"');
  assert.equal(readFileSync(join(folder, "dataset.yaml"), "utf8"), text);
}

async function fitting(page) {
  await tab(page, "Fits");
  const checked = page.locator(".checks input:checked");
  while (await checked.count() > 0) await checked.first().uncheck();
  const boxes = page.locator(".checks input");
  for (const model of kFour) await page.locator(`.checks input[value=${model}]`).check();
  assert.ok(await boxes.count() > 20);
  await page.getByLabel("Left out to judge them").selectOption("fraction=0.3");
  await page.getByLabel("Name").fill("four models");
  await page.getByRole("button", {name: /^Fit/}).click();
  await page.locator("progress").waitFor();
  await page.locator("figure canvas").first().waitFor({timeout: 60000});
  await shoot(page, "4-fitting");
  await page.locator("section table").waitFor({timeout: 120000});
  assert.equal(await page.locator("section tbody tr").count(), kFour.length);
  await shoot(page, "5-leaderboard");
  assert.ok(existsSync(join(folder, "fits", "four models", "report.html")));
}

// Models and leaderboard are those of the command line: its kept fits are read again by the same command.
async function same_models(page) {
  const words = JSON.parse(await page.evaluate(() => fetch("/api/fits").then((r) => r.text()))).fits.find((fit) => fit.name === "four models").arguments;
  const own = join(scratch, "own"), at = words.indexOf("--output");
  try {
    execFileSync(program, [...words.slice(0, at), "--output", own, ...words.slice(at + 2)], {stdio: "pipe"});
  } catch (error) { assert.equal(error.status, 4, String(error.stderr)); }
  const plain = (text) => text.replace(/"(command|created)":.*/g, "");
  for (const name of readdirSync(join(own, "models")))
    assert.equal(plain(readFileSync(join(own, "models", name), "utf8")), plain(readFileSync(join(folder, "fits", "four models", "models", name), "utf8")), name);
}

async function comparing(page) {
  await tab(page, "Compare");
  await until_ink(plot(page, "Force in time"));
  for (const title of ["Force over velocity", "Force over displacement", "Measured minus modelled"]) await until_ink(plot(page, title));
  assert.match(await page.locator(".work").textContent(), /dashpot evaluate .*--traces csv/);
  const [download] = await Promise.all([page.waitForEvent("download"), plot(page, "Force over velocity").getByRole("button", {name: "SVG"}).click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /^<svg .*<path clip-path/s);
  await shoot(page, "6-compare");
}

// The studio ends with a fit running; the next one finds everything, and goes on.
async function restart(page) {
  await tab(page, "Fits");
  for (const model of ["modified_bouc_wen", "extended_bingham", "hysteretic_biviscous"]) await page.locator(`.checks input[value=${model}]`).check();
  await page.getByLabel("Name").fill("many");
  await page.getByRole("button", {name: /^Fit/}).click();
  await page.locator("progress").waitFor();
  await studio.end();
  await page.close();
  studio = await start(program, folder);
  const next = await open(studio.address);
  assert.equal(await next.locator(".list li").count(), 20);
  await tab(next, "Fits");
  const many = next.locator("section", {has: next.getByRole("heading", {name: "many"})});
  assert.match(await many.textContent(), /stopped/);
  await many.getByRole("button", {name: "Go on"}).click();
  await many.locator("progress").waitFor();
  await many.getByRole("button", {name: "Stop"}).click();
  await many.getByRole("button", {name: "Go on"}).waitFor();
  assert.ok(await next.locator("section", {hasText: "four models"}).locator("table").count() === 1);
  return next;
}

async function small_and_dark(page) {
  await tab(page, "Recordings");
  await page.getByRole("button", {name: "Dark"}).click();
  await until_ink(plot(page, "Force over velocity"));
  await shoot(page, "7-dark");
  await page.setViewportSize({width: 390, height: 844});
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  const wide = await page.evaluate(() => [...document.querySelectorAll("body *")].filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest(".frame")).map((e) => `${e.tagName}.${e.className}`).slice(0, 8));
  assert.ok(content <= window, `${wide}: the page is ${content} px wide in a window of ${window}`);
  await shoot(page, "8-phone");
}

try {
  const page = await open(studio.address);
  assert.equal(new URL(page.url()).hash, "", "the token leaves the address");
  for (const step of [recordings, correction, same_dataset_file, fitting, same_models, comparing]) {
    const begun = Date.now();
    await step(page);
    console.log(`${step.name}: ${Date.now() - begun} ms`);
  }
  await small_and_dark(await restart(page));
  assert.deepEqual(problems, []);
  console.log("the story was played");
} catch (error) {
  for (const page of context.pages()) console.log((await page.locator("body").innerText().catch(() => "")).slice(-600));
  console.log(problems.join("\n"));
  throw error;
} finally {
  await context.close();
  await studio.end();
  remove_folder(scratch);
}
