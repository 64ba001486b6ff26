// The report of a design run: the verdict, the front on axes of choice, all designs, tolerances, constraints.

const with_shown_unit = (named, text = named.name) => named.shown_unit ? `${text} (${named.shown_unit})` : text;
const words = (name) => name.replaceAll("_", " ");

// Every figure of the designs that can stand on an axis: {key, label, value, second?, bound?, ...}.
function design_figures(data) {
  const scaled = (named, pick) => (design) => {
    const value = pick(design);
    return is_number(value) ? value / named.shown_factor : null;
  };
  const figure = (kind, named, index, text, rest = {}) => ({kind, key: `${kind}-${index}`, named, text: unbroken(text),
    label: with_shown_unit(named, words(text)), value: scaled(named, (design) => design[kind][index]), ...rest});
  const told = (by) => (named, index) => data.second_model ? scaled(named, (design) => design[by]?.[index]) : null;
  const first = told("first"), second = told("second");
  return [
    ...data.goals.map((goal, i) => figure("goals", goal, i, goal.text.replace(/^(largest|smallest) /, ""), {second: second(goal, i), hint: goal.meaning})),
    ...data.constraints.map((own, i) => figure("constraints", own, i, own.text.replace(/ at (least|most) \S+( [^ ]+)?(?= at |$)/, ""),
      {first: first(own, data.goals.length + i), second: second(own, data.goals.length + i), bound: own.bound / own.shown_factor, hint: own.text})),
    ...data.variables.map((own, i) => figure("variables", own, i, own.name, {hint: own.meaning})).filter((own) => own.named.name !== "fluid"),
  ];
}

// A sentence, and constraints that conflict as a list.
function design_verdict([first, ...rest]) {
  return [element("p", {class: "verdict"}, unbroken(words(first))),
    rest.length ? element("ul", {}, rest.map((line) => element("li", {}, unbroken(words(line.replace(/^\* /, "")))))) : null];
}

function design_head(data) {
  const best = data.designs.find((design) => design.role);
  const figure = ([value, unit, label]) => element("div", {class: "figure"},
    element("div", {class: "value"}, value, element("small", {}, unit)), element("div", {class: "label"}, label));
  const goals = data.goals.slice(0, 3).map((goal, i) => {
    const all = data.designs.map((design) => design.goals[i] / goal.shown_factor), [low, high] = extent(all) ?? [0, 0];
    return [low === high ? short_text(low, 4) : `${short_text(low)} … ${short_text(high)}`, goal.shown_unit, unbroken(words(goal.text))];
  });
  const models = data.second_model ? `${data.model}, beside it ${data.second_model}` : data.model;
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, "Dashpot · design"), theme_button()),
    element("h1", {}, data.name || "Design"),
    element("p", {class: "under"}, `${models} · ${data.evaluations} dampers assessed in ${seconds_text(data.wall_seconds)} · ${data.date}`),
    ...design_verdict(data.verdict.split("\n")),
    data.notes?.length ? element("ul", {class: "under"}, data.notes.map((note) => element("li", {}, unbroken(words(note))))) : null,
    best ? element("div", {class: "figures"}, goals.map(figure),
      figure([String(data.designs.length), "", data.designs.length === 1 ? "design" : "designs"])) : null);
}

function front_spec(data, x, y, chosen) {
  const points = (designs, of = "value") => ({x: designs.map((d) => x[of] ? x[of](d) : x.value(d)), y: designs.map((d) => y[of] ? y[of](d) : y.value(d)),
    names: designs.map((d) => d.role ? `${d.name}, ${d.role}` : d.name), kind: "points"});
  const xs = extent(data.designs.map(x.value)) ?? [0, 1], ys = extent(data.designs.map(y.value)) ?? [0, 1];
  const bound = {label: "bound of a constraint", colour: colour("warn"), dash: [5, 4], silent: true, kind: "line"};
  const outstanding = data.designs.filter((design) => design.role);
  return {x: {label: x.label}, y: {label: y.label}, height: 440, nearest: "point", empty: "There is no design.",
    series: [
      ...(x.bound !== undefined ? [{...bound, x: [x.bound, x.bound], y: ys}] : []),
      ...(y.bound !== undefined ? [{...bound, x: xs, y: [y.bound, y.bound]}] : []),
      ...(x.second || y.second ? [{...points(data.designs, "second"), label: `by ${data.second_model}`, colour: colour("muted"), hollow: true}] : []),
      {...points(data.designs), label: "designs", colour: series_colour(0)},
      {...points(outstanding), label: "best of a goal, and the knee", colour: series_colour(1), hollow: true, radius: 7, width: 2, silent: true},
      ...(chosen ? [{...points([chosen]), label: `chosen: ${chosen.name}`, colour: series_colour(4), hollow: true, radius: 10, width: 3, silent: true}] : []),
    ].filter((series) => series.x.length)};
}

function design_columns(data, figures) {
  const numbers = (kind) => figures.filter((own) => own.kind === kind).map((own) => ({title: with_shown_unit(own.named, words(own.kind === "goals" ? own.text : own.named.name)),
    hint: own.hint, numeric: true, value: own.value, text: (design) => short_text(own.value(design), 4)}));
  const fluid = data.variables.findIndex((variable) => variable.name === "fluid");
  return [
    {title: "Design", value: (design) => design.name},
    ...numbers("goals"),
    ...(fluid < 0 ? [] : [{title: "fluid", value: (design) => design.variables[fluid]}]),
    ...numbers("variables"),
    ...(data.second_model ? [{title: "Models differ %", numeric: true, hint: "The largest difference of a goal or constraint, as drawn", value: (d) => d.disagreement, text: (d) => percent_text(100 * d.disagreement)}] : []),
    {title: "Note", hint: "Beyond the family: its model extrapolates there",
      value: (design) => [design.role, design.beyond_family ? "beyond the family" : ""].filter(Boolean).join("; ")},
  ];
}

// Asked, reached and left over, of one design.
function constraint_table(data, design) {
  const figures = design_figures(data).filter((own) => own.kind === "constraints");
  const rows = data.constraints.map((own, i) => ({own, i}));
  const shown = (row, value) => value === null ? kMissing : `${short_text(value, 4)} ${row.own.shown_unit}`;
  return sortable_table(`Constraints of ${design.name}`, [
    {title: "Constraint", value: (row) => unbroken(words(row.own.text))},
    {title: "Reached", numeric: true, value: (row) => figures[row.i].value(design), text: (row) => shown(row, figures[row.i].value(design))},
    ...(data.second_model ? [["first", data.model], ["second", data.second_model]].map(([by, name]) => ({title: `By ${name}`, numeric: true, hint: "As drawn",
      value: (row) => figures[row.i][by](design), text: (row) => shown(row, figures[row.i][by](design))})) : []),
    {title: "Left over %", numeric: true, hint: "In shares of the bound", value: (row) => design.slack[row.i], text: (row) => percent_text(100 * design.slack[row.i])},
  ], rows);
}

// What each tolerance moves in each figure, shaded by its share of the variance.
function tolerance_table(data, design) {
  const named = [...data.goals, ...data.constraints];
  const cell = (figure, own, t) => {
    const share = Math.min(1, Math.max(0, figure.variance_total[t] ?? 0));
    const node = element("td", {class: "heat", title: `${percent_text(100 * share)} % of the variance`},
      `${short_text(figure.local[t] / own.shown_factor)} ${own.shown_unit}`);
    node.style.setProperty("--heat", `${100 * share}%`);
    return node;
  };
  const rows = design.sensitivity.figures.map((figure, i) => [figure, named[i]]).filter(([figure]) => figure.local.some((value) => value !== 0));
  return element("div", {class: "table-frame"}, element("table", {class: "heat-map"},
    element("caption", {}, `${design.name}, ${design.role}: ${percent_text(100 * design.sensitivity.holding)} % of the dampers made hold every constraint`),
    element("thead", {}, element("tr", {}, element("th", {}, "Figure"), element("th", {class: "number"}, "90 % of those made"),
      data.tolerances.map((own) => element("th", {class: "number"}, `${words(own.name)} ±${short_text(own.width / own.shown_factor)} ${own.shown_unit}`)))),
    element("tbody", {}, rows.map(([figure, own]) => element("tr", {}, element("th", {scope: "row"}, unbroken(words(own.text))),
      element("td", {}, `${short_text(figure.low / own.shown_factor)} … ${short_text(figure.high / own.shown_factor)} ${own.shown_unit}`),
      data.tolerances.map((_, t) => cell(figure, own, t)))))));
}

const kDesignTerms = [
  ["Design", "a damper that holds every constraint. Its description was written, read again and assessed anew before it was listed."],
  ["Front", "designs of which none is better than another in all goals."],
  ["Knee", "the design nearest to the best of all goals at once, each goal measured in its extent over the front."],
  ["Left over", "how far a figure is inside its bound, in shares of the bound."],
  ["Tolerance", "a made part lies anywhere within ±, all places alike. The cells say what the whole tolerance moves (derivative × tolerance); their shade is its share of the variance, with all it takes part in (Jansen 1999)."],
];

function start_design(data) {
  const figures = design_figures(data), page = document.getElementById("page");
  const facts_section = section("provenance", "Provenance", "This command prints every figure of this page again.",
    element("pre", {class: "command"}, data.command), facts([...kDesignTerms, ["Note", data.note], ["Made", `${data.date}, Dashpot ${data.version}`]]));
  if (!data.designs.length) {
    page.replaceChildren(design_head(data), facts_section);
    return;
  }
  const choice = {x: figures[0], y: figures[1] ?? figures[0], design: data.designs.find((design) => design.role.includes("knee")) ?? data.designs[0]};
  const plot = new Plot("Designs", "Every point is a damper. Drag to zoom; a row of the table marks its point.");
  const held = element("div");
  const show = (change = {}) => {
    Object.assign(choice, change);
    plot.show(() => front_spec(data, choice.x, choice.y, data.designs.length > 1 ? choice.design : null));
    held.replaceChildren(element("h3", {}, choice.design.name), constraint_table(data, choice.design));
  };
  const axis = (id, label) => {
    const node = chooser(id, label, figures.map((own) => [own.key, words(own.text)]), (key) => show({[id]: figures.find((own) => own.key === key)}));
    node.querySelector("select").value = choice[id].key;
    return node;
  };
  const told = data.designs.filter((design) => design.sensitivity);
  page.replaceChildren(...[design_head(data),
    data.designs.length > 1 ? section("front", "The front", "Choose what stands on the axes: goals, constrained figures, or what varies.",
      element("div", {class: "choices"}, axis("x", "Across"), axis("y", "Up")), plot.node) : null,
    section("designs", "Designs", "A click on a row shows its constraints below; a click on a head sorts. Each is a damper's description in designs/ and a model in models/.",
      sortable_table("Designs", design_columns(data, figures), data.designs, {on_row: (design) => show({design})})),
    data.constraints.length ? section("constraints", "Constraints", data.share ? `As ${percent_text(100 * data.share)} % of the dampers made reach them.` : "As drawn.", held) : null,
    told.length ? section("tolerances", "What tolerances do", "Made dampers differ from their drawing.", element("div", {class: "heat-host"}, told.map((design) => tolerance_table(data, design)))) : null,
    facts_section].filter(Boolean));
  show();
}
