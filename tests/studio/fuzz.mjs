// Attacks the studio with requests changed by chance; by hand, since 10^6 take minutes.
// usage: node fuzz.mjs DASHPOT [REQUESTS] [SEED]
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from "node:fs";
import {connect} from "node:net";
import {join} from "node:path";
import {make_folder, open, remove_folder, send, start} from "./studio.mjs";

const [program, requests, seed] = [process.argv[2], +(process.argv[3] ?? 1e6), +(process.argv[4] ?? 1)];
const outside = make_folder(), folder = join(outside, "project");
mkdirSync(folder);
writeFileSync(join(folder, "run_1A.csv"), "time (s),displacement (mm),force (N)\n" +
  Array.from({length: 400}, (_, k) => `${k / 100},${(5 * Math.sin(k / 10)).toFixed(3)},${(300 * Math.cos(k / 10)).toFixed(1)}`).join("\n"));
writeFileSync(join(outside, "secret"), "hush");
// A fitted model, so that requests for one get as far as they can.
execFileSync(program, ["rank", folder, "--models", "bingham", "--leave-out", "fraction=0.3", "--output", join(folder, "fits", "x")], {stdio: "ignore"});

let state = seed >>> 0;
const random = (n) => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return Math.floor(state / 2 ** 32 * n); };
const one_of = (list) => list[random(list.length)];
const studio = await start(program, folder);
let died = false, answers = 0;
const statuses = new Map();
studio.child.once("exit", () => { died = true; });
const own = await open(studio);
await send(studio.port, {path: "/api/recordings", headers: own});

const nasty = ["..", "../", "%2e%2e%2f", "%00", "\0", "/etc/passwd", "secret", "-1", "1e309", "nan", "9".repeat(400), "{", "[[[[", "\"", "$(id)", ";id", "\r\n", "\xff\xfe", "x".repeat(3000), "", "--output", "&", "=", "%", "%f"];
const paths = ["/", "/studio.js", "/api/fits", "/api/recordings", "/api/models", "/api/fitted", "/report/x", "/api/session", "/api/token", "/api/upload?name=a.csv",
  "/api/view?record=0&x=time&y=force&from=0&to=1&width=100", "/api/view?record=0&x=velocity&y=force&width=9", "/api/traces?model=fits%2Fx%2Fmodels%2Fbingham.json", "/api/module?model=fits%2Fx%2Fmodels%2Fbingham.json",
  "/api/drive", `/api/driven?key=${"0".repeat(32)}&record=0&x=time&y=body`, "/api/machine", "/api/dampers", "/api/design", "/api/work/design", "/api/work/ride", "/api/result/design/x", "/report/design/x",
  "/api/export", "/api/exports", "/api/exported?folder=x&file=y", "/api/formats", "/api/correct", "/api/costs", "/api/changes?since=0", "/api/result/ride/x", "/loops.js", "/licences.txt"];
const bodies = ["{}", `{"token":"x"}`, `{"action":"stop","name":"x"}`, `{"action":"start","name":"","models":["x"]}`, `{"action":"go_on","name":"../x"}`,
  `{"plant":"savaresi_spelta","road":"step","duration":0.2}`, `{"plant":"savaresi_spelta","road":"iso8608,class=C","damper":"fits/x/models/bingham.json","settings":"motion_ratio=0.7"}`,
  `{"action":"start","name":"../x","request":"damper: passenger_car"}`, `{"model":"fits/x/models/bingham.json","formats":["c"],"name":"x"}`,
  `{"action":"start","name":"../x","models":["bingham"],"from":{"model":"fits/x/models/bingham.json","parameters":{"f_c_a":900}}}`, `{"action":"start","name":"x","models":["bingham"],"from":{"model":"../secret","parameters":{"x":1e309}}}`,
  `{"file":"../secret","set":"force.unit=kN"}`, `{"file":"run_1A.csv","set":"level=2; cut=0.5:3"}`, `{"action":"start","name":"x","plant":"savaresi_spelta","controllers":["skyhook"],"road":"step"}`];
const heads = Object.entries(own).map(([name, value]) => `${name}: ${value}`);

function changed(text) {
  for (let k = random(3); k > 0; --k) {
    const at = random(text.length + 1), end = at + random(6);
    text = one_of([() => text.slice(0, at) + one_of(nasty) + text.slice(at), () => text.slice(0, at) + text.slice(end),
      () => text.slice(0, at) + String.fromCharCode(random(256)) + text.slice(at + 1)])();
  }
  return text;
}

// One request on a connection or several, as they come, without waiting: behind a bad one the server reads no other.
function attack(count) {
  return new Promise((done) => {
    const socket = connect(studio.port, "127.0.0.1");
    const over = () => { socket.destroy(); done(); };
    let text = "", given = "";
    for (let k = 0; k < count; ++k) {
      const body = random(2) ? changed(one_of(bodies)) : "";
      const lines = [changed(`${one_of(["GET", "POST", "POST", "HEAD", "PUT"])} ${changed(one_of(paths))} HTTP/1.1`),
        ...heads.map((head) => random(12) ? head : changed(head)), `Content-Length: ${random(9) ? Buffer.byteLength(body, "latin1") : one_of(["-1", "99", "1e3", "18446744073709551616"])}`];
      if (k === count - 1) lines.push("Connection: close");
      if (!random(8)) lines.push(one_of(["Transfer-Encoding: chunked", "Content-Encoding: gzip", "Range: bytes=0-,5-,9-1", "Expect: 100-continue", `X: ${one_of(nasty)}`]));
      text += `${lines.join("\r\n")}\r\n\r\n${body}`;
    }
    socket.on("data", (data) => { given += data.toString("latin1"); });
    socket.on("error", over);
    socket.on("close", () => {
      for (const [, status] of given.matchAll(/HTTP\/1\.1 (\d+)/g)) { ++answers; statuses.set(status, (statuses.get(status) ?? 0) + 1); }
      assert.ok(!/hush|root:/.test(given));
      done();
    });
    socket.setTimeout(300, over);
    // Some leave before they are answered.
    random(8) ? socket.write(Buffer.from(text, "latin1")) : socket.end(Buffer.from(text, "latin1"));
  });
}

try {
  const kSeveral = 4, kSide = 40;
  let sent = 0;
  const begun = Date.now();
  await Promise.all(Array.from({length: kSide}, async () => {
    while (sent < requests && !died) {
      const count = random(4) ? 1 : kSeveral;
      sent += count;
      await attack(count);
    }
  }));
  assert.ok(!died, `the studio died after ${sent} requests`);
  const answer = await send(studio.port, {path: "/api/recordings", headers: own});
  assert.equal(answer.status, 200);
  assert.deepEqual(readdirSync(outside).sort(), ["project", "secret"]);
  assert.equal(readFileSync(join(outside, "secret"), "utf8"), "hush");
  const memory = /VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${studio.child.pid}/status`, "utf8"))[1];
  console.log(`${sent} requests, ${answers} of them answered (${[...statuses].map(([status, count]) => `${status}: ${count}`).join(", ")}), in ${((Date.now() - begun) / 1000).toFixed(0)} s: it lives, in ${(memory / 1024).toFixed(0)} MB; no file outside`);
} finally {
  if (!died) await studio.end();
  remove_folder(outside);
}
