#include "dashpot/identify/fit/family_build.h"

#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/error.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify/fit/family_physics_fit.h"
#include "dashpot/numerics/least_squares.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr std::size_t kBuildNumbers = FamilyPhysics::kDeviations;
using BuildMatrix = std::array<double, kBuildNumbers * kBuildNumbers>;

/// Factor L of a positive definite matrix = L L', row by row.
BuildMatrix lower_factor(const BuildMatrix& matrix) {
  BuildMatrix factor{};
  for (std::size_t i = 0; i < kBuildNumbers; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = matrix[i * kBuildNumbers + j];
      for (std::size_t k = 0; k < j; ++k)
        rest -= factor[i * kBuildNumbers + k] * factor[j * kBuildNumbers + k];
      factor[i * kBuildNumbers + j] =
          i == j ? std::sqrt(rest) : rest / factor[j * kBuildNumbers + j];
    }
  return factor;
}

double mean_of(std::span<const double> samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.) / static_cast<double>(samples.size());
}

/// The recordings as records of this member, whose conditions they may state again.
std::vector<FamilyRecord> records_of_build(const FamilyModel& member,
                                           const std::vector<Record>& recordings,
                                           DriveUnit drive_unit) {
  std::vector<FamilyRecord> records;
  for (const Record& recording : recordings) {
    FamilyRecord record{with_conditions(member.member(), recording.conditions, recording.name),
                        damper_inputs(recording, drive_unit), recording.time,
                        recording.channel("force").samples, recording.warm_up};
    for (const MemberField& field : member_fields()) {
      const double own = record.member.*field.field, asked = member.member().*field.field;
      if (field.required && std::abs(own - asked) > 1e-6 * std::abs(asked))
        throw Error(recording.name,
                    "is of a damper whose " + std::string(field.name) + " is " +
                        format_number(own) + " " + std::string(field.unit) + ", not " +
                        format_number(asked),
                    "recordings of one build of this drawing");
    }
    records.push_back(std::move(record));
  }
  if (records.empty()) throw Error(member.name(), "has no recording", "one at least");
  return records;
}

/// The family's numbers. Throws Error where it does not know its builds, or the build is stated.
const FamilyPhysics& physics_of(const FamilyModel& member) {
  const auto* force = dynamic_cast<const PhysicsFamily*>(member.family().force.get());
  if (!force || !(force->physics().record_error > 0))
    throw Error(member.name(), "does not know how builds of a drawing differ",
                "a family_physics of two designs or more");
  if (member.member().build != 0)
    throw Error(member.name(),
                "is to be a build of " + format_number(member.member().build) +
                    " standard deviations, and the recordings tell which build it is",
                "leave 'build' out");
  return force->physics();
}

}  // namespace

void require_builds(const FamilyModel& member) { physics_of(member); }

BuildReport measure_build(const FamilyModel& member, const std::vector<Record>& recordings,
                          DriveUnit drive_unit, ForceZero zero) {
  FamilyPhysics physics = physics_of(member);
  const std::vector<FamilyRecord> records = records_of_build(member, recordings, drive_unit);

  // What is expected of a build: the inverse covariance of its deviations.
  const std::vector<double> covariance = physics.deviation_covariance();
  const std::vector<double> precise = inverse(covariance, kBuildNumbers);
  BuildMatrix precision;
  std::ranges::copy(precise, precision.begin());
  const BuildMatrix factor = lower_factor(precision);

  // Residuals: every record as one observation with the record's error, then the prior.
  LeastSquaresProblem problem;
  std::vector<double> weight;
  for (const FamilyRecord& record : records) {
    const std::span<const double> force_of = std::span(record.force).subspan(record.first);
    const std::size_t count = force_of.size();
    const double from = zero == ForceZero::LoadCell ? 0 : mean_of(force_of);
    double square = 0;
    for (const double sample : force_of) square += (sample - from) * (sample - from);
    weight.push_back(
        1 / (physics.record_error * std::max(std::sqrt(square), 1e-3 * physics.reference.force)));
    problem.residuals += count;
  }
  const std::size_t samples = problem.residuals;
  problem.residuals += kBuildNumbers;
  problem.lower.assign(kBuildNumbers, -3);
  problem.upper.assign(kBuildNumbers, 3);
  problem.residual = [&](std::span<const double> x, std::span<double> r) {
    FamilyPhysics built = physics;
    std::ranges::copy(x, built.deviation.begin());
    std::size_t at = 0;
    for (std::size_t n = 0; n < records.size(); ++n) {
      const std::vector<double> modelled =
          run_family_physics(built, records[n].member, records[n].inputs, records[n].time);
      const std::span<double> own = r.subspan(at, modelled.size() - records[n].first);
      for (std::size_t k = 0; k < own.size(); ++k) {
        const std::size_t sample = records[n].first + k;
        own[k] = weight[n] * (modelled[sample] + member.offset() - records[n].force[sample]);
      }
      at += own.size();
      if (zero == ForceZero::LoadCell) continue;
      const double mean = mean_of(own);
      for (double& residual : own) residual -= mean;
    }

    // The prior.
    for (std::size_t i = 0; i < kBuildNumbers; ++i) {
      double whitened = 0;
      for (std::size_t k = i; k < kBuildNumbers; ++k)
        whitened += factor[k * kBuildNumbers + i] * x[k];
      r[samples + i] = whitened;
    }
    return true;
  };
  const LeastSquaresReport solved =
      solve(problem, std::vector<double>(kBuildNumbers), {.threads = 1});
  std::ranges::copy(solved.x, physics.deviation.begin());

  // How far the build lies from its drawing, in the spread that left-out dampers had.
  constexpr double kOneInHundred = 13.277;   // of chi squared with four degrees of freedom
  constexpr double kWithoutOffset = 11.345;  // with three
  BuildReport report;
  report.unlikely = zero == ForceZero::LoadCell ? kOneInHundred : kWithoutOffset;
  const std::vector<double> left =
      solved.normal_matrix.empty() ? covariance : inverse(solved.normal_matrix, kBuildNumbers);
  for (std::size_t i = 0; i < kBuildNumbers; ++i) {
    const std::size_t ii = i * kBuildNumbers + i;
    for (std::size_t k = 0; k < kBuildNumbers; ++k)
      report.distance += solved.x[i] * precision[i * kBuildNumbers + k] * solved.x[k];
    const bool newtons = i == kBuildNumbers - 1;
    const double unit = newtons ? physics.reference.force : 1;
    report.deviations.push_back({std::string(PhysicsFamily::kDeviationNames[i]),
                                 newtons ? unit * solved.x[i] : std::expm1(solved.x[i]),
                                 unit * std::sqrt(covariance[ii]), unit * std::sqrt(left[ii])});
  }

  // The family with this build in it: what is left of its spread is what this build is known by.
  auto family = std::make_shared<Family>(member.family());
  family->force = std::make_shared<PhysicsFamily>(physics);
  family->build_spread = std::sqrt(left.front());
  family->drawing_spread = 0;
  report.model = std::make_shared<FamilyModel>(family, member.member(), member.offset());
  const auto esr = [&](const FamilyModel& model) {
    const OffsetMode offset = zero == ForceZero::LoadCell ? OffsetMode::None : OffsetMode::Record;
    return evaluate(model, recordings, drive_unit, {.offset = offset}).pooled.esr;
  };
  report.esr_before = esr(member);
  report.esr_after = esr(*report.model);
  report.left_of_usual = std::sqrt(report.esr_after / 100) / physics.record_error;
  return report;
}

}  // namespace dashpot
