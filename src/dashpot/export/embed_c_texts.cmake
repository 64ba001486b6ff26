# Writes OUTPUT: a C++ file that holds TEXTS (paths, separated by commas) by their names.
string(REPLACE "," ";" paths "${TEXTS}")
set(entries "")
foreach(path ${paths})
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  string(APPEND entries "  {\"${name}\", R\"dashpot_text(${text})dashpot_text\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"dashpot/export/c/c_text.h\"

namespace dashpot {

std::vector<std::pair<std::string_view, std::string_view>> c_texts() {
  return {
${entries}  };
}

}  // namespace dashpot
")
