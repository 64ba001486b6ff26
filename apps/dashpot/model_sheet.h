#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/value.h"

namespace dashpot::cli {

/// A parameter of a model in text, in the order of the sheet's columns.
struct ParameterLine {
  std::string name, unit, value, bounds, form, meaning;
};

/// A registered model as the documentation shows it, whatever its kind.
struct ModelSheet {
  std::string name, kind, title, equation, source, remarks;
  std::string dissipates;  ///< with which parameters; laws only
  std::vector<std::string> inputs = {};
  std::string inverse = "search";              ///< or "closed form"
  std::vector<std::string> states = {};        ///< "z, m"
  std::vector<ParameterLine> parameters = {};  ///< of a law
  std::size_t numbers = 0;  ///< fitted, with the usual forms of dependence on current
  std::span<const std::string_view> settings = {};  ///< what of --network its fit follows
};

ModelSheet model_sheet(const std::string& name);

std::string sheet_text(const ModelSheet& sheet, int width);
std::string sheet_markdown(const ModelSheet& sheet);
Value sheet_json(const ModelSheet& sheet);

}  // namespace dashpot::cli
