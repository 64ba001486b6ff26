// A vehicle with a model as its damper: two of them side by side over one road, and what all controllers are worth in it.
import {html, useEffect, useMemo, useRef, useState} from "/htm.mjs";
import {ask, tell} from "/ask.js";
import {Command} from "/command.js";
import {ModelOptions} from "/export.js";
import {keep, useKept} from "/kept.js";
import {Plot} from "/plot.js";
import {Scatter} from "/scatter.js";
import {Settings, Setting, setting_words, typed, with_settings} from "/setting.js";
import {RideList} from "/rides.js";

const kNone = "none";
const kDrive = {name: "current", unit: "A or V", default: 0, lower: 0, upper: 20, span: 5, meaning: "of a damper that no controller drives"};
const kDuration = {name: "duration", unit: "s", default: 10, lower: 0.1, upper: 60, empty: "the road's", meaning: "of the drive; empty: as long as is usual on this road"};
const kMostDriven = 400;

// The whole of what one of the two dampers is driven with.
function drive_of(common, one) {
  const of_controller = one.controller ? {controller: with_settings(one.controller, one.values), in_car: common.in_car} : {current: typed(one.current)};
  return {plant: common.plant, values: setting_words(common.values), damper: one.damper, road: with_settings(common.road, common.road_values),
    duration: typed(common.duration), ...of_controller};
}

// Driven again whenever something was moved: one at a time, and then at once as it is meanwhile.
function useDrive(asked) {
  const key = asked && JSON.stringify(asked), wanted = useRef(), is_running = useRef(false), is_gone = useRef(false);
  const [state, set_state] = useState({});
  useEffect(() => () => { is_gone.current = true; }, []);
  useEffect(() => {
    wanted.current = key;
    if (!key) return set_state({});
    if (is_running.current) return;
    (async () => {
      is_running.current = true;
      for (let done; done !== wanted.current && wanted.current && !is_gone.current;) {
        done = wanted.current;
        const got = await tell("/api/drive", JSON.parse(done)).catch((problem) => ({error: problem.message}));
        if (wanted.current && !is_gone.current) set_state((old) => got.error ? {...old, error: got.error} : {got});
      }
      is_running.current = false;
    })();
  }, [key]);
  return state;
}

const measure = (run, name) => run?.measures.find((m) => m.name === name)?.value;
const spoken = (name) => name.replace(/^vdv$/, "vibration dose (VDV)").replace(/^mtvv$/, "greatest transient (MTVV)").replaceAll("_", " ");

// Both drives and the passive one, measure by measure.
function Measures({columns}) {
  const rows = columns[0].run.measures;
  const text = (value) => Number.isFinite(value) ? String(+value.toPrecision(4)) : "–";
  return html`<div class="frame"><table><caption class="hidden">Measures of the drives</caption>
    <thead><tr><th>Measure</th><th>Unit</th>${columns.map((c) => html`<th class="number" title=${c.title}>${c.title.split(":")[0]}</th>`)}</tr></thead>
    <tbody>${rows.map((row) => html`<tr key=${row.name}><td>${spoken(row.name)}</td><td>${row.unit === "1" ? "" : row.unit}</td>${columns.map((c) => html`<td class="number">${text(measure(c.run, row.name))}</td>`)}</tr>`)}</tbody></table></div>`;
}

// One channel of every drive over time, or over another channel.
function Traces({runs, x, y, title, x_label, y_label, window, on_zoom, theme, height, keep: file, wide}) {
  const [series, set_series] = useState([]), [range, set_range] = useState();
  const key = runs.map((run) => `${run.key} ${run.record} ${run.label}`).join("\n");
  useEffect(() => {
    let is_old = false;
    Promise.all(runs.filter((run) => run.channels.has(y)).map((run) => ask("/api/driven", {key: run.key, record: run.record, x, y, from: window?.[0], to: window?.[1], width: x === "time" ? 700 : 300})
      .then((got) => ({label: run.label, colour: run.colour, ...got})))).then((got) => {
      if (is_old) return;
      set_series(got);
      set_range(x === "time" && got.length > 0 ? window ?? [got[0].first, got[0].last] : undefined);
    }).catch(() => {});
    return () => { is_old = true; };
  }, [key, x, y, window?.[0], window?.[1]]);
  return html`<${Plot} title=${title} x_label=${x_label} y_label=${y_label} series=${series} x_range=${range} on_zoom=${x === "time" ? on_zoom : undefined} theme=${theme} height=${height} keep=${file} wide=${wide} />`;
}

function OneDamper({name, one, on_change, lists, models, may_be_off}) {
  const law = lists.controllers.find((c) => c.name === one.controller);
  const set = (change) => on_change({...one, ...change});
  return html`<fieldset class="one-damper"><legend><i class="swatch colour-${name === "A" ? 1 : 2}"></i> ${name}</legend>
    <label class="field">Damper<select value=${one.damper} onChange=${(event) => set({damper: event.target.value})}>
      ${may_be_off && html`<option value=${kNone}>nothing beside A</option>`}
      <option value="">the plant's own range, ideal</option>
      <${ModelOptions} models=${models} />
      <optgroup label="Published, and of common practice">${lists.dampers.map((d) => html`<option key=${d.name} value=${d.name}>${d.name}</option>`)}</optgroup></select></label>
    ${one.damper !== kNone && html`
      <label class="field">Controller<select value=${one.controller} onChange=${(event) => set({controller: event.target.value, values: {}})}>
        <option value="">none: the current stays</option>${lists.controllers.map((c) => html`<option key=${c.name} value=${c.name}>${c.title}</option>`)}</select></label>
      ${law ? html`<${Settings} name=${name} rows=${law.parameters} values=${one.values} on_change=${(values) => set({values})} />`
        : html`<${Setting} name=${name} row=${kDrive} value=${one.current} on_change=${(current) => set({current})} />`}`}
  </fieldset>`;
}

export function Machine({version, fits, theme}) {
  const [lists, set_lists] = useState(), [models, set_models] = useState();
  useEffect(() => { ask("/api/machine").then(set_lists); }, []);
  useEffect(() => { ask("/api/dampers").then((got) => set_models(got.models)); }, [version, fits]);
  return lists && models ? html`<${Drive} lists=${lists} models=${models} theme=${theme} fits=${fits} />` : html`<main></main>`;
}

function Drive({lists, models, theme, fits}) {
  const [common, set_common] = useKept("machine.common", {plant: "savaresi_spelta", values: {}, road: "iso8608", road_values: {}, duration: "10", in_car: false});
  const [a, set_a] = useKept("machine.a", {damper: models[0] ?? "", controller: "skyhook", values: {}, current: ""});
  const [b, set_b] = useKept("machine.b", {damper: kNone, controller: "skyhook", values: {}, current: ""});
  const [driven, set_driven] = useKept("machine.driven", []), [window, set_window] = useState();
  const set = (change) => { set_common({...common, ...change}); set_window(undefined); };
  const of_a = useDrive(drive_of(common, a)), of_b = useDrive(b.damper === kNone ? undefined : drive_of(common, b));
  const plant = lists.plants.find((p) => p.name === common.plant), road = lists.roads.find((r) => r.name === common.road);
  const kind = lists.kinds.find((k) => k.name === (plant?.kind || common.plant));

  // The curves of both, and of the passive vehicle behind them.
  const runs = useMemo(() => {
    const passive = [of_a, of_b].find((one) => one.got?.against)?.got;
    const run = (got, record, label, colour) => ({key: got.key, record, label, colour, channels: new Set(got.channels.map((c) => c.name))});
    return [passive && run(passive, 1, "passive", 0), of_a.got && run(of_a.got, 0, "A", 1),
      of_b.got && b.damper !== kNone && run(of_b.got, 0, "B", 2)].filter(Boolean);
  }, [of_a.got?.key, of_b.got?.key, b.damper]);
  const shown = [[of_a.got, "A", 1], [b.damper === kNone ? undefined : of_b.got, "B", 2]].filter(([got]) => got);
  const passive = shown.find(([got]) => got.against)?.[0].against;
  const columns = [...shown.map(([got, name]) => ({title: `${name}: ${got.run.name}, ${got.run.dampers.join(", ")}`, run: got.run})), ...(passive ? [{title: `passive: ${passive.name}`, run: passive}] : [])];
  const place = (run) => ({x: measure(run, "weighted_acceleration"), y: measure(run, "tyre_load")});

  // Every drive leaves a point, so that one sees what a slider trades.
  const ground = JSON.stringify(common);
  useEffect(() => {
    const next = driven.filter((point) => point.ground === ground);
    for (const [got, name, colour] of shown)
      if (!next.some((point) => point.key === got.key && point.colour === colour)) next.push({...place(got.run), key: got.key, colour, ground, label: `${name}: ${got.run.name}`});
    if (next.length !== driven.length) set_driven(next.slice(-kMostDriven));
  }, [of_a.got?.key, of_b.got?.key, ground]);
  const points = [...driven.filter((point) => point.ground === ground).map((point) => ({...point, is_faint: true})),
    ...(passive ? [{...place(passive), label: "passive", colour: 0, size: 6, is_named: true}] : []),
    ...shown.map(([got, name, colour]) => ({...place(got.run), label: name, colour, size: 6, is_named: true}))];

  const channels = of_a.got?.channels.map((c) => c.name) ?? [];
  const first = (ending, but) => channels.find((name) => name.endsWith(ending) && !(but && name.startsWith(but)));
  const tyre = first("_load")?.replace(/_load$/, ""), strut = first("_force", tyre)?.replace(/_force$/, "");
  const in_time = [[first("_acceleration"), "Body acceleration", "m/s²"], [tyre && `${tyre}_load`, "Tyre load", "N"], [strut && `${strut}_deflection`, "Deflection", "m"],
    [strut && `${strut}_force`, "Damper force", "N"], [strut && `${strut}_current`, "Drive", "A, V or share"], [tyre && `${tyre}_road`, "Road", "m"]].filter(([name]) => name && channels.includes(name));
  const zoom = (from, to) => set_window(from === undefined ? undefined : [from, to]);
  return html`<main>
    <div class="side"><h2>Vehicle</h2>
      <label class="field">Plant<select value=${common.plant} onChange=${(event) => set({plant: event.target.value, values: {}})}>
        ${lists.plants.map((p) => html`<option key=${p.name} value=${p.name}>${p.title}</option>`)}</select></label>
      ${kind?.parameters.length > 0 && html`<details><summary>Values of the plant</summary><${Settings} name="Plant" rows=${kind.parameters.map((row) => ({...row, default: plant?.values[row.name] ?? row.default}))} values=${common.values} on_change=${(values) => set({values})} /></details>`}
      <label class="field">Road<select value=${common.road} onChange=${(event) => set({road: event.target.value, road_values: {}, duration: event.target.value === "step" ? "" : common.duration})}>
        ${lists.roads.map((r) => html`<option key=${r.name} value=${r.name}>${r.title}</option>`)}</select></label>
      <details><summary>Settings of the road</summary><${Settings} name="Road" rows=${road?.parameters} values=${common.road_values} on_change=${(road_values) => set({road_values})} /></details>
      <${Setting} name="Drive" row=${kDuration} value=${common.duration} on_change=${(duration) => set({duration})} />
      <label class="tick"><input type="checkbox" checked=${common.in_car} onChange=${(event) => set({in_car: event.target.checked})} /> Sensors as in a car</label>
      <${OneDamper} name="A" one=${a} on_change=${set_a} lists=${lists} models=${models} />
      <${OneDamper} name="B" one=${b} on_change=${set_b} lists=${lists} models=${models} may_be_off=${true} />
    </div>
    <div class="work">
      ${[["A", of_a], ["B", of_b]].map(([name, one]) => one.error && html`<p class="error" role="alert">${name}: ${one.error}</p>`)}
      ${shown.length === 0 ? html`<p class="empty">${of_a.error ? "It cannot be driven so." : "Driving ..."}</p>` : html`
        <div class="row"><h2>${shown[0][0].ground}</h2>${window && html`<button class="plain" onClick=${() => zoom()}>Show all</button>`}
          <span class="note">${columns.map((c) => c.title).join("; ")}. Every drive leaves a point; a drag along time zooms.</span></div>
        <div class="plots">
          <${Scatter} title="Comfort against road holding" x_label="Weighted body acceleration (m/s²)" y_label="Dynamic tyre load (%)" points=${points} height=${320} theme=${theme} keep="comfort-holding" />
          <${Traces} runs=${runs} x=${`${strut}_velocity`} y=${`${strut}_force`} title="The damper at work" x_label="Velocity (m/s)" y_label="Force (N)" theme=${theme} height=${290} keep="damper-at-work" />
          ${in_time.map(([name, title, unit], k) => html`<${Traces} key=${name} runs=${name.endsWith("_road") ? runs.slice(-1).map((run) => ({...run, label: "", colour: 0})) : runs} x="time" y=${name} title=${title} x_label="Time (s)" y_label=${`${title} (${unit})`}
            window=${window} on_zoom=${zoom} theme=${theme} height=${200} keep=${name} />`)}
        </div>
        ${shown.flatMap(([got, name]) => got.run.warnings.map((warning) => html`<p class="error">${name}: ${warning}</p>`))}
        ${[...new Set(shown.flatMap(([got]) => got.remarks.filter((remark) => !got.run.warnings.some((warning) => remark.endsWith(warning)))))].map((remark) => html`<p class="note">${remark}</p>`)}
        <${Measures} columns=${columns} />
        ${shown.map(([got]) => html`<${Command} words=${got.arguments} />`)}`}
      <${RideList} fits=${fits} theme=${theme} asked=${drive_of(common, {...a, controller: ""})} own=${[a, b].filter((one) => one.damper !== kNone && one.controller).map((one) => with_settings(one.controller, one.values))} />
    </div></main>`;
}

// To be opened with this model as its damper.
export const drive_model = (model) => keep("machine.a", {damper: model, controller: "skyhook", values: {}, current: ""});
