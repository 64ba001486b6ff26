// Reads the page's data and builds the page.

function start() {
  const data = JSON.parse(document.getElementById("data").textContent);
  start_theme();
  const pages = {inspect: start_inspect, search: start_search, document: start_document, design: start_design};
  (pages[data.page] ?? start_report)(data);
  on_theme_change(redraw_all_plots);
  document.documentElement.dataset.ready = "true";
}
start();
