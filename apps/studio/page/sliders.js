// A model under the hand: current, amplitude and frequency of a sine and the parameters of a law or a damper as sliders, the
// loops redrawn at each move over a measured one. The model runs here, as the module that `dashpot export --to js` writes.
import {html, useEffect, useMemo, useRef, useState} from "/htm.mjs";
import {ask, opened, tell} from "/ask.js";
import {Command} from "/command.js";
import {useKept} from "/kept.js";
import {extent, Plot} from "/plot.js";
import {plain} from "/recordings.js";
import {beyond, kept_range, loop_curves, loop_of, loop_words, member_of, motion_of, motion_sliders, parameter_sliders, place_of, three_digits, value_at} from "/loops.js";

const kHandle = 400;  // places of a slider
const kStyles = {measured: {colour: 0, width: 3}, physics: {colour: 3, width: 1.2}, before: {colour: 2, dash: [6, 4]}, band: {colour: 1, width: 1, dash: [2, 3]}, set: {colour: 1, width: 2}};
const short = (path) => path.replace(/^fits\//, "").replace("/models/", ": ").replace(/\.json$/, "");
const shown = ({scale, unit}, value) => `${three_digits(scale * value)} ${unit}`.trim();

function Slider({slider, value, on_move}) {
  const id = `set-${slider.key}`, text = shown(slider, value);
  return html`<div class="slider"><label for=${id} title=${slider.meaning}>${slider.label}</label><output for=${id}>${text}</output>
    <input type="range" id=${id} min="0" max=${kHandle} step="1" title=${slider.meaning} aria-valuetext=${text}
      value=${Math.round(kHandle * place_of(slider, value))} onInput=${(event) => on_move(slider.key, value_at(slider, event.target.value / kHandle))} /></div>`;
}

// The plots' axes stand still while the loops fill half of them, from each reset on.
function Loops({loop, before, record, level, resets, theme}) {
  const ranges = useRef({});
  if (ranges.current.resets !== resets) ranges.current = {resets};
  const plot = (key, title, x_label) => {
    const series = loop_curves(key, loop, before, record, level).map(({role, ...curve}) => ({...curve, ...kStyles[role]}));
    const range = (name, lists) => ranges.current[`${key} ${name}`] = kept_range(ranges.current[`${key} ${name}`], extent(lists));
    return html`<${Plot} title=${title} x_label=${x_label} y_label="Force (N)" series=${series} theme=${theme} height=${360} keep=${`sliders-${key}`}
      x_range=${range("x", series.map((s) => s.x))} y_range=${range("y", series.map((s) => s.y))} />`;
  };
  return html`<div class="plots">${plot("velocity", "Force over velocity", "Velocity (mm/s)")}${plot("displacement", "Force over displacement", "Displacement (mm)")}</div>`;
}

// The measured loops of one of the records at constant drive, as loops.js takes them.
function useRecord(records, at) {
  const [loops, set_loops] = useState(), found = records[at];
  useEffect(() => {
    set_loops(undefined);
    if (!found) return;
    let is_old = false;
    const over = async (x) => {
      const got = await ask("/api/view", {name: found.name, x, y: "force", width: 400});
      return {x: got.x.map((value) => value === null ? NaN : 1e3 * value), y: got.y};
    };
    Promise.all([over("velocity"), over("displacement")])
      .then(([velocity, displacement]) => is_old || set_loops({name: found.name, current: found.drive_level, conditions: found.conditions, velocity, displacement}))
      .catch(() => {});
    return () => { is_old = true; };
  }, [found?.name]);
  return loops;
}

function Model({program, path, known, theme, on_fit}) {
  const {model} = program;
  const records = useMemo(() => (known?.records ?? []).filter((record) => record.drive_level !== null), [known]);
  const [over, set_over] = useKept("sliders-over", records.length >> 1), record = useRecord(records, over);
  const sliders = useMemo(() => motion_sliders(model), [program]), own = useMemo(() => parameter_sliders(model), [program]);

  // The sliders stand where the record has them, or in the middle of the data.
  const start = useMemo(() => ({...Object.fromEntries(sliders.map(({key, value}) => [key, value])), ...record ? motion_of(record) : {}}), [program, record]);
  const damper = useMemo(() => record ? member_of(record, model) : {}, [program, record]);
  const [setting, set_setting] = useState(start), [parameters, set_parameters] = useState(damper), [resets, set_resets] = useState(0);
  const reset = () => { set_setting(start); set_parameters(damper); set_resets((count) => count + 1); };
  useEffect(reset, [start, damper]);

  // A member takes all of these but the yield stress, which follows from a drawing.
  const changes = Object.entries(parameters).filter(([name, value]) => model.kind === "family" && name !== "yield_stress" && value !== own.find(({key}) => key === name).value);
  const loop = loop_of(program, setting, parameters), is_changed = Object.entries(parameters).some(([name, value]) => value !== damper[name]);
  const outside = beyond(model, setting, parameters);
  const bound = (list, values, set) => list.map((slider) => html`<${Slider} key=${slider.key} slider=${slider} value=${values[slider.key] ?? slider.value}
    on_move=${(key, value) => set((now) => ({...now, [key]: value}))} />`);
  return html`<h2>${model.title}</h2><div class="moved">
    <div class="controls">
      ${records.length > 0 && html`<label class="field">Measured record<select value=${over} onChange=${(event) => set_over(event.target.value === "" ? "" : Number(event.target.value))}>
        ${records.map(({name}, k) => html`<option value=${k}>${plain(name)}</option>`)}<option value="">no record</option></select></label>`}
      ${bound(sliders, setting, set_setting)}
      <span class="row"><button class="plain" onClick=${reset}>As identified</button>
        ${model.kind === "law" && html`<button class="plain" disabled=${!is_changed} title="Fits this law again; its search begins with these parameters, and nowhere else" onClick=${() => on_fit(path, parameters)}>Fit from here</button>`}</span>
      ${own.length > 0 ? html`<details open><summary>${model.kind === "family" ? "The damper" : "Parameters of the law"}</summary>${bound(own, parameters, set_parameters)}</details>`
      : html`<p class="note">Its numbers were fitted as a whole: none has a meaning of its own to be set by.</p>`}</div>
    <div class="loops"><${Loops} loop=${loop} before=${is_changed ? loop_of(program, setting, damper) : undefined} record=${record} level=${model.interval?.level} resets=${resets} theme=${theme} />
      <p class="beyond" role="status">${outside.length > 0 && `Outside the data: ${outside.join("; ")}. What is drawn there is extrapolated.`}</p>
      <p class="note" aria-live="polite">${loop_words(loop)}</p></div>
  </div>
  ${changes.length > 0 && html`<h3 title="Its yield stress follows from a drawing: --damper">This damper as a model of its own</h3>
    <${Command} words=${["member", `${known?.folder ?? "."}/${path}`, "--set", changes.map(([name, value]) => `${name}=${+value.toPrecision(6)}`).join(","), "-o", "member.json"]} />`}`;
}

export function Sliders({known, version, theme, fits, go, on_changed}) {
  const [fitted, set_fitted] = useState([]), [chosen, set_chosen] = useKept("sliders-model"), [got, set_got] = useState({}), [error, set_error] = useState("");
  useEffect(() => { ask("/api/fitted").then((answer) => set_fitted(answer.models)).catch((problem) => set_error(problem.message)); }, [version]);
  const path = fitted.includes(chosen) ? chosen : fitted[0];
  useEffect(() => {
    if (!path) return;
    let is_old = false;
    set_error("");
    import(opened(`/api/module?model=${encodeURIComponent(path)}`)).then((program) => is_old || set_got({path, program}))
      // A browser does not say why a module could not be had: asked for again, the studio does.
      .catch((problem) => ask("/api/module", {model: path}).then(() => problem, (said) => said).then(({message}) => is_old || set_error(message)));
    return () => { is_old = true; };
  }, [path]);
  // A fit of one law whose search begins with what the sliders say.
  const fit_from = async (model, parameters) => {
    const law = model.split("/").at(-1).replace(/\.json$/, "");
    let name = `${law} from here`;
    for (let k = 2; fits.some((fit) => fit.name === name); ++k) name = `${law} from here ${k}`;
    const said = await tell("/api/fits", {action: "start", name, models: [law], from: {model, parameters}}).catch((problem) => ({error: problem.message}));
    set_error(said.error ?? "");
    if (said.error) return;
    on_changed();
    go("fits");
  };
  return html`<main>
    <div class="side"><h2>Models</h2>
      ${fitted.length === 0 ? html`<p class="note">Fitted models come here.</p>` : html`<fieldset class="checks"><legend class="hidden">Model to move</legend>
        ${fitted.map((model) => html`<label key=${model}><input type="radio" name="moved" checked=${model === path} onChange=${() => set_chosen(model)} /><span>${short(model)}</span></label>`)}</fieldset>`}
    </div>
    <div class="work">
      ${error && html`<p class="error" role="alert">${error}</p>`}
      ${!path ? html`<p class="empty">Fit a model to move its sliders.</p>` : got.path === path && html`<${Model} key=${path} program=${got.program} path=${path} known=${known} theme=${theme} on_fit=${fit_from} />
        <h3>The model as a module of JavaScript, as it runs here</h3><${Command} words=${["export", `${known?.folder ?? "."}/${path}`, "--to", "js"]} />`}
    </div>
  </main>`;
}
