#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/value.h"

namespace dashpot::studio {

/// The samples that `dashpot inspect --samples` or `dashpot evaluate --traces raw` wrote to a
/// folder, seen without being read whole: the file is mapped while it is used.
class SampleView {
 public:
  /// Throws Error where the folder does not hold such samples.
  explicit SampleView(const std::filesystem::path& folder);
  ~SampleView();
  SampleView(const SampleView&) = delete;
  SampleView& operator=(const SampleView&) = delete;

  std::size_t records() const { return records_.size(); }
  /// The place of a record. Throws Error where there is none of this name: files may have changed
  /// since a page learnt of them.
  std::size_t place_of(const std::string& record) const;
  /// One column of a record; empty when the record has none of this name.
  std::span<const double> column(std::size_t record, const std::string& name) const;
  std::string unit(std::size_t record, const std::string& name) const;

 private:
  struct Column {
    std::string name, unit;
    std::size_t at;
  };
  struct Record {
    std::string name;
    std::size_t samples;
    std::vector<Column> columns;
  };
  const Column* find(std::size_t record, const std::string& name) const;

  std::vector<Record> records_;
  const double* samples_ = nullptr;
  std::size_t count_ = 0;
};

/// A curve as few points as a picture needs.
struct Curve {
  std::vector<double> x, y;
};

/// The samples of `time` from `from` to `to`: their first and one behind the last.
std::pair<std::size_t, std::size_t> window_of(std::span<const double> time, double from, double to);

/// y over a rising x: every sample where they fit; else of each of `columns` equal stretches of x
/// the least and the greatest, in the order in which they came.
Curve thin_in_time(std::span<const double> x, std::span<const double> y, std::size_t columns);

/// y over an x that goes to and fro: samples that lie at least a part in 1 / `steps` of the extent
/// from the one before, along the arc.
Curve thin_along_arc(std::span<const double> x, std::span<const double> y, std::size_t steps);

}  // namespace dashpot::studio
