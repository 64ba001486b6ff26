// Two browsers at once on one project: whoever comes second is told so, and nothing is half or lost.
// usage: node together.mjs DASHPOT
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {make_folder, open, remove_folder, send, start} from "./studio.mjs";

const program = process.argv[2], scratch = make_folder(), folder = join(scratch, "project");
mkdirSync(folder);
const wave = (k) => "time (s),displacement (mm),force (N)\n" + Array.from({length: 600}, (_, i) =>
  `${i / 200},${(8 * Math.sin(i / 12)).toFixed(4)},${(300 * Math.tanh(4 * Math.cos(i / 12)) + k).toFixed(3)}`).join("\n");
const files = Array.from({length: 6}, (_, k) => `${"abcdef"[k]}_1A.csv`);
for (const [k, name] of files.entries()) writeFileSync(join(folder, name), wave(k));

let studio = await start(program, folder);
const first = await open(studio);
const token = JSON.parse((await send(studio.port, {method: "POST", path: "/api/token", headers: first, body: "{}"})).text).token;
const second = await open({...studio, token});
const browsers = [first, second];
const post = (own, path, body) => send(studio.port, {method: "POST", path, headers: own, body: JSON.stringify(body)});
const get = async (own, path) => JSON.parse((await send(studio.port, {path, headers: own})).text);
// The same request of both at once: their statuses, the lower first.
const both = async (ask) => (await Promise.all(browsers.map(ask))).map((answer) => answer.status).sort();

try {
  // Corrections of six files, three by each browser, all at once: the dataset file has every one of them.
  const corrected = await Promise.all(files.map((file, k) => post(browsers[k % 2], "/api/correct", {file, set: `level=${k / 4}; cut=0:2.5`})));
  assert.deepEqual(corrected.map((answer) => JSON.parse(answer.text)), files.map(() => ({done: true})));
  const text = readFileSync(join(folder, "dataset.yaml"), "utf8");
  for (const file of files) assert.ok(text.includes(file), `${file} in\n${text}`);
  const [one, other] = await Promise.all(browsers.map((own) => get(own, "/api/recordings")));
  assert.deepEqual(one, other);
  assert.deepEqual(one.records.map((record) => record.drive_level).sort(), files.map((_, k) => k / 4));
  const told = JSON.parse(execFileSync(program, ["inspect", folder, "--json", "--quiet"], {encoding: "utf8"}));
  assert.deepEqual(told.records, one.records, "the command line reads the same");
  assert.equal((await get(second, "/api/changes?since=0")).corrections, files.length, "each browser hears of corrections");

  // A browser that knows the records in another order draws the one that it names.
  const greatest = async (name) => Math.max(...(await get(second, `/api/view?${new URLSearchParams({name, x: "time", y: "force"})}`)).y);
  for (const [k, name] of files.entries()) assert.ok(Math.abs(await greatest(name.replace(".csv", "")) - 299.8 - k) < 0.3, name);
  assert.match((await get(second, "/api/view?name=gone&x=time&y=force")).error, /'gone': is no record of this folder/);

  // Two contents under one name: one is taken, whole, and the other refused.
  const contents = [wave(100), wave(200)];
  const sent = await Promise.all(browsers.map((own, k) => send(studio.port, {method: "POST", path: "/api/upload?name=new_1A.csv", headers: {...own, "Content-Type": "application/octet-stream"}, body: contents[k]})));
  assert.deepEqual(sent.map((answer) => answer.status).sort(), [200, 400]);
  assert.equal(readFileSync(join(folder, "recordings", "new_1A.csv"), "utf8"), contents[sent.findIndex((answer) => answer.status === 200)]);

  // One name for a fit, a ride and a design: one of each is begun.
  const vehicle = {plant: "savaresi_spelta", road: "step", duration: 1};
  const request = "damper: passenger_car\nat: {current: 2 A, velocity: 0.3 m/s}\nvary: {gap: {from: 0.6 mm, to: 2 mm}}\ngoals:\n  - {maximise: force}\n  - {minimise: off_force}\n";
  assert.deepEqual(await both((own) => post(own, "/api/fits", {action: "start", name: "same", models: ["bingham"], leave_out: "fraction=0.3"})), [200, 400]);
  assert.deepEqual(await both((own) => post(own, "/api/work/design", {action: "start", name: "same", request, points: 8, generations: 3})), [200, 400]);
  assert.deepEqual(await both((own) => post(own, "/api/work/ride", {action: "start", name: "same", ...vehicle, controllers: ["skyhook"]})), [200, 400]);
  const until_ended = async (path, key) => {
    for (let k = 0; k < 600; ++k) {
      const work = (await get(first, path))[key].find((w) => w.name === "same");
      if (work.state !== "running") return work;
      await new Promise((done) => setTimeout(done, 100));
    }
    assert.fail(`${path} does not end`);
  };
  for (const [path, key] of [["/api/fits", "fits"], ["/api/work/design", "work"], ["/api/work/ride", "work"]]) {
    const work = await until_ended(path, key);
    assert.equal(work.state, "done", JSON.stringify(work));
  }

  // A front goes on from the designs that it has: begun by one of the two.
  assert.deepEqual(await both((own) => post(own, "/api/work/design", {action: "go_on", name: "same"})), [200, 400]);
  const gone_on = await until_ended("/api/work/design", "work");
  assert.equal(gone_on.state, "done", gone_on.message);
  assert.deepEqual(gone_on.arguments.slice(-4), ["--start-from", join(folder, "designs", "same"), "--output", join(folder, "designs", "same")]);
  const ride = await get(second, "/api/result/ride/same");
  assert.deepEqual(ride.controlled.map((one) => one.name), ["skyhook"]);

  // The same drive and the same export of both: the same answer, and an archive that is whole.
  const driven = await Promise.all(browsers.map((own) => post(own, "/api/drive", {...vehicle, damper: "fits/same/models/bingham.json", controller: "skyhook"})));
  assert.deepEqual(driven.map((answer) => answer.status), [200, 200], driven[0].text);
  assert.equal(driven[0].text, driven[1].text);
  const exported = await Promise.all(browsers.map((own) => post(own, "/api/export", {model: "fits/same/models/bingham.json", formats: ["c", "tables"]})));
  assert.deepEqual(exported.map((answer) => answer.status), [200, 200], exported[0].text);
  assert.equal(exported[0].text, exported[1].text);
  const {folder: place, files: written} = JSON.parse(exported[0].text);
  for (const {name, bytes} of written) assert.equal(readFileSync(join(folder, "exports", place, name)).length, bytes, name);

  // All of it is there after a restart, and every note of the studio can be read.
  await studio.end();
  studio = await start(program, folder);
  const again = await open(studio);
  assert.equal((await get(again, "/api/fits")).fits[0].state, "done");
  assert.equal((await get(again, "/api/work/design")).work[0].state, "done");
  for (const results of ["fits", "designs", "rides"]) JSON.parse(readFileSync(join(folder, results, "same", "studio.json"), "utf8"));
  assert.deepEqual(readdirSync(join(folder, ".studio", "incoming")), []);
  console.log("two browsers did not disturb each other");
} finally {
  await studio.end();
  remove_folder(scratch);
}
