// Models that run in the page: a motion and a law's parameters to be set, and the loops redrawn at each move.

const kHandle = 400;  // places of a slider

function slider_node(slider, on_move) {
  const id = `set-${slider.key}`, shown = (value) => `${three_digits(slider.scale * value)} ${slider.unit}`.trim();
  const text = element("output", {for: id});
  const input = element("input", {type: "range", id, min: 0, max: kHandle, step: 1, title: slider.meaning,
    oninput: () => show(value_at(slider, input.value / kHandle), true)});
  function show(value, is_moved) {
    text.textContent = shown(value);
    input.setAttribute("aria-valuetext", shown(value));
    if (is_moved) on_move(slider.key, value);
    else input.value = Math.round(kHandle * place_of(slider, value));
  }
  show(slider.value);
  return {node: element("div", {class: "slider"}, element("label", {for: id, title: slider.meaning}, slider.label), text, input),
    show};
}

// A record of the page as loops.js takes it: its samples stand in the units of the page already.
function measured_loop({displacement, velocity, force, first, ...record}) {
  const cut = (place) => series_of(place).subarray(first), y = cut(force);
  return {...record, displacement: {x: cut(displacement), y}, velocity: {x: cut(velocity), y}};
}

// How the curves of a loop look, by their role.
function loop_style(role) {
  return {measured: {colour: colour("measured"), width: 3}, physics: {colour: colour("series-3"), width: 1.2}, before: {colour: colour("measured"), dash: [6, 4]},
    band: {colour: colour("modelled"), width: 1, dash: [2, 3]}, set: {colour: colour("modelled"), width: 2}}[role];
}

// `programs`: functions that give them, so that those alone run that the reader looks at. `records`: their samples are places
// in those of the page.
function document_sliders({models, records}, units) {
  const velocity = new Plot("Force over velocity"), displacement = new Plot("Force over displacement");
  const controls = element("div"), words = element("p", {class: "note", "aria-live": "polite"}), leaves = element("p", {class: "beyond", role: "status"});
  let program, setting, parameters, own_damper, record, take_record, is_due = false, is_first = true;

  function draw() {
    is_due = false;
    const loop = loop_of(program, setting, parameters, units), before = parameters === own_damper ? null : loop_of(program, setting, own_damper, units);
    const spec = (key, label) => () => ({
      x: {label}, y: {label: `Force (${units.N.name})`}, height: 320,
      series: loop_curves(key, loop, before, record, program.model.interval?.level).map(({role, ...curve}) => ({...curve, ...loop_style(role)})),
    });
    for (const [plot, key, label] of [[velocity, "velocity", `Velocity (${units["m/s"].name})`], [displacement, "displacement", `Displacement (${units.m.name})`]]) {
      if (is_first) plot.show(spec(key, label)); else plot.move(spec(key, label));
    }
    is_first = false;
    const outside = beyond(program.model, setting, parameters, units);
    leaves.textContent = outside.length ? `Outside the data: ${outside.join("; ")}. What is drawn there is extrapolated.` : "";
    words.textContent = loop_words(loop, units);
  }
  // However fast the handle moves, one drawing per frame.
  function redraw() {
    if (!is_due) requestAnimationFrame(draw);
    is_due = true;
  }

  function take(index) {
    program = page_programs[models[index].program]();
    const sliders = motion_sliders(program.model, units), own = parameter_sliders(program.model);
    const nodes = [...sliders.map((slider) => slider_node(slider, (key, value) => { setting[key] = value; redraw(); })),
      ...own.map((slider) => slider_node(slider, (key, value) => { parameters = {...parameters, [key]: value}; redraw(); }))];
    // The sliders where the record has them, or in the middle of the data.
    const reset = () => {
      setting = {...Object.fromEntries(sliders.map(({key, value}) => [key, value])), ...record ? motion_of(record, units) : {}};
      parameters = own_damper = record ? member_of(record, program.model) : {};
      [...sliders, ...own].forEach(({key, value}, k) => nodes[k].show(setting[key] ?? parameters[key] ?? value));
      is_first = true;
      redraw();
    };
    take_record = (place) => {
      record = place === "" ? null : measured_loop(records[Number(place)]);
      reset();
    };
    controls.replaceChildren(...nodes.slice(0, sliders.length).map(({node}) => node),
      element("button", {type: "button", class: "reset", onclick: reset}, "As identified"),
      own.length ? element("details", {open: true}, element("summary", {}, "Parameters of the law"), nodes.slice(sliders.length).map(({node}) => node))
                 : element("p", {class: "note"}, "Its numbers were fitted as a whole: none has a meaning of its own to be set by."));
    reset();
  }
  // The page opens over the record in the middle of the list.
  const over = chooser("moved-over", "Record", [...records.map(({name}, index) => [String(index), name]), ["", "no record"]], (value) => take_record(value));
  take(0);
  if (records.length > 0) {
    const middle = String(records.length >> 1);
    over.querySelector("select").value = middle;
    take_record(middle);
  }
  return element("div", {class: "moved"},
    element("div", {class: "controls"},
      chooser("moved", "Model", models.map(({name}, index) => [String(index), name]), (value) => take(Number(value))),
      records.length > 0 ? over : null, controls),
    element("div", {class: "loops"}, element("div", {class: "grid two"}, velocity.node, displacement.node), leaves, words));
}
