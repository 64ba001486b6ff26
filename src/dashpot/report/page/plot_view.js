// The part of the plane that a plot shows, and the values under the pointer.

// What differs by rounding alone is one value, and has a window of its own size.
function padded([low, high], part) {
  const size = Math.max(Math.abs(low), Math.abs(high)), span = high - low > 1e-9 * size ? high - low : size || 1;
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

// As many digits as tell the ticks apart: quarters need two decimals. Very small and very large ones have exponents.
function tick_text(ticks) {
  const values = ticks.filter((value) => value !== null), largest = Math.max(...values.map(Math.abs));
  const step = values.length > 1 ? Math.abs(values[1] - values[0]) : largest;
  const has_exponent = largest > 0 && (largest < 1e-4 || largest >= 1e7);
  const text = (value, digits) => has_exponent ? value.toExponential(digits) : value.toFixed(digits);
  let digits = 0;
  while (digits < 15 && !values.every((value) => Math.abs(value - Number(text(value, digits))) < 1e-3 * step)) digits++;
  return (value) => value === null ? "" : value === 0 ? "0" : text(value, digits).replace("e+", "e").replaceAll("-", "−");
}

const kLetter = 6.8;  // px, of a tick's text

// Width of the text of a tick at the end of an axis across, with the digit that halves of steps need.
function last_tick_width([low, high]) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 6)), last = Math.round(high / step) * step;
  return kLetter * tick_text([last - step / 2, last])(last).length;
}

// Room from one tick of an axis across to the next.
function tick_room(u, axis, low, high) {
  return Math.max(56, 16 + last_tick_width([low, high]));
}

// Width of an axis up: for its label and the longest text of a tick.
function tick_width(u, texts) {
  return Math.max(56, 20 + kLetter * Math.max(0, ...(texts ?? []).map((text) => String(text).length)));
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
