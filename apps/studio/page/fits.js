// Fits: models to choose, work that goes on in the background, leaderboards.
import {html, useEffect, useState} from "/htm.mjs";
import {ask, opened, tell} from "/ask.js";
import {Command} from "/command.js";
import {Plot} from "/plot.js";

const kStates = {running: "running", stopped: "stopped; its finished fits are kept", done: "done", failed: "failed"};
const kUsualColumns = ["model", "rmse_N", "esr_percent", "nrmse_percent", "worst_esr_percent", "parameters", "dissipates"];

// The training error of every fit over time. A fit searches several times, with other weights: each search falls from
// its own 100 %, and the line breaks between them.
function curves_of(steps) {
  const fits = new Map();
  for (const [what, seconds, cost] of steps) {
    if (!fits.has(what)) fits.set(what, {x: [], y: [], first: cost, last: Infinity});
    const fit = fits.get(what);
    if (cost > fit.last) {
      fit.x.push(seconds);
      fit.y.push(null);
      fit.first = cost;
    }
    fit.last = cost;
    fit.x.push(seconds);
    fit.y.push(100 * Math.sqrt(cost / (fit.first || 1)));
  }
  const models = [...new Set([...fits.keys()].map((what) => what.split(",")[0]))];
  const is_first = (what) => [...fits.keys()].find((other) => other.split(",")[0] === what.split(",")[0]) === what;
  return [...fits].map(([what, fit]) => {
    const model = what.split(",")[0];
    return {label: is_first(what) ? model : "", colour: models.indexOf(model) + 1, x: fit.x, y: fit.y};
  });
}

// The models that have ended, the best first, before the leaderboard is there.
function table_of(judged) {
  const columns = Object.keys(judged[0]);
  const rows = [...judged].sort((a, b) => (a.esr_percent ?? Infinity) - (b.esr_percent ?? Infinity)).map((row) => columns.map((column) => String(row[column] ?? "")));
  return {columns, rows};
}

function Leaderboard({table, name}) {
  const [all, set_all] = useState(false);
  const known = table.columns.map((column, k) => [column, k]);
  const usual = known.filter(([column]) => kUsualColumns.includes(column));
  const shown = all || usual.length < 3 ? known : usual;
  const text = (cell) => /^-?\d+\.\d{4,}(e[+-]?\d+)?$/.test(cell) ? String(+Number(cell).toPrecision(4)) : cell;
  const is_number = (k) => table.rows.some((row) => row[k] !== "" && !Number.isNaN(Number(row[k])));
  return html`<div class="frame"><table><caption class="hidden">Leaderboard of ${name}, the best model first</caption>
    <thead><tr>${shown.map(([column, k]) => html`<th class=${is_number(k) ? "number" : ""}>${column.replaceAll("_", " ")}</th>`)}</tr></thead>
    <tbody>${table.rows.map((row, r) => html`<tr class=${r === 0 ? "leader" : ""}>${shown.map(([, k]) => html`<td class=${is_number(k) ? "number" : ""}>${text(row[k])}</td>`)}</tr>`)}</tbody></table></div>
    ${shown.length < known.length || all ? html`<button class="plain" onClick=${() => set_all(!all)}>${all ? "Fewer columns" : `All ${known.length} columns`}</button>` : ""}`;
}

function Fit({fit, theme, act}) {
  const curves = curves_of(fit.steps);
  return html`<section class="fit" aria-label="Fit ${fit.name}">
    <header><h3>${fit.name}</h3><span class="state" role="status">${kStates[fit.state] ?? fit.state}${fit.state === "running" && fit.stage ? `: ${fit.stage}` : ""}</span>
      ${fit.state === "running" && html`<button class="plain" onClick=${() => act("stop", fit.name)}>Stop</button>`}
      ${(fit.state === "stopped" || fit.state === "failed") && fit.arguments.length > 0 && html`<button class="plain" onClick=${() => act("go_on", fit.name)}>Go on</button>`}
      ${fit.has_report && html`<a href=${opened(`/report/${encodeURIComponent(fit.name)}`)} target="_blank" rel="noopener">Report</a>`}
    </header>
    ${fit.state === "running" && html`<progress max="1" value=${fit.fraction} aria-label="Progress of ${fit.name}"></progress>`}
    ${fit.message && html`<p class="error">${fit.message}</p>`}
    ${curves.length > 0 && fit.state !== "done" && html`<${Plot} title="Error of each fit as it falls" x_label="Time (s)" y_label="Error (% of the search's start)" is_log=${true} series=${curves} theme=${theme} height=${200} />`}
    ${fit.state === "running" && fit.parameters && html`<p class="note moving" aria-label="Parameters of ${fit.parameters.of} as they move">${fit.parameters.of}: ${fit.parameters.values.map(([name, value]) => html`<span>${name} = ${value.toPrecision(4)}</span> `)}</p>`}
    ${fit.state === "running" && fit.judged.length > 0 && html`<${Leaderboard} table=${table_of(fit.judged)} name=${fit.name} />`}
    ${fit.leaderboard && fit.state === "done" && html`<${Leaderboard} table=${fit.leaderboard} name=${fit.name} />`}
    ${fit.arguments.length > 0 && html`<${Command} words=${fit.arguments} />`}
  </section>`;
}

export function Fits({known, fits, theme, on_changed}) {
  const [models, set_models] = useState([]), [chosen, set_chosen] = useState(new Set(["bingham", "tanh_kwok"]));
  const [name, set_name] = useState(""), [leave_out, set_leave_out] = useState(""), [error, set_error] = useState("");
  useEffect(() => { ask("/api/models").then((got) => set_models(got.models)); }, []);
  // What the fits of each model take, as the command line estimates it for these recordings.
  const [costs, set_costs] = useState(new Map());
  useEffect(() => { ask("/api/costs").then((got) => set_costs(new Map(got.costs.map((c) => [c.model, c.seconds])))).catch(() => {}); }, [known]);
  const cost_text = (seconds) => seconds === undefined ? "" : seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : `${Math.round(seconds / 60)} min`;
  const total = [...chosen].reduce((sum, model) => sum + (costs.get(model) ?? 0), 0);
  const free_name = () => {
    for (let k = 1; ; ++k) if (!fits.some((fit) => fit.name === `fit-${k}`)) return `fit-${k}`;
  };
  const act = async (action, of, more = {}) => {
    const got = await tell("/api/fits", {action, name: of, ...more}).catch((problem) => ({error: problem.message}));
    set_error(got.error ?? "");
    if (!got.error && action === "start") set_name("");
    on_changed();
  };
  const start = (event) => {
    event.preventDefault();
    act("start", name || free_name(), {models: models.map((m) => m.name).filter((m) => chosen.has(m)), leave_out});
  };
  const turn = (model) => () => {
    const next = new Set(chosen);
    next.has(model) ? next.delete(model) : next.add(model);
    set_chosen(next);
  };
  const count = known?.records?.length ?? 0;
  return html`<main>
    <form class="side" onSubmit=${start}>
      <h2>New fit</h2>
      <fieldset class="checks"><legend class="hidden">Models</legend>${models.map((model) => html`<label key=${model.name}>
        <input type="checkbox" value=${model.name} checked=${chosen.has(model.name)} onChange=${turn(model.name)} /><span>${model.title}</span><small>${cost_text(costs.get(model.name))}</small></label>`)}</fieldset>
      <label class="field">Left out to judge them<select value=${leave_out} onChange=${(event) => set_leave_out(event.target.value)}>
        <option value="">as the recordings allow</option><option value="condition">each motion in turn</option><option value="current">each current in turn</option>
        <option value="record">each record in turn</option><option value="groups=6">six groups of motions</option><option value="blocks=5">five blocks of time</option><option value="fraction=0.3">the last 30 % of each record</option></select></label>
      <label class="field">Name<input value=${name} placeholder=${free_name()} onInput=${(event) => set_name(event.target.value)} /></label>
      <button class="strong" disabled=${chosen.size === 0 || count === 0}>Fit ${chosen.size} ${chosen.size === 1 ? "model" : "models"} to ${count} records</button>
      ${total > 0 && html`<p class="note">About ${cost_text(total)} of CPU time, estimated; within a factor of two.</p>`}
      ${error && html`<p class="error" role="alert">${error}</p>`}
    </form>
    <div class="work"><h2>Fits</h2>
      ${fits.length === 0 ? html`<p class="empty">Choose models and fit them; they are judged on records that they have not seen.</p>`
        : [...fits].reverse().map((fit) => html`<${Fit} key=${fit.name} fit=${fit} theme=${theme} act=${act} />`)}
    </div>
  </main>`;
}
