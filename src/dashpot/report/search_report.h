#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/identify/search/search.h"
#include "dashpot/value.h"

namespace dashpot {

/// What the report of a search is made from.
struct SearchInput {
  const Dataset& dataset;
  const SearchReport& search;
  std::string command;  ///< the command line that prints all its figures again
  std::string version;
  std::string date;  ///< ISO 8601
};

/// The first `most` trials as a table for a terminal; `of` says what was searched.
std::string trial_table(const std::vector<Trial>& trials, const SearchReport& of, int width,
                        std::size_t most);
/// A few sentences: the best network, the smallest that is practically as good, and what to beware
/// of.
std::string search_verdict(const SearchReport& search);
/// "24 trials", or the rungs of halving: "27 trials with 1/9 of the data, 9 with 1/3, 3 with all".
std::string search_plan(const std::vector<Rung>& rungs, SearchEffort effort);
/// "hidden=10, activation=tanh": what was searched, as this trial has it.
std::string searched_settings(const Trial& trial, const SearchReport& search);

/// As a page, for programs, as Markdown, and one line per trial. The last holds no times: it is the
/// same bit for bit whenever the search is.
std::string html_search(const SearchInput& input);
Value json_search(const SearchInput& input);
std::string markdown_search(const SearchInput& input);
std::string csv_search(const SearchReport& search);

/// Error against parameters as search.svg and search.pdf; returns the paths. Throws Error when
/// gnuplot is missing or no trial is usable.
std::vector<std::filesystem::path> write_search_figure(const SearchReport& search,
                                                       const std::filesystem::path& folder);

}  // namespace dashpot
