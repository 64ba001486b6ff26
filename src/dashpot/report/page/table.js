// Tables that sort by a click on a column's head.
//
// column = {title, value: (row) => number or text, text?: (row) => text or node, numeric?, hint?, ascending?}

function sortable_table(caption, columns, rows, options = {}) {
  const body = element("tbody");
  const state = {column: -1, ascending: true};
  const heads = columns.map((column, index) => {
    const button = element("button", {type: "button", title: column.hint, onclick: () => sort_by(index)}, column.title);
    return element("th", {scope: "col", class: column.numeric ? "number" : null, "aria-sort": "none"}, button);
  });

  function fill(ordered) {
    body.replaceChildren(...ordered.map((row) => element("tr", {class: options.row_class?.(row),
        onclick: options.on_row ? () => options.on_row(row) : null},
      columns.map((column, i) => element(i === 0 ? "th" : "td", {scope: i === 0 ? "row" : null,
        class: column.numeric ? "number" : null}, column.text ? column.text(row) : String(column.value(row) ?? kMissing))))));
  }

  function sort_by(index) {
    state.ascending = state.column === index ? !state.ascending : columns[index].ascending ?? true;
    state.column = index;
    heads.forEach((head, i) => head.setAttribute("aria-sort",
      i !== index ? "none" : state.ascending ? "ascending" : "descending"));
    fill([...rows].sort(order_of(columns[index].value, state.ascending)));
  }

  fill(rows);
  return element("div", {class: "table-frame", tabindex: 0, role: "region", "aria-label": caption},
    element("table", {class: "sortable"}, element("caption", {}, caption),
      element("thead", {}, element("tr", {}, heads)), body));
}

// What is missing stands last, whichever way the column is sorted.
function order_of(value, ascending) {
  return (a, b) => {
    const [x, y] = [value(a), value(b)], [no_x, no_y] = [x, y].map((v) => v === null || v === undefined);
    if (no_x || no_y) return no_x - no_y;
    const order = typeof x === "number" ? x - y : String(x).localeCompare(String(y), "en", {numeric: true});
    return ascending ? order : -order;
  };
}

// A list of pairs, for facts such as the provenance.
function facts(pairs) {
  return element("dl", {class: "facts"}, pairs.filter(([, value]) => value).map(([name, value]) =>
    [element("dt", {}, name), element("dd", {}, value)]));
}
