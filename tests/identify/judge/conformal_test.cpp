#include "dashpot/identify/judge/conformal.h"

#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A result at one level of the drive whose error is noise: 5 N, and 20 N above 0.6 m/s.
RecordResult noisy(std::size_t samples, double drive, Random& random) {
  RecordResult r;
  r.drive_level = drive;
  for (std::size_t k = 0; k < samples; ++k) {
    r.velocity.push_back(random.uniform(-1, 1));
    r.drive.push_back(drive);
    r.modelled.push_back(100);
    r.measured.push_back(100 + (std::abs(r.velocity[k]) > 0.6 ? 20 : 5) * random.normal());
  }
  return r;
}

/// A sine of 10 mm under a damper of 1000 N s/m, 100 N of friction and a friction of 50 N / A, with
/// 10 N of noise.
Record sine(const std::string& name, double frequency, double drive, Random& random) {
  Record record;
  record.name = name;
  record.condition = name;
  record.drive_level = drive;
  record.sample_time = 0.005;
  Channel x{"displacement", "m", {}, ""}, v{"velocity", "m/s", {}, ""}, f{"force", "N", {}, ""},
      i{"current", "A", {}, ""};
  const double w = 2 * std::numbers::pi * frequency;
  for (std::size_t k = 0; k < 300; ++k) {
    const double t = 0.005 * static_cast<double>(k);
    record.time.push_back(t);
    x.samples.push_back(0.01 * std::sin(w * t));
    v.samples.push_back(0.01 * w * std::cos(w * t));
    f.samples.push_back(1000 * v.samples[k] + (100 + 50 * drive) * std::copysign(1, v.samples[k]) +
                        10 * random.normal());
    i.samples.push_back(drive);
  }
  record.channels = {x, v, f, i};
  return record;
}

Dataset sines(std::size_t count) {
  Dataset dataset;
  dataset.name = "sines";
  Random random(3);
  for (std::size_t k = 0; k < count; ++k)
    dataset.records.push_back(sine("sine " + std::to_string(k), 1.1 + 0.7 * static_cast<double>(k),
                                   static_cast<double>(k % 2), random));
  return dataset;
}

}  // namespace

TEST_CASE("one group: the split conformal rank, ceil((n + 1) level)") {
  std::vector<double> scores;
  for (int k = 1; k <= 99; ++k) scores.push_back(k);
  CHECK(conformal_factor({{scores}}, 0.9) == 90);  // ceil(100 * 0.9)
  CHECK(conformal_factor({{scores}}, 0.95) == 95);
  CHECK(conformal_factor({{{1, 2, 3, 4, 5, 6, 7, 8, 9}}}, 0.9) == 9);
  CHECK(!conformal_factor({{{1, 2, 3, 4, 5, 6, 7, 8}}},
                          0.9));  // 9 * 0.9 > 8: no sample is large enough
  CHECK(!conformal_factor({}, 0.9));
}

TEST_CASE("a record counts as one, whatever its length") {
  const std::vector<double> calm(10000, 1), wild(100, 5);
  CHECK(conformal_factor({{calm, wild}}, 0.9) == 5);  // of all samples, 99 % are at 1
  CHECK(conformal_factor({{calm, calm, calm, wild}}, 0.7) == 1);
  // And a part as one, whatever its records: here the wild ones are half.
  CHECK(conformal_factor({{calm, calm, calm}, {wild}}, 0.7) == 5);
}

TEST_CASE("known noise: the band covers what it claims in every class, and follows it") {
  Random random(11);
  std::vector<RecordResult> training, calibration, fresh;
  for (int k = 0; k < 6; ++k) {
    training.push_back(noisy(1000, k % 2, random));
    calibration.push_back(noisy(1000, k % 2, random));
    fresh.push_back(noisy(1000, k % 2, random));
  }
  const auto shape = error_shape(training);
  REQUIRE(shape);
  const auto band = conformal_band(shape, {relative_errors(calibration, *shape)});
  REQUIRE(band);
  CHECK(band->records == 6);
  // 1.645 sigma of a normal error; classes borrow 200 samples from wider ones, hence 25 %.
  CHECK_CLOSE(band->half_width_at({0, 0.9, 0}), 1.645 * 20, 0.25, 0);
  CHECK_CLOSE(band->half_width_at({0, 0.4, 1}), 1.645 * 5, 0.25, 0);
  for (const auto& [low, high] : {std::pair{0.0, 0.6}, std::pair{0.6, 1.0}}) {
    double inside = 0, all = 0;
    for (const RecordResult& r : fresh)
      for (std::size_t k = 0; k < r.measured.size(); ++k)
        if (const double speed = std::abs(r.velocity[k]); speed >= low && speed < high)
          inside += std::abs(r.measured[k] - 100) <= band->half_width_at({0, speed, r.drive[k]}),
              ++all;
    CHECK_CLOSE(inside / all, 0.9, 0.04, 0);  // within the 86-94 % that reports are held to
  }
}

TEST_CASE(
    "parts of unlike error: a new one is covered as claimed, where the plain quantile falls "
    "short" *
    doctest::test_suite("long")) {
  // The scale of the error is log-normal, 0.7, from part to part; within a part errors are normal.
  // The mean coverage of new parts is known by the error function.
  for (const std::size_t count : {3, 5}) {
    Random random(21);
    constexpr int kTrials = 400;
    double plain = 0, widened = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<ErrorGroups> parts(count);
      for (ErrorGroups& part : parts) {
        const double scale = std::exp(0.7 * random.normal());
        part.resize(1);
        for (int k = 0; k < 200; ++k) part[0].push_back(scale * std::abs(random.normal()));
      }
      const double factor = *conformal_factor(parts), wider = factor * *widening(parts);
      for (int k = 0; k < 20; ++k) {
        const double scale = std::exp(0.7 * random.normal());
        plain += std::erf(factor / scale / std::numbers::sqrt2) / (20 * kTrials);
        widened += std::erf(wider / scale / std::numbers::sqrt2) / (20 * kTrials);
      }
    }
    CAPTURE(count);
    CHECK(plain < 0.89);
    CHECK_CLOSE(widened, 0.91, 0, 0.015);
  }
}

TEST_CASE("parts that are alike are not widened; a single one's records stand for parts") {
  Random random(4);
  std::vector<ErrorGroups> alike(4, ErrorGroups(2));
  for (ErrorGroups& part : alike)
    for (std::vector<double>& record : part)
      for (int k = 0; k < 4000; ++k) record.push_back(std::abs(random.normal()));
  CHECK_CLOSE(*widening(alike), 1, 0.02, 0);
  CHECK_CLOSE(*widening({alike[0]}), 1, 0.04, 0);
  CHECK(*widening({{alike[0][0]}}) == 1);
  CHECK(!widening({{{1, 2}}, {{1, 2}}}));  // too few samples for any factor
}

TEST_CASE("a class with few samples leans on its speed, and every width is positive") {
  Random random(5);
  std::vector<RecordResult> training = {noisy(4000, 0, random), noisy(2, 1, random)};
  for (double& force : training[1].measured) force = 1e4;  // two samples must not set a width
  training[1].velocity = {0.9, 0.9};
  const ForceBand shape = *error_shape(training);
  CHECK(shape.half_width_at({0, 0.9, 0}) < 20);
  CHECK(shape.half_width_at({0, 0.9, 1}) < 200);  // as two samples beside 200 of that speed
  // 1400 samples of this speed at sqrt(2 / pi) 5 N, beside 200 at the mean of all, 8.8 + 5 N.
  CHECK_CLOSE(shape.half_width_at({0, 0.4, 1}), 5.2, 0.1, 0);
  for (RecordResult& r : training) r.measured = r.modelled;
  const ForceBand perfect = *error_shape(training);
  for (const double width : perfect.half_width) CHECK(width > 0);
  for (RecordResult& r : training) r.diverged_at = 0;
  CHECK(!error_shape(training));
}

TEST_CASE("ranked models carry an interval, by folds and with one division") {
  for (const std::string way : {"condition", "fraction=0.3", "condition=sine 2"}) {
    CAPTURE(way);
    const Dataset dataset = sines(6);
    const Ranking ranking = rank({"bingham"}, dataset, parse_leave_out(way), {.threads = 1});
    const RankedModel& model = ranking.models.front();
    REQUIRE(model.band);
    CHECK(model.left_out.coverage.samples == model.left_out.pooled.samples);
    CHECK(model.left_out.coverage.percent() >= 86);
    CHECK(model.left_out.coverage.percent() <= 94);
    CHECK_CLOSE(model.left_out.coverage.mean_width(), 2 * 1.645 * 10, 0.15,
                0);  // the noise, and little more
    REQUIRE(model.left_out.worst_covered());
    CHECK(model.left_out.worst_covered()->coverage.percent() <= model.left_out.coverage.percent());

    const ModelFile file = parse_model(format_model(to_model_file(model, dataset, "")), "m.json");
    REQUIRE(file.interval);
    const Evaluation again = evaluate(*file.model, dataset.records, dataset.drive_unit,
                                      {.band = file.interval, .threads = 1});
    CHECK_CLOSE(again.coverage.percent(), 90, 0.05, 0);
  }
}

TEST_CASE("ends of records are covered by bands that were made without them, from one fit") {
  // A record of five stretches, the third of which is five times as noisy as the others.
  Random random(6);
  std::vector<RecordResult> left_out = {noisy(10000, 0, random)};
  const ForceBand shape = *error_shape(left_out);
  for (std::size_t k = 4000; k < 6000; ++k)
    left_out[0].measured[k] = 100 + 5 * (left_out[0].measured[k] - 100);
  const std::vector<ErrorGroups> errors = cover_by_parts(shape, left_out);
  REQUIRE(errors.size() == 5);

  // The band of the four that are alike is 1.645 times their noise: of one that is five times as
  // wide it covers 26 %. What the loud one does for the quiet ones is what widening is for.
  Coverage loud;
  const std::vector<ErrorGroups> quiet = {errors[0], errors[1], errors[3], errors[4]};
  loud.add(coverage({&left_out[0], 4000, 6000}, *conformal_band(shape, quiet)));
  CHECK_CLOSE(loud.percent(), 26, 0.1, 0);
  CHECK(left_out[0].coverage.samples == 10000);
  const double four = (left_out[0].coverage.percent() - loud.percent() / 5) / 0.8;
  CHECK(four > 99);
  REQUIRE(left_out[0].band);
  CHECK(left_out[0].band->records == 5);

  // Many records are dealt to ten parts.
  left_out.assign(23, noisy(100, 1, random));
  CHECK(cover_by_parts(shape, left_out).size() == 10);
  left_out.resize(1);
  left_out[0].diverged_at = 0;
  cover_by_parts(shape, left_out);
  CHECK(!left_out[0].band);
  CHECK(left_out[0].coverage.samples == 0);

  const Ranking ranking =
      rank({"bingham"}, sines(2), parse_leave_out("fraction=0.3"), {.threads = 1});
  CHECK(ranking.models[0].fold_fits.empty());
  CHECK(ranking.models[0].held_back_fits.empty());
}

TEST_CASE("the judged records do not touch their own interval") {
  Dataset calm = sines(4), wild = calm;
  for (double& force : wild.records[1].channels[2].samples) force += 300 * std::sin(force);
  const auto band_of = [](const Dataset& dataset) {
    const Ranking ranking =
        rank({"bingham"}, dataset, parse_leave_out("condition=sine 1"), {.threads = 1});
    return format_json(to_json(*ranking.models.front().left_out.records.front().band));
  };
  CHECK(band_of(calm) == band_of(wild));
}
