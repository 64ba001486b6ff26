// How a series becomes ink. Data are taken in their own order, so that loops close and time may be any.

function pixel_scale(u, key) {
  const {min, max} = u.scales[key], {left, top, width, height} = u.bbox;
  return key === "x" ? (x) => left + (x - min) / (max - min) * width
                     : (y) => top + (max - y) / (max - min) * height;
}

function line_path(u, index) {
  const [xs, ys] = u.data[index], px = pixel_scale(u, "x"), py = pixel_scale(u, "y");
  const path = new Path2D();
  let down = false;
  for (let i = 0; i < xs.length; i++) {
    const x = px(xs[i]), y = py(ys[i]);
    if (!Number.isFinite(x) || !Number.isFinite(y)) { down = false; continue; }
    if (down) path.lineTo(x, y); else path.moveTo(x, y);
    down = true;
  }
  return {stroke: path};
}

// The inside of a closed line.
function area_path(u, index) {
  const {stroke} = line_path(u, index);
  stroke.closePath();
  return {stroke, fill: stroke};
}

function points_path(radius) {
  return (u, index) => {
    const [xs, ys] = u.data[index], px = pixel_scale(u, "x"), py = pixel_scale(u, "y");
    const path = new Path2D(), r = radius * devicePixelRatio;
    for (let i = 0; i < xs.length; i++) {
      const x = px(xs[i]), y = py(ys[i]);
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      path.moveTo(x + r, y);
      path.arc(x, y, r, 0, 2 * Math.PI);
    }
    return {stroke: path, fill: path};
  };
}

// Bars from zero, `width` in units of x, centred on each x.
function bars_path(width) {
  return (u, index) => {
    const [xs, ys] = u.data[index], px = pixel_scale(u, "x"), py = pixel_scale(u, "y");
    const path = new Path2D();
    for (let i = 0; i < xs.length; i++) {
      if (!Number.isFinite(ys[i])) continue;
      const left = px(xs[i] - width / 2), right = px(xs[i] + width / 2);
      path.rect(left, py(ys[i]), Math.max(right - left - devicePixelRatio, 1), py(0) - py(ys[i]));
    }
    return {stroke: path, fill: path};
  };
}

// Options of a series for uPlot.
function series_options(series) {
  const own = {
    stroke: series.colour, width: series.width ?? 1.5, dash: series.dash, alpha: series.alpha ?? 1,
    facets: [{scale: "x", auto: true}, {scale: "y", auto: true}], points: {show: false},
  };
  if (series.kind === "points") {
    return {...own, paths: points_path(series.radius ?? 3.5), fill: series.hollow ? undefined : series.colour};
  }
  if (series.kind === "bars") return {...own, width: 0, paths: bars_path(series.bar_width), fill: series.colour};
  if (series.kind === "area") return {...own, width: 0, paths: area_path, fill: series.colour};
  return {...own, paths: line_path};
}
