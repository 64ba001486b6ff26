// Controllers compared in one vehicle, in the background: what each is worth, beside what is possible.
import {html, useState} from "/htm.mjs";
import {Command} from "/command.js";
import {Scatter} from "/scatter.js";
import {useResult, useWork, WorkHead} from "/work.js";

const kUsual = ["skyhook", "skyhook_linear", "groundhook", "add", "pdd", "sh_add", "mix1"];
const percent = (value, of) => 100 * value / of;

// The proven bound as a line up to `reach`: below and left of it no controller gets, whatever it weighs. In shares of passive.
function bound_line(possible, passive, reach) {
  const a = passive.body_acceleration ** 2, f = 1 / possible.find((one) => one.comfort_weight === 0)?.holding_weight;
  const proven = possible.filter((one) => one.proven).map((one) => ({comfort: one.comfort_weight * a, holding: one.holding_weight * f, bound: one.bound}));
  const least = proven.filter((one) => one.holding === 0).map((one) => Math.sqrt(one.bound / one.comfort))[0] ?? 0;
  const line = {x: [], y: []};
  for (let share = least; share <= reach; share += 0.01) {
    line.x.push(100 * share);
    line.y.push(100 * Math.sqrt(Math.max(0, ...proven.filter((one) => one.holding > 0).map((one) => (one.bound - one.comfort * share ** 2) / one.holding))));
  }
  return line;
}

function Ride({one, act, theme}) {
  const result = useResult("ride", one), [chosen, set_chosen] = useState();
  const at = (ridden, extra) => ({x: ridden.road.weighted_acceleration, y: ridden.road.tyre_load, label: ridden.name, ...extra});
  const points = result ? [at(result.passive, {colour: 0, size: 6, is_named: true}), ...result.controlled.map((c, k) => at(c, {colour: k + 1, size: 5, is_named: true}))] : [];
  const held = result?.held.length > 0 ? [{x: result.held.map((h) => h.weighted_acceleration), y: result.held.map((h) => h.tyre_load), colour: 0, dash: "5 4", legend: "the same damper, held"}] : [];
  const possible = result?.possible ?? [], passive = result?.passive.road;
  const share = (ridden, extra) => ({x: percent(ridden.road.body_acceleration, passive.body_acceleration), y: percent(ridden.road.tyre_load, passive.tyre_load), label: ridden.name, ...extra});
  const unit = possible.find((p) => p.comfort_weight === 0);
  const shares = result && possible.length > 0 ? [share(result.passive, {colour: 0, size: 6, is_named: true}), ...result.controlled.map((c, k) => share(c, {colour: k + 1, size: 5, is_named: true}))] : [];
  const reach = Math.max(1.2, ...shares.map(({x}) => 1.1 * x / 100).filter(Number.isFinite));
  return html`<section class="fit" aria-label="Ride ${one.name}"><${WorkHead} kind="ride" one=${one} act=${act} again="Ride again" />
    ${result && html`<div class="plots">
      <${Scatter} title="Comfort against road holding" x_label="Weighted body acceleration (m/s²)" y_label="Dynamic tyre load (%)" points=${points} lines=${held} chosen=${chosen} on_choose=${set_chosen} theme=${theme} keep=${one.name} wide=${possible.length === 0} />
      ${possible.length > 0 && unit && html`<${Scatter} title="What is possible" x_label="Body acceleration (% of passive)" y_label="Tyre force (% of passive)" theme=${theme} keep=${`${one.name}-possible`}
        points=${shares} lines=${[{...bound_line(possible, passive, reach), colour: "ink", legend: "proven bound", is_edge: true}, {x: possible.map((p) => percent(p.at_optimum.body_acceleration_rms, passive.body_acceleration)), y: possible.map((p) => 100 * p.at_optimum.tyre_force_rms * Math.sqrt(unit.holding_weight)), colour: 0, dash: "5 4", legend: "optimum, road known"}]} />`}
      </div>
      ${chosen !== undefined && points[chosen] && html`<p class="note" role="status">${points[chosen].label}: ${points[chosen].x.toPrecision(3)} m/s² weighted, ${points[chosen].y.toPrecision(3)} % tyre load.</p>`}`}
    ${one.arguments.length > 0 && html`<${Command} words=${one.arguments} />`}
  </section>`;
}

export function RideList({asked, own, fits, theme}) {
  const {work, error, act, free_name} = useWork("ride", fits), [bound, set_bound] = useState(false);
  const start = () => {
    const {in_car, current, ...vehicle} = asked;
    act("start", free_name(), {...vehicle, controllers: [...new Set([...kUsual, ...own])], bound});
  };
  return html`<div class="row"><h2>All controllers in this vehicle</h2><button class="plain" onClick=${start}>Ride them with damper A</button>
      <label class="tick"><input type="checkbox" checked=${bound} onChange=${(event) => set_bound(event.target.checked)} /> with the bound that none can beat (minutes; quarter cars, dampers without memory)</label></div>
    ${error && html`<p class="error" role="alert">${error}</p>`}
    ${[...work].reverse().map((one) => html`<${Ride} key=${one.name} one=${one} act=${act} theme=${theme} />`)}`;
}
