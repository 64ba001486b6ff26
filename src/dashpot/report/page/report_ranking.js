// The head of the report: what was asked, the verdict in words, and the ranking.

const kStatusText = {converged: "", iteration_limit: "fit stopped at its iteration limit", failed: "fit failed"};

function report_head(report) {
  const best = report.models[0];
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, "Dashpot · identification report"), theme_button()),
    element("h1", {}, report.dataset.name),
    element("p", {class: "under"}, `${counted(report.dataset.records, "record")} · ${counted(report.models.length, "model")} · `
      + `${report.protocol_title} · ${report.date}`),
    element("p", {class: "verdict"}, unbroken(report.verdict)),
    best && best.left_out.records.length ? key_figures(best) : null);
}

function counted(count, noun) {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

function key_figures(best) {
  const {pooled, worst_esr_percent, worst_record} = best.left_out;
  const figure = (value, unit, label) => element("div", {class: "figure"},
    element("div", {class: "value"}, value, element("small", {}, unit)), element("div", {class: "label"}, label));
  return element("div", {class: "figures", "aria-label": `Key figures of ${best.title}`},
    figure(percent_text(pooled.esr_percent), "%", "of the force's power left unexplained (ESR)"),
    figure(number_text(pooled.rmse_N), "N", "RMS error, free run, left-out records"),
    figure(percent_text(pooled.fit_percent), "%", "fit: 100 (1 − √ESR)"),
    figure(percent_text(worst_esr_percent), "%", unbroken(`ESR of the worst record, ${worst_record}`)));
}

function ranking_columns(report) {
  const left_out = (key) => (model) => model.left_out.pooled[key];
  const percent = (title, value, hint) => ({title, value, text: (m) => percent_text(value(m)), numeric: true, hint});
  return [
    {title: "Model", value: (m) => m.title, text: model_cell},
    percent("ESR %", left_out("esr_percent"), "Error power over force power, left-out records, one offset per record"),
    {title: "RMSE N", value: left_out("rmse_N"), text: (m) => number_text(left_out("rmse_N")(m)), numeric: true, hint: "Root mean square error"},
    {...percent("Fit %", left_out("fit_percent"), "100 (1 − √ESR)"), ascending: false},
    {title: "R²", value: left_out("r2"), text: (m) => fixed_text(left_out("r2")(m), 3), numeric: true, ascending: false, hint: "1 − ESR"},
    percent("RMS / half-span %", left_out("rms_half_span_percent"), "200 RMSE / (Fmax − Fmin)"),
    percent("Mean ESR %", (m) => m.left_out.mean_esr_percent, "Mean over the left-out records"),
    percent("Worst ESR %", (m) => m.left_out.worst_esr_percent, "ESR of the worst left-out record; a click on the row shows it"),
    {title: "Slow RMSE N", value: slow_rmse, text: (m) => number_text(slow_rmse(m)), numeric: true, hint: "RMS error in the band of least speed: the pre-yield region"},
    percent("Energy error %", (m) => m.left_out.mean_energy_error_percent, "Of the dissipated energy: mean of its magnitude over the records"),
    percent("ESR % without offset", (m) => m.left_out.pooled_without_offset.esr_percent, "The model as it stands in its file"),
    percent("Training ESR %", (m) => m.training.pooled.esr_percent, "The final fit, on the records that it was fitted on"),
    ...interval_columns(report),
    {title: "Par.", value: (m) => m.parameter_count, numeric: true, hint: "Free numbers of the model"},
    {title: "ns / step", value: (m) => m.nanoseconds_per_step, text: (m) => number_text(m.nanoseconds_per_step, 2), numeric: true, hint: "Time of one step on this machine"},
    {title: "Fit time", value: (m) => m.seconds, text: (m) => seconds_text(m.seconds), numeric: true, hint: "CPU time of all folds and the final fit"},
    ...report.models.some(({stress}) => stress) ? [{title: "Bounded", value: (m) => m.stress?.largest_spans, text: bounded_text, numeric: true,
      hint: "Largest force at twice the stroke and speed of the data, in force spans of the data; more than 10 is called unbounded"}] : [],
  ];
}

function slow_rmse(model) {
  return model.left_out.bands[0]?.metrics.rmse_N;
}

function bounded_text({stress}) {
  if (!stress) return kMissing;
  if (!stress.finite) return "diverged";
  return `${stress.bounded ? "yes" : "no"}, ${number_text(stress.largest_spans, 2)}`;
}

function model_cell(model) {
  const marks = [kStatusText[model.fit.status],
    model.left_out.diverged ? `diverged on ${counted(model.left_out.diverged, "record")}` : ""].filter(Boolean);
  return [element("span", {class: "model-name"}, model.title),
    ...marks.map((text) => element("span", {class: "mark"}, text))];
}

function ranking_section(report, choose_model) {
  return section("ranking", "Ranking",
    "Best first. Every figure is of left-out records in free run unless its column says otherwise; a click on a head sorts, a click on a row looks closer.",
    sortable_table("Models, best first", ranking_columns(report), report.models,
      {on_row: choose_model, row_class: (model) => model === report.models[0] ? "best" : null}),
    report.one_step ? element("p", {class: "note"}, report.one_step) : null);
}
