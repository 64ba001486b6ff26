// The interval that a model claims around its force, and what it covered.

// As the model file says: steps in speed, linear between the knots of the drive, and in quadrature the spread of an ensemble.
function half_width(band, velocity, drive, spread) {
  return Math.hypot(class_width(band, velocity, drive), (band.spread ?? 0) * spread);
}

function class_width(band, velocity, drive) {
  const {speeds, drives, half_width_N} = band, last = drives.length - 1;
  const row = speeds.filter((edge) => Math.abs(velocity) >= edge).length * drives.length;
  const next = drives.findIndex((knot) => drive < knot);
  if (next === 0 || last === 0) return half_width_N[row];
  if (next < 0) return half_width_N[row + last];
  const share = (drive - drives[next - 1]) / (drives[next] - drives[next - 1]);
  return half_width_N[row + next - 1] * (1 - share) + half_width_N[row + next] * share;
}

// The interval in time, as one area behind the curves; none for a model without one.
function interval_series(own) {
  const {band, interval} = own.result;
  if (!band || !interval || !own.velocity || !own.drive) return [];
  const half = own.modelled.map((_, i) => half_width(band, own.velocity[i], own.drive[i], own.spread?.[i] ?? 0));
  const edge = (sign) => Array.from(own.modelled, (force, i) => force + sign * half[i]);
  return [{label: `${short_text(100 * band.level)} % interval, covers ${percent_text(interval.coverage_percent)} %`, kind: "area", silent: true,
    x: [...own.time, ...[...own.time].reverse()], y: [...edge(1), ...edge(-1).reverse()], colour: colour("modelled"), alpha: 0.2}];
}

function interval_columns(report) {
  const of = (key) => (model) => model.left_out.interval?.[key];
  if (!report.models.some(of("coverage_percent"))) return [];
  return [
    {title: "Covered %", value: of("coverage_percent"), text: (m) => percent_text(of("coverage_percent")(m)), numeric: true,
      hint: "Left-out samples inside the model's interval of the force, which claims 90 % and was made without them"},
    {title: "Width N", value: of("mean_width_N"), text: (m) => number_text(of("mean_width_N")(m)), numeric: true, hint: "Mean width of that interval"},
  ];
}
