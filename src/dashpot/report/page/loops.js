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
function parameter_sliders({inputs: [displacement, velocity], parameters}) {
  const greatest = {m: half_stroke(displacement), "m/s": velocity.high};
  for (const {unit, value} of parameters) if (value !== 0) greatest[unit] = Math.max(greatest[unit] ?? 0, Math.abs(value));
  return parameters.map(({name, unit, meaning, value, lower, upper}) => {
    const reach = Math.abs(value) || (greatest[unit] ?? 1);
    return {key: name, label: name, unit: unit === "1" ? "" : unit, meaning, scale: 1, value,
      low: Math.max(value - reach, lower ?? -Infinity), high: Math.min(value + reach, upper ?? Infinity)};
  });
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
function beyond({inputs: [displacement, velocity, current]}, setting, units = kPageUnits) {
  const way = (value) => three_digits(units.m.factor * value), rate = (value) => three_digits(units["m/s"].factor * value);
  const outside = (least, most, {low, high}) => least < low - 1e-9 * Math.abs(low) || most > high + 1e-9 * Math.abs(high);
  const middle = (displacement.low + displacement.high) / 2, speed = 2 * Math.PI * setting.frequency * setting.amplitude;
  const words = [];
  if (outside(setting.current, setting.current, current))
    words.push(`${current.unit === "V" ? "voltage" : "current"} ${three_digits(setting.current)} ${current.unit}, recorded ${three_digits(current.low)} to ${three_digits(current.high)}`);
  if (outside(middle - setting.amplitude, middle + setting.amplitude, displacement))
    words.push(`amplitude ${way(setting.amplitude)} ${units.m.name}, recorded to ${way((displacement.high - displacement.low) / 2)}`);
  if (outside(-speed, speed, velocity))
    words.push(`speed to ${rate(speed)} ${units["m/s"].name}, recorded ${rate(velocity.low)} to ${rate(velocity.high)}`);
  return words;
}

// The old range of an axis where the new one lies within it and fills half of it or more, so that axes stand still.
function kept_range(old, [least, most]) {
  return old && least >= old[0] && most <= old[1] && most - least >= 0.5 * (old[1] - old[0]) ? old : [least, most];
}

// One cycle after as many as it takes to close, or as there is time for: displacement, velocity and force along it, the energy that it
// takes out, in the units of the page, and whether it closes. Begins at rest at the lower end.
function loop_of({model, create, reset, advance}, {current, amplitude, frequency}, parameters, units = kPageUnits) {
  const [{low, high}] = model.inputs, middle = (low + high) / 2, rate = 2 * Math.PI * frequency, begin = performance.now();
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
  const {N, m, J, "m/s": rate_unit} = units;
  return {displacement: motion.map(([x]) => m.factor * x), velocity: motion.map(([, v]) => rate_unit.factor * v),
    force: force.map((f) => N.factor * f), energy: J.factor * energy, least: N.factor * least, greatest: N.factor * greatest, closes};
}

// What is seen of a loop, in words.
function loop_words({least, greatest, energy, closes}, units = kPageUnits) {
  if (!Number.isFinite(least + greatest)) return "The model diverges here.";
  return `Force ${three_digits(least)} to ${three_digits(greatest)} ${units.N.name}; ${three_digits(Math.abs(energy))} ${units.J.name} ${energy < 0 ? "fed in" : "taken out"} in a cycle${closes ? "" : "; the loop is not closed yet"}.`;
}
