// One plot for everything on the page: uPlot in its x-y mode with our axes, zoom, read-out and legend.
//
// spec = {x: {label, values?, ticks?, range?, log?}, y: {label, zero?, log?}, series: [{label, x, y, kind, colour, ...}],
//         shade_until?, height?, nearest?: "x" | "point", empty?}; with `log` the data are decimal logarithms.

const kPadding = 0.04;
const all_plots = [];

class Plot {
  // `spoken` is what a screen reader calls it, where no title stands above it.
  constructor(title, note = null, spoken = title) {
    this.hidden = new Set();
    this.legend = element("div", {class: "legend"});
    this.reset_button = element("button", {type: "button", class: "reset", hidden: true, onclick: () => this.reset()},
      "Reset view");
    this.canvas = element("div", {class: "canvas", tabindex: 0, role: "img", "aria-label": spoken,
      onkeydown: (event) => this.on_key(event)});
    this.readout = element("div", {class: "readout", hidden: true});
    this.canvas.append(this.readout);
    this.node = element("figure", {class: "plot"},
      element("figcaption", {}, title ? element("h3", {}, title) : null, this.reset_button),
      this.legend, this.canvas, note ? element("p", {class: "note"}, note) : null);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    all_plots.push(this);
  }

  // `make_spec` is asked again when the theme changes, since colours are part of a spec.
  show(make_spec) {
    this.make_spec = make_spec;
    this.view = null;
    this.draw();
  }

  // The same series with other numbers, on the plot that stands: for what moves under the reader's hand.
  move(make_spec) {
    this.make_spec = make_spec;
    const spec = make_spec(), visible = spec.series.filter((series) => !this.hidden.has(series.label));
    if (!this.u || visible.length !== this.u.series.length - 1 || spec.series.length !== this.spec.series.length) return this.draw();
    this.spec = spec;
    this.readout.hidden = true;
    const fresh = full_view(visible, spec);
    this.full = {x: kept_range(this.full.x, fresh.x), y: kept_range(this.full.y, fresh.y)};
    this.u.batch(() => {
      this.u.setData([null, ...visible.map((series) => [series.x, series.y])], false);
      this.set_view(this.view ?? this.full);
    });
  }

  draw() {
    if (!this.make_spec || !this.canvas.clientWidth) return;
    this.spec = this.make_spec();
    this.u?.destroy();
    this.u = null;
    this.readout.hidden = true;
    this.draw_legend();
    const visible = this.visible_series();
    this.canvas.classList.toggle("empty", !visible.length);
    this.canvas.dataset.empty = this.spec.empty ?? "Nothing to show here.";
    if (!visible.length) return;
    this.full = full_view(visible, this.spec);
    const data = [null, ...visible.map((series) => [series.x, series.y])];
    this.u = new uPlot(this.options(visible), data, this.canvas);
    if (this.view) this.set_view(this.view);
    this.u.over.addEventListener("mousedown", (event) => { if (event.shiftKey) this.pan(event); }, true);
  }

  visible_series() {
    return this.spec.series.filter((series) => series.x?.length && !this.hidden.has(series.label));
  }

  options(visible) {
    const axis = {stroke: colour("muted"), grid: {stroke: colour("grid"), width: 1}, ticks: {stroke: colour("grid"), size: 4},
      font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelGap: 2, labelSize: 20};
    const beyond = this.spec.x.ticks ? 10 : Math.max(10, last_tick_width(this.full.x) / 2);  // for the text of the last tick
    return {
      mode: 2, width: this.canvas.clientWidth, height: this.height(), padding: [8, beyond, 0, 0],
      legend: {show: false},
      cursor: {x: true, y: true, points: {show: false}, dataIdx: () => null, drag: {x: true, y: true, uni: 25}},
      scales: {x: {time: false, range: () => this.full.x}, y: {range: () => this.full.y}},
      series: [null, ...visible.map(series_options)],
      axes: [
        {...axis, scale: "x", label: this.spec.x.label, size: 30, space: tick_room, ...axis_ticks(this.spec.x)},
        {...axis, scale: "y", label: this.spec.y.label, size: tick_width, ...axis_ticks(this.spec.y)},
      ],
      hooks: {
        setCursor: [(u) => this.read(u)],
        setScale: [() => this.on_scale()],
        drawClear: [(u) => shade(u, this.spec.shade_until)],
      },
    };
  }

  height() {
    return is_dark.printing ? 210 : this.spec.height ?? 280;
  }

  resize() {
    if (!this.u) this.draw();
    else if (Math.abs(this.u.width - this.canvas.clientWidth) > 1) {
      this.u.setSize({width: this.canvas.clientWidth, height: this.height()});
    }
  }

  set_view(view) {
    this.u.batch(() => {
      this.u.setScale("x", {min: view.x[0], max: view.x[1]});
      this.u.setScale("y", {min: view.y[0], max: view.y[1]});
    });
  }

  present_view() {
    const {x, y} = this.u.scales;
    return {x: [x.min, x.max], y: [y.min, y.max]};
  }

  reset() {
    this.view = null;
    this.set_view(this.full);
    if (document.activeElement === this.reset_button) this.canvas.focus();
  }

  on_scale() {
    if (!this.u || this.u.scales.y.min === null) return;
    const view = this.present_view(), {full} = this;
    const zoomed = ["x", "y"].some((key) => view[key].some((edge, i) =>
      Math.abs(edge - full[key][i]) > 1e-9 * (full[key][1] - full[key][0])));
    this.view = zoomed ? view : null;
    this.reset_button.hidden = !zoomed;
  }

  // Shift and drag moves the view; uPlot's own drag, without shift, zooms.
  pan(event) {
    event.stopImmediatePropagation();
    event.preventDefault();
    const start = this.present_view(), {width, height} = this.u.over.getBoundingClientRect();
    const move = (now) => this.set_view(shifted(start, (event.clientX - now.clientX) / width, (now.clientY - event.clientY) / height));
    const end = () => { removeEventListener("mousemove", move); removeEventListener("mouseup", end); };
    addEventListener("mousemove", move);
    addEventListener("mouseup", end);
  }

  on_key(event) {
    if (!this.u) return;
    const view = this.present_view();
    const next = {
      "+": () => scaled(view, 0.7), "=": () => scaled(view, 0.7), "-": () => scaled(view, 1 / 0.7), "0": () => this.full,
      ArrowLeft: () => shifted(view, -0.1, 0), ArrowRight: () => shifted(view, 0.1, 0),
      ArrowUp: () => shifted(view, 0, 0.1), ArrowDown: () => shifted(view, 0, -0.1),
    }[event.key];
    if (!next) return;
    event.preventDefault();
    this.set_view(next());
  }

  // Every label once, as a button that hides and shows its series.
  draw_legend() {
    const labels = new Map(this.spec.series.filter((series) => series.label && !series.unlisted).map((series) => [series.label, series]));
    this.legend.replaceChildren(...[...labels.values()].map((series) => element("button", {
      type: "button", "aria-pressed": String(!this.hidden.has(series.label)), title: "Hide or show",
      onclick: () => {
        if (!this.hidden.delete(series.label)) this.hidden.add(series.label);
        this.draw();
      },
    }, swatch(series), series.label)));
  }

  read(u) {
    const {left, top} = u.cursor;
    const lines = left >= 0 && top >= 0 ? read_values(u, this.visible_series(), this.spec) : null;
    this.readout.hidden = !lines;
    if (!lines) return;
    this.readout.replaceChildren(...lines.map(([series, text]) => element("div", {}, series ? swatch(series) : null, text)));
    const ox = u.over.offsetLeft, flip = left > u.over.clientWidth * 0.55;
    this.readout.style.left = `${ox + left + (flip ? -12 : 12)}px`;
    this.readout.style.transform = flip ? "translateX(-100%)" : "";
    this.readout.style.top = `${Math.max(0, top - 10)}px`;
  }
}

function redraw_all_plots() {
  all_plots.forEach((plot) => plot.draw());
}
