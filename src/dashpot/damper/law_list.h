#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/law.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// Every force law, in alphabetical order.
std::span<const Law* const> laws();

/// The law of that name, Dashpot's own or one of a file. Throws Error(where, "unknown model ...")
/// which says what is known.
const Law& find_law(std::string_view name, const std::string& where = {});

/// Whether Dashpot itself has a law of that name, which no law from a file may take.
bool is_own_law(std::string_view name);
/// Whether find_law() knows it.
bool is_law(std::string_view name);

/// Reads the law of a file (docs/laws-from-a-file.md), which is then known by its name until the
/// program ends; of two texts with one name the later is meant. Throws Error on what is wrong with
/// the file, and where it takes the name of a law of Dashpot's own.
const Law& know_law(const std::filesystem::path& file);
/// Names of the laws that were read from files; not among laws().
std::vector<std::string> laws_of_files();
/// The description of such a law; null where there is none of that name.
const ModelInfo* file_law_info(std::string_view name);

ModelInfo info_of(const Law& law);

}  // namespace dashpot
