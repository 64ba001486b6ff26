// Points in a plane, with lines behind them: one can be picked, by a click or by the arrow keys.
import {html, useEffect, useRef, useState} from "/htm.mjs";
import {colour, nice_ticks, resolved, save, span_of, tick_text, tick_width} from "/plot.js";

const kEdge = {left: 60, right: 14, top: 10, bottom: 44};

function extent(values) {
  const finite = values.filter(Number.isFinite), low = Math.min(...finite), high = Math.max(...finite);
  if (!(low <= high)) return [0, 1];
  const room = span_of(low, high) * 0.06;
  return [low - room, high + room];
}

// Where the words of points stand: beside them, and a line lower or higher where others stand already.
function places_of_words(points, px, py, width) {
  const taken = [];
  return points.map((p) => {
    const reach = 6.2 * p.label.length, is_right = px(p.x) + 8 + reach > width && px(p.x) > width / 2;
    const x = px(p.x) + (is_right ? -8 : 8), from = is_right ? x - reach : x;
    const is_free = (y) => taken.every((t) => Math.abs(t.y - y) > 11 || t.from > from + reach || t.from + t.reach < from);
    const y = [-6, 12, -18, 24, -30, 36].map((shift) => py(p.y) + shift).find(is_free) ?? py(p.y) - 6;
    taken.push({y, from, reach});
    return {x, y, anchor: is_right ? "end" : "start", label: p.label};
  });
}

// points: [{x, y, label, colour, size, is_faint}], lines: [{x, y, label, colour, dash, is_edge}]; an edge goes on upwards, and
// what lies left of it and below is shaded. chosen: the place of a point. A colour is that of a series, or "ink".
export function Scatter({title, x_label, y_label, points, lines = [], chosen, on_choose, keep, height = 340, theme, wide}) {
  const frame = useRef(), [width, set_width] = useState(0);
  useEffect(() => {
    const watch = new ResizeObserver(([entry]) => set_width(Math.floor(entry.contentRect.width)));
    watch.observe(frame.current);
    return () => watch.disconnect();
  }, []);
  const [x0, x1] = extent([...points.map((p) => p.x), ...lines.flatMap((l) => l.x)]);
  const [y0, y1] = extent([...points.map((p) => p.y), ...lines.flatMap((l) => l.y)]);
  const xs = nice_ticks(x0, x1, Math.max(5, Math.min(6, width / 90))), ys = nice_ticks(y0, y1), x_texts = tick_text(xs), y_texts = tick_text(ys);
  const left = Math.max(kEdge.left, tick_width(y_texts));
  const px = (x) => left + (x - x0) / (x1 - x0) * (width - left - kEdge.right);
  const py = (y) => height - kEdge.bottom - (y - y0) / (y1 - y0) * (height - kEdge.top - kEdge.bottom);
  const is_inside = (p) => Number.isFinite(p.x) && Number.isFinite(p.y);
  const pick = (event) => {
    const box = frame.current.getBoundingClientRect(), at = [event.clientX - box.left, event.clientY - box.top];
    const far = (p) => is_inside(p) ? Math.hypot(px(p.x) - at[0], py(p.y) - at[1]) : Infinity;
    const nearest = points.reduce((best, p, k) => far(p) < far(points[best]) ? k : best, 0);
    if (points.length > 0 && far(points[nearest]) < 40) on_choose?.(nearest);
  };
  const on_key = (event) => {
    const step = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1}[event.key];
    if (!step || !on_choose || points.length === 0) return;
    event.preventDefault();
    const order = points.map((_, k) => k).filter((k) => is_inside(points[k])).sort((a, b) => points[a].x - points[b].x);
    on_choose(order[Math.min(order.length - 1, Math.max(0, order.indexOf(chosen) + step))]);
  };
  const grid = resolved("--grid"), muted = resolved("--muted"), ink = resolved("--ink");
  const path = (line) => line.x.map((x, i) => `${i ? "L" : line.is_edge ? `M${px(x).toFixed(1)} ${kEdge.top}L` : "M"}${px(x).toFixed(1)} ${py(line.y[i]).toFixed(1)}`).join("");
  const shade = (line) => `${path(line)}V${height - kEdge.bottom}H${left}V${kEdge.top}Z`, stroke = (of) => of === "ink" ? ink : colour(of);
  const swatch = (of) => of === "ink" ? "ink" : of === 0 ? 0 : (of - 1) % 6 + 1;
  const mark = chosen === undefined ? undefined : points[chosen];
  const labelled = [...lines, ...points].filter((one) => one.legend);
  const store = () => save(`${keep}.svg`, frame.current.querySelector("svg").outerHTML.replace("<svg ", `<svg xmlns="http://www.w3.org/2000/svg" `), "image/svg+xml");
  return html`<figure class=${wide ? "wide" : ""}>
    <figcaption><h3>${title}</h3>
      ${labelled.length > 0 && html`<div class="legend">${labelled.map((one) => html`<span><i class="swatch ${one.dash ? "dashed" : ""} colour-${swatch(one.colour)}"></i>${one.legend}</span>`)}</div>`}
      ${keep && html`<button class="plain" onClick=${store}>SVG</button>`}</figcaption>
    <div class="canvas" ref=${frame} tabindex=${on_choose ? 0 : -1} role="img" onClick=${pick} onKeyDown=${on_key}
      aria-label="${title}: ${y_label} over ${x_label}, ${points.length} points${on_choose ? "; arrow keys pick one" : ""}${mark ? `; picked: ${mark.label}` : ""}">
    ${width > 40 && html`<svg key=${theme} width=${width} height=${height} viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="11">
      ${xs.map((x, i) => html`<g><path d="M${px(x)} ${kEdge.top}V${height - kEdge.bottom}" stroke=${grid} /><text x=${px(x)} y=${height - kEdge.bottom + 15} text-anchor="middle" fill=${muted}>${x_texts[i]}</text></g>`)}
      ${ys.map((y, i) => html`<g><path d="M${left} ${py(y)}H${width - kEdge.right}" stroke=${grid} /><text x=${left - 6} y=${py(y) + 4} text-anchor="end" fill=${muted}>${y_texts[i]}</text></g>`)}
      ${lines.filter((line) => line.is_edge).map((line) => html`<path d=${shade(line)} fill=${ink} fill-opacity="0.08" />`)}
      ${lines.map((line) => html`<path d=${path(line)} fill="none" stroke=${stroke(line.colour)} stroke-width="1.5" stroke-dasharray=${line.dash ?? "none"} />`)}
      ${points.filter(is_inside).map((p) => html`<circle cx=${px(p.x)} cy=${py(p.y)} r=${p.size ?? 4} fill=${colour(p.colour)} fill-opacity=${p.is_faint ? 0.28 : 0.9}><title>${p.label}</title></circle>`)}
      ${places_of_words(points.filter((p) => is_inside(p) && p.is_named), px, py, width).map((word) => html`<text x=${word.x} y=${word.y} text-anchor=${word.anchor} fill=${ink}>${word.label}</text>`)}
      ${mark && is_inside(mark) && html`<circle cx=${px(mark.x)} cy=${py(mark.y)} r="9" fill="none" stroke=${ink} stroke-width="2" />`}
      <text x=${(left + width - kEdge.right) / 2} y=${height - 8} text-anchor="middle" font-size="12" fill=${muted}>${x_label}</text>
      <text transform="translate(14 ${(kEdge.top + height - kEdge.bottom) / 2}) rotate(-90)" text-anchor="middle" font-size="12" fill=${muted}>${y_label}</text></svg>`}
    </div></figure>`;
}
