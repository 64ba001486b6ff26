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
    reset: () => show(slider.value)};
}

// `programs`: functions that give them, so that those alone run that the reader looks at.
function document_sliders({models}, units) {
  const velocity = new Plot("Force over velocity"), displacement = new Plot("Force over displacement");
  const controls = element("div"), words = element("p", {class: "note", "aria-live": "polite"}), leaves = element("p", {class: "beyond", role: "status"});
  let program, setting, parameters, is_due = false, is_first = true;

  function draw() {
    is_due = false;
    const loop = loop_of(program, setting, parameters, units), is_changed = Object.keys(parameters).length > 0;
    const before = is_changed ? loop_of(program, setting, {}, units) : null;
    const spec = (key, label) => () => ({
      x: {label}, y: {label: `Force (${units.N.name})`}, height: 320,
      series: [...before ? [{label: "as identified", x: before[key], y: before.force, colour: colour("measured"), dash: [6, 4]}] : [],
        {label: "as set", x: loop[key], y: loop.force, colour: colour("modelled"), width: 2}],
    });
    for (const [plot, key, label] of [[velocity, "velocity", `Velocity (${units["m/s"].name})`], [displacement, "displacement", `Displacement (${units.m.name})`]]) {
      if (is_first) plot.show(spec(key, label)); else plot.move(spec(key, label));
    }
    is_first = false;
    const outside = beyond(program.model, setting, units);
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
    setting = Object.fromEntries(sliders.map(({key, value}) => [key, value]));
    parameters = {};
    const nodes = [...sliders.map((slider) => slider_node(slider, (key, value) => { setting[key] = value; redraw(); })),
      ...own.map((slider) => slider_node(slider, (key, value) => { parameters[key] = value; redraw(); }))];
    const reset = () => {
      nodes.forEach((one) => one.reset());
      sliders.forEach(({key, value}) => { setting[key] = value; });
      parameters = {};
      redraw();
    };
    controls.replaceChildren(...nodes.slice(0, sliders.length).map(({node}) => node),
      element("button", {type: "button", class: "reset", onclick: reset}, "As identified"),
      own.length ? element("details", {open: true}, element("summary", {}, "Parameters of the law"), nodes.slice(sliders.length).map(({node}) => node))
                 : element("p", {class: "note"}, "Its numbers were fitted as a whole: none has a meaning of its own to be set by."));
    is_first = true;
    redraw();
  }
  take(0);
  return element("div", {class: "moved"},
    element("div", {class: "controls"},
      chooser("moved", "Model", models.map(({name}, index) => [String(index), name]), (value) => take(Number(value))), controls),
    element("div", {class: "loops"}, element("div", {class: "grid two"}, velocity.node, displacement.node), leaves, words));
}
