#include "dashpot/damper/kinds/family/line_family.h"

#include <cmath>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/model_file.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

namespace {

FamilyLine example_line() {
  FamilyLine line;
  line.current = 1;
  line.pole_length = 6e-3;
  line.gap = 1e-3;
  line.viscosity = 0.28;
  line.frequency = 2;
  line.centre = 1e-3;
  line.slow = 1e-3;
  line.offset = 0.5;
  line.size = {2, 0.5, -0.1, 0.2, 0.3, -0.4};
  line.phase = {0.3, 0.1, 0, 0, 0, 0};
  return line;
}

FamilyModel line_model(const FamilyLine& line) {
  Family family = family_of(std::make_shared<LineFamily>(line));
  family.name = "family_line";
  family.build_spread = 0;
  return {std::make_shared<Family>(family), example_member()};
}

}  // namespace

TEST_CASE("a family's line turns its force with the motion, in a size that ignores the speed") {
  const FamilyModel model = line_model(example_line());
  for (const double half_stroke : {0.005, 0.02}) {
    std::vector<double> state(model.state_size());
    const auto input_at = [&](double t) {
      return DamperInput{1e-3 + half_stroke * std::sin(2 * t), 2 * half_stroke * std::cos(2 * t),
                         0.5};
    };
    DamperInput now = input_at(0);
    model.rest(now, state);
    double most = 0, least = INFINITY;  // of the amplitude that the motion is told to have
    for (int k = 1; k <= 40000; ++k) {
      const DamperInput next = input_at(1e-3 * k);
      model.advance(now, next, 1e-3, state);
      now = next;
      if (k < 30000) continue;
      const double size = std::abs(model.force(now, state) - 0.5), turned = 0.3 + 0.1 * 0.5;
      most = std::max(most, size);
      const double told = std::cos(2e-3 * k - turned);
      if (std::abs(told) > 0.5) least = std::min(least, size / std::abs(told));
    }
    // At the family's own gap, length and fluid the logarithms are 0.
    CHECK_CLOSE(most, std::exp(2 + 0.25 - 0.025), 0.01, 0);
    CHECK_CLOSE(least, std::exp(2 + 0.25 - 0.025), 0.01, 0);
  }
}

TEST_CASE("a line that has seen one fluid reads the yield stress, and its file says so") {
  FamilyLine line = example_line();
  line.by_current = false;
  line.yield_stress = 5e4;
  line.size = line.phase = {1, 0.5, 0, 0};
  const FamilyModel model = line_model(line);
  ModelFile file;
  file.model = model.with_offset(0);
  const std::string text = format_model(file);
  CHECK(format_model(parse_model(text, "text")) == text);
  CHECK(line.features(example_member(), 0.5)[1] == 3e4 / 5e4);
  line.size.push_back(0);
  CHECK(contains(message_of([&] { LineFamily{line, "here"}; }), "4 for the size"));
}
