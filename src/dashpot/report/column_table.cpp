#include "dashpot/report/column_table.h"

#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"

namespace dashpot {

ColumnTable in_units(ColumnTable table, const PrintUnits& units) {
  for (DataColumn& column : table.columns) {
    const PrintUnit unit = units.of(column.unit);
    column.unit = unit.name;
    if (unit.factor != 1)
      for (double& number : column.numbers) number *= unit.factor;
  }
  return table;
}

std::string csv_table(const ColumnTable& table) {
  std::vector<std::string> titles;
  for (const DataColumn& column : table.columns) {
    const bool plain = column.is_text() || column.unit == "1";
    titles.push_back(csv_field(plain ? column.name : column.name + '[' + column.unit + ']'));
  }

  // A number that is not finite leaves its field empty.
  std::string text = join(titles, ",") + '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool first = true;
    for (const DataColumn& column : table.columns) {
      if (!first) text += ',';
      first = false;
      if (column.is_text())
        text += csv_field(column.texts[row]);
      else if (std::isfinite(column.numbers[row]))
        text += format_exact(column.numbers[row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace dashpot
