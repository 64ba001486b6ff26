// Models over records: the same plot for every model, residuals, and the command of each figure.
import {html, useEffect, useState} from "/htm.mjs";
import {ask} from "/ask.js";
import {Command} from "/command.js";
import {Plot} from "/plot.js";
import {plain} from "/recordings.js";

const kViews = {
  time: ["time", "modelled", "Force in time", "Time (s)", "Force (N)"],
  velocity: ["velocity", "modelled", "Force over velocity", "Velocity (m/s)", "Force (N)"],
  displacement: ["displacement", "modelled", "Force over displacement", "Displacement (m)", "Force (N)"],
  residual: ["time", "residual", "Measured minus modelled", "Time (s)", "Residual (N)"],
};
const short = (path) => path.replace(/^fits\//, "").replace("/models/", ": ").replace(/\.json$/, "");

const folder_of = (path) => path.split("/")[1];

// One figure: the measured force, and each model over it.
function Overlay({view, record, models, window, on_zoom, theme, height, keep, wide, title, on_error}) {
  const [x, y, heading, x_label, y_label] = kViews[view];
  const [series, set_series] = useState([]), [range, set_range] = useState();
  useEffect(() => {
    let is_old = false;
    const asked = {name: record, x, from: window?.[0], to: window?.[1], width: x === "time" ? 900 : 400};
    const all = models.map((model, k) => ask("/api/traces", {...asked, y, model})
      .then((got) => ({label: models.every((m) => folder_of(m) === folder_of(model)) ? short(model).split(": ").at(-1) : short(model), colour: k + 1, ...got})));
    // The measured force is the same in all traces.
    if (view !== "residual" && models.length > 0)
      all.unshift(ask("/api/traces", {...asked, y: "measured", model: models[0]}).then((got) => ({label: "measured", colour: 0, width: 2.5, ...got})));
    Promise.all(all).then((got) => {
      if (is_old) return;
      set_series(got);
      set_range(x === "time" && got.length > 0 ? window ?? [got[0].first, got[0].last] : undefined);
    }).catch((problem) => {
      if (is_old) return;
      set_series([]);
      on_error?.(problem.message);
    });
    return () => { is_old = true; };
  }, [view, record, models.join("\n"), window?.[0], window?.[1]]);
  return html`<${Plot} title=${title ?? heading} x_label=${x_label} y_label=${y_label} series=${series} x_range=${range}
    on_zoom=${x === "time" ? on_zoom : undefined} theme=${theme} height=${height} keep=${keep} wide=${wide} />`;
}

export function Compare({known, version, theme}) {
  const [fitted, set_fitted] = useState([]), [chosen, set_chosen] = useState(), [name, set_name] = useState();
  const [window, set_window] = useState(), [all_of, set_all_of] = useState(""), [error, set_error] = useState("");
  useEffect(() => { ask("/api/fitted").then((got) => set_fitted(got.models)); }, [version]);
  const models = (chosen ?? fitted.slice(0, 2)).filter((model) => fitted.includes(model));
  const records = known?.records ?? [], record = records.find((r) => r.name === name) ?? records[0];
  const zoom = (from, to) => set_window(from === undefined ? undefined : [from, to]);
  const turn = (model) => () => { set_error(""); set_chosen(models.includes(model) ? models.filter((m) => m !== model) : [...models, model]); };
  const of_motion = records.filter((r) => r.condition === record?.condition);
  const common = {record: record?.name, models, theme, on_error: set_error};
  return html`<main>
    <div class="side"><h2>Models</h2>
      ${fitted.length === 0 ? html`<p class="note">Fitted models come here.</p>` : html`<fieldset class="checks"><legend class="hidden">Models to compare</legend>
        ${fitted.map((model) => html`<label key=${model}><input type="checkbox" checked=${models.includes(model)} onChange=${turn(model)} /><span>${short(model)}</span></label>`)}</fieldset>`}
      <label class="field">Record<select value=${record?.name} onChange=${(event) => { set_error(""); set_name(event.target.value); set_window(undefined); }}>
        ${records.map((r) => html`<option value=${r.name}>${plain(r.name)}</option>`)}</select></label>
      <label class="field">The same plot for all records of this motion<select value=${all_of} onChange=${(event) => set_all_of(event.target.value)}>
        <option value="">off</option>${Object.entries(kViews).map(([key, view]) => html`<option value=${key}>${view[2]}</option>`)}</select></label>
    </div>
    <div class="work">
      ${models.length === 0 || !record ? html`<p class="empty">Choose models to see them over a record.</p>` : html`
        <div class="row"><h2>${plain(record.name)}</h2>${window && html`<button class="plain" onClick=${() => zoom()}>Show all</button>`}</div>
        ${error && html`<p class="error" role="alert">${error}</p>`}
        <div class="plots">
          <${Overlay} ...${common} view="time" window=${window} on_zoom=${zoom} height=${260} keep="force-in-time" wide=${true} />
          <${Overlay} ...${common} view="velocity" window=${window} height=${320} keep="force-velocity" />
          <${Overlay} ...${common} view="displacement" window=${window} height=${320} keep="force-displacement" />
          <${Overlay} ...${common} view="residual" window=${window} on_zoom=${zoom} height=${200} keep="residual" wide=${true} />
        </div>
        ${all_of && html`<h2>${kViews[all_of][2]}: all records of ${record.condition || "this motion"}</h2><div class="plots">${of_motion.map((r, k) =>
          html`<${Overlay} key=${r.name} ...${common} record=${r.name} view=${all_of} title=${plain(r.name)} height=${230} keep=${`${all_of}-${k + 1}`} />`)}</div>`}
        <h3>The forces in these figures</h3>
        ${models.map((model) => html`<${Command} words=${["evaluate", `${known.folder}/${model}`, known.folder, "--traces", "csv", "--output", "traces"]} />`)}`}
    </div>
  </main>`;
}
