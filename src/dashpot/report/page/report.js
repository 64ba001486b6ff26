// The report: head, ranking, a closer look at one model and record, all records, parameters, protocol.

function closer_section(report, choice, on_choice) {
  const plots = closer_plots(report);
  const model = chooser("model", "Model", report.models.map((one, i) => [String(i), `${i + 1}. ${one.title}`]), (value) => on_choice({model: report.models[value]}));
  const record = chooser("record", "Record", record_choices(report), (value) => on_choice({record: value}));
  const node = section("closer", "A closer look", "One model on one left-out record; the loops show all records of the same motion.",
    element("div", {class: "choices"}, model, record),
    element("p", {class: "chosen", "aria-live": "polite"}),
    plots.force.node,
    element("div", {class: "grid two"}, plots.force_velocity.node, plots.force_displacement.node),
    plots.residual.node,
    element("div", {class: "grid two"}, plots.histogram.node, plots.autocorrelation.node));
  return {node, show: () => {
    model.querySelector("select").value = String(report.models.indexOf(choice.model));
    record.querySelector("select").value = choice.record;
    node.querySelector(".chosen").textContent = unbroken(chosen_text(choice));
    show_closer(plots, report, choice.model, choice.record);
  }};
}

function record_choices(report) {
  return report.series.records.map(({name}) => [name, name]);
}

function chosen_text({model, record}) {
  const result = model.left_out.records.find((one) => one.record === record);
  if (!result) return `${model.title} was not judged on ${record}.`;
  if (is_number(result.diverged_at)) return `${model.title} diverged at ${number_text(result.diverged_at)} s.`;
  const {metrics} = result;
  return `${model.title}: ESR ${percent_text(metrics.esr_percent)} %, RMSE ${number_text(metrics.rmse_N)} N, fit ${percent_text(metrics.fit_percent)} %, `
    + `greatest error ${number_text(metrics.max_error_N)} N, energy error ${percent_text(result.energy_error_percent)} %, offset ${number_text(result.offset_N)} N.`;
}

function start_report(report) {
  const page = document.getElementById("page");
  const choice = {model: report.models[0], record: report.models[0]?.left_out.worst_record || report.series.records[0]?.name};
  if (!report.models.length) {
    page.replaceChildren(report_head(report), judged_section(report), provenance_section(report));
    return;
  }
  const overview = overview_section(report), fitted = fitted_section();
  const closer = closer_section(report, choice, (change) => choose(change));
  function choose(change) {
    Object.assign(choice, change);
    closer.show();
    if (change.model) { overview.show(choice.model); fitted.show(choice.model); }
  }
  const look_closer = (model) => {
    choose({model, record: model.left_out.worst_record || choice.record});
    closer.node.scrollIntoView({behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth"});
  };
  page.replaceChildren(report_head(report), ranking_section(report, look_closer), closer.node, overview.node, fitted.node,
    judged_section(report), provenance_section(report));
  choose({model: choice.model});
}
