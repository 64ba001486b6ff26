// The studio: views of one folder, kept up to date by one request that waits for news.
import {html, render, useEffect, useRef, useState} from "/htm.mjs";
import {ask, open_session, tell} from "/ask.js";
import {Compare} from "/compare.js";
import {Design} from "/design.js";
import {Export} from "/export.js";
import {Fits} from "/fits.js";
import {Machine} from "/machine.js";
import {Recordings} from "/recordings.js";
import {Sliders} from "/sliders.js";

const kViews = [["recordings", "Recordings", Recordings], ["fits", "Fits", Fits], ["compare", "Compare", Compare],
  ["sliders", "Sliders", Sliders], ["machine", "Machine", Machine], ["design", "Design", Design], ["export", "Export", Export]];
const kThemeKey = "dashpot-theme";

function useTheme() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const [theme, set_theme] = useState(localStorage.getItem(kThemeKey) ?? (system.matches ? "dark" : "light"));
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  const turn = () => {
    const next = theme === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = next;
    localStorage.setItem(kThemeKey, next);
    set_theme(next);
  };
  document.documentElement.dataset.theme = theme;
  return [theme, turn];
}

function Studio() {
  const [view, set_view] = useState("recordings"), [theme, turn_theme] = useTheme();
  const [known, set_known] = useState(), [fits, set_fits] = useState([]), [version, set_version] = useState(0);
  const [problem, set_problem] = useState(""), [address, set_address] = useState("");
  const reload = () => ask("/api/recordings").then((got) => { set_known(got); set_version((v) => v + 1); }).catch((error) => set_problem(error.message));
  const reload_fits = () => ask("/api/fits").then((got) => set_fits(got.fits)).catch(() => {});
  const asked_again = useRef(0);

  // News come as a number that grows; a hidden page asks for none.
  useEffect(() => {
    reload();
    let is_over = false, seen = 0, corrections;
    (async () => {
      while (!is_over) {
        if (document.hidden) await new Promise((done) => document.addEventListener("visibilitychange", done, {once: true}));
        try {
          const news = await ask("/api/changes", {since: seen});
          if (news.version !== seen) await reload_fits();
          else await new Promise((done) => setTimeout(done, 500));
          // Another browser may have corrected a recording.
          if (corrections !== undefined && news.corrections !== corrections) await reload();
          seen = news.version;
          corrections = news.corrections;
          set_problem("");
          await new Promise((done) => setTimeout(done, 150));
        } catch (error) {
          set_problem(error instanceof TypeError ? "The studio does not answer: was it ended? Start it again and open its new address." : error.message);
          await new Promise((done) => setTimeout(done, 2000));
        }
      }
    })();
    return () => { is_over = true; };
  }, []);
  const second = async () => set_address(`${location.origin}/#${(await tell("/api/token", {})).token}`);
  const [, , View] = kViews.find(([name]) => name === view);
  const on_key = (event) => {
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (!step) return;
    const at = kViews.findIndex(([name]) => name === view), next = kViews[(at + step + kViews.length) % kViews.length][0];
    set_view(next);
    document.getElementById(`tab-${next}`).focus();
  };
  useEffect(() => { if (known) document.documentElement.dataset.ready = ""; }, [known]);
  return html`
    <header class="bar"><span class="name">Dashpot studio</span>
      <div class="tabs" role="tablist" onKeyDown=${on_key}>${kViews.map(([name, title]) => html`<button id="tab-${name}" role="tab" aria-selected=${name === view}
        tabindex=${name === view ? 0 : -1} onClick=${() => set_view(name)}>${title}</button>`)}</div>
      <span class="folder" title=${known?.folder}>${known?.folder}</span>
      <button class="plain" onClick=${second}>Second browser</button>
      <button class="plain" onClick=${turn_theme}>${theme === "dark" ? "Light" : "Dark"}</button>
      ${address && html`<span class="note" role="status">Opens once: <code>${address}</code></span>`}
    </header>
    ${problem && html`<p class="error bar" role="alert">${problem}</p>`}
    <${View} known=${known} version=${version} fits=${fits} theme=${theme} go=${set_view} on_changed=${() => { reload(); reload_fits(); }} />`;
}

await open_session();
render(html`<${Studio} />`, document.getElementById("studio"));
