// One model on one record, and on the records of the same motion.

// The series of a record as `model` saw it, or null for a model that was not run on it.
function traces(report, model, record_name) {
  const record = report.series.records.find(({name}) => name === record_name);
  const result = model.left_out.records.find(({record: name}) => name === record_name);
  if (!record || !result || !record.modelled[model.name]) return null;
  return {result, time: series_of(record.time), displacement: series_of(record.displacement), velocity: series_of(record.velocity),
    drive: series_of(record.drive), measured: series_of(record.measured), modelled: series_of(record.modelled[model.name]),
    spread: series_of(record.spread[model.name])};
}

const kHelp = "Every plot: drag to zoom, Shift and drag to move, double-click to reset; with the keyboard + − arrows 0.";
const kLoopNote = "Lines: measured. Dashes: modelled.";

function closer_plots(report) {
  return {
    force: new Plot("Force in time", "Where its start is shaded, it is simulated but not scored.", kHelp),
    force_velocity: new Plot("Force against velocity", kLoopNote),
    force_displacement: new Plot("Force against displacement", kLoopNote),
    residual: new Plot("Residual in time"),
    histogram: new Plot("Distribution of the residual"),
    autocorrelation: new Plot("Autocorrelation of the residual",
      "Between the dashed lines, the residual cannot be told from noise (95 %). What stands outside is structure that the model leaves."),
  };
}

function show_closer(plots, report, model, record_name) {
  const own = traces(report, model, record_name);
  plots.force.show(() => force_spec(own));
  plots.force_velocity.show(() => loop_spec(report, model, record_name, "velocity"));
  plots.force_displacement.show(() => loop_spec(report, model, record_name, "displacement"));
  plots.residual.show(() => residual_spec(own));
  const statistics = report.residuals[model.name]?.find(({record}) => record === record_name);
  plots.histogram.show(() => histogram_spec(statistics));
  plots.autocorrelation.show(() => autocorrelation_spec(statistics));
}

function force_spec(own) {
  const outcome = own && (is_number(own.result.diverged_at) ? `diverged at ${short_text(own.result.diverged_at)} s`
    : `fit ${percent_text(own.result.metrics.fit_percent)} %`);
  const series = own ? [
    ...interval_series(own),
    {label: "measured", x: own.time, y: own.measured, colour: colour("measured"), width: 2.2},
    {label: `modelled, ${outcome}`, short: "modelled", x: own.time, y: own.modelled, colour: colour("modelled"), width: 1.4},
  ] : [];
  return {x: {label: "Time (s)"}, y: {label: "Force (N)"}, nearest: "x", height: 340, series,
    shade_until: own?.result.scored_from > own?.time[0] ? own.result.scored_from : null};
}

// Loops of all records of the chosen motion: lines are measured, dashes modelled, colour is the drive.
function loop_spec(report, model, record_name, axis) {
  const condition = model.left_out.records.find(({record}) => record === record_name)?.condition;
  const together = model.left_out.records.filter((one) => one.record === record_name || (condition && one.condition === condition));
  const series = together.flatMap(({record}, index) => {
    const own = traces(report, model, record);
    if (!own) return [];
    const label = drive_text(report, own.result), tint = level_colour(index, together.length);
    const keep = (values) => scored_part(own.time, values, own.result.scored_from);
    const x = keep(own[axis]);
    return [
      {label: together.length > 1 ? label : "measured", short: `measured, ${label}`, x, y: keep(own.measured), colour: together.length > 1 ? tint : colour("measured"), width: 2, alpha: 0.55},
      {label: together.length > 1 ? label : "modelled", short: `modelled, ${label}`, x, y: keep(own.modelled), colour: together.length > 1 ? tint : colour("modelled"), width: 1.6, dash: [5, 3], unlisted: together.length > 1},
    ];
  });
  const [name, unit] = axis === "velocity" ? ["Velocity", "m/s"] : ["Displacement", "m"];
  return {x: {label: `${name} (${unit})`}, y: {label: "Force (N)"}, height: 320,
    series: series.some((one) => extent(one.x)?.some((v) => v !== 0)) ? series : [],
    empty: `The recordings hold no ${axis}.`};
}

function drive_text(report, {record, drive_level}) {
  return is_number(drive_level) ? `${short_text(drive_level)} ${report.dataset.drive_unit}` : record;
}

function residual_spec(own) {
  const series = own ? [{label: "measured − modelled", x: own.time, y: difference(own.measured, own.modelled),
    colour: colour("modelled"), width: 1}] : [];
  return {x: {label: "Time (s)"}, y: {label: "Residual (N)"}, nearest: "x", series,
    shade_until: own?.result.scored_from > own?.time[0] ? own.result.scored_from : null};
}

function histogram_spec(statistics) {
  const shares = statistics?.histogram.shares ?? [];
  const {low, width} = statistics?.histogram ?? {};
  return {x: {label: "Residual (N)"}, y: {label: "Share of samples (%)", zero: true}, nearest: "x",
    series: [{label: "share", x: shares.map((_, i) => low + (i + 0.5) * width), y: shares, kind: "bars", bar_width: width,
      colour: colour("modelled"), unlisted: true}]};
}

function autocorrelation_spec(statistics) {
  const {lags = [], values = [], band = 0} = statistics?.autocorrelation ?? {};
  const edge = (sign) => ({label: "95 % band of noise", x: lags.length ? [lags[0], lags[lags.length - 1]] : [], y: [sign * band, sign * band],
    colour: colour("muted"), width: 1, dash: [4, 4], silent: true});
  return {x: {label: "Lag (s)"}, y: {label: "Correlation (1)"}, nearest: "x",
    series: [{label: "correlation", x: lags, y: values, colour: colour("modelled"), unlisted: true}, edge(1), edge(-1)]};
}
