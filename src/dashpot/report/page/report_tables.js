// What was fitted, and how it was judged.

function parameter_table(model) {
  if (!model.fit.parameters.length) {
    return element("p", {class: "note"}, `${model.title} is fitted as a whole: ${counted(model.parameter_count ?? 0, "number")} without a meaning of their own.`);
  }
  const number = (title, key) => ({title, value: (p) => p[key], text: (p) => number_text(p[key], 4), numeric: true});
  return sortable_table(`Parameters of ${model.title}, with 95 % intervals`, [
    {title: "Parameter", value: (p) => p.name, text: (p) => element("code", {}, p.name)},
    number("Value", "value"),
    {title: "95 % interval", value: (p) => p.fixed ? null : p.high - p.low, numeric: true,
      text: (p) => p.fixed ? "fixed" : `${number_text(p.low, 4)} … ${number_text(p.high, 4)}`},
    {title: "Unit", value: (p) => p.unit},
    {title: "Meaning", value: (p) => p.meaning, text: (p) => [p.meaning, p.at_bound ? element("span", {class: "mark"}, "at its bound") : null,
      p.weak ? element("span", {class: "mark"}, "weakly determined") : null].filter(Boolean)},
  ], model.fit.parameters);
}

function offset_table(model) {
  const rows = model.left_out.records;
  const percent = (title, value) => ({title, value, text: (r) => percent_text(value(r)), numeric: true});
  return sortable_table(`Left-out records, ${model.title}`, [
    {title: "Record", value: (r) => r.record},
    percent("ESR %", (r) => r.metrics.esr_percent),
    {title: "RMSE N", value: (r) => r.metrics.rmse_N, text: (r) => number_text(r.metrics.rmse_N), numeric: true},
    {...percent("Fit %", (r) => r.metrics.fit_percent), ascending: false},
    {title: "Offset N", value: (r) => r.offset_N, text: (r) => number_text(r.offset_N), numeric: true, hint: "Added to the model's force: the zero of the load cell, gas"},
    percent("ESR % without offset", (r) => r.metrics_without_offset.esr_percent),
    percent("Energy error %", (r) => r.energy_error_percent),
    ...rows.some((r) => r.interval) ? [{...percent("Covered %", (r) => r.interval?.coverage_percent), ascending: false}] : [],
    {title: "Diverged at", value: (r) => r.diverged_at, text: (r) => is_number(r.diverged_at) ? `${number_text(r.diverged_at)} s` : kMissing, numeric: true},
  ], rows, {row_class: (r) => is_number(r.diverged_at) ? "diverged" : null});
}

function warnings_list(model) {
  const folds = model.fold_fits.filter(({status}) => status !== "converged").map(({fold, status, message}) => `${fold}: ${kStatusText[status]}. ${message}`);
  const lines = [...(model.fit.status !== "converged" ? [`${kStatusText[model.fit.status]}. ${model.fit.message}`] : []), ...folds, ...model.fit.warnings];
  if (!lines.length) return element("p", {class: "note"}, "No warnings.");
  return element("ul", {class: "warnings"}, lines.map((line) => element("li", {}, line)));
}

function fitted_section() {
  const host = element("div");
  const show = (model) => host.replaceChildren(
    parameter_table(model), element("h3", {}, "Warnings"), warnings_list(model), element("h3", {}, "Record by record"), offset_table(model));
  return {show, node: section("fitted", "What was fitted", "The final fit of the chosen model, and each left-out record with its force offset.", host)};
}

const kDefinitions = [
  ["Free run", "the model sees the motion and the drive from the first sample on, and never the measured force. Warm-up samples are simulated but not scored."],
  ["Left out", "whole records, or whole parts of them, that the fit has not seen."],
  ["Offset", "one constant force per record, a declared nuisance: it takes up the zero of the load cell and the gas force. The columns “without offset” judge the model as it stands in its file."],
  ["ESR", "100 Σe² / Σ(F − mean F)², the share of the force's power that is left unexplained. R² = 1 − ESR. Fit = 100 (1 − √ESR)."],
  ["RMSE", "√(mean e²), in newtons. RMS / half-span = 200 RMSE / (Fmax − Fmin)."],
  ["Energy error", "difference of the dissipated energy ∫F v dt, as a share of the measured one."],
  ["Covered", "share of the samples inside the model's 90 % interval of the force. Its width follows speed and drive and comes from errors on other records, each made by a fit that had not seen them. On average over many new records of the same kind it covers about 90 %; a single unlike record can be far from that."],
  ["95 % interval", "of a parameter: from the curvature of the fit; it knows nothing of what the model cannot express."],
];

function judged_section(report, definitions = kDefinitions) {
  return section("judged", "How it was judged", report.protocol, facts(definitions),
    report.folds.length ? element("details", {}, element("summary", {}, counted(report.folds.length, "division")), element("ul", {}, report.folds.map((fold) => element("li", {}, fold)))) : null);
}

function provenance_section(report) {
  const {dataset} = report;
  return section("provenance", "Provenance", "This command prints every figure of this page again.",
    element("pre", {class: "command"}, report.command),
    facts([["Dataset", dataset.name], ["Citation", dataset.citation], ["Made", `${report.date}, Dashpot ${report.version}`], ["Display", report.series.display]]),
    dataset.files.length ? element("details", {}, element("summary", {}, counted(dataset.files.length, "file")), file_table(dataset.files)) : null,
    dataset.notes.length ? element("details", {}, element("summary", {}, `${counted(dataset.notes.length, "note")} on the recordings`), element("ul", {}, dataset.notes.map((note) => element("li", {}, note)))) : null);
}

function file_table(files) {
  return sortable_table("Files", [{title: "File", value: (f) => f.path}, {title: "SHA-256", value: (f) => f.sha256, text: (f) => element("code", {class: "hash"}, f.sha256)}], files);
}
