// Light and dark. Colours live in the style sheet; canvases read them from there.

const kThemeKey = "dashpot-theme";
const theme_listeners = [];

// The present value of a colour of the style sheet, as the browser resolves it.
function colour(name) {
  const probe = colour.probe ??= document.body.appendChild(element("i", {hidden: true}));
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}

// Told apart by every common kind of colour vision; the order is the order of the ranking.
function series_colour(index) {
  return colour(`series-${index % 6 + 1}`);
}

// From dark blue to yellow with even steps in lightness: levels of the drive.
function level_colour(index, count) {
  const stops = is_dark() ? kLevelsOnDark : kLevelsOnLight;
  const place = count > 1 ? index / (count - 1) * (stops.length - 1) : (stops.length - 1) / 2;
  const low = Math.min(Math.floor(place), stops.length - 2), part = place - low;
  const mixed = stops[low].map((value, i) => Math.round(value + part * (stops[low + 1][i] - value)));
  return `rgb(${mixed.join(" ")})`;
}
const kLevelsOnLight = [[38, 70, 130], [24, 128, 138], [60, 160, 95], [214, 150, 20], [190, 72, 30]];
const kLevelsOnDark = [[110, 150, 235], [70, 190, 205], [120, 205, 130], [240, 200, 80], [250, 140, 95]];

function is_dark() {
  if (is_dark.printing) return false;
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

function on_theme_change(listener) {
  theme_listeners.push(listener);
}

function apply_theme(theme) {
  if (theme) document.documentElement.dataset.theme = theme;
  theme_listeners.forEach((listener) => listener());
}

// Storage may be refused to a page that was opened from a file.
function remembered_theme() {
  try { return localStorage.getItem(kThemeKey); } catch { return null; }
}
function remember_theme(theme) {
  try { localStorage.setItem(kThemeKey, theme); } catch { /* the choice then lasts as long as the page */ }
}

function theme_button() {
  const button = element("button", {type: "button", class: "theme", onclick: () => {
    const theme = is_dark() ? "light" : "dark";
    remember_theme(theme);
    apply_theme(theme);
  }});
  const label = () => { button.textContent = is_dark() ? "Light" : "Dark"; };
  button.title = "Change between light and dark";
  label();
  on_theme_change(label);
  return button;
}

function start_theme() {
  apply_theme(remembered_theme());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => apply_theme());
  const printing = (on) => () => {
    is_dark.printing = on;
    document.documentElement.classList.toggle("printing", on);
    apply_theme();
  };
  addEventListener("beforeprint", printing(true));
  addEventListener("afterprint", printing(false));
}
