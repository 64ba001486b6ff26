#include "report/example_ranking.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "dashpot/base/random.h"

using namespace dashpot;

namespace {

struct Motion {
  double amplitude, frequency;
};
constexpr Motion kMotions[] = {{0.005, 3}, {0.010, 1}, {0.010, 3}, {0.020, 2}};
constexpr double kCurrents[] = {0, 0.8, 1.6};

/// A model of the example: how far it is off in yield force and hysteresis, and its noise.
struct Flaw {
  const char *name, *title;
  double gain, lag, noise;
};
constexpr Flaw kFlaws[] = {{"modified_bouc_wen", "Modified Bouc-Wen (Spencer)", 0.99, 0.92, 4},
                           {"tanh_kwok", "Hyperbolic tangent (Kwok)", 0.97, 0.7, 8},
                           {"bingham", "Bingham", 0.94, 0, 12}};

double force(double x, double v, double current, double lag) {
  return 900 * v + 2500 * x + (120 + 480 * current) * std::tanh(45 * v + lag * 60 * x);
}

class ExampleModel final : public DamperModel {
 public:
  explicit ExampleModel(const char* name) : name_(name) {}
  ModelKind kind() const override { return ModelKind::Law; }
  std::string name() const override { return name_; }
  bool needs_displacement() const noexcept override { return true; }
  std::size_t parameter_count() const noexcept override { return 6; }
  std::size_t state_size() const noexcept override { return 0; }
  void rest(const DamperInput&, std::span<double>) const noexcept override {}
  void advance(const DamperInput&, const DamperInput&, double,
               std::span<double>) const noexcept override {}
  double force(const DamperInput& in, std::span<const double>) const noexcept override {
    return ::force(in.displacement, in.velocity, in.current, 1);
  }
  std::unique_ptr<DamperModel> with_offset(double) const override {
    return std::make_unique<ExampleModel>(*this);
  }
  Value to_json() const override { return Value::object(); }

 private:
  const char* name_;
};

Record make_record(const Motion& motion, double current, std::size_t samples, Random& random) {
  Record record;
  record.condition = fmt::format("{:g} mm {:g} Hz", 1000 * motion.amplitude, motion.frequency);
  record.name = fmt::format("{} {:g} A", record.condition, current);
  record.source = record.name + ".csv";
  record.drive_level = current;
  record.sample_time = 0.002;
  record.warm_up = samples / 10;
  Channel x{"displacement", "m", {}, "column x, mm -> m"},
      v{"velocity", "m/s", {}, "column v, mm/s -> m/s"}, f{"force", "N", {}, "column F"},
      i{"current", "A", {}, "from the file name"};
  const double w = 2 * std::numbers::pi * motion.frequency;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = record.sample_time * static_cast<double>(k);
    record.time.push_back(t);
    x.samples.push_back(motion.amplitude * std::sin(w * t));
    v.samples.push_back(motion.amplitude * w * std::cos(w * t));
    f.samples.push_back(force(x.samples[k], v.samples[k], current, 1) + 6 * random.normal() + 20);
    i.samples.push_back(current);
  }
  record.channels = {x, v, f, i};
  return record;
}

RecordResult judge(const Record& record, const Flaw& flaw, Random& random) {
  RecordResult result{.record = record.name,
                      .condition = record.condition,
                      .drive_level = record.drive_level,
                      .left_out = true,
                      .warm_up = record.warm_up,
                      .offset = 20};
  result.time = record.time;
  result.displacement = record.channel("displacement").samples;
  result.velocity = record.channel("velocity").samples;
  result.drive = record.channel("current").samples;
  result.measured = record.channel("force").samples;
  constexpr double kHalfWidth = 60;
  result.band = ForceBand{.records = 9, .speeds = {}, .drives = {0}, .half_width = {kHalfWidth}};
  for (std::size_t k = 0; k < record.size(); ++k) {
    const double modelled = flaw.gain * force(result.displacement[k], result.velocity[k],
                                              *record.drive_level, flaw.lag) +
                            flaw.noise * random.normal() + result.offset;
    result.modelled.push_back(modelled);
    if (k < record.warm_up) continue;
    result.sums.add(result.measured[k], modelled);
    result.sums_without_offset.add(result.measured[k], modelled - result.offset);
    result.coverage.inside += std::abs(result.measured[k] - modelled) <= kHalfWidth;
  }
  result.metrics = metrics(result.sums);
  result.metrics_without_offset = metrics(result.sums_without_offset);
  result.energy_error = 100 * (flaw.gain - 1);
  result.coverage.samples = result.sums.n;
  result.coverage.width = 2 * kHalfWidth * static_cast<double>(result.sums.n);
  result.coverage.force_min = result.sums.force_min;
  result.coverage.force_max = result.sums.force_max;
  return result;
}

void diverge(RecordResult& result) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t at = result.time.size() / 2;
  result.diverged_at = result.time[at];
  std::fill(result.modelled.begin() + static_cast<std::ptrdiff_t>(at), result.modelled.end(), kNan);
  result.metrics.esr = result.metrics.rmse = result.metrics.fit = result.metrics.r2 = kNan;
}

std::vector<BandResult> bands_of(const std::vector<RecordResult>& records) {
  constexpr double kEdges[] = {0, 0.02, 0.08, 0.16, 0.5};
  const char* names[] = {"pre-yield, |v| below 5 % of the largest", "low, 5-25 %",
                         "middle, 25-60 %", "high, above 60 %"};
  std::vector<BandResult> bands;
  for (std::size_t band = 0; band < 4; ++band) {
    ErrorSums sums;
    for (const RecordResult& r : records)
      for (std::size_t k = r.warm_up; k < r.time.size(); ++k)
        if (std::isfinite(r.modelled[k]) && std::abs(r.velocity[k]) >= kEdges[band] &&
            std::abs(r.velocity[k]) < kEdges[band + 1])
          sums.add(r.measured[k], r.modelled[k]);
    bands.push_back({names[band], kEdges[band], kEdges[band + 1], metrics(sums)});
  }
  return bands;
}

Evaluation evaluation_of(std::vector<RecordResult> records) {
  Evaluation evaluation;
  ErrorSums sums, without_offset;
  for (const RecordResult& r : records) {
    sums.add(r.sums);
    without_offset.add(r.sums_without_offset);
    evaluation.coverage.add(r.coverage);
    evaluation.diverged += r.diverged_at.has_value();
    if (!r.diverged_at && r.metrics.esr > evaluation.worst_esr)
      evaluation.worst_esr = r.metrics.esr, evaluation.worst_record = r.record;
  }
  evaluation.mean_esr = evaluation.worst_esr / 2;
  evaluation.mean_energy_error = 3;
  evaluation.drive = {{0, 0, metrics(sums)}, {0.8, 0.8, metrics(sums)}, {1.6, 1.6, metrics(sums)}};
  evaluation.bands = bands_of(records);
  evaluation.pooled = metrics(sums);
  evaluation.pooled_without_offset = metrics(without_offset);
  evaluation.records = std::move(records);
  return evaluation;
}

FitReport fit_of(const Flaw& flaw) {
  FitReport fit;
  fit.status = FitReport::Status::Converged;
  fit.model = std::make_shared<ExampleModel>(flaw.name);
  fit.parameters = {
      {"c0", "N*s/m", "viscous damping", 900 * flaw.gain, 880 * flaw.gain, 920 * flaw.gain},
      {"k0", "N/m", "stiffness", 2500, 1900, 3100, false, false, true},
      {"alpha", "N", "yield force at 0 A", 120, 118, 122},
      {"x0", "m", "place of the spring's zero", 0, 0, 0, true}};
  fit.warnings = {
      "k0 cannot be told from alpha by these motions; a slower one would tell them apart"};
  fit.iterations = 23;
  fit.seconds = 0.4;
  return fit;
}

}  // namespace

ExampleRanking example_ranking(std::size_t samples) {
  ExampleRanking example;
  Random random(7);
  example.dataset.name = "Demonstration damper";
  example.dataset.citation = "Made up for the tests";
  example.dataset.files = {{"demo/5 mm 3 Hz 0 A.csv", std::string(64, 'a')}};
  example.dataset.notes = {"velocity is taken from its channel"};
  example.dataset.readings = {
      {"demo/5 mm 3 Hz 0 A.csv", "x_mm", "displacement", "mm", 1e-3, 0, "header"}};
  for (const Motion& motion : kMotions)
    for (const double current : kCurrents)
      example.dataset.records.push_back(make_record(motion, current, samples, random));
  example.ranking.unit = "division";
  for (const Motion& motion : kMotions)
    example.ranking.folds.push_back(
        fmt::format("without {:g} mm {:g} Hz", 1000 * motion.amplitude, motion.frequency));
  for (const Flaw& flaw : kFlaws) {
    std::vector<RecordResult> results;
    for (const Record& record : example.dataset.records)
      results.push_back(judge(record, flaw, random));
    if (&flaw == &kFlaws[2]) diverge(results.back());
    RankedModel model{.name = flaw.name, .title = flaw.title, .fit = fit_of(flaw)};
    model.left_out = evaluation_of(results);
    model.training = model.left_out;
    model.fold_fits.assign(example.ranking.folds.size(), fit_of(flaw));
    model.seconds = 2.3;
    model.nanoseconds_per_step = 48;
    model.stress = {.seconds = 5, .finite = true, .largest_share = 1.5};
    model.forgetting = {
        .is_tested = true, .seconds = 0.8, .share_left = 1e-4, .record = "a record"};
    if (&flaw == &kFlaws[1])
      model.over_first = PairedRatio{.times = 3.2, .low = 1.4, .high = 7.3, .units = 4};
    example.ranking.models.push_back(std::move(model));
  }
  return example;
}

ExampleRanking crowded_ranking(std::size_t models) {
  ExampleRanking example = example_ranking(300);
  auto& all = example.ranking.models;
  while (all.size() < models) {
    RankedModel next = all[all.size() - 2];
    next.name = fmt::format("model_{}", all.size() - 1);
    next.title = fmt::format("Model number {} of the literature", all.size() - 1);
    next.left_out.pooled.esr *= 1.1;
    all.insert(all.end() - 1, std::move(next));
  }
  return example;
}
