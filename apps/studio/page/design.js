// Designs: a request as a form, its search in the background, and the front to pick from.
import {html, useEffect, useState} from "/htm.mjs";
import {ask} from "/ask.js";
import {Command} from "/command.js";
import {request_of, request_text, rows_of} from "/design_request.js";
import {keep, useKept} from "/kept.js";
import {drive_model} from "/machine.js";
import {Scatter} from "/scatter.js";
import {typed} from "/setting.js";
import {useResult, useWork, WorkHead} from "/work.js";

const spoken = (name) => name.replaceAll("_", " ");

// A list of rows that can be added and removed.
function Rows({title, rows, on_change, empty, children}) {
  const set = (k) => (change) => on_change(rows.map((row, i) => i === k ? {...row, ...change} : row));
  return html`<fieldset class="rows"><legend>${title}</legend>
    ${rows.map((row, k) => html`<div class="form-row" key=${k}>${children(row, set(k), k)}
      <button type="button" class="plain" aria-label="Remove row ${k + 1} of ${title}" onClick=${() => on_change(rows.filter((_, i) => i !== k))}>×</button></div>`)}
    <button type="button" class="plain" onClick=${() => on_change([...rows, empty])}>Add</button></fieldset>`;
}

function Form({rows, set, known}) {
  const change = (key) => (event) => set({...rows, [key]: event.target.value});
  const box = (row, set_row, key, label, placeholder) => html`<input class=${key === "list" || key === "terms" ? "long" : ""} aria-label="${label} of ${row.name || "the new row"}" placeholder=${placeholder ?? label} value=${row[key] ?? ""} onInput=${(event) => set_row({[key]: event.target.value})} />`;
  const choice = (row, set_row, list, label) => html`<select aria-label=${label} value=${row.name} onChange=${(event) => set_row({name: event.target.value})}>
    <option value="">choose ...</option>${list.map((one) => html`<option key=${one.name} value=${one.name} title=${one.meaning}>${spoken(one.name)}</option>`)}</select>`;
  const fields = [...known.fields, {name: "fluid", meaning: "magnetorheological fluid"}];
  const part = (key) => (next) => set({...rows, [key]: next});
  const field = (key, label, size) => html`<label class="field">${label}<input size=${size} value=${rows[key]} onInput=${change(key)} /></label>`;
  return html`
    <label class="field">Name<input value=${rows.name} onInput=${change("name")} /></label>
    <div class="row"><label class="field">Damper<select value=${rows.damper} onChange=${change("damper")}>${known.dampers.map((d) => html`<option value=${d}>${d}</option>`)}</select></label>
      ${field("current", "Current", 6)}${field("velocity", "Velocity", 8)}</div>
    <${Rows} title="What may vary" rows=${rows.vary} on_change=${part("vary")} empty=${{name: "", from: "", to: "", step: ""}}>${(row, set_row) => html`${choice(row, set_row, fields, "Field that varies")}
      ${row.list !== undefined || row.name === "fluid" ? box(row, set_row, "list", "Values", "one, or other") : html`${box(row, set_row, "from", "Least value", "from")}${box(row, set_row, "to", "Greatest value", "to")}${box(row, set_row, "step", "Step", "step")}`}`}</${Rows}>
    <${Rows} title="What follows" rows=${rows.follow} on_change=${part("follow")} empty=${{name: "", terms: ""}}>${(row, set_row) => html`${choice(row, set_row, known.fields, "Field that follows")}${box(row, set_row, "terms", "Terms", "constant: 22 mm, pole_length: 2")}`}</${Rows}>
    <${Rows} title="Must hold" rows=${rows.constraints} on_change=${part("constraints")} empty=${{name: "", min: "", max: "", current: "", velocity: ""}}>${(row, set_row) => html`${choice(row, set_row, known.quantities, "Quantity that must hold")}
      ${box(row, set_row, "min", "Least value", "min")}${box(row, set_row, "max", "Greatest value", "max")}${box(row, set_row, "current", "Current", "at A")}${box(row, set_row, "velocity", "Velocity", "at m/s")}`}</${Rows}>
    <${Rows} title="Goals" rows=${rows.goals} on_change=${part("goals")} empty=${{name: "", way: "maximise", current: "", velocity: ""}}>${(row, set_row) => html`<select aria-label="Direction of the goal" value=${row.way} onChange=${(event) => set_row({way: event.target.value})}><option value="maximise">maximise</option><option value="minimise">minimise</option></select>
      ${choice(row, set_row, known.quantities, "Quantity of the goal")}${box(row, set_row, "current", "Current", "at A")}${box(row, set_row, "velocity", "Velocity", "at m/s")}`}</${Rows}>
    <${Rows} title="Tolerances" rows=${rows.tolerances} on_change=${part("tolerances")} empty=${{name: "", width: ""}}>${(row, set_row) => html`${choice(row, set_row, known.fields, "Field with a tolerance")}${box(row, set_row, "width", "Tolerance", "within ±")}`}</${Rows}>
    <div class="row">${field("share", "Share of dampers made that must hold", 6)}${field("samples", "Samples", 6)}</div>`;
}

const unit_of = (row) => row.shown_unit === "1" ? "" : row.shown_unit;
const shown = (value, row) => typeof value === "string" ? value : Number.isFinite(value) ? `${+(value / row.shown_factor).toPrecision(4)}${unit_of(row) && ` ${unit_of(row)}`}` : "–";

// Everything that a design has, by what a plane can have as its axes.
const axes_of = (result) => [...result.goals.map((row, k) => ({...row, label: row.text, of: (d) => d.goals[k]})), ...result.constraints.map((row, k) => ({...row, label: row.text, of: (d) => d.constraints[k]})),
  ...result.variables.map((row, k) => ({...row, label: spoken(row.name), of: (d) => d.variables[k]})).filter((row) => result.designs.some((d) => typeof row.of(d) === "number"))];

function Front({one, result, theme, go}) {
  const [x, set_x] = useKept(`design.x.${one.name}`, 0), [y, set_y] = useKept(`design.y.${one.name}`, result.goals.length > 1 ? 1 : result.goals.length);
  const knee = result.designs.findIndex((d) => /knee/.test(d.role));
  const [chosen, set_chosen] = useKept(`design.chosen.${one.name}`, Math.max(0, knee));
  if (result.designs.length === 0) return html`<p class="error">${result.verdict}</p>
    ${result.conflict?.members.map((m) => html`<p class="note">${m.constraint}: ${+m.reached.toPrecision(4)} (SI) at best while the others hold</p>`)}`;
  const axes = axes_of(result), ax = axes[Math.min(x, axes.length - 1)], ay = axes[Math.min(y, axes.length - 1)];
  const at = Math.min(chosen, result.designs.length - 1), design = result.designs[at];
  const label = (axis) => `${axis.label}${unit_of(axis) && ` (${unit_of(axis)})`}`;
  const points = result.designs.map((d) => ({x: ax.of(d) / ax.shown_factor, y: ay.of(d) / ay.shown_factor, label: d.role ? `${d.name}: ${d.role}` : d.name, colour: d.role ? 2 : 1, size: d.role ? 6 : 4}));
  const model = `designs/${one.name}/models/${design.name}.json`;
  const axis_choice = (value, set, name) => html`<label class="field">${name}<select value=${value} onChange=${(event) => set(+event.target.value)}>${axes.map((axis, k) => html`<option value=${k}>${axis.label}</option>`)}</select></label>`;
  return html`<p class="note">${result.verdict}</p>
    ${result.notes.map((note) => html`<p class="note" key=${note}>${note}</p>`)}
    <div class="row">${axis_choice(x, set_x, "Along")}${axis_choice(y, set_y, "Up")}</div>
    <${Scatter} title="The front: ${result.designs.length} designs" x_label=${label(ax)} y_label=${label(ay)} points=${points} chosen=${at} on_choose=${set_chosen} theme=${theme} keep=${`front-${one.name}`} height=${360} />
    <div class="row"><h3>${design.name}${design.role ? `: ${design.role}` : ""}</h3>
      <button class="plain" onClick=${() => { drive_model(model); go("machine"); }}>Drive it</button>
      <button class="plain" onClick=${() => { keep("export.model", model); go("export"); }}>Export it</button></div>
    <div class="plots"><div class="frame"><table><caption class="hidden">Sizes of ${design.name}</caption><thead><tr><th>Size</th><th class="number">Value</th></tr></thead>
        <tbody>${result.variables.map((row, k) => html`<tr key=${row.name} title=${row.meaning}><td>${spoken(row.name)}</td><td class="number">${shown(design.variables[k], row)}</td></tr>`)}</tbody></table></div>
      <div class="frame"><table><caption class="hidden">Goals and constraints of ${design.name}</caption><thead><tr><th>Asked</th><th class="number">Reached</th></tr></thead>
        <tbody>${result.goals.map((row, k) => html`<tr key=${row.text} class="leader"><td>${row.text}</td><td class="number">${shown(design.goals[k], row)}</td></tr>`)}
          ${result.constraints.map((row, k) => html`<tr key=${row.text}><td>${row.text}</td><td class="number">${shown(design.constraints[k], row)}</td></tr>`)}</tbody></table></div></div>
    ${design.beyond_family?.length > 0 && html`<p class="error">Beyond the dampers of its model's fit: ${design.beyond_family.join("; ")}</p>`}`;
}

function DesignWork({one, act, theme, go}) {
  const result = useResult("design", one);
  return html`<section class="fit" aria-label="Design ${one.name}"><${WorkHead} kind="design" one=${one} act=${act} again="Go on" is_endless=${true} />
    ${result && html`<${Front} one=${one} result=${result} theme=${theme} go=${go} />`}
    ${one.arguments.length > 0 && html`<${Command} words=${one.arguments} />`}</section>`;
}

export function Design({fits, theme, go}) {
  const [known, set_known] = useState(), [rows, set_rows] = useKept("design.rows"), {work, error, act, free_name} = useWork("design", fits);
  const [how, set_how] = useKept("design.how", {name: "", points: "60", generations: "100", seed: "1"});
  useEffect(() => { ask("/api/design").then((got) => { set_known(got); if (!rows) set_rows(rows_of(got.requests.at(-1).request)); }); }, []);
  if (!known || !rows) return html`<main></main>`;
  const text = request_text(request_of(rows));
  const start = async (event) => {
    event.preventDefault();
    if (await act("start", how.name || free_name(), {request: text, points: typed(how.points), generations: typed(how.generations), seed: typed(how.seed)})) set_how({...how, name: ""});
  };
  const box = (key, label) => html`<label class="field">${label}<input size="6" inputmode="numeric" required value=${how[key]} onInput=${(event) => set_how({...how, [key]: event.target.value})} /></label>`;
  return html`<main class="broad">
    <form class="side" onSubmit=${start}><h2>New design</h2>
      <label class="field">Start from<select value="" onChange=${(event) => event.target.value !== "" && set_rows(rows_of(known.requests[+event.target.value].request))}>
        <option value="">a request that comes with Dashpot ...</option>${known.requests.map((r, k) => html`<option value=${k}>${r.request.name}</option>`)}</select></label>
      <${Form} rows=${rows} set=${set_rows} known=${known} />
      <div class="row">${box("points", "Designs")}${box("generations", "Generations")}${box("seed", "Seed")}</div>
      <label class="field">Name of its folder<input value=${how.name} placeholder=${free_name()} onInput=${(event) => set_how({...how, name: event.target.value})} /></label>
      <button class="strong">Search</button>
      ${error && html`<p class="error" role="alert">${error}</p>`}
      <details><summary>The request as dashpot design reads it</summary><pre class="request">${text}</pre></details>
    </form>
    <div class="work"><h2>Designs</h2>
      ${work.length === 0 ? html`<p class="empty">State what may vary, what must hold and what to favour; the search finds a front of designs.</p>`
        : [...work].reverse().map((one) => html`<${DesignWork} key=${one.name} one=${one} act=${act} theme=${theme} go=${go} />`)}
    </div></main>`;
}
