// Plots: uPlot for what is seen, SVG and PNG for what is kept.
import {html, useEffect, useRef, useState} from "/htm.mjs";

const kMargin = {left: 64, right: 16, top: 12, bottom: 44};

// The present value of a colour of the style sheet.
export function colour(index) {
  const name = index === 0 ? "--measured" : `--series-${(index - 1) % 6 + 1}`;
  return resolved(name);
}
export function resolved(name) {
  const probe = document.createElement("i");
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const value = getComputedStyle(probe).color;
  probe.remove();
  return value;
}

// Where a curve breaks: null as JSON has it, or not a number.
const is_gap = (value) => value === null || Number.isNaN(value);

// Three digits tell a place on an axis; a narrow window needs more.
export function tick_text(values) {
  const largest = Math.max(...values.map(Math.abs));
  const span = Math.abs(values.at(-1) - values[0]) / Math.max(1, values.length - 1) || largest;
  const has_exponent = largest !== 0 && (largest >= 1e5 || largest < 1e-3);
  const text = (value, digits) => has_exponent ? value.toExponential(digits) : value.toFixed(digits);
  let digits = has_exponent ? 1 : span > 0 ? Math.max(0, Math.min(15, -Math.floor(Math.log10(span) + 1e-9))) : 0;
  while (digits < 15 && values.some((value) => Math.abs(value - text(value, digits)) > 0.01 * span)) ++digits;  // steps of 2.5
  return values.map((value) => has_exponent && value === 0 ? "0" : text(value, digits));
}

// Width, px, that the longest of these texts takes on an axis up, with room for the label beside it.
export const tick_width = (texts) => 18 + 6.4 * Math.max(0, ...(texts ?? []).map((text) => String(text).length));

// Places of ticks from a to b, about `count` of them, at 1, 2 or 5 times a power of ten.
export function nice_ticks(a, b, count = 6) {
  const rough = (b - a) / count, unit = 10 ** Math.floor(Math.log10(rough)), step = [1, 2, 5, 10].find((k) => k * unit >= rough) * unit;
  const list = [];
  for (let v = Math.ceil(a / step) * step; v <= b && list.length < 10 * count; v += step) list.push(Math.abs(v) < step / 1e6 ? 0 : v);
  return list;
}

// One curve per series over its own x; uPlot's mode 2 draws such.
function options_of({series, x_label, y_label, is_log}, width, height, on_zoom) {
  const axis = (label) => ({
    label, stroke: resolved("--muted"), grid: {stroke: resolved("--grid"), width: 1}, ticks: {stroke: resolved("--rule"), width: 1, size: 4},
    labelSize: 22, labelFont: "12px system-ui", font: "11px system-ui", labelGap: 0,
    values: (_, values) => is_log && label === y_label ? values.map((v) => v === null ? "" : String(+v.toPrecision(1))) : tick_text(values),
  });
  const path = (u, index) => {
    const [xs, ys] = u.data[index], lines = new Path2D();
    let pen = false;
    for (let i = 0; i < xs.length; ++i) {
      if (is_gap(xs[i]) || is_gap(ys[i])) { pen = false; continue; }
      const x = u.valToPos(xs[i], "x", true), y = u.valToPos(ys[i], "y", true);
      pen ? lines.lineTo(x, y) : lines.moveTo(x, y);
      pen = true;
    }
    u.ctx.save();
    u.ctx.beginPath();
    u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    u.ctx.clip();
    u.ctx.strokeStyle = series[index - 1].stroke;
    u.ctx.lineWidth = (series[index - 1].width ?? 1.5) * devicePixelRatio;
    u.ctx.lineJoin = "round";
    u.ctx.setLineDash((series[index - 1].dash ?? []).map((length) => length * devicePixelRatio));
    u.ctx.stroke(lines);
    u.ctx.restore();
  };
  return {
    mode: 2, width, height, legend: {show: false},
    cursor: {drag: {x: true, y: false, setScale: false}, points: {show: false}, focus: {prox: -1}},
    scales: {x: {time: false, auto: false, range: (_, low, high) => [low, high]}, y: {auto: false, range: (_, low, high) => [low, high], distr: is_log ? 3 : 1}},
    axes: [{...axis(x_label), size: 26}, {...axis(y_label), size: (_, texts) => Math.max(46, tick_width(texts))}],
    series: [{}, ...series.map(() => ({paths: path, facets: [{scale: "x", auto: false}, {scale: "y", auto: false}]}))],
    hooks: {setSelect: [(u) => {
      if (!on_zoom || u.select.width < 4) return;
      const from = u.posToVal(u.select.left, "x"), to = u.posToVal(u.select.left + u.select.width, "x");
      u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
      on_zoom(from, to);
    }]},
  };
}

// How far apart these are; what differs by rounding alone is one value, and has a window of its own size.
export function span_of(low, high) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  return high - low > 1e-9 * size ? high - low : size || 1;
}

export function extent(lists, share = 0.04, is_log = false) {
  let low = Infinity, high = -Infinity;
  for (const list of lists) for (const value of list) if (!is_gap(value) && (!is_log || value > 0)) { low = Math.min(low, value); high = Math.max(high, value); }
  if (low > high) return is_log ? [0.1, 1] : [0, 1];
  if (is_log) return [low / 1.3, high * 1.3];
  const room = span_of(low, high) * share;
  return [low - room, high + room];
}

// The figure as a file that a paper takes.
export function svg_of({title, series, x_label, y_label, x_range, is_log}) {
  const width = 640, height = 400, {right, top, bottom} = kMargin;
  const [x0, x1] = x_range ?? extent(series.map((s) => s.x), 0.02), [y0, y1] = extent(series.map((s) => s.y), 0.04, is_log);
  const xs = nice_ticks(x0, x1), ys = is_log ? [y0 * 1.3, y1 / 1.3] : nice_ticks(y0, y1);
  const x_texts = tick_text(xs), y_texts = tick_text(ys);
  const left = Math.max(kMargin.left, tick_width(y_texts));
  const y_of = (y) => is_log ? Math.log(y) : y;
  const px = (x) => left + (x - x0) / (x1 - x0) * (width - left - right);
  const py = (y) => height - bottom - (y_of(y) - y_of(y0)) / (y_of(y1) - y_of(y0)) * (height - top - bottom);
  const text = (s) => String(s).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
  const lines = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12">`,
    `<title>${text(title)}</title><rect width="${width}" height="${height}" fill="white"/>`,
    `<clipPath id="c"><rect x="${left}" y="${top}" width="${width - left - right}" height="${height - top - bottom}"/></clipPath>`];
  xs.forEach((x, i) => lines.push(`<path d="M${px(x)} ${top}V${height - bottom}" stroke="#e5e5e5"/><text x="${px(x)}" y="${height - bottom + 16}" text-anchor="middle">${x_texts[i]}</text>`));
  ys.forEach((y, i) => lines.push(`<path d="M${left} ${py(y)}H${width - right}" stroke="#e5e5e5"/><text x="${left - 6}" y="${py(y) + 4}" text-anchor="end">${y_texts[i]}</text>`));
  const kInk = ["#7a828c", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
  series.forEach((s, k) => {
    let path = "", pen = false;
    for (let i = 0; i < s.x.length; ++i) {
      if (is_gap(s.x[i]) || is_gap(s.y[i])) { pen = false; continue; }
      path += `${pen ? "L" : "M"}${px(s.x[i]).toFixed(2)} ${py(s.y[i]).toFixed(2)}`;
      pen = true;
    }
    const ink = kInk[s.colour % 7];
    lines.push(`<path clip-path="url(#c)" d="${path}" fill="none" stroke="${ink}" stroke-width="${s.width ?? 1.5}"${s.dash ? ` stroke-dasharray="${s.dash.join(" ")}"` : ""} stroke-linejoin="round"/>`);
    if (s.label) lines.push(`<path d="M${left + 10} ${top + 14 + 16 * k}h18" stroke="${ink}" stroke-width="3"/><text x="${left + 34}" y="${top + 18 + 16 * k}">${text(s.label)}</text>`);
  });
  lines.push(`<rect x="${left}" y="${top}" width="${width - left - right}" height="${height - top - bottom}" fill="none" stroke="#888"/>`,
    `<text x="${(left + width - right) / 2}" y="${height - 8}" text-anchor="middle">${text(x_label)}</text>`,
    `<text transform="translate(16 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">${text(y_label)}</text></svg>`);
  return lines.join("\n");
}

export function save(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// title, x_label, y_label, series: [{label, colour, x, y, width, dash}], x_range, y_range, on_zoom(from, to), theme.
export function Plot({title, x_label, y_label, series, x_range, y_range, on_zoom, height = 220, theme, keep, is_log, wide}) {
  const frame = useRef(), drawn = useRef();
  const [width, set_width] = useState(0);
  useEffect(() => {
    const watch = new ResizeObserver(([entry]) => set_width(Math.floor(entry.contentRect.width)));
    watch.observe(frame.current);
    return () => watch.disconnect();
  }, []);
  const key = `${width} ${height} ${theme} ${series.map((s) => `${s.label} ${s.colour}`)} ${x_label} ${y_label} ${is_log}`;
  useEffect(() => {
    if (width < 40 || series.length === 0) {
      drawn.current?.plot.destroy();
      drawn.current = undefined;
      return;
    }
    const shown = series.map((s) => ({...s, stroke: colour(s.colour)}));
    const data = [null, ...shown.map((s) => [s.x, s.y])];
    const range_of = ([min, max]) => ({min, max});
    const x_shown = range_of(x_range ?? extent(shown.map((s) => s.x), 0.02));
    const y_shown = range_of(y_range ?? extent(shown.map((s) => s.y), 0.04, is_log));
    if (drawn.current?.key !== key) {
      drawn.current?.plot.destroy();
      const options = options_of({series: shown, x_label, y_label, is_log}, width, height, (from, to) => drawn.current?.on_zoom?.(from, to));
      Object.assign(options.scales.x, x_shown);
      Object.assign(options.scales.y, y_shown);
      drawn.current = {key, plot: new uPlot(options, data, frame.current)};
    } else {
      const {plot} = drawn.current;
      plot.batch(() => {
        plot.setData(data, false);
        plot.setScale("x", x_shown);
        plot.setScale("y", y_shown);
      });
    }
    drawn.current.on_zoom = on_zoom;
  });
  useEffect(() => () => { drawn.current?.plot.destroy(); drawn.current = undefined; }, []);
  // The wheel and the keys zoom and pan, where there is something to zoom.
  const zoom = (factor, shift = 0, at = 0.5) => {
    if (!on_zoom) return;
    const [from, to] = x_range ?? extent(series.map((s) => s.x), 0), span = to - from;
    const middle = from + at * span + shift * span;
    on_zoom(middle - at * span * factor, middle + (1 - at) * span * factor);
  };
  const on_key = (event) => {
    const act = {"+": [0.6], "-": [1 / 0.6], ArrowLeft: [1, -0.2], ArrowRight: [1, 0.2]}[event.key];
    if (event.key === "0") on_zoom?.();
    else if (act) zoom(...act);
    else return;
    event.preventDefault();
  };
  const on_wheel = (event) => {
    if (!on_zoom || !(event.ctrlKey || event.shiftKey)) return;
    event.preventDefault();
    const box = frame.current.querySelector(".u-over").getBoundingClientRect();
    zoom(event.deltaY + event.deltaX > 0 ? 1.25 : 0.8, 0, Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
  };
  const wheel = useRef();
  wheel.current = on_wheel;
  useEffect(() => {
    const listener = (event) => wheel.current(event);
    frame.current.addEventListener("wheel", listener, {passive: false});
  }, []);
  const labelled = series.filter((s) => s.label);
  const figure = {title, series, x_label, y_label, x_range, is_log};
  return html`<figure class=${wide ? "wide" : ""}>
    <figcaption><h3>${title}</h3>
      ${labelled.length > 0 && html`<div class="legend">${labelled.map((s) => html`<span><i class="swatch ${s.dash ? "dashed" : ""} colour-${s.colour === 0 ? 0 : (s.colour - 1) % 6 + 1}"></i>${s.label}</span>`)}</div>`}
      ${keep && html`<span class="row"><button class="plain" onClick=${() => save(`${keep}.svg`, svg_of(figure), "image/svg+xml")}>SVG</button>
        <button class="plain" onClick=${() => frame.current.querySelector("canvas").toBlob((blob) => save(`${keep}.png`, blob))}>PNG</button></span>`}
    </figcaption>
    <div class="canvas" ref=${frame} tabindex=${on_zoom ? 0 : -1} onKeyDown=${on_key} role="img"
      aria-label="${title}: ${y_label} over ${x_label}, ${series.length} ${series.length === 1 ? "curve" : "curves"}${on_zoom ? "; plus and minus zoom, arrows pan, 0 shows all" : ""}"></div>
  </figure>`;
}
