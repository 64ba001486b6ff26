// One story in headless Chromium, from an empty project: recordings are chosen and dropped in, a unit is corrected,
// models are fitted, compared, moved by sliders, driven in a car and exported, a damper is designed; the studio ends with
// a fit running and finds everything again.
// usage: node story.mjs DASHPOT [FOLDER_FOR_SCREENSHOTS]; exit 77: skipped.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {cpSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {check_reach} from "./reach.mjs";
import {find_browser, has_ink, kStudio, watch} from "../page/browser.mjs";
import {make_folder, remove_folder, start} from "./studio.mjs";

const [program, screenshots] = process.argv.slice(2);
const start_browser = await find_browser();

// Twenty recordings of the virtual bench, one of which lies about its unit, and a messy folder.
const scratch = make_folder(), folder = join(scratch, "project"), bench = join(scratch, "bench");
execFileSync(program, ["bench", "--motions", "15x1,10x2,5x3,2x5", "--levels", "0,0.5,1,1.5,2", "--cycles", "3", "--sample-rate", "500", "--output", bench], {stdio: "ignore"});
const files = readdirSync(bench).filter((name) => name.endsWith(".csv"));
assert.equal(files.length, 20);
const kFour = ["bingham", "tanh_kwok", "bouc_wen", "modified_bouc_wen"];  // the last takes its time
const lying = "5_mm_3_Hz_1_V.csv";
writeFileSync(join(bench, lying), readFileSync(join(bench, lying), "utf8").replace("F_N", "F_kN"));
const messy = join(scratch, "messy");
mkdirSync(messy);
mkdirSync(folder);
writeFileSync(join(messy, "notes.txt"), "bring the spanner");
mkdirSync(join(messy, "deep", ".hidden"), {recursive: true});
writeFileSync(join(messy, "deep", ".hidden", "secret.csv"), "t_s,x_mm,F_N\n0,1,2\n");
writeFileSync(join(messy, "broken.csv"), "t_s,x_mm,F_N\n0,1,2\n0.1,abc,3\n0.2,1,2\n");

let studio = await start(program, folder);
const context = await start_browser(join(scratch, "profile"));
const problems = [];
async function open(address) {
  const page = await context.newPage();
  watch(page, problems, kStudio, /401|ERR_CONNECTION/);
  page.setDefaultTimeout(60000);
  await page.goto(address);
  await page.waitForSelector("html[data-ready]");
  return page;
}
const shoot = async (page, name) => { if (screenshots) await page.screenshot({path: join(screenshots, `${name}.png`)}); };
const tab = (page, name) => page.getByRole("tab", {name}).click();
const plot = (page, title) => page.locator("figure", {has: page.getByRole("heading", {name: title, exact: true})});

const until_ink = async (figure) => {
  await figure.locator("canvas").waitFor();
  for (let k = 0; k < 60; ++k) {
    if (await has_ink(figure)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  assert.fail(`no curve in ${await figure.textContent()}`);
};

// Drags these files and folders from outside into the page, as a hand does.
async function drop(page, paths) {
  const box = await page.locator(".drop").boundingBox(), session = await context.newCDPSession(page);
  const at = {x: box.x + box.width / 2, y: box.y + box.height / 2, data: {items: [], files: paths, dragOperationsMask: 1}};
  for (const type of ["dragEnter", "dragOver", "drop"]) await session.send("Input.dispatchDragEvent", {type, ...at});
  await session.detach();
}

async function recordings(page) {
  assert.match(await page.locator(".empty").textContent(), /Drop recordings/);
  await shoot(page, "1-empty");
  await page.setInputFiles("#files", files.slice(0, 15).map((name) => join(bench, name)));
  await page.locator(".list li").nth(14).waitFor();
  await drop(page, [...files.slice(15).map((name) => join(bench, name)), messy]);
  await page.locator(".list li").nth(19).waitFor();
  await page.getByText("1 not read").waitFor();
  assert.ok(existsSync(join(folder, "recordings", "messy", "notes.txt")), "a folder keeps its names");
  assert.ok(!existsSync(join(folder, "recordings", "messy", "deep")), "what is hidden stays out");
  assert.equal(await page.locator(".list li").count(), 20);
  assert.match(await page.locator(".side").textContent(), /broken\.csv.*abc/s, "what could not be read is said, with its place");
  for (const title of ["Displacement", "Force", "Force over velocity", "Force over displacement"]) await until_ink(plot(page, title));
  await shoot(page, "2-recordings");
}

// Ticks that hardly differ are told apart, and rounding alone is no range.
async function axes(page) {
  const [texts, room, places, range] = await page.evaluate(() => import("/plot.js").then(({tick_text, tick_width, nice_ticks, extent}) =>
    [[[4414.5, 4414.50005], [120010, 120020], [1e-6, 1.05e-6], [0, 0.25, 0.5]].map(tick_text), tick_width(["4414.50005"]),
      nice_ticks(4414.5, 4414.5 + 2 ** -40).length, extent([[1, 1 + 2 ** -52]])]));
  assert.deepEqual(texts, [["4414.50000", "4414.50005"], ["1.2001e+5", "1.2002e+5"], ["1.00e-6", "1.05e-6"], ["0.00", "0.25", "0.50"]]);
  assert.ok(room > 80, `${room} px`);
  assert.ok(places <= 60, `${places} ticks`);
  assert.ok(range[1] - range[0] > 0.05, `${range}`);
}

async function correction(page) {
  await page.locator(".list button", {hasText: "5_mm_3_Hz_1_V"}).click();
  const greatest = async () => {
    await until_ink(plot(page, "Force over velocity"));
    return page.evaluate(() => import("/ask.js").then(({ask}) => ask("/api/recordings")).then((k) => k.columns.find((c) => c.file.endsWith("5_mm_3_Hz_1_V.csv") && c.channel === "force").factor));
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
  cpSync(join(folder, "recordings"), join(theirs, "recordings"), {recursive: true});
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
  assert.match(await page.locator(".moving").first().textContent(), /^\w+.*: .* = /, "parameters are shown as they move");
  await shoot(page, "4-fitting");
  await page.locator("section table").waitFor({timeout: 120000});
  const first = await page.locator("section tbody tr").count();
  assert.ok(first < kFour.length, `a model stands in the leaderboard when it ends, not with the last: ${first}`);
  await page.getByRole("link", {name: "Report"}).waitFor({timeout: 120000});
  await page.locator("section progress").waitFor({state: "detached"});
  assert.equal(await page.locator("section tbody tr").count(), kFour.length);
  await shoot(page, "5-leaderboard");
  assert.ok(existsSync(join(folder, "fits", "four models", "report.html")));
}

// Models and report are those of the command line, to the bit but for when and how fast they were made.
async function same_models(page) {
  const words = (await page.evaluate(() => import("/ask.js").then(({ask}) => ask("/api/fits")))).fits.find((fit) => fit.name === "four models").arguments;
  const own = join(scratch, "own"), at = words.indexOf("--output");
  try {
    execFileSync(program, [...words.slice(0, at), "--output", own, ...words.slice(at + 2)], {stdio: "pipe"});
  } catch (error) { assert.equal(error.status, 4, String(error.stderr)); }
  const plain = (text) => text.replace(/"(command|created)":.*/g, "");
  for (const name of readdirSync(join(own, "models")))
    assert.equal(plain(readFileSync(join(own, "models", name), "utf8")), plain(readFileSync(join(folder, "fits", "four models", "models", name), "utf8")), name);
  const kOfTime = ["date", "command", "created", "wall_seconds", "seconds", "nanoseconds_per_step"];
  const report = (place) => JSON.stringify(JSON.parse(readFileSync(join(place, "report.json"), "utf8")), (key, value) => kOfTime.includes(key) ? undefined : value);
  assert.equal(report(own), report(join(folder, "fits", "four models")));
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

// A slider is moved, and its loop moves within 50 ms, beside the measured one: of several moves the quickest counts, since
// the machine has other work.
async function sliding(page) {
  await tab(page, "Sliders");
  await page.getByRole("radio", {name: "four models: bouc_wen"}).check();
  await page.locator(".legend", {hasText: "measured"}).first().waitFor();
  await until_ink(plot(page, "Force over velocity"));
  const took = await page.getByRole("slider", {name: "Amplitude"}).evaluate(async (input) => {
    const picture = () => document.querySelector("figure canvas").toDataURL(), frame = () => new Promise((next) => requestAnimationFrame(next)), found = [];
    for (let k = 0; k < 12; ++k) {
      const before = picture(), begin = performance.now();
      input.value = +input.value + (k % 2 ? -20 : 20);
      input.dispatchEvent(new Event("input", {bubbles: true}));
      for (let now = await frame(); ; now = await frame()) if (picture() !== before || now - begin > 5000) break;
      found.push(performance.now() - begin);
    }
    return found;
  });
  assert.ok(Math.min(...took) <= 50, `a move is seen after ${took} ms`);
  await shoot(page, "6b-sliders");
}

// A project's model in a quarter car beside another one: what the page shows is what the command says.
async function driving(page) {
  await tab(page, "Machine");
  const damper = (k) => page.locator(".one-damper").nth(k);
  const driven = async (act) => {
    const [response] = await Promise.all([page.waitForResponse((r) => r.url().endsWith("/api/drive") && r.request().method() === "POST"), act()]);
    const got = await response.json();
    assert.equal(response.status(), 200, got.error);
    return got;
  };
  await until_ink(plot(page, "Body acceleration"));
  assert.equal(await page.getByLabel("Plant: sprung mass, as a number").getAttribute("placeholder"), "400", "the set's own number, not its kind's");
  const first = await driven(() => damper(0).locator("select").first().selectOption("fits/four models/models/tanh_kwok.json"));
  const own = JSON.parse(execFileSync(program, [...first.arguments, "--json", "--quiet"], {encoding: "utf8", stdio: ["ignore", "pipe", "ignore"]}));
  for (const part of ["plant", "ground", "run", "against"]) assert.deepEqual(first[part], own[part], part);
  await driven(() => damper(1).locator("select").first().selectOption("fits/four models/models/bingham.json"));
  await page.locator(".legend", {hasText: "B"}).first().waitFor();

  // A slider of a controller is moved by the keyboard, and each step is driven.
  await driven(() => damper(1).locator("select").nth(1).selectOption("mix1"));
  const points = page.locator("figure", {has: page.getByRole("heading", {name: "Comfort against road holding"})}).locator("circle");
  const slider = damper(1).locator("input[type=range]").first();
  await slider.focus();
  const moved = await driven(() => slider.press("ArrowRight"));
  assert.match(moved.arguments.join(" "), /mix1,crossover=/);
  await page.locator("table th", {hasText: "passive"}).waitFor();
  for (const title of ["Body acceleration", "Tyre load", "Damper force", "The damper at work"]) await until_ink(plot(page, title));
  assert.ok(await points.count() >= 5, "every drive leaves a point");
  await shoot(page, "7-machine");

  // A step; and what cannot be is said.
  const step = await driven(() => page.locator(".side > .field", {hasText: /^Road/}).locator("select").selectOption("step"));
  assert.ok(step.run.measures.some((measure) => measure.name === "settling"));
  await page.getByRole("cell", {name: "settling", exact: true}).waitFor();
  const before = problems.length;
  await damper(1).locator("input:not([type])").first().fill("fast");
  assert.match(await page.locator("[role=alert]").first().textContent(), /B: .*fast/s);
  await damper(1).locator("input:not([type])").first().fill("1.5");
  await page.locator("[role=alert]").waitFor({state: "detached"});
  const duration = page.getByLabel("Drive: duration, as a number");
  await duration.fill("20 s");
  assert.match(await page.locator("[role=alert]").first().textContent(), /'duration' is text, not a number/);
  await duration.fill("2");
  await page.locator("[role=alert]").first().waitFor({state: "detached"});
  assert.match(await page.locator(".work").textContent(), /savaresi_spelta are an example: recalled/, "what the command says of its numbers");
  for (const refused of problems.splice(before)) assert.match(refused, /status of 400/);

  // All controllers ride in the background, and can be stopped.
  await page.getByRole("button", {name: "Ride them with damper A"}).click();
  await page.locator("section progress").waitFor();
  await page.locator("section").getByRole("button", {name: "Stop"}).click();
  await page.getByRole("button", {name: "Ride again"}).waitFor();
}

// A front of designs is that of the command line, to the bit; one of it is picked and driven.
async function designing(page) {
  await tab(page, "Design");
  await page.getByLabel("Least value of gap").fill("0.7 mm");
  await page.getByLabel("Values of fluid").fill("122EG, 140CG");
  await page.getByLabel("Designs", {exact: true}).fill("12");
  await page.getByLabel("Generations").fill("4");
  await page.getByLabel("Name of its folder").fill("car");
  await page.getByRole("button", {name: "Search", exact: true}).click();
  const front = page.locator("figure", {has: page.getByRole("heading", {name: /^The front/})});
  await front.waitFor({timeout: 120000});
  const place = join(folder, "designs", "car"), own = join(scratch, "own-design");
  assert.match(readFileSync(join(place, "request.yaml"), "utf8"), /^damper: passenger_car$[^]*^ {2}gap: \{from: 0\.7 mm, to: 2 mm\}$/m);
  execFileSync(program, ["design", join(place, "request.yaml"), "--points", "12", "--generations", "4", "--seed", "1", "--output", own], {stdio: "ignore"});
  assert.equal(readFileSync(join(own, "design.csv"), "utf8"), readFileSync(join(place, "design.csv"), "utf8"));

  const title = page.locator("section h3", {hasText: /^design_\d+/});
  const knee = await title.textContent();
  await front.locator(".canvas").focus();
  for (const key of ["ArrowLeft", "ArrowRight"]) if (await title.textContent() === knee) {
    await page.keyboard.press(key);
    await new Promise((done) => setTimeout(done, 200));
  }
  assert.notEqual(await title.textContent(), knee, "another design is picked");
  const name = /^design_\d+/.exec(await title.textContent())[0];
  const result = JSON.parse(readFileSync(join(place, "design.json"), "utf8")), design = result.designs.find((d) => d.name === name);
  assert.match(result.notes.join(), /is recalled, not from its data sheet/);
  for (const note of result.notes) assert.ok((await page.locator("section").first().textContent()).includes(note), "what is to be known of the designs is shown");
  assert.match(await page.locator("section").first().textContent(), new RegExp(String(+design.goals[1].toPrecision(4)).replace(".", "\\.")), "its mass is shown");
  await shoot(page, "8-design");
  await page.getByRole("button", {name: "Drive it"}).click();
  await until_ink(plot(page, "Damper force"));
  assert.match(await page.locator(".work .command").first().textContent(), new RegExp(`designs/car/models/${name}\\.json`));
}

// A model becomes an FMU and C, which are those of the command line, and comes as one archive.
async function exporting(page) {
  await tab(page, "Export");
  await page.locator(".side .field select").first().selectOption("fits/four models/models/bouc_wen.json");
  await page.locator(".checks input[value=c]").check();
  await page.locator(".checks input[value=fmu3]").check();
  await page.getByRole("button", {name: "Export", exact: true}).click();
  await page.locator("section table").waitFor();
  const place = join(folder, "exports", "four models, bouc_wen"), names = readdirSync(place);
  for (const ending of [".c", ".h", "_fmi3.fmu", "report.html"]) assert.ok(names.some((name) => name.endsWith(ending)), ending);
  const [archive] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", {name: "All as a zip"}).click()]);
  assert.equal(archive.suggestedFilename(), "four models, bouc_wen.zip");
  const bytes = readFileSync(await archive.path());
  assert.equal(bytes.subarray(0, 4).toString("latin1"), "PK\x03\x04");
  const fmu = names.find((name) => name.endsWith(".fmu"));
  for (const name of [fmu, "report.html"]) assert.ok(bytes.includes(name), name);
  const [single] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", {name: fmu}).click()]);
  assert.deepEqual(readFileSync(await single.path()), readFileSync(join(place, fmu)));

  const own = join(scratch, "own-export"), of_command = (text) => text.replace(/^.*dashpot export.*$/gm, "");
  execFileSync(program, ["export", join(folder, "fits", "four models", "models", "bouc_wen.json"), "--to", "c", "--output", own], {stdio: "ignore"});
  for (const name of readdirSync(own)) assert.equal(of_command(readFileSync(join(own, name), "utf8")), of_command(readFileSync(join(place, name), "utf8")), name);
  await shoot(page, "9-export");
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

  // Designs, rides and exports are there as well.
  await tab(next, "Design");
  await next.getByRole("heading", {name: /^The front/}).waitFor();
  await tab(next, "Machine");
  await next.locator("section h3", {hasText: "ride-1"}).waitFor();
  await until_ink(plot(next, "Body acceleration"));
  await tab(next, "Export");
  await next.getByRole("link", {name: "All as a zip"}).waitFor();
  return next;
}

// A level that is corrected gives a record another place in the list; it stays the one that is looked at.
async function reordering(page) {
  await tab(page, "Recordings");
  const chosen = page.locator(".list button", {hasText: "5_mm_3_Hz_0_V"});
  await chosen.click();
  await page.getByLabel("Drive level").fill("3");
  await page.getByRole("button", {name: "Correct"}).click();
  await page.locator(".list button[aria-current=true]", {hasText: /5_mm_3_Hz_0_V.*3 V/}).waitFor();
}

async function small_and_dark(page) {
  for (const view of ["Recordings", "Fits", "Compare", "Sliders", "Machine", "Design", "Export"]) {
    await tab(page, view);
    await page.locator("main .work").waitFor();
    console.log(await check_reach(page, view));
  }
  await tab(page, "Recordings");
  await page.getByRole("button", {name: "Dark"}).click();
  await until_ink(plot(page, "Force over velocity"));
  await check_reach(page, "Recordings in the dark");
  await shoot(page, "10-dark");
  await page.setViewportSize({width: 390, height: 844});
  for (const view of ["Machine", "Design", "Export", "Recordings"]) {
    await tab(page, view);
    await page.locator("main .work").waitFor();
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    const wide = await page.evaluate(() => [...document.querySelectorAll("body *")].filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest(".frame")).map((e) => `${e.tagName}.${e.className}`).slice(0, 8));
    assert.ok(content <= window, `${view}, ${wide}: the page is ${content} px wide in a window of ${window}`);
  }
  await shoot(page, "11-phone");
}

try {
  const page = await open(studio.address);
  assert.equal(new URL(page.url()).hash, "", "the token leaves the address");
  for (const step of [recordings, axes, correction, same_dataset_file, fitting, same_models, comparing, sliding, driving, designing, exporting]) {
    const begun = Date.now();
    await step(page);
    console.log(`${step.name}: ${Date.now() - begun} ms`);
  }
  const last = await restart(page);
  await reordering(last);
  await small_and_dark(last);
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
