#include "dashpot/machine/damper_unknowns.h"

#include <algorithm>
#include <set>

#include "dashpot/damper/law_list.h"
#include "support.h"

using namespace dashpot;

namespace {

/// tanh_kwok in two kinds of dampers, over 0 to 2 V.
DamperUnknowns two_kinds() {
  const DataScale scale{.force = 1000, .stroke = 0.02, .speed = 0.3, .drive = {0, 2, false, 3}};
  return {{find_law("tanh_kwok"), scale, DriveUnit::Volt, OffsetMode::Record},
          {.names = {"front", "rear"}, .of = {0, 1}}};
}

}  // namespace

TEST_CASE("damper unknowns: each kind has numbers of its own, under its name") {
  const DamperUnknowns unknowns = two_kinds();
  const std::vector<double> start = unknowns.start();
  REQUIRE(start.size() == unknowns.size());
  const std::size_t each = unknowns.size() / 2;
  const std::vector<double> one(start.begin(), start.begin() + std::ptrdiff_t(each));
  CHECK(unknowns.alike(one) == start);

  // A number of the rear ones leaves the front ones as they are.
  std::vector<double> moved = start;
  moved[each] *= 1.5;
  const std::vector<LawModel> before = unknowns.models(start), behind = unknowns.models(moved);
  REQUIRE(behind.size() == 2);
  const DamperInput input{0.01, 0.2, 1};
  CHECK(behind[0].force(input, {}) == before[0].force(input, {}));
  CHECK(behind[1].force(input, {}) != before[1].force(input, {}));
  const std::vector<double> again = unknowns.of(behind);
  for (std::size_t k = 0; k < again.size(); ++k) CHECK_CLOSE(again[k], moved[k], 1e-9, 1e-12);

  // What is told of them: a name of its own for each, by the unknowns of its kind.
  std::set<std::string> names;
  for (const LawUnknowns::Coefficient& c : unknowns.coefficients(moved)) {
    CHECK(names.insert(c.name).second);
    CHECK((c.name.starts_with("front.") || c.name.starts_with("rear.")));
    if (!c.weights.empty()) CHECK((c.first >= each) == c.name.starts_with("rear."));
  }
}

TEST_CASE("damper unknowns: what acts through one parameter does so in one kind") {
  const DamperUnknowns unknowns = two_kinds();
  const std::vector<double> start = unknowns.start();
  const std::size_t each = unknowns.size() / 2;
  const DamperInput input{0.01, 0.2, 1};
  const std::vector<LawModel> before = unknowns.models(start);

  std::size_t next = 0;
  for (const DamperUnknowns::Group& group : unknowns.groups()) {
    CHECK(group.first == next);  // one group behind the other, over all unknowns
    next += group.count();
    const auto moved = unknowns.moved(start, group, unknowns.step(start, group));
    const std::size_t other = 1 - group.kind;
    CHECK(moved[other].force(input, {}) == before[other].force(input, {}));
  }
  CHECK(next == unknowns.size());

  // So does a start at which a parameter does not follow the drive.
  std::vector<double> follows = start;
  for (std::size_t k = 0; k < follows.size(); ++k) follows[k] *= 1 + 0.01 * static_cast<double>(k);
  const auto flattened = unknowns.flattened(follows);
  CHECK(std::ranges::count_if(flattened, [](const auto& f) { return f.group.kind == 1; }) * 2 ==
        std::ssize(flattened));
  for (const DamperUnknowns::Flattened& flat : flattened)
    for (std::size_t k = 0; k < start.size(); ++k)
      if ((k >= each) != (flat.group.kind == 1)) CHECK(flat.unknowns[k] == follows[k]);
}
