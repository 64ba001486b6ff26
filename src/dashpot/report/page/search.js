// The report of a search: the verdict, error against parameters, error by setting, all trials.

const esr_of = (trial) => trial.left_out.esr_percent;
const settings_text = (trial) => Object.entries(trial.settings).map(([name, value]) => `${name}=${value}`).join(", ");

function search_head(data) {
  const best = data.trials.find((trial) => trial.best), smallest = data.trials.find((trial) => trial.smallest);
  const figure = (value, unit, label) => element("div", {class: "figure"},
    element("div", {class: "value"}, value, element("small", {}, unit)), element("div", {class: "label"}, label));
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, "Dashpot · search"), theme_button()),
    element("h1", {}, `${data.dataset.name}, ${data.model}`),
    element("p", {class: "under"}, `${counted(data.dataset.records, "record")} · ${data.plan} · ${data.protocol_title} · ${data.date}`),
    element("p", {class: "verdict"}, unbroken(data.verdict)),
    best ? element("div", {class: "figures"},
      figure(percent_text(esr_of(best)), "%", "of the force's power left unexplained by the best (ESR)"),
      figure(String(best.parameters), "", "parameters of the best"),
      figure(percent_text(esr_of(smallest)), "%", "ESR of the smallest network within one standard error"),
      figure(String(smallest.parameters), "", "parameters of the smallest")) : null);
}

// Trials as points in the logarithms of `x` and the error.
function trial_points(trials, x, rest) {
  return {x: trials.map((trial) => Math.log10(x(trial))), y: trials.map((trial) => Math.log10(esr_of(trial))),
    names: trials.map(settings_text), kind: "points", ...rest};
}

function parameters_spec(data) {
  const usable = data.trials.filter((trial) => trial.usable), parameters = (trial) => trial.parameters;
  const of = (keep) => usable.filter(keep);
  const best = usable.find((trial) => trial.best);
  const limit = best && is_number(best.standard_error_percent) ? Math.log10(esr_of(best) + best.standard_error_percent) : null;
  const ends = extent(usable.map((trial) => Math.log10(trial.parameters))) ?? [0, 1];
  return {x: {label: "Parameters", log: true}, y: {label: "Left-out ESR (%)", log: true}, height: 420, nearest: "point",
    empty: "No trial is usable.",
    series: [
      trial_points(of((trial) => !trial.finalist), parameters, {label: "dropped on the way", colour: colour("muted"), hollow: true}),
      {...trial_points(of((trial) => trial.on_front).reverse(), parameters, {label: "front: none better with as few", colour: series_colour(1)}), kind: "line", silent: true},
      ...(limit === null ? [] : [{label: "best + one standard error", x: ends, y: [limit, limit], colour: colour("muted"), dash: [5, 4], silent: true}]),
      trial_points(of((trial) => trial.finalist), parameters, {label: "trials", colour: series_colour(0)}),
      trial_points(of((trial) => trial.smallest), parameters, {label: "smallest within one standard error", colour: series_colour(1), hollow: true, radius: 8, width: 2, silent: true}),
    ].filter((series) => series.x.length)};
}

// The error of all usable trials by one setting: over its values, or in the logarithm of its range.
function setting_spec(data, axis) {
  const usable = data.trials.filter((trial) => trial.usable && trial.settings[axis.setting] !== undefined);
  const y = {label: "Left-out ESR (%)", log: true};
  const groups = [["dropped on the way", false, colour("muted")], ["trials", true, series_colour(0)]].map(([label, finalist, tint]) =>
    [usable.filter((trial) => trial.finalist === finalist), {label, colour: tint, hollow: !finalist}]).filter(([trials]) => trials.length);
  const value = axis.values ? (trial) => 10 ** axis.values.indexOf(trial.settings[axis.setting]) : (trial) => Number(trial.settings[axis.setting]);
  const x = axis.values ? {label: axis.setting, values: axis.values, range: [-0.5, axis.values.length - 0.5]} : {label: axis.setting, log: axis.range[0] > 0};
  const place = axis.values || x.log ? value : (trial) => 10 ** value(trial);  // trial_points takes the logarithm
  return {x, y, nearest: "point", height: 260, series: groups.map(([trials, rest]) => trial_points(trials, place, rest))};
}

function trial_columns(data) {
  const percent = (title, value, hint) => ({title, value, text: (t) => percent_text(value(t)), numeric: true, hint});
  const halved = data.trials.some((trial) => trial.effort < 1);
  return [
    {title: "Rank", value: (t) => data.trials.indexOf(t) + 1, numeric: true},
    ...data.axes.map((axis) => ({title: axis.setting, hint: axis.meaning, numeric: true, text: (t) => t.settings[axis.setting] ?? kMissing,
      value: (t) => Number.isNaN(Number(t.settings[axis.setting])) ? t.settings[axis.setting] : Number(t.settings[axis.setting])})),
    percent("ESR %", esr_of, "Error power over force power, left-out records, one offset per record"),
    percent("± %", (t) => t.standard_error_percent, "Standard error of the mean over the divisions' ESR"),
    percent("Worst ESR %", (t) => t.worst_esr_percent, "Of the worst left-out record"),
    {title: "RMSE N", value: (t) => t.left_out.rmse_N, text: (t) => number_text(t.left_out.rmse_N), numeric: true},
    {title: "Par.", value: (t) => t.parameters, numeric: true, hint: "Fitted numbers"},
    ...(halved ? [{title: "Effort", value: (t) => t.effort, text: (t) => t.effort === 1 ? "all" : `1/${Math.round(1 / t.effort)}`, numeric: true, hint: "The share of the full effort at which the trial was last judged"}] : []),
    {title: "Fit time", value: (t) => t.seconds, text: (t) => seconds_text(t.seconds), numeric: true, hint: "CPU time of all divisions"},
    {title: "Note", value: trial_note, text: (t) => t.usable ? trial_note(t) : element("span", {class: "mark"}, trial_note(t))},
  ];
}

function trial_note(trial) {
  if (trial.failure) return `failed: ${trial.failure}`;
  if (trial.diverged) return `diverged on ${counted(trial.diverged, "record")}`;
  return [trial.best && "best", trial.smallest && "smallest within one standard error", trial.on_front && "front"].filter(Boolean).join(", ");
}

const kSearchTerms = [
  ...kDefinitions.filter(([name]) => ["Free run", "Left out", "Offset", "ESR", "RMSE"].includes(name)),
  ["Standard error", "of the mean over the divisions' ESR. Within one of the best, a smaller network is taken to be as good (Breiman and others, 1984)."],
  ["Front", "networks of which none with as few parameters has a smaller error."],
  ["Dropped", "by halving: judged with a share of the effort, and not among the best third (Jamieson and Talwalkar, 2016)."],
];

function start_search(data) {
  const parameters = new Plot("Error against parameters", "Every point is a network, judged on records that it has not seen. Both axes are logarithmic.");
  const settings = data.axes.map((axis) => [axis, new Plot(`Error by ${axis.setting}`, axis.meaning)]);
  document.getElementById("page").replaceChildren(search_head(data),
    section("size", "Error and size", "The smallest network within one standard error of the best is the usual choice: what is beyond it may be chance.", parameters.node),
    section("settings", "Setting by setting", "All trials over each setting that was searched; the other settings vary at the same time.",
      element("div", {class: "grid two"}, settings.map(([, plot]) => plot.node))),
    section("trials", "Trials", "Best first; a click on a head sorts.",
      sortable_table("Trials, best first", trial_columns(data), data.trials, {row_class: (trial) => trial.diverged ? "diverged" : null})),
    judged_section(data, kSearchTerms), provenance_section(data));
  parameters.show(() => parameters_spec(data));
  settings.forEach(([axis, plot]) => plot.show(() => setting_spec(data, axis)));
}
