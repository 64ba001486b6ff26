// A model of the project in forms that other programs take.
import {html, useEffect, useState} from "/htm.mjs";
import {ask, opened, tell} from "/ask.js";
import {Command} from "/command.js";
import {useKept} from "/kept.js";

export const model_label = (path) => path.replace(/^(fits|designs)\//, "").replace("/models/", ": ").replace(/\.json$/, "");
const size_text = (bytes) => bytes < 1e4 ? `${bytes} B` : bytes < 1e6 ? `${Math.round(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

export function ModelOptions({models}) {
  const groups = [["Fitted", models.filter((m) => m.startsWith("fits/"))], ["Designed", models.filter((m) => m.startsWith("designs/"))]];
  return groups.filter(([, of]) => of.length > 0).map(([title, of]) => html`<optgroup label=${title}>${of.map((model) => html`<option key=${model} value=${model}>${model_label(model)}</option>`)}</optgroup>`);
}

export function Export({version, fits}) {
  const [models, set_models] = useState(), [formats, set_formats] = useState([]);
  const [chosen, set_chosen] = useKept("export.model", ""), [wanted, set_wanted] = useKept("export.formats", ["fmu3"]);
  const [more, set_more] = useKept("export.more", {name: "", precision: "", sample_time: ""});
  const [done, set_done] = useState([]), [error, set_error] = useState(""), [busy, set_busy] = useState(false);
  useEffect(() => { ask("/api/dampers").then((got) => set_models(got.models)); }, [version, fits]);
  const reload = () => ask("/api/exports").then((got) => set_done(got.exports));
  useEffect(() => { reload(); }, []);
  useEffect(() => { ask("/api/formats").then((got) => set_formats(got.formats)); }, []);
  const model = models?.includes(chosen) ? chosen : models?.[0] ?? "";
  const turn = (name) => () => set_wanted(wanted.includes(name) ? wanted.filter((f) => f !== name) : [...wanted, name]);
  const start = async (event) => {
    event.preventDefault();
    set_busy(true);
    const got = await tell("/api/export", {model, formats: formats.map((f) => f.name).filter((f) => wanted.includes(f)), ...more}).catch((problem) => ({error: problem.message}));
    set_busy(false);
    set_error(got.error ?? "");
    await reload();
  };
  const link = (folder, file) => opened(`/api/exported?${new URLSearchParams({folder, ...(file ? {file} : {})})}`);
  const field = (key) => (event) => set_more({...more, [key]: event.target.value});
  return html`<main>
    <form class="side" onSubmit=${start}>
      <h2>Export</h2>
      <label class="field">Model<select value=${model} onChange=${(event) => set_chosen(event.target.value)}><${ModelOptions} models=${models ?? []} /></select></label>
      <fieldset class="checks"><legend class="hidden">Formats</legend>${formats.map((f) => html`<label key=${f.name} title="From ${f.takes}; writes ${f.files}">
        <input type="checkbox" value=${f.name} checked=${wanted.includes(f.name)} onChange=${turn(f.name)} /><span>${f.title}</span><small>${f.name}</small></label>`)}</fieldset>
      <label class="field">Name of files and functions<input value=${more.name} placeholder="the model's" onInput=${field("name")} /></label>
      <label class="field">Precision of C and ONNX<select value=${more.precision} onChange=${field("precision")}><option value="">double in C, float in ONNX</option><option value="double">double</option><option value="float">float</option></select></label>
      <label class="field">Sample time<input value=${more.sample_time} placeholder="of the model's data, or 1 ms" onInput=${field("sample_time")} /></label>
      <button class="strong" disabled=${!model || wanted.length === 0 || busy}>${busy ? "Exporting ..." : "Export"}</button>
      ${error && html`<p class="error" role="alert">${error}</p>`}
    </form>
    <div class="work"><h2>Files</h2>
      ${done.length === 0 ? html`<p class="empty">${models?.length === 0 ? "Fitted and designed models can be exported; there is none yet." : "Choose a model and what it is to become."}</p>` : done.map((one) => html`
        <section class="fit" key=${one.folder} aria-label="Export of ${model_label(one.model)}">
          <header><h3>${model_label(one.model)}</h3><span class="state" role="status">${one.files.length} files in exports/${one.folder}</span>
            <a class="strong" href=${link(one.folder)} download>All as a zip</a></header>
          <div class="frame"><table><caption class="hidden">The files of this export</caption><thead><tr><th>File</th><th class="number">Size</th></tr></thead>
            <tbody>${one.files.map((file) => html`<tr key=${file.name}><td><a href=${link(one.folder, file.name)} download>${file.name}</a></td><td class="number">${size_text(file.bytes)}</td></tr>`)}</tbody></table></div>
          <${Command} words=${one.arguments} />
        </section>`)}
    </div></main>`;
}
