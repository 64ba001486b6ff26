// The loops of a model under a sine that the reader sets. A model is a program that `dashpot export --to js` writes:
// {model, create, reset, step, advance, force}. Nothing here knows of a page: the studio takes this file, too.

const kPerCycle = 360, kMostCycles = 8, kMostTime = 25;  // samples; cycles to settle in; ms

// Three digits, with an exponent where a number is very large or small.
function three_digits(value) {
  const size = Math.abs(value), is_plain = size === 0 || (size >= 1e-4 && size < 1e6);
  return (is_plain ? String(Number(value.toPrecision(3))) : Number(value.toPrecision(3)).toExponential()).replace("e+", "e").replaceAll("-", "−");
}

// How a page shows what is computed in SI: for each unit its name there and the factor to it.
const kPageUnits = {N: {name: "N", factor: 1}, m: {name: "mm", factor: 1e3}, "m/s": {name: "mm/s", factor: 1e3}, J: {name: "J", factor: 1}};

// A slider: {key, label, unit, scale (shown = scale * value), low, high, value, is_log?, meaning?}.
function motion_sliders({inputs: [displacement, velocity, current]}, units = kPageUnits) {
  const stroke = half_stroke(displacement), top = Math.max(Math.abs(velocity.low), Math.abs(velocity.high));
  const edge = top / (2 * Math.PI * stroke);  // Hz: the whole stroke at the greatest speed
  const two_digits = (value) => Number(value.toPrecision(2));
  const amplitude = two_digits(0.6 * stroke), levels = [Math.min(current.low, 0), Math.max(current.high, 0)];
  return [
    {key: "current", label: current.unit === "V" ? "Voltage" : "Current", unit: current.unit, scale: 1, low: 1.5 * levels[0], high: 1.5 * levels[1] || 1,
      value: two_digits((current.low + current.high) / 2)},
    {key: "amplitude", label: "Amplitude", unit: units.m.name, scale: units.m.factor, low: stroke / 50, high: 1.5 * stroke, value: amplitude},
    {key: "frequency", label: "Frequency", unit: "Hz", scale: 1, low: edge / 20, high: 20 * edge, is_log: true,
      value: two_digits(0.6 * top / (2 * Math.PI * amplitude))},
  ];
}

// From nothing to twice the value, within the bounds of the parameter. One that is 0 reaches as far as the greatest of its
// unit, or as the motion.
function parameter_sliders({kind, inputs: [displacement, velocity], parameters}) {
  if (kind === "family") return parameters.map(member_slider);
  const greatest = {m: half_stroke(displacement), "m/s": velocity.high};
  for (const {unit, value} of parameters) if (value !== 0) greatest[unit] = Math.max(greatest[unit] ?? 0, Math.abs(value));
  return parameters.map(({name, unit, meaning, value, lower, upper}) => {
    const reach = Math.abs(value) || (greatest[unit] ?? 1);
    return {key: name, label: name, unit: unit === "1" ? "" : unit, meaning, scale: 1, value,
      low: Math.max(value - reach, lower ?? -Infinity), high: Math.min(value + reach, upper ?? Infinity)};
  });
}

// A number of a family's damper reaches over its bounds, half as far again as the dampers of the fit.
function member_slider({name, unit, meaning, value, lower, upper}) {
  const [scale, shown] = {m: [1e3, "mm"], "m^2": [1e6, "mm²"], Pa: [1e-3, "kPa"], "Pa*s": [1e3, "mPa·s"], 1: [1, ""]}[unit] ?? [1, unit];
  const is_log = unit === "1/s";
  return {key: name, label: name.replaceAll("_", " "), unit: shown, meaning, scale, value, is_log, low: is_log ? value / 10 : lower, high: is_log ? 10 * value : upper};
}

function half_stroke({low, high}) {
  return (high - low) / 2 || 0.01;
}

// Places of a slider's handle, 0 ... 1.
function place_of({low, high, is_log}, value) {
  return is_log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low || 1);
}
function value_at({low, high, is_log}, place) {
  return is_log ? low * (high / low) ** place : low + (high - low) * place;
}

// Where a motion leaves the data of the model, in words, one for each way.
function beyond(model, setting, parameters = {}, units = kPageUnits) {
  const {inputs: [displacement, velocity, current]} = model;
  const way = (value) => three_digits(units.m.factor * value), rate = (value) => three_digits(units["m/s"].factor * value);
  const room = 0.01;  // of the range: a record's motion is set to two digits
  const outside = (least, most, {low, high}) => least < low - room * (high - low) || most > high + room * (high - low);
  const middle = middle_of(model, setting), speed = 2 * Math.PI * setting.frequency * setting.amplitude;
  const words = [];
  if (outside(setting.current, setting.current, current))
    words.push(`${current.unit === "V" ? "voltage" : "current"} ${three_digits(setting.current)} ${current.unit}, recorded ${three_digits(current.low)} to ${three_digits(current.high)}`);
  if (outside(middle - setting.amplitude, middle + setting.amplitude, displacement))
    words.push(`amplitude ${way(setting.amplitude)} ${units.m.name}, recorded to ${way((displacement.high - displacement.low) / 2)}`);
  if (outside(-speed, speed, velocity))
    words.push(`speed to ${rate(speed)} ${units["m/s"].name}, recorded ${rate(velocity.low)} to ${rate(velocity.high)}`);
  for (const parameter of model.parameters) {
    const {name, low, high} = parameter, value = parameters[name] ?? parameter.value;
    if (low === undefined || !outside(value, value, parameter)) continue;
    const {label, scale, unit} = member_slider(parameter);
    words.push(`${label} ${three_digits(scale * value)} ${unit}, dampers of the fit ${three_digits(scale * low)} to ${three_digits(scale * high)}`);
  }
  return words;
}

// Where a motion has its middle: where the record that it follows has it, or the data as a whole.
function middle_of({inputs: [{low, high}]}, {middle}) {
  return middle ?? (low + high) / 2;
}

// A record: {current, conditions, velocity: {x, y}, displacement: {x, y}}, with y the force, in the units of the page. The sine
// that is nearest to its motion, to two digits; the middle is exact.
function motion_of({current, velocity, displacement}, units = kPageUnits) {
  const [low, high] = ends_of(displacement.x).map((x) => x / units.m.factor), [least, most] = ends_of(velocity.x).map((v) => v / units["m/s"].factor);
  const two_digits = (value) => Number(value.toPrecision(2)), amplitude = (high - low) / 2;
  return {current, middle: (low + high) / 2, amplitude: two_digits(amplitude), frequency: two_digits((most - least) / 2 / (2 * Math.PI * amplitude))};
}
function ends_of(values) {
  return [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
}

// The record's damper as numbers of a family's: what its conditions state. Their yield stress is that at the record's current,
// the model's that at the end of its curve.
function member_of({current, conditions = {}}, {kind, parameters, yield_curve}) {
  const found = {};
  if (kind === "family") for (const {name} of parameters) if (conditions[name] !== undefined) found[name] = conditions[name];
  if (found.yield_stress !== undefined) {
    const {currents, stresses} = yield_curve, here = between_knots(currents, stresses, Math.abs(current));
    if (here > 0) found.yield_stress *= stresses.at(-1) / here;
    else delete found.yield_stress;
  }
  return found;
}

// Straight between the knots, held beyond them.
function between_knots(knots, values, at) {
  const next = knots.filter((knot) => knot <= at).length;
  if (next === 0 || next === knots.length) return values[Math.max(0, next - 1)];
  return values[next - 1] + (at - knots[next - 1]) / (knots[next] - knots[next - 1]) * (values[next] - values[next - 1]);
}

// Half of the band around a force, N; `builds`: the spread of the force among builds there, N.
function half_width_of({speeds, drives, half_width_N, spread = 0}, velocity, current, builds) {
  const row = drives.length * speeds.filter((edge) => edge <= Math.abs(velocity)).length;
  return Math.hypot(between_knots(drives, half_width_N.slice(row, row + drives.length), current), spread * builds);
}

// The old range of an axis where the new one lies within it and fills half of it or more, so that axes stand still.
function kept_range(old, [least, most]) {
  return old && least >= old[0] && most <= old[1] && most - least >= 0.5 * (old[1] - old[0]) ? old : [least, most];
}

// One cycle after as many as it takes to close, or as there is time for: displacement, velocity and force along it, the energy that it
// takes out, in the units of the page, and whether it closes; where there are such, half of the band around the force, and what plate flow
// alone would give. Begins at rest at the lower end.
function loop_of({model, create, reset, advance, plate_flow}, setting, parameters, units = kPageUnits) {
  const {current, amplitude, frequency} = setting, middle = middle_of(model, setting), rate = 2 * Math.PI * frequency, begin = performance.now();
  const motion = Array.from({length: kPerCycle + 1}, (_, k) => {
    const phase = 2 * Math.PI * k / kPerCycle;
    return [middle - amplitude * Math.cos(phase), amplitude * rate * Math.sin(phase)];
  });
  const state = create(parameters), force = new Float64Array(kPerCycle + 1), dt = 1 / (frequency * kPerCycle);
  force[kPerCycle] = reset(state, ...motion[0], current);

  // Cycle after cycle, until one ends where it began.
  let closes = false, least, greatest;
  for (let cycle = 0; cycle < kMostCycles && !closes; cycle++) {
    force[0] = least = greatest = force[kPerCycle];
    for (let k = 1; k <= kPerCycle; k++) {
      force[k] = advance(state, motion[k][0], motion[k][1], current, dt);
      least = Math.min(least, force[k]);
      greatest = Math.max(greatest, force[k]);
    }
    closes = cycle > 0 && Math.abs(force[kPerCycle] - force[0]) <= 1e-3 * (greatest - least);
    if (cycle > 0 && performance.now() - begin > kMostTime) break;
  }

  let energy = 0;
  for (let k = 1; k <= kPerCycle; k++) energy += (force[k] + force[k - 1]) / 2 * (motion[k][0] - motion[k - 1][0]);

  // Builds differ by a share of the force, which `build` has moved already.
  const {interval} = model, {build_spread = 0, offset = 0} = interval ?? {}, build = parameters.build ?? model.parameters.find(({name}) => name === "build")?.value ?? 0;
  const builds = (newton) => Math.abs((newton - offset) / (1 + build_spread * build) * build_spread);
  const {N, m, J, "m/s": rate_unit} = units;
  return {displacement: motion.map(([x]) => m.factor * x), velocity: motion.map(([, v]) => rate_unit.factor * v),
    force: force.map((newton) => N.factor * newton), energy: J.factor * energy, least: N.factor * least, greatest: N.factor * greatest, closes,
    half_width: interval ? motion.map(([, v], k) => N.factor * half_width_of(interval, v, current, builds(force[k]))) : undefined,
    plate: plate_flow ? motion.map(([x, v]) => N.factor * plate_flow(state, x, v, current)) : undefined};
}

// What is drawn over `key`, "velocity" or "displacement", the one below first: {role, label, x, y}. `before`: the loop as
// identified, `record`: a measured one, either may be missing.
function loop_curves(key, loop, before, record, level) {
  const {[key]: x, force, half_width, plate} = loop, curves = [];
  if (record) curves.push({role: "measured", label: "measured", ...record[key]});
  if (plate) curves.push({role: "physics", label: "plate flow alone", x, y: plate});
  if (before) curves.push({role: "before", label: "as identified", x: before[key], y: before.force});
  if (half_width) curves.push({role: "band", label: `${Math.round(100 * level)} % band`, x: [...x, NaN, ...x],
    y: [...half_width.map((half, k) => force[k] + half), NaN, ...half_width.map((half, k) => force[k] - half)]});
  curves.push({role: "set", label: "as set", x, y: force});
  return curves;
}

// What is seen of a loop, in words.
function loop_words({least, greatest, energy, closes}, units = kPageUnits) {
  if (!Number.isFinite(least + greatest)) return "The model diverges here.";
  return `Force ${three_digits(least)} to ${three_digits(greatest)} ${units.N.name}; ${three_digits(Math.abs(energy))} ${units.J.name} ${energy < 0 ? "fed in" : "taken out"} in a cycle${closes ? "" : "; the loop is not closed yet"}.`;
}
