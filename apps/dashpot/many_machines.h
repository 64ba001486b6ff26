#pragma once
#include <filesystem>
#include <string>

#include "command.h"
#include "dashpot/base/part.h"

namespace dashpot::cli {

/// How the work of one command goes over several machines.
struct ManyMachines {
  std::string part, simd;
};

std::vector<Option> many_machines_options(ManyMachines& settings);

/// Settles the instruction set, before any work, and gives the part, all of the work unless stated.
/// Throws UsageError.
Part settle_machines(const ManyMachines& settings);

/// Whether the tasks are to be made and kept before results are told: those of a part, or under
/// mpirun those of all, which every process shares.
bool are_dealt_out(const Part& part);

/// Says what was made and how the parts become one; the exit code.
int finish_part(const PartReport& report, const Part& part, const std::string& what,
                const std::filesystem::path& store, Console& console);

}  // namespace dashpot::cli
