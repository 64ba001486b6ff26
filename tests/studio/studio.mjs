// What the tests of the studio share: the program with a project of its own, and plain requests.
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {request} from "node:http";
import {tmpdir} from "node:os";
import {join} from "node:path";

export const make_folder = () => mkdtempSync(join(tmpdir(), "dashpot-studio-"));
export const remove_folder = (folder) => rmSync(folder, {recursive: true, force: true});

// The studio of a folder: {port, token, address, end(), child}.
export function start(program, folder, words = []) {
  const child = spawn(program, ["studio", "--no-open", ...words, folder], {stdio: ["ignore", "pipe", "pipe"]});
  return new Promise((done, fail) => {
    let text = "", errors = "";
    child.stderr.on("data", (data) => { errors += data; });
    child.stdout.on("data", (data) => {
      text += data;
      const found = /(http:\/\/127\.0\.0\.1:(\d+)\/)#([0-9a-f]{64})\s/.exec(text);
      if (found) done({child, port: +found[2], token: found[3], address: found[0].trim(),
        end: () => new Promise((over) => { child.once("exit", over); child.kill("SIGTERM"); })});
    });
    child.once("exit", (code) => fail(new Error(`the studio ended with ${code}: ${errors}`)));
  });
}

// One request as it is written, with the path as it stands: no browser tidies it.
export function send(port, {method = "GET", path = "/", headers = {}, body} = {}) {
  return new Promise((done, fail) => {
    const asked = request({host: "127.0.0.1", port, method, path, headers, agent: false}, (response) => {
      const parts = [];
      response.on("data", (part) => parts.push(part));
      response.on("end", () => done({status: response.statusCode, headers: response.headers, text: Buffer.concat(parts).toString()}));
      response.on("error", fail);
    });
    asked.on("error", fail);
    asked.end(body);
  });
}

// The headers of the studio's own page, which holds the cookie and the key.
export async function open(studio) {
  const own = {Host: `127.0.0.1:${studio.port}`, Origin: `http://127.0.0.1:${studio.port}`, "Content-Type": "application/json"};
  const answer = await send(studio.port, {method: "POST", path: "/api/session", headers: own, body: JSON.stringify({token: studio.token})});
  if (answer.status !== 200) throw new Error(`no session: ${answer.text}`);
  return {...own, Cookie: answer.headers["set-cookie"][0].split(";")[0], "X-Dashpot-Key": JSON.parse(answer.text).key};
}
