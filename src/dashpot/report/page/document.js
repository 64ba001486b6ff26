// Draws a document: its head, then every section with its words, choices, tables, figures and lists.
// It knows these parts (document.h) and nothing of models, recordings or dampers.

// Lines that begin with "* " are a list.
function verdict_parts(verdict) {
  const [first, ...rest] = verdict.split("\n");
  return [element("p", {class: "verdict"}, unbroken(first)),
    rest.length ? element("ul", {}, rest.map((line) => element("li", {}, unbroken(line.replace(/^\* /, ""))))) : null];
}

function document_head({kind, title, subtitle, date, verdict, key_figures}) {
  const figure = ({value, unit, label}) => element("div", {class: "figure"},
    element("div", {class: "value"}, value, element("small", {}, unit)), element("div", {class: "label"}, unbroken(label)));
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, `Dashpot · ${kind}`), theme_button()),
    element("h1", {}, title),
    element("p", {class: "under"}, [subtitle, date].filter(Boolean).join(" · ")),
    ...verdict_parts(verdict),
    key_figures.length ? element("div", {class: "figures"}, key_figures.map(figure)) : null);
}

// A part that opens when asked to, or the part itself.
function folded({folded: is_folded, title}, ...content) {
  return is_folded ? element("details", {}, element("summary", {}, title), ...content) : content;
}

function look_at(section_name) {
  document.getElementById(section_name)?.scrollIntoView({behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth"});
}

// Cells are words. A column sorts by its keys, else by the numbers or the words in its cells; a dash is no value.
function document_table(table) {
  const {title, columns, rows, note, keys, shades, warnings, leaders, chooses, leads_to} = table;
  const number_in = (cell) => { const value = parseFloat(cell.replace("−", "-")); return Number.isNaN(value) ? null : value; };
  const value_in = (cell, numeric) => ["", "-", kMissing].includes(cell) ? null : numeric ? number_in(cell) : cell;
  const described = columns.map((column, i) => ({...column,
    text: (row) => rows[row][i], value: (row) => keys?.[row][i] ?? value_in(rows[row][i], column.numeric),
    shade: shades ? (row) => shades[row][i] : null}));
  const node = sortable_table(title, described, rows.map((_, row) => row), {
    row_class: (row) => warnings?.[row] ? "warning" : leaders?.[row] ? "leader" : null,
    on_row: chooses ? (row) => { choose(chooses[row]); if (leads_to) look_at(leads_to); } : null});
  return folded(table, title && !table.folded ? element("h3", {}, title) : null, node, note ? element("p", {class: "note"}, note) : null);
}

function document_figure(figure) {
  const plots = figure.panels.map((panel) => {
    const plot = new Plot(panel.title, panel.note, panel.title || `${figure.title}: ${panel.y_label} over ${panel.x_label}`);
    const show = () => plot.show(() => panel_spec(panel));
    if (panel.series.some(({when}) => when)) on_choice(show);
    show();
    return plot.node;
  });
  return [figure.title ? element("h3", {}, figure.title) : null, figure.caption ? element("p", {class: "note"}, figure.caption) : null,
    element("div", {class: figure.columns > 1 ? "grid two" : "grid"}, plots)];
}

// Without a title each line is a paragraph, else they are a list.
function document_list(list) {
  const {title, lines} = list;
  if (!title) return lines.map((line) => element("p", {class: "chosen"}, unbroken(line)));
  const items = lines.length ? element("ul", {class: list.folded ? null : "warnings"}, lines.map((line) => element("li", {}, line))) : element("p", {class: "note"}, "None.");
  return folded(list, list.folded ? null : element("h3", {}, title), items);
}

function facts(pairs) {
  return element("dl", {class: "facts"}, pairs.filter(([, value]) => value).map(([name, value]) =>
    [element("dt", {}, name), element("dd", {}, value)]));
}

function document_section(part, ...before) {
  const {name, title, lead, paragraphs, choices, plane, sliders, tables, figures, remarks, lists} = part;
  const words = lists.filter(({title: own}) => !own), named = lists.filter(({title: own}) => own);
  return section(name, title, lead, ...before,
    paragraphs.map((text) => element("p", {class: "lead"}, text)),
    choices.length ? element("div", {class: "choices"}, choices.map(choice_select)) : null,
    plane ? document_plane(plane) : null,
    sliders ? document_sliders(sliders, page_units) : null,
    living(words, document_list, {"aria-live": "polite"}),
    living(tables, document_table), figures.map(document_figure),
    remarks.length ? element("ul", {class: "warnings"}, remarks.map((text) => element("li", {}, text))) : null,
    living(named, document_list),
    part.facts.length ? facts(part.facts) : null);
}

let page_units;  // in which its own programs show what they compute in SI

function start_document(data) {
  page_units = data.units;
  share_samples(data.samples);
  // Choices first: parts of other sections, before and after, depend on them.
  data.sections.forEach(({choices}) => choices.forEach(({name, chosen: first}) => { chosen[name] = first; }));
  data.provenance.facts.push(["Made", `${data.date}, Dashpot ${data.version}`]);
  document.getElementById("page").replaceChildren(document_head(data), ...data.sections.map((part) => document_section(part)),
    document_section(data.provenance, element("p", {class: "lead"}, "This command prints every figure of this page again."),
      element("pre", {class: "command"}, data.command)));
}
