#include "dashpot/record/readers/csv.h"
#include "dashpot/record/readers/hdf5.h"
#include "dashpot/record/readers/mat.h"
#include "dashpot/record/readers/mdf4.h"
#include "dashpot/record/readers/tdms.h"
#include "dashpot/record/readers/xlsx.h"
#include "fuzz.h"

// The readers alone, without what becomes of their tables: many times the inputs of the targets
// that load a file as the command line would.

namespace {

/// What build_record relies on: columns of one length, whose cells are finite or known to be bad.
void require_sound(const dashpot::RawTable& table) {
  for (const dashpot::RawColumn& column : table.columns) {
    require_true(column.values.size() == table.rows());
    require_true(!column.bad || column.bad->row < table.rows());
    for (const double value : column.values)
      require_true(std::isfinite(value) || (std::isnan(value) && column.bad));
  }
  for (const auto& [row, line] : table.lines) require_true(row <= table.rows() && line > 0);
}

template <std::vector<dashpot::RawTable> (*read)(const std::filesystem::path&)>
void read_fuzzed(const std::string& input) {
  const std::vector<dashpot::RawTable> tables = read(fuzz_file("bytes", input));
  require_true(!tables.empty());
  for (const dashpot::RawTable& table : tables) require_sound(table);
}

const FuzzTarget targets[] = {{"csv_table", read_fuzzed<dashpot::read_csv>},
                              {"hdf5_tables", read_fuzzed<dashpot::read_hdf5>},
                              {"mat_tables", read_fuzzed<dashpot::read_mat>},
                              {"mdf4_tables", read_fuzzed<dashpot::read_mdf4>},
                              {"tdms_tables", read_fuzzed<dashpot::read_tdms>},
                              {"xlsx_tables", read_fuzzed<dashpot::read_xlsx>}};

}  // namespace
