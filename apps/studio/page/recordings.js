// What was recorded: how each file was understood, its plots, and corrections by hand.
import {html, useEffect, useMemo, useRef, useState} from "/htm.mjs";
import {ask, tell, upload} from "/ask.js";
import {Command} from "/command.js";
import {Plot} from "/plot.js";

const kChannels = ["displacement", "velocity", "acceleration", "force", "current", "voltage", "temperature"];

export const file_of = (record, known) => {
  const found = known.columns.find((c) => record.source === c.file || record.source.startsWith(`${c.file},`));
  const path = found ? found.file : record.source;
  return {path, relative: path.startsWith(`${known.folder}/`) ? path.slice(known.folder.length + 1) : path};
};

// A record's name and condition without the folder that all share.
export const plain = (name) => name.replace(/^recordings\//, "");

// Files of a drop, those in folders too, each with its path.
async function dropped_files(transfer) {
  const files = [];
  const walk = async (entry, path) => {
    if (entry.isFile) files.push([`${path}${entry.name}`, await new Promise((done, fail) => entry.file(done, fail))]);
    if (!entry.isDirectory || entry.name.startsWith(".")) return;
    const reader = entry.createReader();
    for (let part; (part = await new Promise((done, fail) => reader.readEntries(done, fail))).length;)
      for (const inner of part) await walk(inner, `${path}${entry.name}/`);
  };
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  for (const entry of entries) await walk(entry, "");
  return files;
}

function DropZone({formats, on_done}) {
  const [over, set_over] = useState(false), [state, set_state] = useState(""), [errors, set_errors] = useState([]);
  const files_input = useRef(), folder_input = useRef();
  const take = async (files) => {
    const wrong = [];
    for (const [k, [name, file]] of files.entries()) {
      set_state(`${k + 1} of ${files.length}: ${name}`);
      if (!name.split("/").at(-1).startsWith(".")) await upload(name, file).catch((error) => wrong.push(error.message));
    }
    set_state("");
    set_errors(wrong);
    on_done();
  };
  const chosen = (event) => take([...event.target.files].map((file) => [file.webkitRelativePath || file.name, file]));
  return html`<div class="drop ${over ? "over" : ""}"
      onDragOver=${(event) => { event.preventDefault(); set_over(true); }} onDragLeave=${() => set_over(false)}
      onDrop=${async (event) => { event.preventDefault(); set_over(false); take(await dropped_files(event.dataTransfer)); }}>
    <span>Drop recordings here, or choose</span>
    <button class="plain" onClick=${() => files_input.current.click()}>Files</button>
    <button class="plain" onClick=${() => folder_input.current.click()}>Folder</button>
    <input ref=${files_input} id="files" type="file" multiple hidden onChange=${chosen} aria-label="Recordings" />
    <input ref=${folder_input} id="folder" type="file" webkitdirectory hidden onChange=${chosen} aria-label="A folder of recordings" />
    <span class="note" role="status">${state || formats}</span>
    ${errors.map((error) => html`<span class="error">${error}</span>`)}
  </div>`;
}

// Parts of a window of time come from the server as fine as the plot is wide.
function useView(path, record, x, y, window, width, version) {
  const [view, set_view] = useState({x: [], y: []});
  useEffect(() => {
    if (record === undefined) return;
    let is_old = false;
    ask(path, {name: record, x, y, from: window?.[0], to: window?.[1], width}).then((got) => is_old || set_view(got)).catch(() => is_old || set_view({x: [], y: []}));
    return () => { is_old = true; };
  }, [path, record, x, y, window?.[0], window?.[1], width, version]);
  return view;
}

function ChannelPlot({record, version, x, y, title, x_label, y_label, window, on_zoom, theme, height, width = 900}) {
  const view = useView("/api/view", record, x, y, window, width, version);
  const is_time = x === "time";
  return html`<${Plot} title=${title} x_label=${x_label} y_label=${y_label} height=${height} theme=${theme}
    series=${[{label: "", colour: 1, x: view.x, y: view.y}]}
    x_range=${is_time ? window ?? (view.first === undefined ? undefined : [view.first, view.last]) : undefined}
    on_zoom=${is_time ? on_zoom : undefined} />`;
}

// What the boxes of the table ask for, as words of --set.
function corrections_of(rows, edits, known_level) {
  const words = [];
  for (const row of rows) {
    const edit = edits[row.column] ?? {};
    const channel = edit.channel ?? row.channel;
    if (edit.channel !== undefined && row.channel && edit.channel !== row.channel) words.push(`${row.channel}=none`);
    if (!channel || channel === "time") continue;
    if (edit.channel !== undefined && edit.channel !== row.channel) {
      const number = /^column (\d+)$/.exec(row.column);
      words.push(`${channel}.column=${number ? number[1] : row.column}`);
      if (edit.unit === undefined && row.unit) words.push(`${channel}.unit=${row.unit}`);
    }
    for (const key of ["unit", "sign"]) if (edit[key]) words.push(`${channel}.${key}=${edit[key]}`);
  }
  const {level, from, to, rest} = edits[""] ?? {};
  if (level) words.push(`level=${level}`);
  if (from || to) words.push(`cut=${from ?? ""}:${to ?? ""}`);
  if (rest) words.push(`rest=${rest}`);
  return words.sort((a, b) => b.endsWith("=none") - a.endsWith("=none")).join("; ");
}

function Correction({record, known, on_done}) {
  const [edits, set_edits] = useState({}), [error, set_error] = useState(""), [busy, set_busy] = useState(false);
  const {path, relative} = file_of(record, known);
  const rows = useMemo(() => {
    const seen = new Set();
    return known.columns.filter((c) => c.file === path && !c.column.startsWith("(") && !seen.has(c.column) && seen.add(c.column));
  }, [known, path]);
  const edit = (column, key) => (event) => set_edits({...edits, [column]: {...edits[column], [key]: event.target.value}});
  const set = corrections_of(rows, edits);
  const words = ["inspect", known.folder, "--correct", relative, "--set", set];
  const correct = async (event) => {
    event.preventDefault();
    set_busy(true);
    const got = await tell("/api/correct", {file: relative, set}).catch((problem) => ({error: problem.message}));
    set_busy(false);
    set_error(got.error ?? "");
    if (!got.error) { set_edits({}); on_done(); }
  };
  const own = edits[""] ?? {};
  return html`<form onSubmit=${correct} class="fit">
    <h3>How ${relative} was understood</h3>
    <div class="frame"><table><caption class="hidden">Columns of the file, and what each was taken for</caption>
      <thead><tr><th>Column</th><th>Channel</th><th>Unit</th><th>Sign</th><th>Why</th></tr></thead>
      <tbody>${rows.map((row) => html`<tr key=${row.column}>
        <td>${row.column}</td>
        <td>${row.channel === "time" ? "time" : html`<select aria-label="Channel of ${row.column}" value=${edits[row.column]?.channel ?? row.channel} onChange=${edit(row.column, "channel")}>
          <option value="">not used</option>${[...new Set([...kChannels, row.channel].filter(Boolean))].map((c) => html`<option value=${c}>${c}</option>`)}</select>`}</td>
        <td>${row.channel === "time" ? row.unit : html`<input aria-label="Unit of ${row.column}" placeholder=${row.unit || "SI"} value=${edits[row.column]?.unit ?? ""} onInput=${edit(row.column, "unit")} />`}</td>
        <td>${row.channel === "time" ? "" : html`<select aria-label="Sign of ${row.column}" value=${edits[row.column]?.sign ?? ""} onChange=${edit(row.column, "sign")}>
          <option value="">as it is</option><option value="1">+1</option><option value="-1">−1</option></select>`}</td>
        <td class="note">${row.basis}</td></tr>`)}</tbody></table></div>
    <div class="row">
      <label class="field">Drive level (${known.drive_unit})<input size="8" inputmode="decimal" placeholder=${record.drive_level ?? ""} value=${own.level ?? ""} onInput=${edit("", "level")} /></label>
      <label class="field">Cut from (s)<input size="8" inputmode="decimal" value=${own.from ?? ""} onInput=${edit("", "from")} /></label>
      <label class="field">Cut to (s)<input size="8" inputmode="decimal" value=${own.to ?? ""} onInput=${edit("", "to")} /></label>
      <label class="field">Rest at the ends<select value=${own.rest ?? ""} onChange=${edit("", "rest")}><option value="">as it is</option><option value="drop">drop</option><option value="keep">keep</option></select></label>
      <button class="strong" disabled=${!set || busy}>${busy ? "Reading ..." : "Correct"}</button>
    </div>
    ${error && html`<p class="error" role="alert">${error}</p>`}
    ${set && html`<${Command} words=${words} />`}
    <p class="note">A correction is written into dataset.yaml of the folder, which every command reads; comments and entries that are there stay.</p>
  </form>`;
}

export function Recordings({known, version, theme, on_changed}) {
  const [chosen, set_chosen] = useState(), [window, set_window] = useState();
  const records = known?.records ?? [];
  // A correction may give a record another place in the list, or another name.
  const place_of = (key) => records.findIndex((r) => r[key] === chosen?.[key]), named = place_of("name");
  const at = Math.max(0, named < 0 ? place_of("source") : named), record = records[at];
  useEffect(() => set_window(undefined), [record?.name, version]);
  const zoom = (from, to) => set_window(from === undefined ? undefined : [from, to]);
  const doubts = new Map((known?.suspects ?? []).map((s) => [s.record, s.why]));
  const drive = known?.drive_unit === "V" ? "voltage" : "current";
  const in_time = record ? [["displacement", "Displacement (m)"], ["velocity", "Velocity (m/s)"], ["force", "Force (N)"],
    [drive, drive === "current" ? "Current (A)" : "Voltage (V)"]].filter(([name]) => record.channels.includes(name)) : [];
  return html`<main>
    <div class="side">
      <h2>Recordings</h2>
      <${DropZone} formats=${known?.formats} on_done=${on_changed} />
      ${known?.error && records.length === 0 && html`<p class="note">${known.error}</p>`}
      <ul class="list" aria-label="Records">${records.map((r, k) => html`<li key=${r.name} class=${doubts.has(r.name) ? "doubt" : ""}>
        <button aria-current=${k === at} onClick=${() => set_chosen(r)}>${plain(r.name)}
          <small>${doubts.get(r.name) ?? [r.condition === r.name ? "" : plain(r.condition), r.drive_level === null ? "" : `${+r.drive_level.toPrecision(4)} ${known.drive_unit}`, `${r.samples} samples`].filter(Boolean).join(" · ")}</small></button></li>`)}</ul>
      ${known?.unread?.length > 0 && html`<details open><summary>${known.unread.length} not read</summary>${known.unread.map((f) => html`<p class="error">${f.why}</p>`)}</details>`}
      ${known?.passed_over?.length > 0 && html`<details><summary>${known.passed_over.length} passed over</summary>${known.passed_over.map((f) => html`<p class="note">${f.file}: ${f.why}</p>`)}</details>`}
      ${known?.notes?.length > 0 && html`<details><summary>${known.notes.length} notes on all</summary>${known.notes.map((n) => html`<p class="note">${n}</p>`)}</details>`}
    </div>
    <div class="work">
      ${!record ? html`<p class="empty">Drop recordings of a damper to see them.</p>` : html`
        <div class="row"><h2>${plain(record.name)}</h2>${window && html`<button class="plain" onClick=${() => zoom()}>Show all</button>`}
          <span class="note">A drag along time zooms; with Ctrl or Shift, the wheel does.</span></div>
        <div class="plots">${in_time.map(([name, label]) => html`<${ChannelPlot} key=${name} record=${record.name} version=${version} x="time" y=${name} title=${label.replace(/ \(.*/, "")}
          x_label="Time (s)" y_label=${label} window=${window} on_zoom=${zoom} theme=${theme} height=${190} />`)}
          ${[["velocity", "Velocity (m/s)"], ["displacement", "Displacement (m)"]].filter(([name]) => record.channels.includes(name) && record.channels.includes("force")).map(([name, label]) =>
            html`<${ChannelPlot} key=${`loop-${name}`} record=${record.name} version=${version} x=${name} y="force" title="Force over ${name}" x_label=${label} y_label="Force (N)" window=${window} theme=${theme} height=${300} width=${400} />`)}
        </div>
        ${record.notes.length > 0 && html`<details><summary>${record.notes.length} notes on this record</summary>${record.notes.map((n) => html`<p class="note">${n}</p>`)}</details>`}
        <${Correction} key=${record.name} record=${record} known=${known} on_done=${on_changed} />
        <${Command} words=${["inspect", known.folder]} />`}
    </div>
  </main>`;
}
