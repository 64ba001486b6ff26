# Writes OUTPUT: a C++ file that holds the studio's files, each served under its name.
function(append_text name type text)
  # A literal may not be longer than 64 KiB everywhere; its parts are joined by the compiler.
  set(literal "")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 12000 part)
    string(APPEND literal "\n    R\"studio_page(${part})studio_page\"")
    math(EXPR at "${at} + 12000")
  endwhile()
  set(assets "${assets}    {\"${name}\", \"${type}\",${literal}},\n" PARENT_SCOPE)
endfunction()
macro(append_asset name type path)
  file(READ ${path} content)
  append_text(${name} "${type}" "${content}")
endmacro()

set(script "text/javascript; charset=utf-8")
append_asset(/ "text/html; charset=utf-8" ${PAGE_DIR}/index.html)
file(GLOB modules ${PAGE_DIR}/*.js)
foreach(module ${modules})
  get_filename_component(name ${module} NAME)
  append_asset(/${name} "${script}" ${module})
endforeach()
# The sliders of the report's page and of the studio are one: there it is part of a script, here a module.
file(READ ${LOOPS} loops)
string(REGEX MATCHALL "\nfunction [a-z_]+" names "${loops}")
string(REPLACE "\nfunction " "" names "${names}")
string(REPLACE ";" ", " names "${names}")
append_text(/loops.js "${script}" "${loops}\nexport {${names}};\n")
append_asset(/studio.css "text/css; charset=utf-8" ${PAGE_DIR}/studio.css)
# Libraries of others, with their licences beside them.
file(READ ${MODULES_DIR}/htm/preact/standalone.module.js htm)
append_text(/htm.mjs "${script}" "/*! htm (Apache-2.0) with Preact (MIT): /licences.txt */\n${htm}")
append_asset(/uplot.js "${script}" ${MODULES_DIR}/uplot/dist/uPlot.iife.min.js)
append_asset(/uplot.css "text/css; charset=utf-8" ${MODULES_DIR}/uplot/dist/uPlot.min.css)
file(READ ${MODULES_DIR}/htm/LICENSE of_htm)
file(READ ${PAGE_DIR}/preact.licence of_preact)
file(READ ${MODULES_DIR}/uplot/LICENSE of_uplot)
append_text(/licences.txt "text/plain; charset=utf-8"
  "What the studio's page is made of, by others.\n\nhtm\n\n${of_htm}\n\nPreact\n\n${of_preact}\n\nuPlot\n\n${of_uplot}")

file(WRITE ${OUTPUT} "#include \"assets.h\"

namespace dashpot::studio {

std::span<const Asset> assets() {
  static constexpr Asset kAssets[] = {
${assets}  };
  return kAssets;
}

}  // namespace dashpot::studio
")
