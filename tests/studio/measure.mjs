// How quick the studio answers, and what it takes when nobody asks. usage: node tests/studio/measure.mjs DASHPOT [SAMPLES]
import {execFileSync} from "node:child_process";
import {copyFileSync, mkdirSync, openSync, readFileSync, readdirSync, writeSync, closeSync} from "node:fs";
import {join} from "node:path";
import {make_folder, open, remove_folder, send, start} from "./studio.mjs";

const [program, samples] = [process.argv[2], +(process.argv[3] ?? 1e7)];
const scratch = make_folder(), twenty = join(scratch, "twenty"), long = join(scratch, "long");
const quantile = (list, share) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(share * list.length))];
const memory = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]) / 1024;
const cpu = (pid) => readFileSync(`/proc/${pid}/stat`, "utf8").split(" ").slice(13, 15).map(Number).reduce((a, b) => a + b) * 10;
const rest = (ms) => new Promise((done) => setTimeout(done, ms));

async function timed(studio, own, paths) {
  const took = [];
  for (const path of paths) {
    const begun = performance.now();
    const {status} = await send(studio.port, {path, headers: own});
    if (status !== 200) throw new Error(`${path}: ${status}`);
    took.push(performance.now() - begun);
  }
  return `median ${quantile(took, 0.5).toFixed(1)} ms, 99th percentile ${quantile(took, 0.99).toFixed(1)} ms of ${took.length}`;
}

try {
  // Twenty recordings: the first view, 1000 pictures, an idle quarter of a minute.
  execFileSync(program, ["bench", "--motions", "15x1,10x2,5x3,2x5", "--levels", "0,0.5,1,1.5,2", "--cycles", "3", "--sample-rate", "500", "--output", twenty], {stdio: "ignore"});
  let studio = await start(program, twenty), own = await open(studio);
  console.log(`20 records, first view: ${await timed(studio, own, ["/api/recordings"])}`);
  const path = (k) => `/api/view?record=${k % 20}&x=${k % 2 ? "time" : "velocity"}&y=force&width=900`;
  await timed(studio, own, Array.from({length: 50}, (_, k) => path(k)));
  const before = memory(studio.child.pid);
  console.log(`20 records, pictures: ${await timed(studio, own, Array.from({length: 1000}, (_, k) => path(k)))}`);
  console.log(`memory: ${before.toFixed(1)} MB before these, ${memory(studio.child.pid).toFixed(1)} MB after`);
  const drives = [];
  for (let k = 0; k < 100; ++k) {
    const begun = performance.now();
    const {status, text} = await send(studio.port, {method: "POST", path: "/api/drive", headers: own, body: JSON.stringify({plant: "savaresi_spelta", damper: "spencer1997", controller: `mix1,crossover=${1 + k / 50}`, road: "iso8608", duration: 10})});
    if (status !== 200) throw new Error(text);
    drives.push(performance.now() - begun);
  }
  console.log(`drives of 10 s with a modified Bouc-Wen damper: median ${quantile(drives, 0.5).toFixed(0)} ms, 99th percentile ${quantile(drives, 0.99).toFixed(0)} ms of 100`);
  await rest(4000);
  const spent = cpu(studio.child.pid);
  await rest(10000);
  console.log(`idle: ${((cpu(studio.child.pid) - spent) / 100).toFixed(2)} % of a core over 10 s`);
  await studio.end();

  // One long recording: pan and zoom.
  mkdirSync(long);
  const file = openSync(join(long, "long_1A.csv"), "w");
  writeSync(file, "time (s),displacement (mm),force (N)\n");
  for (let k = 0; k < samples;) {
    let text = "";
    for (const end = Math.min(samples, k + 20000); k < end; ++k) text += `${(k * 1e-3).toFixed(3)},${(10 * Math.sin(k * 0.01)).toFixed(3)},${(500 * Math.tanh(20 * Math.cos(k * 0.01))).toFixed(1)}\n`;
    writeSync(file, text);
  }
  closeSync(file);
  studio = await start(program, long);
  own = await open(studio);
  console.log(`${samples} samples, reading: ${await timed(studio, own, ["/api/recordings"])}`);
  const last = samples * 1e-3, views = Array.from({length: 200}, (_, k) => {
    const span = last * 0.5 ** (k % 10), from = (last - span) * ((k * 0.37) % 1);
    return `/api/view?record=0&x=time&y=force&from=${from}&to=${from + span}&width=900`;
  });
  console.log(`${samples} samples, pan and zoom: ${await timed(studio, own, views)}`);
  console.log(`${samples} samples, loops: ${await timed(studio, own, views.slice(0, 50).map((view) => view.replace("x=time", "x=velocity")))}`);
  console.log(`memory: ${memory(studio.child.pid).toFixed(1)} MB`);
  await studio.end();
} finally {
  remove_folder(scratch);
}
