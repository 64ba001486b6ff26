// Points in a plane whose axes the reader chooses.

function document_plane(plane) {
  const plot = new Plot(plane.title, plane.note), axes = {across: 0, up: Math.min(1, plane.quantities.length - 1)};
  const show = () => plot.show(() => plane_spec(plane, plane.quantities[axes.across], plane.quantities[axes.up]));
  const axis = (name, label) => {
    const node = chooser(name, label, plane.quantities.map((quantity, i) => [String(i), quantity.name]), (value) => { axes[name] = Number(value); show(); });
    node.querySelector("select").value = String(axes[name]);
    return node;
  };
  on_choice(show);
  show();
  return [element("div", {class: "choices"}, axis("across", "Across"), axis("up", "Up")), plot.node];
}

function plane_spec(plane, x, y) {
  const points = (keep, of = (quantity) => quantity.values) => {
    const places = plane.names.map((_, i) => i).filter(keep), at = (quantity) => places.map((i) => of(quantity)[i]);
    return {x: at(x), y: at(y), names: places.map((i) => plane.names[i]), kind: "points"};
  };
  const bound = {label: "bound of a constraint", colour: colour("warn"), dash: [5, 4], silent: true};
  const by_second = (quantity) => quantity.second.length ? quantity.second : quantity.values;
  const [xs, ys] = [x, y].map(({values}) => extent(values) ?? [0, 1]), marked = chosen[plane.choice];
  return {x: {label: x.label}, y: {label: y.label}, height: 440, nearest: "point",
    series: [
      ...is_number(x.bound) ? [{...bound, x: [x.bound, x.bound], y: ys}] : [],
      ...is_number(y.bound) ? [{...bound, x: xs, y: [y.bound, y.bound]}] : [],
      ...x.second.length || y.second.length ? [{...points(() => true, by_second), label: plane.second_label, colour: colour("muted"), hollow: true}] : [],
      {...points(() => true), label: plane.points_label, colour: series_colour(0)},
      {...points((i) => plane.outstanding[i]), label: plane.outstanding_label, colour: series_colour(1), hollow: true, radius: 7, width: 2, silent: true},
      {...points((i) => i === marked), label: `chosen: ${plane.names[marked]}`, colour: series_colour(4), hollow: true, radius: 10, width: 3, silent: true},
    ].filter((series) => series.x.length)};
}
