#include "dashpot/identify/judge/error_model.h"

#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/numerics/constants.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kStep = 0.002, kLag = 0.01;  // s

/// A slow element that the model lacks: 200 N tanh(z / 0.1 m/s) of a velocity that lags by 10 ms.
double lacking(double z) { return 200 * std::tanh(z / 0.1); }

/// A model's record over a sine: its error is that element, where `noise` is 0, else noise of that
/// colour.
RecordResult erred(double amplitude, double frequency, double element, double noise, double keeps,
                   Random& random) {
  RecordResult r;
  const double w = 2 * std::numbers::pi * frequency;
  double z = amplitude * w, n = 0;
  for (int k = 0; k < 1500; ++k) {
    const double t = kStep * k;
    r.time.push_back(t);
    r.displacement.push_back(amplitude * std::sin(w * t));
    r.velocity.push_back(amplitude * w * std::cos(w * t));
    r.drive.push_back(1);
    z += kStep / kLag * (r.velocity.back() - z);
    n = keeps * n + std::sqrt(1 - keeps * keeps) * random.normal();
    r.modelled.push_back(1000 * r.velocity.back());
    r.measured.push_back(r.modelled.back() + element * lacking(z) + noise * n);
  }
  return r;
}

std::vector<RecordResult> sines(double element, double noise, double keeps) {
  Random random(3);
  std::vector<RecordResult> records;
  for (const auto& [amplitude, frequency] :
       {std::pair(0.03, 0.7), {0.02, 2.0}, {0.01, 5.0}, {0.005, 9.0}, {0.002, 14.0}, {0.015, 3.0}})
    records.push_back(erred(amplitude, frequency, element, noise, keeps, random));
  return records;
}

/// Nothing: what an erring damper adds is then its force.
std::shared_ptr<const DamperModel> no_force() {
  const Law& law = find_law("bingham", "test");
  return std::make_shared<LawModel>(
      LawModel::constant(law, std::vector<double>(law.params.size(), 0)));
}

/// rms over a motion of two sines, which the error model has not seen, of its error less the
/// element; over the element's.
double share_missed(const ErrorDraw& error) {
  const std::shared_ptr<const DamperModel> damper = erring(no_force(), error);
  std::vector<double> state(damper->state_size());
  DamperInput before{0, 0, 1};
  damper->rest(before, state);
  double z = 0, missed = 0, all = 0;
  for (int k = 1; k < 3000; ++k) {
    const double t = kStep * k;
    const DamperInput now{0.01 * std::sin(8 * t) + 0.002 * std::sin(60 * t),
                          0.08 * std::cos(8 * t) + 0.12 * std::cos(60 * t), 1};
    damper->advance(before, now, kStep, state);
    z += kStep / kLag * (now.velocity - z);
    missed += std::pow(damper->force(now, state) - lacking(z), 2);
    all += std::pow(lacking(z), 2);
    before = now;
  }
  return std::sqrt(missed / all);
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

TEST_CASE("error model: what follows from the motion is known along motions that were not seen") {
  const ErrorModel errors(sines(1, 0, 0));
  CHECK(errors.unexplained() < 40);               // of 150 N
  CHECK(share_missed(errors.draw(6, 1)) < 0.35);  // 1 where nothing is learnt
}

TEST_CASE("error model: of noise nothing is learnt, and its size and colour are") {
  // 20 N that forget within 20 ms.
  const ErrorModel errors(sines(0, 20, std::exp(-kStep / 0.02)));
  CHECK_CLOSE(errors.unexplained(), 20, 0.15, 0);

  // Draws carry a share of it, none to all: half of its rms on average.
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    sum += rms(errors.draw(20, seed).noise.front()) / 40;
  CHECK(sum > 6);
  CHECK(sum < 14);
}

TEST_CASE("error model: white noise is the load cell's and moves no damper") {
  const ErrorModel errors(sines(0, 20, 0));
  CHECK_CLOSE(errors.unexplained(), 20, 0.15, 0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const std::vector<double>& noise : errors.draw(5, seed).noise) CHECK(rms(noise) < 7);
}

TEST_CASE("error model: the same seed, the same error; others differ by what records leave open") {
  const ErrorModel errors(sines(1, 10, 0.9));
  CHECK(errors.draw(2, 7).weights == errors.draw(2, 7).weights);
  CHECK(errors.draw(2, 7).noise == errors.draw(2, 7).noise);
  CHECK(errors.draw(2, 7).weights != errors.draw(2, 8).weights);
}

TEST_CASE("error model: one record is divided in time; without a finite error there is none") {
  const std::vector<RecordResult> all = sines(1, 0, 0);
  CHECK(ErrorModel({all[1]}).unexplained() < 40);
  std::vector<RecordResult> diverged = {all[1]};
  diverged.front().diverged_at = 0.1;
  CHECK(message_of([&] { ErrorModel{diverged}; }) ==
        "error of the model: it has no finite error on a left-out record; records that its fits "
        "have not seen, on which it does not diverge");
}
