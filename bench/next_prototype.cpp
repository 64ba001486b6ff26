// Prints the table "Which prototype next?" of docs/family.md.
//
//   bench_next_prototype [REPETITIONS]
//
// Virtual families whose truth is known and of other structure than the model (tests/design/
// drawn_family.h): two drawings by chance are recorded; then two are chosen by next_drawings(),
// recorded, the family fitted again, and two more chosen. Beside it stand the same two and others
// by chance, and a grid. Errors are those on 20 drawings that nobody has recorded, built exactly
// as drawn: the root mean square over records of each one's error as a share of its force.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "dashpot/error.h"
#include "design/drawn_family.h"

using namespace dashpot;

namespace {

/// A family's recordings, one drawing after the other.
struct Campaign {
  const DrawnFamily& family;
  Random random;
  std::vector<Record> records = {};
  void record(const DamperDescription& drawing) {
    for (Record& one : recorded_drawing(family, drawing, random)) records.push_back(std::move(one));
  }
};

constexpr std::size_t kWays = 5;
constexpr std::string_view kWayNames[kWays] = {"2 by chance", "6 by chance", "6 of a grid",
                                               "2 by chance, 4 chosen", "10 by chance"};

/// Drawings that nobody has recorded, built exactly.
Campaign judging(const DrawnFamily& family) {
  DrawnFamily exact = family;
  exact.scatter = exact.noise = 0;
  Campaign judged{exact, Random(1)};
  for (const DamperDescription& drawing : random_drawings(drawn_family_request(), 20, 1))
    judged.record(drawing);
  return judged;
}

std::array<double, kWays> errors_of(const DrawnFamily& family, const Campaign& judged,
                                    std::uint64_t seed) {
  const DesignRequest request = drawn_family_request();
  const auto error = [&](const Campaign& campaign) {
    return share_of_force(*fitted_drawings(campaign.records), judged.records);
  };

  // By chance: the first two are those that the choice begins with, too.
  std::array<double, kWays> errors{};
  Campaign chance{family, Random(seed)};
  const std::size_t of_two = 2 * family.tests.size();
  std::shared_ptr<const FamilyModel> fitted;
  for (std::size_t k = 0; k < 10; ++k) {
    chance.record(random_drawings(request, 1, 100 * seed + k).front());
    if (k == 1) {
      fitted = fitted_drawings(chance.records);
      errors[0] = share_of_force(*fitted, judged.records);
    }
    if (k == 5) errors[1] = error(chance);
  }
  errors[4] = error(chance);

  Campaign grid{family, Random(seed)};
  for (const DamperDescription& drawing : grid_drawings(request, 6)) grid.record(drawing);
  errors[2] = error(grid);

  Campaign chosen{family, Random(seed + 1000)};
  chosen.records.assign(chance.records.begin(),
                        chance.records.begin() + static_cast<std::ptrdiff_t>(of_two));
  for (int step = 0; step < 2; ++step) {
    for (const NextDrawing& next :
         next_drawings(request, *fitted, {.count = 2, .tests = family.tests, .seed = seed})
             .drawings)
      chosen.record(next.damper);
    fitted = fitted_drawings(chosen.records);
  }
  errors[3] = share_of_force(*fitted, judged.records);
  return errors;
}

void print_truth(const char* title, const DrawnFamily& family, std::size_t repetitions) {
  std::vector<std::array<double, kWays>> all;
  const Campaign judged = judging(family);
  for (std::size_t k = 0; k < repetitions; ++k) {
    all.push_back(errors_of(family, judged, k + 1));
    fmt::print(stderr, "{}: {} of {}\n", title, k + 1, repetitions);
  }
  fmt::print("{}, {} repetitions: error on drawings that nobody has recorded, % of the force\n",
             title, repetitions);
  for (std::size_t way = 0; way < kWays; ++way) {
    std::vector<double> errors;
    for (const auto& one : all) errors.push_back(100 * one[way]);
    std::ranges::sort(errors);
    const auto at = [&](double share) {
      return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    double mean = 0;
    for (const double one : errors) mean += one / static_cast<double>(errors.size());
    fmt::print("  {:24} mean {:6.2f}  median {:6.2f}  10 to 90 % of them {:6.2f} to {:6.2f}\n",
               kWayNames[way], mean, at(0.5), at(0.1), at(0.9));
  }
  const auto no_worse = [&](std::size_t way) {
    return std::ranges::count_if(all, [&](const auto& one) { return one[3] <= one[way]; });
  };
  fmt::print(
      "  chosen no worse than 10 by chance in {}, than 6 by chance in {}, than a grid in {}\n\n",
      no_worse(4), no_worse(1), no_worse(2));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::size_t repetitions = argc > 1 ? std::stoul(argv[1]) : 20;
    print_truth("Bingham flow, a spring, friction", {.tests = drawn_family_tests()}, repetitions);
    print_truth("Herschel-Bulkley flow, valves that lean by 15 %",
                {.leans = true, .tests = drawn_family_tests()}, repetitions);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
