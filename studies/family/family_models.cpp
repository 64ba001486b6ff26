// Models of the registry on the samples of the family study.
#include <algorithm>
#include <iterator>

#include "dashpot/base/parallel.h"
#include "dashpot/identify.h"
#include "studies/family/family_study.h"

namespace dashpot {
namespace {

/// One fit and what it is judged on.
struct Lesson {
  FamilyProtocol protocol;
  std::vector<Record> training, judged;
};

/// The runs of the cycles whose samples these are.
std::vector<Record> runs_of(const FamilySamples& family, const std::vector<std::size_t>& samples) {
  std::vector<bool> chosen(family.size());
  for (const std::size_t s : samples) chosen[s] = true;
  std::vector<Record> runs;
  for (std::size_t c = 0; c < family.runs.size(); ++c)
    if (chosen[family.first[c]]) runs.push_back(family.runs[c]);
  return runs;
}

std::vector<Lesson> lessons_of(const FamilySamples& family) {
  std::vector<Lesson> lessons;
  for (const FamilyProtocol protocol :
       {FamilyProtocol::AllSamples, FamilyProtocol::Geometries, FamilyProtocol::Fluids})
    for (const FamilyDivision& division : divisions_of(family, protocol))
      lessons.push_back(
          {protocol, runs_of(family, division.training), runs_of(family, division.judged)});
  return lessons;
}

ErrorSums errors_of(const std::string& model, const Lesson& lesson, const FamilySamples& family,
                    const Monitor& monitor) {
  IdentifyOptions options{.offset = OffsetMode::None, .threads = 1, .monitor = {{}, monitor.stop}};
  const FitReport fit = identify(model, lesson.training, family.drive_unit, options);
  ErrorSums sums;
  if (!fit.model) return sums;
  const Evaluation judged = evaluate(*fit.model, lesson.judged, family.drive_unit,
                                     {.offset = OffsetMode::None, .threads = 1});
  for (const RecordResult& record : judged.records) sums.add(record.sums);
  return sums;
}

}  // namespace

std::vector<FamilyModelOutcome> judge_family_models(const FamilySamples& family,
                                                    const FamilyStudyOptions& options) {
  if (options.models.empty() ||
      std::ranges::any_of(family.runs, [](const Record& run) { return !run.find("current"); }))
    return {};

  // Every model on every division, side by side.
  const std::vector<Lesson> lessons = lessons_of(family);
  std::vector<ErrorSums> sums(options.models.size() * lessons.size());
  parallel_for(sums.size(), options.threads, [&](std::size_t k) {
    sums[k] = errors_of(options.models[k / lessons.size()], lessons[k % lessons.size()], family,
                        options.monitor);
  });

  // The divisions of one protocol are judged together.
  std::vector<FamilyModelOutcome> outcomes;
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    FamilyModelOutcome& outcome = outcomes.emplace_back();
    outcome.name = options.models[m];
    for (std::size_t k = 0; k < lessons.size(); ++k) {
      ErrorSums& all = lessons[k].protocol == FamilyProtocol::AllSamples   ? outcome.learnt
                       : lessons[k].protocol == FamilyProtocol::Geometries ? outcome.geometries
                                                                           : outcome.fluids;
      all.add(sums[m * lessons.size() + k]);
    }
  }
  return outcomes;
}

}  // namespace dashpot
