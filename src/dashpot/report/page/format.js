// Numbers for people, and elements: text always enters the page through text nodes, never as markup.

const kMissing = "–";

function is_number(value) {
  return typeof value === "number" && Number.isFinite(value);
}

// At most `digits` significant digits, without an exponent where one can do without.
function number_text(value, digits = 3) {
  if (!is_number(value)) return kMissing;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${trim_zeros(mantissa)}e${Number(exponent)}`.replace("-", "−").replace("e-", "e−");
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(decimals, 20)).replace("-", "−");
}

function trim_zeros(text) {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

// As short as the number allows: 0.8, 12, 0.005.
function short_text(value, digits = 3) {
  return trim_zeros(number_text(value, digits));
}

// A number and its unit stay on one line.
function unbroken(text) {
  return text.replace(/(\d) (%|N|A|V|mm|Hz)(?![a-z])/g, "$1\u00a0$2");
}

// element("p", {class: "note"}, "text", child, ...); `on...` attributes are listeners.
function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

// A titled part of the page; `id` is its address.
function section(id, title, lead, ...children) {
  return element("section", {id, "aria-labelledby": `${id}-title`},
    element("h2", {id: `${id}-title`}, title), lead ? element("p", {class: "lead"}, lead) : null, ...children);
}

// A labelled select; calls `on_choice` with the chosen value.
function chooser(id, label, choices, on_choice) {
  const select = element("select", {id, onchange: () => on_choice(select.value)},
    choices.map(([value, text]) => element("option", {value}, text)));
  return element("div", {class: "chooser"}, element("label", {for: id}, label), select);
}
