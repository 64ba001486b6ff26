// Tables that sort by a click on a column's head.
//
// column = {title, value: (row) => number or text, text: (row) => text, numeric?, hint?, descending?, shade?: (row) => 0 ... 1}

function sortable_table(caption, columns, rows, options) {
  const body = element("tbody");
  const state = {column: -1, ascending: true};
  const heads = columns.map((column, index) => {
    const button = element("button", {type: "button", title: column.hint, onclick: () => sort_by(index)}, column.title);
    return element("th", {scope: "col", class: column.numeric ? "number" : null, "aria-sort": "none"}, button);
  });

  function cell(column, row, index) {
    const share = column.shade?.(row), is_shaded = is_number(share);
    const node = element(index === 0 ? "th" : "td", {scope: index === 0 ? "row" : null,
      class: is_shaded ? "heat" : column.numeric ? "number" : null}, column.text(row));
    if (is_shaded) node.style.setProperty("--heat", `${Math.round(100 * share)}%`);
    return node;
  }

  function fill(ordered) {
    body.replaceChildren(...ordered.map((row) => element("tr", {class: options.row_class(row),
        onclick: options.on_row ? () => options.on_row(row) : null}, columns.map((column, i) => cell(column, row, i)))));
  }

  function sort_by(index) {
    state.ascending = state.column === index ? !state.ascending : !columns[index].descending;
    state.column = index;
    heads.forEach((head, i) => head.setAttribute("aria-sort",
      i !== index ? "none" : state.ascending ? "ascending" : "descending"));
    fill([...rows].sort(order_of(columns[index].value, state.ascending)));
  }

  fill(rows);
  return element("div", {class: "table-frame", tabindex: 0, role: "region", "aria-label": caption},
    element("table", {class: options.on_row ? "sortable clickable" : "sortable"}, element("caption", {}, caption),
      element("thead", {}, element("tr", {}, heads)), body));
}

// Missing values stand last, whichever way the column is sorted.
function order_of(value, ascending) {
  return (a, b) => {
    const [x, y] = [value(a), value(b)], [no_x, no_y] = [x, y].map((v) => v === null || v === undefined);
    if (no_x || no_y) return no_x - no_y;
    const order = typeof x === "number" ? x - y : String(x).localeCompare(String(y), "en", {numeric: true});
    return ascending ? order : -order;
  };
}
