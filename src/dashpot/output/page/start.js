// Reads the page's data and builds the page.

function start() {
  const data = JSON.parse(document.getElementById("data").textContent);
  start_theme();
  ({inspect: start_inspect, search: start_search, design: start_design}[data.page] ?? start_report)(data);
  on_theme_change(redraw_all_plots);
  document.documentElement.dataset.ready = "true";
}
start();
