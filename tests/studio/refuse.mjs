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
symlinkSync(join(outside), join(folder, "fits", "way-out"));
const studio = await start(program, folder);
const {port} = studio;

// One at a time has a project.
assert.throws(() => execFileSync(program, ["studio", "--no-open", folder], {stdio: "pipe", timeout: 10000}),
  (error) => error.status === 1 && /another studio/.test(error.stderr));

const own = await open(studio);
const {Cookie, ...stranger} = own;
const host = own.Host, json = (value) => JSON.stringify(value);
const upload = {...own, "Content-Type": "application/octet-stream"};
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
  ["a guessed cookie", {path: "/api/fits", headers: {...stranger, Cookie: `dashpot_studio_${port}=${"0".repeat(64)}`}}, 401],
  ["an empty cookie", {path: "/api/fits", headers: {...stranger, Cookie: `dashpot_studio_${port}=`}}, 401],
  ["the cookie of another port", {path: "/api/fits", headers: {...stranger, Cookie: Cookie.replace(`_${port}=`, `_${port + 1}=`)}}, 401],
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
