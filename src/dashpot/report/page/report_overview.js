// All records at once: where in the space of motions and drives a model errs.

// Cells of one condition and one drive level; several records there count by their mean.
function heat_map(report, model) {
  const records = model.left_out.records;
  const conditions = [...new Set(records.map(({condition, record}) => condition || record))];
  const key = ({drive_level}) => is_number(drive_level) ? drive_level : "varying";
  const levels = [...new Set(records.map(key))].sort((a, b) => a - b);
  const cell = (condition, level) => {
    const here = records.filter((one) => (one.condition || one.record) === condition && key(one) === level);
    if (!here.length) return element("td", {class: "none"}, kMissing);
    if (here.some(({diverged_at}) => is_number(diverged_at))) return element("td", {class: "heat diverged", title: names(here)}, "diverged");
    const esr = here.reduce((sum, {metrics}) => sum + metrics.esr_percent, 0) / here.length;
    const node = element("td", {class: "heat", title: names(here)}, percent_text(esr));
    node.style.setProperty("--heat", `${heat_share(esr)}%`);
    return node;
  };
  const names = (here) => here.map(({record}) => record).join(", ");
  const {drive_unit} = report.dataset;
  return element("div", {class: "table-frame", tabindex: 0, role: "region", "aria-label": "ESR by condition and drive"},
    element("table", {class: "heat-map"}, element("caption", {}, `ESR in %, ${model.title}`),
      element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "Condition"),
        levels.map((level) => element("th", {scope: "col", class: "number"}, is_number(level) ? `${short_text(level)} ${drive_unit}` : level)))),
      element("tbody", {}, conditions.map((condition) => element("tr", {}, element("th", {scope: "row"}, condition),
        levels.map((level) => cell(condition, level)))))));
}

// 0 % of ink at an ESR of 0.3 %, all of it at 100 %; logarithmic, since errors differ by decades.
function heat_share(esr) {
  if (!is_number(esr) || esr <= 0) return 0;
  return Math.round(100 * Math.min(1, Math.max(0, Math.log10(esr / 0.3) / Math.log10(100 / 0.3))));
}

// Greatest and least force of every record against its greatest and least velocity, one colour per drive level.
function peak_spec(report, model) {
  const groups = new Map();
  for (const result of model.left_out.records) {
    const own = traces(report, model, result.record);
    if (!own) continue;
    const label = is_number(result.drive_level) ? drive_text(report, result) : "varying drive";
    if (!groups.has(label)) groups.set(label, {level: result.drive_level ?? 0, label, points: []});
    const part = (values) => extent(scored_part(own.time, values, result.scored_from)) ?? [NaN, NaN];
    const [velocity, measured, modelled] = [own.velocity, own.measured, own.modelled].map(part);
    for (const end of [0, 1]) groups.get(label).points.push({name: result.record, x: velocity[end], measured: measured[end], modelled: modelled[end]});
  }
  const sorted = [...groups.values()].sort((a, b) => a.level - b.level);
  return {x: {label: "Peak velocity (m/s)"}, y: {label: "Peak force (N)"}, height: 320, series: sorted.flatMap((group, index) => {
    const points = group.points.sort((a, b) => a.x - b.x), tint = level_colour(index, sorted.length);
    const common = {label: group.label, x: points.map(({x}) => x), colour: tint, names: points.map(({name}) => name)};
    // The line is broken between compression and extension: nothing was judged in between.
    const line = [...points.filter(({x}) => x < 0), {x: NaN, modelled: NaN}, ...points.filter(({x}) => x >= 0)];
    return [
      {...common, x: line.map(({x}) => x), y: line.map(({modelled}) => modelled), width: 1.5, dash: [5, 3], unlisted: true, silent: true},
      {...common, y: points.map(({measured}) => measured), kind: "points", short: `measured, ${group.label}`},
      {...common, y: points.map(({modelled}) => modelled), kind: "points", hollow: true, radius: 4.5, short: `modelled, ${group.label}`, unlisted: true},
    ];
  })};
}

const kMostBars = 5;

// Grouped bars, one group per velocity band, one bar per model: the best ones, and the chosen one.
function bands_spec(report, chosen) {
  const models = report.models.filter((model, i) => model.left_out.bands.length && (i < kMostBars || model === chosen));
  const bands = models[0]?.left_out.bands ?? [], names = bands.map(({name}) => name);
  const ticks = bands.map(({name, low, high}) => `${name.split(",")[0]}\n${short_text(low, 2)}–${short_text(high, 2)}`);
  const width = 0.8 / Math.max(models.length, 1);
  return {x: {label: "Band of speed (m/s)", values: names, ticks, range: [-0.5, names.length - 0.5]}, y: {label: "RMS error (N)", zero: true}, nearest: "point", height: 320,
    series: models.map((model) => ({
      label: model.title, kind: "bars", bar_width: width, colour: series_colour(models.indexOf(model)),
      x: names.map((_, i) => i + (models.indexOf(model) - (models.length - 1) / 2) * width),
      y: model.left_out.bands.map(({metrics}) => metrics.rmse_N),
    }))};
}

function overview_section(report) {
  const bands = new Plot("Error by speed", "Every bar is the RMS error of the samples in a band of |v|. The first band is the pre-yield region, where laws without hysteresis fail."
    + (report.models.length > kMostBars ? ` Shown are the ${kMostBars} best models and the chosen one.` : ""));
  const peak = new Plot("Peak force against velocity", "Filled: measured. Rings and dashes: modelled.");
  const heat = element("div", {class: "heat-host"});
  const show = (model) => {
    bands.show(() => bands_spec(report, model));
    heat.replaceChildren(heat_map(report, model));
    peak.show(() => peak_spec(report, model));
  };
  return {show, node: section("overview", "Across all records", "Where the error lies: by motion, by drive and by speed.",
    element("div", {class: "grid two"}, peak.node, bands.node), heat)};
}
