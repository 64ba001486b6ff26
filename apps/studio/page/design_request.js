// A design request as a form has it, and as the YAML that `dashpot design` reads.
const is_plain = (text) => /^[A-Za-z0-9][\w .*\/^%+-]*$/.test(text) && !/^(yes|no|true|false|null|on|off)$/i.test(text.trim());
const scalar = (value) => typeof value === "number" ? String(value) : is_plain(String(value)) ? String(value).trim() : JSON.stringify(String(value));
const flow = (value) => Array.isArray(value) ? `[${value.map(flow).join(", ")}]`
  : typeof value === "object" && value !== null ? `{${Object.entries(value).map(([key, one]) => `${scalar(key)}: ${flow(one)}`).join(", ")}}` : scalar(value);

export function request_text(request) {
  const lines = [];
  for (const [key, value] of Object.entries(request)) {
    if (value === undefined || value === "" || (typeof value === "object" && Object.keys(value).length === 0)) continue;
    const is_map = ["vary", "follow", "tolerances"].includes(key);
    if (is_map) lines.push(`${key}:`, ...Object.entries(value).map(([name, one]) => `  ${scalar(name)}: ${flow(one)}`));
    else if (Array.isArray(value)) lines.push(`${key}:`, ...value.map((one) => `  - ${flow(one)}`));
    else lines.push(`${key}: ${flow(value)}`);
  }
  return `${lines.join("\n")}\n`;
}

// Rows of the form and back: a map is a list of rows with a name, so that rows keep their place while they are edited.
const text_of = (value) => value === undefined ? "" : String(value);
export const rows_of = (request) => ({
  name: text_of(request.name), note: text_of(request.note), damper: request.damper, current: text_of(request.at?.current), velocity: text_of(request.at?.velocity), displacement: request.at?.displacement,
  vary: Object.entries(request.vary ?? {}).map(([name, v]) => Array.isArray(v) ? {name, list: v.join(", ")} : {name, from: text_of(v.from), to: text_of(v.to), step: text_of(v.step)}),
  follow: Object.entries(request.follow ?? {}).map(([name, v]) => ({name, terms: Object.entries(v).map(([key, one]) => `${key}: ${one}`).join(", ")})),
  tolerances: Object.entries(request.tolerances ?? {}).map(([name, width]) => ({name, width: text_of(width)})),
  share: text_of(request.robust?.share), samples: text_of(request.robust?.samples),
  constraints: (request.constraints ?? []).map(({quantity, min, max, current, velocity, ...rest}) => ({name: quantity, min: text_of(min), max: text_of(max), current: text_of(current), velocity: text_of(velocity), rest})),
  goals: (request.goals ?? []).map(({maximise, minimise, current, velocity, ...rest}) => ({name: maximise ?? minimise, way: maximise ? "maximise" : "minimise", current: text_of(current), velocity: text_of(velocity), rest})),
});

const number_or_text = (text) => text !== "" && Number.isFinite(+text) ? +text : text;
const filled = (object) => Object.fromEntries(Object.entries(object).filter(([, value]) => value !== "" && value !== undefined).map(([key, value]) => [key, typeof value === "string" ? number_or_text(value) : value]));
const terms_of = (text) => Object.fromEntries(text.split(",").map((term) => term.split(":").map((part) => part.trim())).filter(([key, value]) => key && value).map(([key, value]) => [key, number_or_text(value)]));
export const request_of = (rows) => ({
  name: rows.name, note: rows.note, damper: rows.damper, at: filled({current: rows.current, velocity: rows.velocity, displacement: rows.displacement}),
  vary: Object.fromEntries(rows.vary.filter((v) => v.name).map((v) => [v.name, v.list !== undefined ? v.list.split(",").map((one) => number_or_text(one.trim())).filter((one) => one !== "") : filled({from: v.from, to: v.to, step: v.step})])),
  follow: Object.fromEntries(rows.follow.filter((f) => f.name).map((f) => [f.name, terms_of(f.terms)])),
  tolerances: Object.fromEntries(rows.tolerances.filter((t) => t.name && t.width).map((t) => [t.name, number_or_text(t.width)])),
  robust: filled({share: rows.share, samples: rows.share ? rows.samples : ""}),
  constraints: rows.constraints.filter((c) => c.name).map((c) => filled({quantity: c.name, min: c.min, max: c.max, current: c.current, velocity: c.velocity, ...c.rest})),
  goals: rows.goals.filter((g) => g.name).map((g) => filled({[g.way]: g.name, current: g.current, velocity: g.velocity, ...g.rest})),
});
