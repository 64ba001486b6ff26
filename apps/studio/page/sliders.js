// A model under the hand: current, amplitude and frequency of a sine and the parameters of a law as sliders, the loops
// redrawn at each move. The model runs here, as the module that `dashpot export --to js` writes.
import {html, useEffect, useMemo, useRef, useState} from "/htm.mjs";
import {ask} from "/ask.js";
import {Command} from "/command.js";
import {extent, Plot} from "/plot.js";
import {beyond, kept_range, loop_of, loop_words, motion_sliders, parameter_sliders, place_of, three_digits, value_at} from "/loops.js";

const kHandle = 400;  // places of a slider
const short = (path) => path.replace(/^fits\//, "").replace("/models/", ": ").replace(/\.json$/, "");
const shown = ({scale, unit}, value) => `${three_digits(scale * value)} ${unit}`.trim();

function Slider({slider, value, on_move}) {
  const id = `set-${slider.key}`, text = shown(slider, value);
  return html`<div class="slider"><label for=${id} title=${slider.meaning}>${slider.label}</label><output for=${id}>${text}</output>
    <input type="range" id=${id} min="0" max=${kHandle} step="1" title=${slider.meaning} aria-valuetext=${text}
      value=${Math.round(kHandle * place_of(slider, value))} onInput=${(event) => on_move(slider.key, value_at(slider, event.target.value / kHandle))} /></div>`;
}

// The plots' axes stand still while the loops fill half of them.
function Loops({loop, before, theme}) {
  const ranges = useRef({});
  const plot = (key, title, x_label) => {
    const series = [...before ? [{label: "as identified", colour: 0, x: before[key], y: before.force}] : [],
      {label: "as set", colour: 1, width: 2, x: loop[key], y: loop.force}];
    const range = (name, lists) => ranges.current[`${key} ${name}`] = kept_range(ranges.current[`${key} ${name}`], extent(lists));
    return html`<${Plot} title=${title} x_label=${x_label} y_label="Force (N)" series=${series} theme=${theme} height=${360} keep=${`sliders-${key}`}
      x_range=${range("x", series.map((s) => s.x))} y_range=${range("y", series.map((s) => s.y))} />`;
  };
  return html`<div class="plots">${plot("velocity", "Force over velocity", "Velocity (mm/s)")}${plot("displacement", "Force over displacement", "Displacement (mm)")}</div>`;
}

function Model({program, theme}) {
  const {model} = program;
  const sliders = useMemo(() => motion_sliders(model), [program]), own = useMemo(() => parameter_sliders(model), [program]);
  const start = useMemo(() => Object.fromEntries(sliders.map(({key, value}) => [key, value])), [program]);
  const [setting, set_setting] = useState(start), [parameters, set_parameters] = useState({});
  const loop = loop_of(program, setting, parameters), is_changed = Object.keys(parameters).length > 0;
  const outside = beyond(model, setting);
  const reset = () => { set_setting(start); set_parameters({}); };
  const bound = (list, values, set) => list.map((slider) => html`<${Slider} key=${slider.key} slider=${slider} value=${values[slider.key] ?? slider.value}
    on_move=${(key, value) => set((now) => ({...now, [key]: value}))} />`);
  return html`<h2>${model.title}</h2><div class="moved">
    <div class="controls">${bound(sliders, setting, set_setting)}
      <button class="plain" onClick=${reset}>As identified</button>
      ${own.length > 0 ? html`<details open><summary>Parameters of the law</summary>${bound(own, parameters, set_parameters)}</details>`
      : html`<p class="note">Its numbers were fitted as a whole: none has a meaning of its own to be set by.</p>`}</div>
    <div class="loops"><${Loops} loop=${loop} before=${is_changed ? loop_of(program, setting, {}) : undefined} theme=${theme} />
      <p class="beyond" role="status">${outside.length > 0 && `Outside the data: ${outside.join("; ")}. What is drawn there is extrapolated.`}</p>
      <p class="note" aria-live="polite">${loop_words(loop)}</p></div>
  </div>`;
}

export function Sliders({known, version, theme}) {
  const [fitted, set_fitted] = useState([]), [chosen, set_chosen] = useState(), [got, set_got] = useState({}), [error, set_error] = useState("");
  useEffect(() => { ask("/api/fitted").then((answer) => set_fitted(answer.models)).catch((problem) => set_error(problem.message)); }, [version]);
  const path = fitted.includes(chosen) ? chosen : fitted[0];
  useEffect(() => {
    if (!path) return;
    let is_old = false;
    set_error("");
    import(`/api/module?model=${encodeURIComponent(path)}`).then((program) => is_old || set_got({path, program}))
      // A browser does not say why a module could not be had: asked for again, the studio does.
      .catch((problem) => ask("/api/module", {model: path}).then(() => problem, (said) => said).then(({message}) => is_old || set_error(message)));
    return () => { is_old = true; };
  }, [path]);
  return html`<main>
    <div class="side"><h2>Models</h2>
      ${fitted.length === 0 ? html`<p class="note">Fitted models come here.</p>` : html`<fieldset class="checks"><legend class="hidden">Model to move</legend>
        ${fitted.map((model) => html`<label key=${model}><input type="radio" name="moved" checked=${model === path} onChange=${() => set_chosen(model)} /><span>${short(model)}</span></label>`)}</fieldset>`}
    </div>
    <div class="work">
      ${error && html`<p class="error" role="alert">${error}</p>`}
      ${!path ? html`<p class="empty">Fit a model to move its sliders.</p>` : got.path === path && html`<${Model} key=${path} program=${got.program} theme=${theme} />
        <h3>The model as a module of JavaScript, as it runs here</h3><${Command} words=${["export", `${known?.folder ?? "."}/${path}`, "--to", "js"]} />`}
    </div>
  </main>`;
}
