// Reads the page's document and draws it.

function start() {
  start_theme();
  start_document(JSON.parse(document.getElementById("data").textContent));
  on_theme_change(redraw_all_plots);
  document.documentElement.dataset.ready = "true";
}
start();
