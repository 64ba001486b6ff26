// What was understood of the recordings, record by record.

function inspect_head(data) {
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, "Dashpot · recordings"), theme_button()),
    element("h1", {}, data.dataset.name),
    element("p", {class: "under"}, `${counted(data.dataset.records, "record")} · ${counted(data.dataset.files.length, "file")} · ${data.date}`));
}

function inspect_record_table(data, on_row) {
  const number = (title, key) => ({title, value: (r) => r[key], text: (r) => short_text(r[key]), numeric: true});
  return sortable_table("Records", [
    {title: "Record", value: (r) => r.name}, {title: "Condition", value: (r) => r.condition},
    number(`Drive ${data.dataset.drive_unit}`, "drive_level"), {title: "Samples", value: (r) => r.samples, numeric: true},
    number("Duration s", "duration"), number("Rate Hz", "rate"),
    number("Least x m", "displacement_min"), number("Greatest x m", "displacement_max"),
    number("Greatest |v| m/s", "speed_max"), number("Least F N", "force_min"), number("Greatest F N", "force_max"),
    {title: "Role", value: (r) => r.role},
  ], data.records, {on_row});
}

function readings_table(data) {
  return sortable_table("Columns, as they were understood", [
    {title: "File", value: (r) => r.file}, {title: "Column", value: (r) => r.column}, {title: "Channel", value: (r) => r.channel || kMissing},
    {title: "Unit", value: (r) => r.unit}, {title: "Factor to SI", value: (r) => r.factor, text: (r) => short_text(r.factor, 6), numeric: true},
    {title: "Basis", value: (r) => r.basis}], data.readings);
}

const kInspectTitles = {displacement: ["Displacement", "m"], force: ["Force", "N"], velocity: ["Velocity", "m/s"]};

function inspect_plots(data) {
  const in_time = ["displacement", "velocity", "force", "drive"];
  const plots = {
    displacement: new Plot("Displacement"),
    velocity: new Plot("Velocity", "Where the recording has a velocity channel of its own, the velocity derived from displacement stands beside it."),
    force: new Plot("Force"), drive: new Plot("Drive"),
    force_velocity: new Plot("Force against velocity"), force_displacement: new Plot("Force against displacement"),
  };
  const show = (record) => {
    in_time.forEach((name) => plots[name].show(() => time_spec(data, record, name)));
    plots.force_velocity.show(() => crossed_spec(record, "velocity"));
    plots.force_displacement.show(() => crossed_spec(record, "displacement"));
  };
  return {plots, show};
}

function time_spec(data, record, name) {
  const [title, unit] = kInspectTitles[name] ?? ["Drive", data.dataset.drive_unit];
  const time = series_of(record.series.time);
  const series = [{label: name === "velocity" ? record.velocity_origin : name, values: series_of(record.series[name]), tint: "measured"},
    ...(name === "velocity" ? [{label: record.derived_origin, values: series_of(record.series.derived_velocity), tint: "modelled"}] : [])];
  return {x: {label: "Time (s)"}, y: {label: `${title} (${unit})`}, nearest: "x", height: 220, empty: `The record holds no ${name}.`,
    series: series.filter(({values}) => values).map(({label, values, tint}) => ({label, x: time, y: values, colour: colour(tint), unlisted: name !== "velocity"}))};
}

function crossed_spec(record, name) {
  const [title, unit] = kInspectTitles[name], x = series_of(record.series[name]), force = series_of(record.series.force);
  return {x: {label: `${title} (${unit})`}, y: {label: "Force (N)"}, height: 320, empty: `The record holds no ${x ? "force" : name}.`,
    series: x && force ? [{label: "measured", x, y: force, colour: colour("measured"), unlisted: true}] : []};
}

function start_inspect(data) {
  const {plots, show} = inspect_plots(data);
  const notes = element("ul", {class: "warnings"});
  const source = element("p", {class: "chosen", "aria-live": "polite"});
  const pick = chooser("record", "Record", data.records.map(({name}, i) => [String(i), name]), (value) => choose(data.records[value]));
  function choose(record) {
    pick.querySelector("select").value = String(data.records.indexOf(record));
    source.textContent = record.source;
    notes.replaceChildren(...record.notes.map((note) => element("li", {}, note)));
    show(record);
  }
  const closer = section("closer", "Record", null, element("div", {class: "choices"}, pick), source, notes,
    element("div", {class: "grid two"}, plots.displacement.node, plots.velocity.node, plots.force.node, plots.drive.node),
    element("div", {class: "grid two"}, plots.force_velocity.node, plots.force_displacement.node));
  const to_record = (record) => { choose(record); closer.scrollIntoView(); };
  document.getElementById("page").replaceChildren(inspect_head(data),
    section("records", "Records", "A click on a row shows its record below.", inspect_record_table(data, to_record)), closer,
    section("readings", "What was understood", null, readings_table(data)), provenance_section(data));
  if (data.records.length) choose(data.records[0]);
}
