#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/line_family.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::string_view kMark = "mark", kRefuse = "refuse";

Value range_json(const Family::Range& range, std::string_view unit) {
  return Value::object({{"min", range.min}, {"max", range.max}, {"unit", unit}});
}

Value domain_json(const Family& family) {
  Value out = Value::object();
  for (const Family::Range& range : family.domain)
    for (const MemberField& field : member_fields())
      if (field.field == range.field)
        out.add(std::string(field.name), range_json(range, field.unit));
  if (family.yield) out.add(std::string(kYieldStress), range_json(*family.yield, "Pa"));
  return out;
}

Family::Range read_range(const Value& value, const std::string& name, std::string_view unit) {
  ObjectReader ends(value, "the domain of " + name);
  const Family::Range range{nullptr, ends.number("min"), ends.number("max")};
  if (const std::string stated = ends.string("unit"); stated != unit)
    throw Error(value.where(), "unit is '" + stated + "'", "write " + std::string(unit));
  ends.finish();
  if (!(range.min <= range.max)) throw Error(value.where(), "min is above max");
  return range;
}

void read_domain(const Value& value, Family& family) {
  ObjectReader reader(value, "the domain of a family");
  for (const MemberField& field : member_fields()) {
    if (!field.required) continue;
    family.domain.push_back(
        read_range(reader.required(field.name), std::string(field.name), field.unit));
    family.domain.back().field = field.field;
  }
  if (const Value* yield = reader.optional(kYieldStress))
    family.yield = read_range(*yield, std::string(kYieldStress), "Pa");
  reader.finish();
}

std::unique_ptr<FamilyForce> read_network(const Value& value, ObjectReader& reader) {
  std::vector<std::string> inputs;
  for (const Value& item : reader.required("inputs").items()) inputs.push_back(item.as_string());
  std::vector<Mlp> members;
  for (const Value& item : reader.required("members").items()) {
    ObjectReader member(item, "a network of a family");
    members.push_back(read_mlp(member));
    member.finish();
  }
  reader.finish();
  return std::make_unique<FamilyNetwork>(std::move(inputs), std::move(members), value.where());
}

FamilyGates::Quantities read_quantities(const Value& value) {
  const std::vector<double> numbers = value.as_numbers();
  FamilyGates::Quantities q{};
  if (numbers.size() != q.size())
    throw Error(value.where(), "has " + std::to_string(numbers.size()) + " numbers",
                "field, fluid, gap, length");
  std::copy(numbers.begin(), numbers.end(), q.begin());
  return q;
}

std::unique_ptr<FamilyForce> read_gates(const Value& value, ObjectReader& reader) {
  FamilyGates gates;
  gates.bank.path_rates = reader.required("path_rates").as_numbers();
  gates.bank.velocity_rates = reader.required("velocity_rates").as_numbers();
  gates.soft_speeds = reader.required("soft_speeds").as_numbers();
  gates.half_current = reader.number("half_current");
  gates.mean = read_quantities(reader.required("mean"));
  gates.scale = read_quantities(reader.required("scale"));
  gates.term_scale = reader.required("term_scale").as_numbers();
  gates.weights = reader.required("weights").as_numbers();
  reader.finish();
  return std::make_unique<GatedFamily>(std::move(gates), value.where());
}

FamilyBaseline read_baseline(const Value& value) {
  ObjectReader reader(value, "the first principles of a family");
  const Value& target = reader.required("target");
  const FamilyBaseline baseline{family_target_named(target.as_string(), target.where()),
                                reader.number("share"), reader.number("onset")};
  reader.finish();
  if (!(baseline.onset > 0)) throw Error(value.where(), "onset is not a positive number");
  return baseline;
}

OutsideFamily read_outside(const Value& value) {
  if (value.as_string() == kMark) return OutsideFamily::Mark;
  if (value.as_string() == kRefuse) return OutsideFamily::Refuse;
  throw Error(value.where(), "unknown '" + value.as_string() + "'", "mark or refuse");
}

}  // namespace

std::unique_ptr<FamilyForce> family_force_from_json(const Value& value) {
  ObjectReader reader(value, "the learned part of a family");
  const Value& kind = reader.required("kind");
  if (kind.as_string() == "network") return read_network(value, reader);
  if (kind.as_string() == "gates") return read_gates(value, reader);
  if (kind.as_string() == kLineFamily) return read_line_family(value, reader);
  if (kind.as_string() == kPhysicsFamily) return read_physics_family(value, reader);
  if (kind.as_string() == "line" || kind.as_string() == "physics")
    throw Error(kind.where(),
                "is a family of an earlier version, which told a motion's speed in another way",
                "fit it again: dashpot identify or rank, with its recordings");
  throw Error(kind.where(), "unknown kind '" + kind.as_string() + "'",
              "network, gates, ellipses or plate_flow");
}

Value FamilyModel::to_json() const {
  const FamilyBaseline& baseline = family_->baseline;
  Value value =
      Value::object({{"name", family_->name},
                     {"member", dashpot::to_json(member_)},
                     {"domain", domain_json(*family_)},
                     {"outside", family_->outside == OutsideFamily::Mark ? kMark : kRefuse},
                     {"build_spread", family_->build_spread},
                     {"baseline", Value::object({{"target", name_of(baseline.target)},
                                                 {"share", baseline.share},
                                                 {"onset", baseline.onset}})},
                     {"force", family_->force->to_json()},
                     {"offset", offset_}});
  if (family_->drawing_spread > 0) value.add("drawing_spread", family_->drawing_spread);
  return value;
}

std::unique_ptr<FamilyModel> family_model_from_json(const Value& value) {
  ObjectReader reader(value, "a model of a family");
  auto family = std::make_shared<Family>();
  family->name = reader.string("name");
  FamilyMember member = read_member(reader.required("member"));
  read_domain(reader.required("domain"), *family);
  family->outside = read_outside(reader.required("outside"));
  family->build_spread = reader.number("build_spread");
  family->drawing_spread = reader.number("drawing_spread", 0);
  family->baseline = read_baseline(reader.required("baseline"));
  family->force = family_force_from_json(reader.required("force"));
  const double offset = reader.number("offset");
  reader.finish();

  if (!(family->build_spread >= 0 && family->drawing_spread >= 0))
    throw Error(value.where(), "a spread is negative", "0 or more");
  return std::make_unique<FamilyModel>(std::move(family), std::move(member), offset);
}

}  // namespace dashpot
