// Work in the background, rides and designs as fits are: its state, and what one can do with it.
import {html, useEffect, useState} from "/htm.mjs";
import {ask, opened, tell} from "/ask.js";

const kStates = {running: "running", stopped: "stopped", done: "done", failed: "failed"};

// All work of a kind, and what starts, stops and goes on with it.
export function useWork(kind, fits) {
  const [work, set_work] = useState([]), [error, set_error] = useState("");
  const reload = () => ask(`/api/work/${kind}`).then((got) => set_work(got.work)).catch((problem) => set_error(problem.message));
  useEffect(() => { reload(); }, [kind, fits]);
  const act = async (action, name, asked = {}) => {
    const got = await tell(`/api/work/${kind}`, {action, name, ...asked}).catch((problem) => ({error: problem.message}));
    set_error(got.error ?? "");
    await reload();
    return !got.error;
  };
  const free_name = () => {
    for (let k = 1; ; ++k) if (!work.some((one) => one.name === `${kind}-${k}`)) return `${kind}-${k}`;
  };
  return {work, error, act, free_name};
}

// What a piece of work wrote, once it ends or was stopped.
export function useResult(kind, one) {
  const [result, set_result] = useState();
  const is_there = one?.has_report && one.state !== "running";
  useEffect(() => {
    set_result(undefined);
    if (is_there) ask(`/api/result/${kind}/${encodeURIComponent(one.name)}`).then(set_result).catch(() => {});
  }, [one?.name, is_there, one?.state]);
  return result;
}

export function WorkHead({kind, one, act, again, is_endless}) {
  return html`<header><h3>${one.name}</h3><span class="state" role="status">${kStates[one.state] ?? one.state}${one.state === "running" && one.stage ? `: ${one.stage}` : ""}</span>
      ${one.state === "running" && html`<button class="plain" onClick=${() => act("stop", one.name)}>Stop</button>`}
      ${(one.state === "stopped" || one.state === "failed" || (is_endless && one.state === "done")) && one.arguments.length > 0 && html`<button class="plain" onClick=${() => act("go_on", one.name)}>${again}</button>`}
      ${one.has_report && one.state !== "running" && html`<a href=${opened(`/report/${kind}/${encodeURIComponent(one.name)}`)} target="_blank" rel="noopener">Report</a>`}
    </header>
    ${one.state === "running" && html`<progress max="1" value=${one.fraction} aria-label="Progress of ${one.name}"></progress>`}
    ${one.message && html`<p class="error">${one.message}</p>`}`;
}
