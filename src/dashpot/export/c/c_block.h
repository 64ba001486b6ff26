#pragma once
#include <string>
#include <vector>

#include "dashpot/export.h"

namespace dashpot {

/// A field of a block's damper_input, or of its commands; one of a kind, or an array of them.
struct CPort {
  struct Part {
    std::string name, unit;
  };
  std::string name, unit, meaning;  ///< `unit`: empty where none is known
  std::string place;                ///< in C: "struts[#].deflection", # being which of them
  std::size_t count = 1;
  std::vector<Part> parts = {};  ///< for each of several: the strut or coordinate it belongs to

  /// The place of one of them.
  std::string at(std::size_t which) const;
};

/// An inverse or a controller, which gives commands sample by sample, as C99: damper_init,
/// damper_reset and damper_step on a damper_model, without heap, files or globals that change.
struct CBlock {
  /// The inputs at a sample, port by port, and the commands that the library gives for them in
  /// double precision.
  struct Sample {
    std::vector<double> inputs, commands;
    bool matters = true;  ///< elsewhere no command is better than another, and rounding decides
  };
  std::string name;   ///< of files, and of functions in place of "damper"
  std::string title;  ///< what it is, in a line
  std::string about;  ///< what it was made for, in sentences
  CPrecision precision = CPrecision::Double;
  /// In double precision, with names that begin with damper_; @prefix@ and @command@ are open.
  std::string header, source;
  std::string step;  ///< a statement that takes `model` and `input` and writes commands[]
  std::vector<CPort> inputs, commands;
  std::size_t state_size = 0;   ///< numbers in damper_model's `state`, one at least
  double sample_time = 0;       ///< s
  double range = 0;             ///< largest less least command
  double tolerance = 1e-12;     ///< share of the range within which the commands agree
  std::vector<Sample> samples;  ///< a run from rest
  /// Per command, what its difference counts by, for commands of several units; empty: 1 each.
  std::vector<double> scales = {};
  std::string version;
};

/// Statements that write the fields of `input`, a damper_input*, from `row`, the inputs port by
/// port.
std::string c_block_reads(const CBlock& block);
/// NAME.h, NAME.c and NAME_test.c, a main that checks them along the run. Throws Error where the
/// code has inside what a name would begin with.
std::vector<ExportedFile> write_c_block(const CBlock& block, const std::string& command);
/// The header and the source alone, under another name.
std::vector<ExportedFile> c_block_sources(const CBlock& block, const std::string& name,
                                          const std::string& command);

}  // namespace dashpot
