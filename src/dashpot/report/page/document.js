// A page of words, tables and figures, such as a study makes.

function document_head(data) {
  return element("header", {class: "head"},
    element("div", {class: "bar"}, element("span", {class: "over"}, "Dashpot · study"), theme_button()),
    element("h1", {}, data.title),
    element("p", {class: "under"}, [data.subtitle, data.date].filter(Boolean).join(" · ")),
    element("p", {class: "verdict"}, data.verdict));
}

// Cells are words; a column of numbers sorts by the numbers in them.
function document_table({title, columns, rows, note}) {
  const number_in = (cell) => { const value = parseFloat(cell.replace("−", "-")); return Number.isNaN(value) ? null : value; };
  const described = columns.map((column, i) => ({title: column.title, numeric: column.numeric, text: (row) => row[i],
    value: (row) => column.numeric ? number_in(row[i]) : row[i]}));
  return [element("h3", {}, title), sortable_table(title, described, rows), note ? element("p", {class: "note"}, note) : null];
}

function figure_spec(panel) {
  const series = panel.series.map(({label, colour: tint, mark, width, x, y}) => ({
    label, unlisted: !label, silent: !label, x: series_of(x), y: series_of(y), colour: colour(tint), width,
    ...mark === "dots" ? {kind: "points", radius: width} : mark === "dashes" ? {dash: [6, 4]} : {},
  }));
  const places = panel.places.length ? {values: panel.places, range: [-0.6, panel.places.length - 0.4]} : {};
  return {x: {label: panel.x_label, ...places}, y: {label: panel.y_label}, height: 300, nearest: "point", series};
}

function document_figure(figure, index) {
  const plots = figure.panels.map((panel) => {
    const plot = new Plot(panel.title || figure.title);
    plot.show(() => figure_spec(panel));
    return plot.node;
  });
  return [element("h3", {}, figure.title), element("p", {class: "note"}, figure.caption),
    element("div", {class: figure.columns > 1 ? "grid two" : "grid"}, plots),
    index === 0 ? element("p", {class: "note help"}, kHelp) : null];
}

function document_section(part) {
  return section(part.name, part.title, null,
    part.paragraphs.map((text) => element("p", {class: "lead"}, text)),
    part.tables.map(document_table), part.figures.map(document_figure),
    part.remarks.length ? element("ul", {class: "warnings"}, part.remarks.map((text) => element("li", {}, text))) : null);
}

function start_document(data) {
  document.getElementById("page").replaceChildren(document_head(data), ...data.sections.map(document_section),
    section("provenance", "Provenance", "This command prints every figure of this page again.",
      element("pre", {class: "command"}, data.command), element("p", {class: "note"}, `${data.date}, Dashpot ${data.version}`)));
}
