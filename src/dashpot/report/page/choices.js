// The options that the reader has chosen, by the names of the choices. Parts of the document say under
// which options they are shown.

const chosen = {};
const choice_listeners = [];

// `when` = {choice: [options]}; nothing: always.
function holds(when) {
  return Object.entries(when ?? {}).every(([name, options]) => options.includes(chosen[name]));
}

function on_choice(listener) {
  choice_listeners.push(listener);
}

function choose(changes) {
  Object.assign(chosen, changes);
  choice_listeners.forEach((listener) => listener());
}

// A labelled select that shows and sets the chosen option; on paper its text stands alone.
function choice_select({name, label, options, chosen: first}) {
  chosen[name] = first;
  const node = chooser(name, label, options.map((option, i) => [String(i), option]), (value) => choose({[name]: Number(value)}));
  const printed = element("span", {class: "printed"});
  node.append(printed);
  const show = () => {
    node.querySelector("select").value = String(chosen[name]);
    printed.textContent = options[chosen[name]];
  };
  on_choice(show);
  show();
  return node;
}

// The parts whose condition holds, drawn anew only when others come to hold.
function living(parts, draw, attributes = {}) {
  if (!parts.some(({when}) => when)) return parts.map(draw);
  const host = element("div", attributes);
  let shown = null;
  const show = () => {
    const now = parts.filter(({when}) => holds(when));
    if (shown && now.length === shown.length && now.every((part, i) => part === shown[i])) return;
    shown = now;
    host.replaceChildren(...now.flatMap(draw).flat(Infinity).filter(Boolean));
  };
  on_choice(show);
  show();
  return host;
}
