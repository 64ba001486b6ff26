#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot {

/// One thing that a hand corrected in how a file was understood: what, and its new value.
///   CHANNEL.column, .unit, .scale, .offset, .sign, .centre, .moving_mass   as in a dataset file
///   CHANNEL=none            the channel is not used
///   level=0.5               the constant drive, A or V
///   cut=0.5:3 (either may be empty), cut=none, rest=drop, rest=keep
///   sample_rate=1000, velocity_cutoff=40, condition=..., name=...
using Correction = std::pair<std::string, std::string>;

/// "force.unit=kN; force.sign=-1" as corrections. Throws Error on a part without '='.
std::vector<Correction> parse_corrections(const std::string& text);

/// A dataset file with the corrections of one of its files. The file gets an entry of its own, the
/// first of all, which says what was said or understood of it and is corrected; an earlier such
/// entry is replaced. Everything else of the text stays as it is, comments included.
///   text: of the dataset file; "" makes one that states what was understood of all recordings and
///     leaves files that come later to be understood by themselves
///   dataset: the recordings as that text reads them; folder: the folder they were loaded from
///   file: relative to the folder, "recordings/run3.csv"
/// Throws Error where the file gave no record, on a correction that is unknown, on a level where
/// the drive has no unit, and where the entries of the text are not written one below the other.
std::string corrected_statement(const std::string& text, const Dataset& dataset,
                                const std::filesystem::path& folder, const std::string& file,
                                const std::vector<Correction>& corrections);

}  // namespace dashpot
