// The part of the plane that a plot shows, and the values under the pointer.

function padded([low, high], part) {
  const span = high - low || Math.abs(high) || 1;
  return [low - part * span, high + part * span];
}

// The view that holds all series; `zero` keeps 0 at its edge, as bars need it.
function full_view(series, spec) {
  let x = spec.x.range ?? null, y = spec.y.zero ? [0, 0] : null;
  for (const one of series) {
    if (!spec.x.range) x = extent(one.x, x);
    y = extent(one.y, y);
  }
  const [low, high] = padded(y ?? [0, 1], kPadding);
  const bottom = spec.y.zero && y[0] >= 0 ? 0 : low;
  return {x: spec.x.range ?? padded(x ?? [0, 1], spec.nearest === "x" ? 0.005 : kPadding), y: [bottom, high]};
}

function shifted(view, right, up) {
  const move = ([low, high], part) => [low + part * (high - low), high + part * (high - low)];
  return {x: move(view.x, right), y: move(view.y, up)};
}

function scaled(view, factor) {
  const scale = ([low, high]) => {
    const middle = (low + high) / 2, half = (high - low) / 2 * factor;
    return [middle - half, middle + half];
  };
  return {x: scale(view.x), y: scale(view.y)};
}

// Ticks at whole places with words, for bars by category; at round numbers on a logarithmic axis.
function axis_ticks(axis) {
  if (axis.log) {
    return {splits: (u, index, low, high) => log_places(low, high), values: (_, places) => places.map((place) => short_text(10 ** place))};
  }
  if (!axis.values) return {values: (_, ticks) => ticks.map(tick_text(ticks))};
  return {
    splits: () => axis.values.map((_, i) => i), values: () => axis.ticks ?? axis.values, size: 46, grid: {show: false}, ticks: {show: false},
  };
}

// Places of the ticks of a logarithmic axis: as many as have room.
function log_places(low, high) {
  const digits = high - low < 1 ? [1, 1.5, 2, 3, 4, 5, 6, 8] : high - low < 2.5 ? [1, 2, 5] : [1], places = [];
  for (let power = Math.floor(low); power <= high; power++) {
    places.push(...digits.map((digit) => power + Math.log10(digit)).filter((place) => place >= low && place <= high));
  }
  return places;
}

// As many decimals as the ticks need: quarters need two.
function tick_text(ticks) {
  const is_round = (value, decimals) => Math.abs(value * 10 ** decimals - Math.round(value * 10 ** decimals)) < 1e-6;
  let decimals = 0;
  while (decimals < 8 && !ticks.every((value) => value === null || is_round(value, decimals))) decimals++;
  return (value) => value === null ? "" : (value === 0 ? "0" : value.toFixed(decimals).replace("-", "−"));
}

// The warm-up: simulated, not scored.
function shade(u, until) {
  if (!is_number(until) || until <= u.scales.x.min) return;
  const {left, top, height} = u.bbox, right = Math.min(u.valToPos(until, "x", true), left + u.bbox.width);
  u.ctx.fillStyle = colour("shade");
  u.ctx.fillRect(left, top, right - left, height);
}

function nearest_index(u, series, by_x) {
  const {left, top} = u.cursor, {x: sx, y: sy} = u.scales;
  const px = u.over.clientWidth / (sx.max - sx.min), py = u.over.clientHeight / (sy.max - sy.min);
  let best = -1, distance = Infinity;
  for (let i = 0; i < series.x.length; i++) {
    const dx = (series.x[i] - sx.min) * px - left, dy = by_x ? 0 : (sy.max - series.y[i]) * py - top;
    const here = dx * dx + dy * dy;
    if (here < distance) { distance = here; best = i; }
  }
  return {index: best, distance};
}

// Lines of the read-out: every series at the nearest x, or the one nearest point.
function read_values(u, visible, spec) {
  const name = (axis) => axis.label.replace(/ [(].*/, ""), unit = (axis) => (axis.label.match(/[(](.*)[)]/) ?? ["", ""])[1];
  const at = (axis, value) => axis.values ? axis.values[Math.round(value)] ?? "" : `${name(axis)} ${short_text(axis.log ? 10 ** value : value, 4)} ${unit(axis)}`;
  const listed = visible.filter((series) => !series.silent);
  if (!listed.length) return null;
  if (spec.nearest === "x") {
    const found = listed.map((series) => [series, nearest_index(u, series, true).index]).filter(([, i]) => i >= 0);
    if (!found.length) return null;
    return [[null, at(spec.x, found[0][0].x[found[0][1]])],
      ...found.map(([series, i]) => [series, `${series.short ?? series.label}: ${short_text(series.y[i], 4)} ${unit(spec.y)}`])];
  }
  let best = null;
  for (const series of listed) {
    const {index, distance} = nearest_index(u, series, false);
    if (index >= 0 && (!best || distance < best.distance)) best = {series, index, distance};
  }
  if (!best || best.distance > 60 * 60) return null;
  const {series, index} = best;
  return [[series, [series.short ?? series.label, series.names?.[index]].filter(Boolean).join(", ")],
    [null, at(spec.x, series.x[index])], [null, at(spec.y, series.y[index])]];
}

function swatch(series) {
  const style = ["points", "bars", "area"].includes(series.kind) ? (series.hollow ? "ring" : "dot") : series.dash ? "dash" : "line";
  const node = element("span", {class: `swatch ${style}`, "aria-hidden": "true"});
  node.style.setProperty("--own", series.colour);
  return node;
}
