// From the panels of a document to what a plot draws: colours of the theme, unpacked samples, only
// the series whose condition holds.

// "level-2-5" is the second of five levels; any other name is the palette's.
function named_colour(name) {
  const level = name.match(/^level-(\d+)-(\d+)$/);
  return level ? level_colour(level[1] - 1, Number(level[2])) : colour(name);
}

function panel_spec(panel) {
  const active = panel.series.filter(({when}) => holds(when));
  const bars = active.filter(({mark}) => mark === "bars"), spans = active.filter(({mark}) => mark === "span");
  const places = panel.places.length ? panel.places : null;
  const axis = (label, log) => ({label, log});
  return {
    x: {...axis(panel.x_label, panel.x_log), values: places?.map((place) => place.split("\n")[0]), ticks: places,
      range: places ? [-0.6, places.length - 0.4] : null},
    y: {...axis(panel.y_label, panel.y_log), zero: bars.length > 0},
    height: panel.height, nearest: panel.reads_along_x ? "x" : "point", empty: panel.empty,
    shade_until: spans.length ? Math.max(...spans.flatMap(({x}) => extent(series_of(x)))) : null,
    series: active.filter(({mark}) => mark !== "span")
      .map((series) => plotted(panel, series, bars.indexOf(series), bars.length)).filter(({x}) => x.length),
  };
}

function plotted(panel, series, bar, bars) {
  const {label, mark, width, names, reading, unlisted, silent, opacity} = series;
  const common = {label, short: reading, names, unlisted, silent, alpha: opacity, colour: named_colour(series.colour), ...points_of(panel, series)};
  if (mark === "bars" && panel.places.length) {
    const own = 0.8 / bars;  // side by side at each place
    return {...common, kind: "bars", bar_width: own, x: common.x.map((x) => x + (bar - (bars - 1) / 2) * own)};
  }
  if (mark === "bars") return {...common, kind: "bars", bar_width: common.x.length > 1 ? common.x[1] - common.x[0] : 1};
  if (mark === "dots") return {...common, kind: "points", radius: width};
  if (mark === "rings") return {...common, kind: "points", hollow: true, radius: width, width: width > 5 ? 2 : 1.5};
  if (mark === "area") return {...common, kind: "area"};
  return {...common, width, dash: mark === "dashes" ? [6, 4] : undefined};
}

// x and y as plotted: from `first` on, what is subtracted taken off, logarithms on logarithmic axes.
function points_of(panel, {x: x_source, y: y_source, minus, half_width, first = 0}) {
  let x = series_of(x_source), y = series_of(y_source);
  if (minus !== undefined) y = difference(y, series_of(minus));
  if (half_width !== undefined) {
    const half = series_of(half_width), edge = (sign) => Array.from(y, (value, i) => value + sign * half[i]);
    [x, y] = [[...x, ...[...x].reverse()], [...edge(1), ...edge(-1).reverse()]];
  }
  if (first > 0) [x, y] = [x.slice(first), y.slice(first)];
  return {x: panel.x_log ? x.map(Math.log10) : x, y: panel.y_log ? y.map(Math.log10) : y};
}
