#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// A measurement of LabVIEW or NI-DAQmx in TDMS (1.0 and 2.0), by its beginning.
bool is_tdms(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Reads the groups of channels: of each, the channels of the commonest length as a table, scaled
/// as their properties say; wf_increment is the time base where no channel is time. Streams the
/// data: memory is what the columns need. Texts, complex numbers, digital lines and scales for
/// sensors of temperature and strain are passed over with a note. A last segment that its writer
/// never closed is read as far as it is whole, with a note. Throws Error on damage and NoTable when
/// no group holds numbers.
std::vector<RawTable> read_tdms(const std::filesystem::path& path);

}  // namespace dashpot
