#include "sample_view.h"

#include <algorithm>
#include <cmath>
#include <fcntl.h>
#include <unistd.h>

#include <sys/mman.h>
#include <sys/stat.h>

#include "dashpot/base/file.h"
#include "dashpot/error.h"

namespace dashpot::studio {
namespace {

constexpr std::size_t kMostOnLoop = 2'000'000;  // samples that a loop is drawn of

struct Extent {
  double low = INFINITY, high = -INFINITY;
};
Extent extent(std::span<const double> values, std::size_t step) {
  Extent found;
  for (std::size_t i = 0; i < values.size(); i += step) {
    found.low = std::min(found.low, values[i]);
    found.high = std::max(found.high, values[i]);
  }
  return found;
}

}  // namespace

SampleView::SampleView(const std::filesystem::path& folder) {
  // What lies where.
  const std::string index = (folder / "samples.json").string();
  const Value value = parse_json(read_file(index), index);
  const Value* records = value.find("records");
  if (!records) throw Error(index, "lists no records");
  for (const Value& one : records->items()) {
    Record record{one.find("name")->as_string(),
                  static_cast<std::size_t>(one.find("samples")->as_number()),
                  {}};
    for (const Value& column : one.find("columns")->items())
      record.columns.push_back({column.find("name")->as_string(), column.find("unit")->as_string(),
                                static_cast<std::size_t>(column.find("at")->as_number())});
    records_.push_back(std::move(record));
  }

  // The samples themselves, as far as they are looked at.
  const std::string file = (folder / "samples.f64").string();
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  struct stat status{};
  if (descriptor < 0 || fstat(descriptor, &status) != 0) {
    if (descriptor >= 0) close(descriptor);
    throw Error(file, "cannot be read");
  }
  count_ = static_cast<std::size_t>(status.st_size) / sizeof(double);
  if (count_ > 0) {
    void* mapped = mmap(nullptr, count_ * sizeof(double), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (mapped != MAP_FAILED) samples_ = static_cast<const double*>(mapped);
  }
  close(descriptor);
  if (count_ > 0 && !samples_) throw Error(file, "cannot be mapped");
}

SampleView::~SampleView() {
  if (samples_) munmap(const_cast<double*>(samples_), count_ * sizeof(double));
}

std::size_t SampleView::place_of(const std::string& record) const {
  const auto at = std::ranges::find(records_, record, &Record::name);
  if (at == records_.end())
    throw Error("'" + record + "'", "is no record of this folder, or none any more",
                "reload the page to see those that there are");
  return static_cast<std::size_t>(at - records_.begin());
}

const SampleView::Column* SampleView::find(std::size_t record, const std::string& name) const {
  if (record >= records_.size()) return nullptr;
  const auto& columns = records_[record].columns;
  const auto at = std::ranges::find(columns, name, &Column::name);
  return at == columns.end() ? nullptr : &*at;
}

std::span<const double> SampleView::column(std::size_t record, const std::string& name) const {
  const Column* column = find(record, name);
  if (!column || column->at + records_[record].samples > count_) return {};
  return {samples_ + column->at, records_[record].samples};
}

std::string SampleView::unit(std::size_t record, const std::string& name) const {
  const Column* column = find(record, name);
  return column ? column->unit : "";
}

std::pair<std::size_t, std::size_t> window_of(std::span<const double> time, double from,
                                              double to) {
  const auto first = std::lower_bound(time.begin(), time.end(), from);
  const auto last = std::upper_bound(first, time.end(), to);
  // One sample more on either side, so that lines run to the edge.
  const auto begin = static_cast<std::size_t>(first - time.begin()),
             end = static_cast<std::size_t>(last - time.begin());
  return {begin > 0 ? begin - 1 : 0, std::min(end + 1, time.size())};
}

Curve thin_in_time(std::span<const double> x, std::span<const double> y, std::size_t columns) {
  if (x.size() <= 3 * columns) return {{x.begin(), x.end()}, {y.begin(), y.end()}};

  // The lowest and the highest sample of each column, in their order.
  Curve curve;
  const std::size_t count = x.size();
  for (std::size_t k = 0; k < columns; ++k) {
    const std::size_t first = k * count / columns, last = (k + 1) * count / columns;
    std::size_t low = first, high = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (!curve.x.empty() && curve.x.back() == x[i]) continue;
      curve.x.push_back(x[i]);
      curve.y.push_back(y[i]);
    }
  }
  return curve;
}

Curve thin_along_arc(std::span<const double> x, std::span<const double> y, std::size_t steps) {
  // A window of very many samples is looked at in steps of several: its loops lie over each other.
  const std::size_t step = 1 + x.size() / kMostOnLoop;
  const Extent of_x = extent(x, step), of_y = extent(y, step);
  const double per_x = static_cast<double>(steps) / std::max(of_x.high - of_x.low, 1e-300),
               per_y = static_cast<double>(steps) / std::max(of_y.high - of_y.low, 1e-300);
  constexpr std::size_t kMostPoints = 12000;
  Curve curve;
  for (std::size_t i = 0; i < x.size() && curve.x.size() < kMostPoints; i += step) {
    const bool is_near = !curve.x.empty() && i + step < x.size() &&
                         std::abs(x[i] - curve.x.back()) * per_x < 1 &&
                         std::abs(y[i] - curve.y.back()) * per_y < 1;
    if (is_near) continue;
    curve.x.push_back(x[i]);
    curve.y.push_back(y[i]);
  }
  return curve;
}

}  // namespace dashpot::studio
