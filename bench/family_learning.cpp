// Prints the table "Would more dampers help?" of docs/family.md.
//
//   bench_family_learning FOLDER [LINE_DRAWS [PHYSICS_DRAWS]]
//
// Of a family's recordings each geometry (gap and pole length) is left out in turn, and a model is
// fitted on the records of some of the others, drawn by chance. If more geometries in the fit bring
// the error on the one left out down to the last, data are what is short; if it has long been flat,
// the model's structure is, or what no drawing tells. Beside it stand the error on the records of
// the fit, and that on those left out were the strength of each damper known. Every third sample,
// which loses nothing in motions as slow as the published ones.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include <fmt/format.h>

#include "dashpot/base/random.h"
#include "dashpot/damper_model.h"
#include "dashpot/dataset.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"
#include "dashpot/split.h"
#include "identify/fit/virtual_family.h"

using namespace dashpot;

namespace {

std::pair<double, double> geometry_of(const Record& record) {
  std::pair<double, double> geometry{};
  for (const auto& [name, value] : record.conditions) {
    if (name == "gap") geometry.first = value;
    if (name == "pole_length") geometry.second = value;
  }
  return geometry;
}

/// Sums over everything that was left out, and over everything that was fitted.
struct Errors {
  ErrorSums own, left_out, strength_known;
};

/// The errors where every damper's force is multiplied by what is best for it.
void add_with_strength(const Evaluation& evaluation, const std::vector<Record>& records,
                       ErrorSums& sums) {
  std::map<std::string, std::pair<double, double>> products;
  const auto visit = [&](const auto& see) {
    for (std::size_t k = 0; k < records.size(); ++k) {
      const RecordResult& r = evaluation.records[k];
      for (std::size_t s = r.warm_up; s < r.measured.size(); ++s)
        see(products[records[k].condition], r.measured[s], r.modelled[s]);
    }
  };
  visit([](auto& product, double measured, double modelled) {
    product.first += measured * modelled;
    product.second += modelled * modelled;
  });
  visit([&](auto& product, double measured, double modelled) {
    sums.add(measured, product.first / product.second * modelled);
  });
}

void add_fold(const std::string& model, const Fold& fold, std::size_t count, Random& random,
              Errors& errors) {
  // So many of the other geometries.
  std::vector<std::pair<double, double>> others;
  for (const Record& record : fold.training)
    if (std::ranges::find(others, geometry_of(record)) == others.end())
      others.push_back(geometry_of(record));
  while (others.size() > count)
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(random.index(others.size())));
  std::vector<Record> training;
  for (const Record& record : fold.training)
    if (std::ranges::find(others, geometry_of(record)) != others.end()) training.push_back(record);

  const EvaluateOptions as_is{.offset = OffsetMode::None};
  const FitReport fit =
      identify(model, training, DriveUnit::Ampere, {.offset = OffsetMode::None, .threads = 1});
  const Evaluation own = evaluate(*fit.model, training, DriveUnit::Ampere, as_is),
                   left = evaluate(*fit.model, fold.left_out, DriveUnit::Ampere, as_is);
  for (const RecordResult& r : own.records) errors.own.add(r.sums);
  for (const RecordResult& r : left.records) errors.left_out.add(r.sums);
  add_with_strength(left, fold.left_out, errors.strength_known);
}

void print_curve(const std::string& model, const std::vector<Fold>& folds, std::size_t draws) {
  fmt::print(
      "{}, ESR %: geometries in the fit, of its own records, left out (least and most of {} "
      "draws), left out with each damper's strength known\n",
      model, draws);
  for (const std::size_t count : {2u, 4u, 6u, 8u}) {
    Errors all;
    double least = INFINITY, most = 0;
    const std::size_t own_draws = count < folds.size() - 1 ? draws : 1;
    for (std::size_t draw = 0; draw < own_draws; ++draw) {
      Random random(draw + 1);
      Errors errors;
      for (const Fold& fold : folds) add_fold(model, fold, count, random, errors);
      const double esr = metrics(errors.left_out).esr;
      least = std::min(least, esr);
      most = std::max(most, esr);
      all.own.add(errors.own);
      all.left_out.add(errors.left_out);
      all.strength_known.add(errors.strength_known);
    }
    fmt::print("  {:2}  {:6.2f}  {:6.2f} ({:.2f} to {:.2f})  {:6.2f}\n", count,
               metrics(all.own).esr, metrics(all.left_out).esr, least, most,
               metrics(all.strength_known).esr);
    std::fflush(stdout);
  }
}

std::size_t number_or(int argc, char** argv, int place, std::size_t usual) {
  return argc > place ? std::stoul(argv[place]) : usual;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2)
      throw std::runtime_error("usage: bench_family_learning FOLDER [LINE_DRAWS [PHYSICS_DRAWS]]");
    std::vector<Fold> folds =
        split(load_dataset({argv[1]}), parse_leave_out("each=gap,pole_length"));
    for (Fold& fold : folds) {
      fold.training = every_third(std::move(fold.training));
      fold.left_out = every_third(std::move(fold.left_out));
    }
    print_curve("family_line", folds, number_or(argc, argv, 2, 20));
    print_curve("family_physics", folds, number_or(argc, argv, 3, 2));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
