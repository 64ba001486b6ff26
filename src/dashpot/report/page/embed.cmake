# Writes OUTPUT: a C++ file that holds the page's files as text. The script is every .js file, start.js last.
function(append_asset name)
  set(content "")
  foreach(path ${ARGN})
    file(READ ${path} text)
    string(APPEND content "${text}")
  endforeach()
  set(assets "${assets}  {\"${name}\", R\"dashpot_page(${content})dashpot_page\"},\n" PARENT_SCOPE)
endfunction()

file(GLOB scripts ${PAGE_DIR}/*.js)
list(SORT scripts)
list(REMOVE_ITEM scripts ${PAGE_DIR}/start.js)

append_asset(page.html ${PAGE_DIR}/page.html)
append_asset(page.css ${PAGE_DIR}/page.css)
append_asset(script ${scripts} ${PAGE_DIR}/start.js)
append_asset(uplot.js ${UPLOT_DIR}/dist/uPlot.iife.min.js)
append_asset(uplot.css ${UPLOT_DIR}/dist/uPlot.min.css)
append_asset(uplot.licence ${UPLOT_DIR}/LICENSE)

file(WRITE ${OUTPUT} "#include \"dashpot/report/page.h\"

namespace dashpot {

std::vector<std::pair<std::string_view, std::string_view>> page_assets() {
  return {
${assets}  };
}

}  // namespace dashpot
")
