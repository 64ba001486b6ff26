// Numbers that a plant, a road or a controller takes: a slider around the default, and a field for any other value.
import {html} from "/htm.mjs";

const kReach = 10;
const rounded = (value) => String(+value.toPrecision(3));

// Where the slider goes from and to; logarithmic where the number is positive.
function scale_of({default: usual, lower, upper, span = 1}) {
  if (usual > 0 && lower >= 0) return {low: Math.log(Math.max(lower, usual / kReach)), high: Math.log(Math.min(upper, usual * kReach)), to: Math.log, from: Math.exp};
  const reach = usual === 0 ? Math.min(span, upper) : Math.abs(usual) * kReach;
  return {low: Math.max(lower, usual - reach), high: Math.min(upper, usual + reach), to: (x) => x, from: (x) => x};
}

export function Setting({row, value, on_change, name}) {
  const scale = scale_of(row), text = value ?? "", number = Number.isFinite(parseFloat(text)) ? parseFloat(text) : row.default;
  const place = Math.min(scale.high, Math.max(scale.low, scale.to(number)));
  const label = row.name.replaceAll("_", " ");
  return html`<div class="setting" title=${row.meaning}><span>${label}${row.unit === "1" ? "" : ` (${row.unit})`}</span>
    <input type="range" aria-label="${name}: ${label}" min=${scale.low} max=${scale.high} step="any" value=${place} onInput=${(event) => on_change(rounded(scale.from(+event.target.value)))} />
    <input aria-label="${name}: ${label}, as a number" inputmode="decimal" placeholder=${row.empty ?? rounded(row.default)} value=${text} onInput=${(event) => on_change(event.target.value)} /></div>`;
}

// What was typed as a number, or as it is for the studio to refuse; nothing where the field is empty.
export const typed = (text) => text.trim() === "" ? undefined : Number.isFinite(+text) ? +text : text;

// The settings of a thing, of which only those that were changed become words.
export const setting_words = (values = {}) => Object.entries(values).filter(([, value]) => value !== "").map(([name, value]) => `${name}=${value}`).join(",");
export const with_settings = (name, values) => [name, setting_words(values)].filter(Boolean).join(",");

const kClasses = ["A", "B", "C", "D", "E", "F", "G", "H"];
export function Settings({rows = [], values = {}, on_change, name}) {
  const change = (key) => (value) => on_change({...values, [key]: value});
  return rows.map((row) => row.name === "roughness"
    ? html`<label class="field" key="class">Class of ISO 8608<select value=${values.class ?? "C"} onChange=${(event) => change("class")(event.target.value)}>${kClasses.map((c) => html`<option value=${c}>${c}</option>`)}</select></label>`
    : html`<${Setting} key=${row.name} row=${row} name=${name} value=${values[row.name]} on_change=${change(row.name)} />`);
}
