// What the studio refuses, as a table of requests and answers; see docs/threat-model.md.
// usage: node refuse.mjs DASHPOT
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, readdirSync, readFileSync, symlinkSync, writeFileSync} from "node:fs";
import {connect} from "node:net";
import {networkInterfaces} from "node:os";
import {join} from "node:path";
import {make_folder, open, remove_folder, send, start} from "./studio.mjs";

const program = process.argv[2];
const outside = make_folder(), folder = join(outside, "project");
mkdirSync(join(folder, "fits", "own", "models"), {recursive: true});
writeFileSync(join(outside, "secret.csv"), "hush");
writeFileSync(join(folder, "fits", "own", "report.html"), "<p>report</p>");
writeFileSync(join(folder, "fits", "own", "models", "plain.json"), "{}");
// A fitted law, of recordings that are not the project's.
const bench = make_folder();
writeFileSync(join(bench, "run_1A.csv"), "time (s),displacement (mm),force (N)\n" +
  Array.from({length: 400}, (_, k) => `${k / 100},${(5 * Math.sin(k / 10)).toFixed(3)},${(300 * Math.cos(k / 10)).toFixed(1)}`).join("\n"));
execFileSync(program, ["identify", bench, "--models", "bingham", "--leave-out", "fraction=0.3", "--no-report", "--output", join(folder, "fits", "own")], {stdio: "ignore"});
remove_folder(bench);
// Work that nobody of this studio asked for, in a folder from elsewhere.
for (const [kind, asked] of [["fits", {models: ["--output=/tmp/x"], leave_out: "", state: "stopped"}], ["designs", {request: "damper: ../../../secret.csv\nvary: {gap: {from: 1 mm, to: 2 mm}}\ngoals: [{minimise: mass}]", state: "stopped"}]]) {
  mkdirSync(join(folder, kind, "planted"), {recursive: true});
  writeFileSync(join(folder, kind, "planted", "studio.json"), JSON.stringify(asked));
}
symlinkSync(join(outside), join(folder, "fits", "way-out"));
const studio = await start(program, folder);
const {port} = studio;

// One at a time has a project.
assert.throws(() => execFileSync(program, ["studio", "--no-open", folder], {stdio: "pipe", timeout: 10000}),
  (error) => error.status === 1 && /another studio/.test(error.stderr));

// A misspelt folder is no new project.
assert.throws(() => execFileSync(program, ["studio", "--no-open", join(outside, "projet")], {stdio: "pipe", timeout: 10000}),
  (error) => error.status === 1 && /projet: is no folder/.test(error.stderr));
assert.ok(!existsSync(join(outside, "projet")));

const own = await open(studio);
const {Cookie, "X-Dashpot-Key": key, ...stranger} = own;
const {token} = JSON.parse((await send(studio.port, {method: "POST", path: "/api/token", headers: own, body: "{}"})).text);
const {address_key} = JSON.parse((await send(studio.port, {method: "POST", path: "/api/session", headers: stranger, body: JSON.stringify({token})})).text);
const host = own.Host, json = (value) => JSON.stringify(value);
const upload = {...own, "Content-Type": "application/octet-stream"};
const drive = (more) => json({plant: "savaresi_spelta", road: "step", duration: 1, ...more});
const fit_from = (from, models = ["bingham"]) => json({action: "start", name: "moved", models, from});
const design = (request, more) => json({action: "start", name: "x", request, ...more});
const cases = [
  // [what, request, status]
  ["its own page", {headers: {Host: host}}, 200],
  ["its own data", {path: "/api/recordings", headers: own}, 200],
  ["the name localhost", {path: "/api/fits", headers: {...own, Host: `localhost:${port}`, Origin: `http://localhost:${port}`}}, 200],
  // Names and origins
  ["a name that was bent to this machine", {path: "/api/recordings", headers: {...own, Host: `evil.example:${port}`}}, 421],
  ["its name without the port", {path: "/", headers: {Host: "127.0.0.1"}}, 421],
  ["its name with another port", {path: "/", headers: {Host: "127.0.0.1:80"}}, 421],
  ["a name that begins like its own", {path: "/", headers: {Host: `127.0.0.1:${port}.evil.example`}}, 421],
  ["a page of another origin", {path: "/api/recordings", headers: {...own, Origin: "http://evil.example"}}, 403],
  ["a page of another port", {path: "/api/recordings", headers: {...own, Origin: `http://127.0.0.1:${port + 1}`}}, 403],
  ["a page without an origin (sandboxed: a report)", {path: "/api/fits", headers: {...own, Origin: "null"}}, 403],
  ["a page of another site, by the browser's word", {path: "/api/recordings", headers: {...own, "Sec-Fetch-Site": "cross-site"}}, 403],
  ["a page of a neighbour site", {path: "/uplot.js", headers: {Host: host, "Sec-Fetch-Site": "same-site"}}, 403],
  ["a picture of its page in a page of another", {path: "/", headers: {Host: host, "Sec-Fetch-Site": "cross-site"}}, 403],
  // Who holds no cookie
  ["a second user of the machine", {path: "/api/recordings", headers: stranger}, 401],
  ["a report without the cookie", {path: "/report/own", headers: stranger}, 401],
  ["a guessed cookie", {path: "/api/fits", headers: {...own, Cookie: `dashpot_studio_${port}=${"0".repeat(64)}`}}, 401],
  ["the cookie alone, as another port of the machine gets it", {path: "/api/fits", headers: {...stranger, Cookie}}, 401],
  ["a change by the cookie alone", {method: "POST", path: "/api/fits", headers: {...stranger, Cookie}, body: "{}"}, 401],
  ["a report by the cookie alone", {path: "/report/own", headers: {...stranger, Cookie}}, 401],
  ["data by the key of addresses", {path: `/api/fits?session=${address_key}`, headers: {...stranger, Cookie}}, 401],
  ["a report as the page opens it", {path: `/report/own?session=${address_key}`, headers: {Host: host, Cookie}}, 200],
  ["the keys without the cookie", {path: "/api/fits", headers: {...stranger, "X-Dashpot-Key": key}}, 401],
  ["an empty cookie", {path: "/api/fits", headers: {...own, Cookie: `dashpot_studio_${port}=`}}, 401],
  ["the cookie of another port", {path: "/api/fits", headers: {...own, Cookie: Cookie.replace(`_${port}=`, `_${port + 1}=`)}}, 401],
  ["a second browser with a token that was used", {method: "POST", path: "/api/session", headers: stranger, body: json({token: studio.token})}, 401],
  ["an empty token", {method: "POST", path: "/api/session", headers: stranger, body: json({token: ""})}, 401],
  // Forms of others
  ["a form of another page", {method: "POST", path: "/api/fits", headers: {...own, "Content-Type": "application/x-www-form-urlencoded"}, body: "a=b"}, 415],
  ["a form of text", {method: "POST", path: "/api/fits", headers: {...own, "Content-Type": "text/plain"}, body: "{}"}, 415],
  ["a change without an origin", {method: "POST", path: "/api/fits", headers: {Host: host, Cookie, "Content-Type": "application/json"}, body: "{}"}, 403],
  ["a method that is not known", {method: "DELETE", path: "/api/fits", headers: own}, 405],
  ["a question before another origin asks", {method: "OPTIONS", path: "/api/fits", headers: {Host: host, Origin: "http://evil.example"}}, 403],
  // Ways out of the project
  ["a module of a file above", {path: "/api/module?model=..%2fsecret.csv", headers: own}, 400],
  ["a module through a link", {path: "/api/module?model=fits%2fway-out%2fsecret.csv", headers: own}, 400],
  ["a module of what is no model", {path: "/api/module?model=fits%2fown%2freport.html", headers: own}, 400],
  ["a module without the cookie", {path: "/api/module?model=fits%2fown%2freport.html", headers: stranger}, 401],
  ["a report above", {path: "/report/..%2f..", headers: own}, 404],
  ["a report through a link", {path: "/report/way-out", headers: own}, 400],
  ["a file of the machine", {path: "/../../../../etc/passwd", headers: own}, 404],
  ["a file of the machine, coded", {path: "/%2e%2e/%2e%2e/etc/passwd", headers: own}, 404],
  ["a recording above the project", {method: "POST", path: "/api/upload?name=..%2Fx.csv", headers: upload, body: "x"}, 400],
  ["a recording of the machine", {method: "POST", path: "/api/upload?name=%2Ftmp%2Fx.csv", headers: upload, body: "x"}, 400],
  ["a hidden recording", {method: "POST", path: "/api/upload?name=.ssh%2Fx", headers: upload, body: "x"}, 400],
  ["a recording with a line break in its name", {method: "POST", path: "/api/upload?name=a%0Ab.csv", headers: upload, body: "x"}, 400],
  ["a recording with a zero in its name", {method: "POST", path: "/api/upload?name=a%00.csv", headers: upload, body: "x"}, 400],
  ["a recording without a name", {method: "POST", path: "/api/upload", headers: upload, body: "x"}, 400],
  ["a model above the project", {path: "/api/traces?model=..%2Fsecret.csv", headers: own}, 400],
  ["a model through a link", {path: "/api/traces?model=fits%2Fway-out%2Fsecret.csv", headers: own}, 400],
  ["a fit above the project", {method: "POST", path: "/api/fits", headers: own, body: json({action: "start", name: "../x", models: ["bingham"]})}, 400],
  ["a fit that is an option", {method: "POST", path: "/api/fits", headers: own, body: json({action: "start", name: "--plant", models: ["bingham"]})}, 400],
  ["a model that is an option", {method: "POST", path: "/api/fits", headers: own, body: json({action: "start", name: "x", models: ["--network"]})}, 400],
  ["records left out by an option", {method: "POST", path: "/api/fits", headers: own, body: json({action: "start", name: "x", models: ["bingham"], leave_out: "$(id)"})}, 400],
  ["a correction above the project", {method: "POST", path: "/api/correct", headers: own, body: json({file: "../x.csv", set: "level=1"})}, 400],
  ["work from elsewhere that is an option", {method: "POST", path: "/api/fits", headers: own, body: json({action: "go_on", name: "planted"})}, 400],
  ["work from elsewhere that leaves the project", {method: "POST", path: "/api/work/design", headers: own, body: json({action: "go_on", name: "planted"})}, 400],
  // The machine
  ["a drive without the cookie", {method: "POST", path: "/api/drive", headers: stranger, body: drive({})}, 401],
  ["a drive by a form", {method: "POST", path: "/api/drive", headers: {...own, "Content-Type": "text/plain"}, body: drive({})}, 415],
  ["a plant that is a file", {method: "POST", path: "/api/drive", headers: own, body: drive({plant: "/etc/passwd"})}, 400],
  ["a plant that is an option", {method: "POST", path: "/api/drive", headers: own, body: drive({plant: "--list"})}, 400],
  ["values of a plant that are a path", {method: "POST", path: "/api/drive", headers: own, body: drive({values: "sprung_mass=/etc/passwd"})}, 400],
  ["a damper above the project", {method: "POST", path: "/api/drive", headers: own, body: drive({damper: "../secret.csv"})}, 400],
  ["a damper of the machine", {method: "POST", path: "/api/drive", headers: own, body: drive({damper: "/etc/passwd"})}, 400],
  ["a damper through a link", {method: "POST", path: "/api/drive", headers: own, body: drive({damper: "fits/way-out/secret.csv"})}, 400],
  ["two dampers in one", {method: "POST", path: "/api/drive", headers: own, body: drive({damper: "viscous;/etc/passwd"})}, 400],
  ["settings of a damper that are a file", {method: "POST", path: "/api/drive", headers: own, body: drive({damper: "viscous", settings: "file=/etc/passwd"})}, 400],
  ["a road that is a file", {method: "POST", path: "/api/drive", headers: own, body: drive({road: "measured,file=/etc/passwd"})}, 400],
  ["a road with a file", {method: "POST", path: "/api/drive", headers: own, body: drive({road: "iso8608,file=../secret.csv"})}, 400],
  ["a controller that is none", {method: "POST", path: "/api/drive", headers: own, body: drive({controller: "$(id)"})}, 400],
  ["a controller with a second one behind it", {method: "POST", path: "/api/drive", headers: own, body: drive({controller: "mix1,crossover=2;id"})}, 400],
  ["a drive for ever", {method: "POST", path: "/api/drive", headers: own, body: drive({duration: 1e9})}, 400],
  ["a road of more waves than there may be", {method: "POST", path: "/api/drive", headers: own, body: drive({road: "iso8608,waves=1e15"})}, 400],
  ["a drive that does not last", {method: "POST", path: "/api/drive", headers: own, body: json({plant: "savaresi_spelta", road: "step", duration: "1"})}, 400],
  ["a drive of no time", {method: "POST", path: "/api/drive", headers: own, body: drive({duration: 0})}, 400],
  ["a current that is no number", {method: "POST", path: "/api/drive", headers: own, body: drive({current: "1 A"})}, 400],
  ["a drive with more than it has", {method: "POST", path: "/api/drive", headers: own, body: drive({output: "/tmp/x"})}, 400],
  ["a drive of 1 MB", {method: "POST", path: "/api/drive", headers: own, body: drive({values: "x".repeat(1 << 20)})}, 400],
  ["traces above the project", {path: "/api/driven?key=..%2F..%2F..&x=time&y=force", headers: own}, 400],
  ["traces that nobody drove", {path: `/api/driven?key=${"0".repeat(32)}&x=time&y=force`, headers: own}, 400],
  ["work of an unknown kind", {method: "POST", path: "/api/work/shell", headers: own, body: json({action: "start", name: "x"})}, 400],
  ["a ride above the project", {method: "POST", path: "/api/work/ride", headers: own, body: json({action: "start", name: "../x", plant: "savaresi_spelta", road: "step", controllers: ["skyhook"]})}, 400],
  ["a ride with an option for a controller", {method: "POST", path: "/api/work/ride", headers: own, body: json({action: "start", name: "x", plant: "savaresi_spelta", road: "step", controllers: ["--bound"]})}, 400],
  // Fits from a start
  ["a start above the project", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "../secret.csv", parameters: {}})}, 400],
  ["a start through a link", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "fits/way-out/secret.csv", parameters: {}})}, 400],
  ["a start that is no model", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "fits/own/models/plain.json", parameters: {}})}, 400],
  ["a start of another law", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "fits/own/models/bingham.json", parameters: {}}, ["bouc_wen"])}, 400],
  ["a start of two laws", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "fits/own/models/bingham.json", parameters: {}}, ["bingham", "bouc_wen"])}, 400],
  ["a start with a parameter of another law", {method: "POST", path: "/api/fits", headers: own, body: fit_from({model: "fits/own/models/bingham.json", parameters: {alpha: 1}})}, 400],
  ["a start with a parameter that is infinite", {method: "POST", path: "/api/fits", headers: own, body: `{"action":"start","name":"moved","models":["bingham"],"from":{"model":"fits/own/models/bingham.json","parameters":{"f0":1e999}}}`}, 400],
  // Designs
  ["a design above the project", {method: "POST", path: "/api/work/design", headers: own, body: design("damper: passenger_car", {name: "../x"})}, 400],
  ["a damper's file above the project", {method: "POST", path: "/api/work/design", headers: own, body: design("damper: ../../../secret.yaml")}, 400],
  ["a damper's file of the machine", {method: "POST", path: "/api/work/design", headers: own, body: design("damper: /etc/passwd")}, 400],
  ["a request that is no YAML", {method: "POST", path: "/api/work/design", headers: own, body: design("{{{{")}, 400],
  ["a request that grows", {method: "POST", path: "/api/work/design", headers: own, body: design(`a: &a [1,1,1,1,1,1,1,1,1,1]\n${Array.from({length: 12}, (_, k) => `${"bcdefghijklm"[k]}: &${"bcdefghijklm"[k]} [${Array(10).fill(`*${"abcdefghijkl"[k]}`)}]`).join("\n")}`)}, 400],
  ["a design of 10^9 generations", {method: "POST", path: "/api/work/design", headers: own, body: design("damper: passenger_car", {generations: 1e9})}, 400],
  ["a result above the project", {path: "/api/result/design/..", headers: own}, 400],
  ["a report of a design without the cookie", {path: "/report/design/x", headers: stranger}, 401],
  ["a report through a link", {path: "/report/fit/way-out", headers: own}, 400],
  // Exports
  ["an export of a file above the project", {method: "POST", path: "/api/export", headers: own, body: json({model: "../secret.csv", formats: ["c"]})}, 400],
  ["an export through a link", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/way-out/models/x.json", formats: ["c"]})}, 400],
  ["an export of what is no model", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/own/report.html", formats: ["c"]})}, 400],
  ["a format that is an option", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/own/models/plain.json", formats: ["--compiler"]})}, 400],
  ["a name that is a path", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/own/models/plain.json", formats: ["c"], name: "../x"})}, 400],
  ["a sample time that is a command", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/own/models/plain.json", formats: ["c"], sample_time: "$(id)"})}, 400],
  ["a compiler", {method: "POST", path: "/api/export", headers: own, body: json({model: "fits/own/models/plain.json", formats: ["fmu3"], compiler: "sh -c id"})}, 400],
  ["an exported file above the project", {path: "/api/exported?folder=own%2C%20plain&file=..%2F..%2F..%2Fsecret.csv", headers: own}, 400],
  ["a folder of exports above the project", {path: "/api/exported?folder=..%2F..&file=secret.csv", headers: own}, 400],
  ["an exported file without the cookie", {path: "/api/exported?folder=own%2C%20plain", headers: stranger}, 401],
  // What is too much or nothing at all
  ["a body that is no JSON", {method: "POST", path: "/api/fits", headers: own, body: "{"}, 400],
  ["an unknown key", {method: "POST", path: "/api/correct", headers: own, body: json({file: "x", set: "level=1", shell: "id"})}, 400],
  ["a body of 1 MB", {method: "POST", path: "/api/correct", headers: own, body: json({file: "x".repeat(1 << 20), set: ""})}, 400],
  ["an upload said to be of 2 GiB", {method: "POST", path: "/api/upload?name=x.csv", headers: {...upload, "Content-Length": 2 ** 31}, body: ""}, 413],
  ["an address of 10 kB", {path: `/${"x".repeat(10000)}`, headers: own}, 414],
];

try {
  for (const [what, asked, status] of cases) {
    const answer = await send(port, asked).catch((error) => ({status: 0, text: error.message, headers: {}}));
    // A connection that is cut is a refusal as well, where the body was not even read.
    const is_cut = answer.status === 0 && (status === 413 || status === 414 || status === 400);
    assert.ok(answer.status === status || is_cut, `${what}: ${answer.status}, not ${status}: ${answer.text.slice(0, 200)}`);
    assert.ok(!answer.text.includes("root:") && !answer.text.includes("hush"), `${what} gives a file of others away`);
    assert.equal(answer.headers["access-control-allow-origin"], undefined, what);
  }

  // A name that is none is told what one is.
  const unnamed = await send(port, {method: "POST", path: "/api/fits", headers: own, body: json({action: "start", name: "a/b", models: ["bingham"]})});
  assert.match(unnamed.text, /'a\/b': is no name for a fit; at most 120 bytes without '\/'/);

  // None of these left anything behind.
  for (const results of ["rides", "exports"]) assert.ok(!existsSync(join(folder, results)) || readdirSync(join(folder, results)).every((name) => name === ".no-recordings" || name === "own, plain"), results);
  assert.deepEqual(readdirSync(join(folder, "designs")), ["planted"]);

  // The licences of what others made lie beside it.
  const licences = await send(port, {path: "/licences.txt", headers: {Host: host}});
  for (const text of [/Apache License\s+Version 2\.0/, /Jason Miller/, /Leon Sorokin/]) assert.match(licences.text, text);

  // Headers of what it serves.
  const page = await send(port, {headers: {Host: host}});
  assert.match(page.headers["content-security-policy"], /default-src 'none'; script-src 'self'; style-src 'self'/);
  assert.ok(!/<script(?![^>]*src=)/.test(page.text), "no script in the page's text");
  const report = await send(port, {path: "/report/own", headers: own});
  assert.equal(report.status, 200);
  assert.match(report.headers["content-security-policy"], /^sandbox allow-scripts; default-src 'none'/);
  const again = await send(port, {method: "POST", path: "/api/token", headers: own, body: "{}"});
  const second = await send(port, {method: "POST", path: "/api/session", headers: stranger, body: json({token: JSON.parse(again.text).token})});
  assert.match(second.headers["set-cookie"][0], /; HttpOnly; SameSite=Strict; Path=\/$/);

  // Only this machine can reach it.
  for (const addresses of Object.values(networkInterfaces()))
    for (const {address, internal, family} of addresses) if (!internal && family === "IPv4")
      await new Promise((done, fail) => connect(port, address).once("connect", () => fail(new Error(`it answers at ${address}`))).once("error", done));

  // A recording that would unpack to far more than it is, and one that is no recording: the child refuses, the studio lives.
  const {gzipSync} = await import("node:zlib");
  await send(port, {method: "POST", path: "/api/upload?name=bomb.csv.gz", headers: upload, body: gzipSync(Buffer.alloc(200 << 20))});
  await send(port, {method: "POST", path: "/api/upload?name=noise.mat", headers: upload, body: Buffer.from("MATLAB 5.0 MAT-file".padEnd(5000, "\xff"))});
  const said = JSON.parse((await send(port, {path: "/api/recordings", headers: own})).text);
  assert.match(JSON.stringify(said), /bomb\.csv\.gz/);
  const taken = await send(port, {method: "POST", path: "/api/upload?name=noise.mat", headers: upload, body: "other"});
  assert.equal(taken.status, 400, "a name that is taken");

  // Nothing was written outside, and nothing half.
  assert.deepEqual(readdirSync(outside).sort(), ["project", "secret.csv"]);
  assert.deepEqual(readdirSync(join(folder, ".studio", "incoming")), []);
  assert.equal(readFileSync(join(outside, "secret.csv"), "utf8"), "hush");
  assert.ok(!existsSync("/tmp/x.csv"));
  console.log(`${cases.length} requests were answered as they should be`);
} finally {
  await studio.end();
  remove_folder(outside);
}
