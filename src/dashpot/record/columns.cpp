#include "dashpot/record/columns.h"

#include <algorithm>
#include <set>

#include "dashpot/base/escape.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"

namespace dashpot {
namespace {

std::string column_name(const RawTable& table, std::size_t column) {
  const std::string& name = table.columns[column].name;
  return name.empty() ? "column " + std::to_string(column + 1) : name;
}

/// The unit in brackets behind a column's name, where it counts what the channel is; else empty.
std::string unit_behind(std::string_view name, std::string_view channel) {
  const auto parts = parts_by_brackets(name);
  const auto si = parse_unit(std::string(si_unit(channel)));
  return parts && si && parse_unit(parts->unit)->dimension == si->dimension ? parts->unit : "";
}

/// Index of the column that a statement means, by number or by name, where one alone has it also
/// without its unit. Throws Error when it is missing.
std::size_t find_column(const RawTable& table, const ChannelStatement& statement) {
  if (statement.index > table.columns.size())
    throw Error(table.file, "has no column " + std::to_string(statement.index),
                "it has " + table.column_list());
  if (statement.index > 0) return statement.index - 1;

  const auto called = [&](const RawColumn& column) { return column.name == statement.column; };
  const auto called_so = [&](const RawColumn& column) {
    const auto parts = parts_by_brackets(column.name);
    return parts && parts->name == statement.column;
  };
  auto found = std::ranges::find_if(table.columns, called);
  if (found == table.columns.end() && std::ranges::count_if(table.columns, called_so) == 1)
    found = std::ranges::find_if(table.columns, called_so);
  if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
  if (!table.named())
    throw Error(table.file, "no line names its columns, so there is no '" + statement.column + "'",
                "state the column's number in the dataset file, as in 'column: 2'");
  throw Error(table.file,
              "has no column '" + statement.column + "' for " + statement.channel + " (stated at " +
                  statement.where + ")",
              "it has " + table.column_list());
}

/// Fills in how raw numbers become SI: sample = sign * scale * (raw - offset), then the unit's own
/// factor and offset, written as one factor and one offset.
void set_unit(ColumnUse& use, const std::string& unit_text, const ChannelStatement& statement) {
  const std::string_view si = si_unit(use.channel);
  use.unit = unit_text.empty() ? std::string(si) : unit_text;
  use.si_unit = si.empty() ? use.unit : std::string(si);

  const Unit unit = use.unit.empty() ? Unit{} : require_unit(use.unit, statement.where);
  // A channel without a standard unit keeps the unit of its file.
  const double to_si = si.empty() ? 1 : unit.factor, shift = si.empty() ? 0 : unit.offset;
  use.factor = statement.sign * statement.scale * to_si;
  use.raw_offset = statement.offset - shift / use.factor;
  use.centre = statement.centre;
  use.placed = statement.placed;
  use.directed = statement.directed;
  use.moving_mass = statement.moving_mass;
  use.keeps_noise = statement.keeps_noise;
}

/// A column whose name says that it counts something else than the channel that it is stated to be:
/// volts for amperes.
void refuse_other_quantity(const RawColumn& column, const NamedChannel& named,
                           const ChannelStatement& statement) {
  const auto own = parse_unit(named.unit),
             right = parse_unit(std::string(si_unit(statement.channel)));
  if (named.unit.empty() || !own || !right || own->dimension == right->dimension) return;
  throw Error(statement.where,
              "column '" + column.name + "' counts " + named.unit + " by its name, and " +
                  statement.channel + " is in " + std::string(si_unit(statement.channel)),
              "'" + named.channel + ": {column: " + yaml_string(column.name) +
                  "}', or state its unit: '" + statement.channel +
                  ": {column: " + yaml_string(column.name) + ", unit: UNIT}'");
}

ColumnUse use_stated(const RawTable& table, const ChannelStatement& statement,
                     const std::string& stated_in) {
  ColumnUse use;
  use.column = find_column(table, statement);
  use.channel = statement.channel;
  use.stated = true;
  use.basis = "stated in " + stated_in;

  // The unit: as stated, else as the file gives it, else SI, which the readings then say.
  std::string unit = statement.unit;
  if (unit.empty()) {
    const RawColumn& column = table.columns[use.column];
    const NamedChannel named = recognise_channel(column.name, column.unit);
    unit = !column.unit.empty()           ? column.unit
           : named.channel == use.channel ? named.unit
                                          : unit_behind(column.name, use.channel);
    if (column.unit.empty() && named.channel == use.channel && !named.problem.empty())
      throw Error(statement.where, "column '" + column.name + "' has " + named.problem,
                  "state its unit: '" + use.channel + ": {column: " + yaml_string(column.name) +
                      ", unit: UNIT}'");
    if (unit.empty()) refuse_other_quantity(column, named, statement);
    use.basis += unit.empty() ? ", assumed SI: no unit given" : ", unit from the file";
  }
  set_unit(use, unit, statement);
  return use;
}

/// A column that claims a channel by its name.
struct Claim {
  std::size_t column;
  NamedChannel named;
};

bool same_values(const RawColumn& a, const RawColumn& b) {
  return !a.bad && !b.bad && a.values == b.values;
}

/// The one of several claims that counts: the only plain name, or any when all hold the same
/// values; nullptr when that does not decide.
const Claim* choose(const std::vector<Claim>& claims, const RawTable& table) {
  const Claim* plain = nullptr;
  std::size_t plain_names = 0;
  for (const Claim& claim : claims)
    if (claim.named.plain && plain_names++ == 0) plain = &claim;
  if (claims.size() == 1) return &claims.front();
  if (plain_names == 1) return plain;

  const bool same = std::all_of(claims.begin(), claims.end(), [&](const Claim& claim) {
    return same_values(table.columns[claim.column], table.columns[claims.front().column]);
  });
  return same ? &claims.front() : nullptr;
}

[[noreturn]] void refuse_two(const std::vector<Claim>& claims, const RawTable& table) {
  const std::string& channel = claims.front().named.channel;
  // Columns of one name are told apart by their numbers.
  const std::string name = column_name(table, claims[0].column);
  const bool is_same = name == column_name(table, claims[1].column);
  const std::string first =
      "{column: " + (is_same ? std::to_string(claims[0].column + 1) : yaml_string(name)) + "}";
  throw Error(
      table.file,
      "columns '" + column_name(table, claims[0].column) + "' and '" +
          column_name(table, claims[1].column) + "' are both " + channel + " by their names",
      "state which in a dataset file, as in '" +
          (channel == "time" ? "time: " + first : "channels: {" + channel + ": " + first + "}") +
          "'");
}

/// Uses the chosen column of a channel; notes the others as unused.
void use_claims(const std::vector<Claim>& claims, const RawTable& table, ColumnUses& out) {
  const Claim* chosen = choose(claims, table);
  if (!chosen) refuse_two(claims, table);
  for (const Claim& claim : claims)
    if (&claim != chosen)
      out.unused.emplace_back(claim.column, "not used: '" + column_name(table, chosen->column) +
                                                "' is the " + claim.named.channel);

  if (!chosen->named.problem.empty())
    throw Error(
        table.where(0),
        "column '" + column_name(table, chosen->column) + "' has " + chosen->named.problem,
        "correct the header, or state it in a dataset file: 'channels: {" + chosen->named.channel +
            ": {column: " + yaml_string(column_name(table, chosen->column)) + ", unit: UNIT}}'");

  ColumnUse use;
  use.column = chosen->column;
  use.channel = chosen->named.channel;
  use.basis = chosen->named.unit.empty() ? "header; assumed SI: no unit given" : "header";
  ChannelStatement plain;
  plain.where = table.where(0);
  set_unit(use, chosen->named.unit, plain);
  out.used.push_back(std::move(use));
}

}  // namespace

ColumnUses understand_columns(const RawTable& table, const FileStatement& statement,
                              const std::string& stated_in) {
  ColumnUses out;
  std::set<std::size_t> taken;
  std::set<std::string> stated;

  // Statements first: a column that is stated is not looked at again.
  for (const ChannelStatement& channel : statement.channels) {
    out.used.push_back(use_stated(table, channel, stated_in));
    taken.insert(out.used.back().column);
    if (!stated.insert(channel.channel).second)
      throw Error(channel.where, channel.channel + " is stated twice");
  }

  // The rest speak by their names, unless the dataset file says that only stated columns count.
  // Group what they claim by channel.
  std::vector<std::vector<Claim>> claims;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    if (taken.count(k)) continue;
    const NamedChannel named = recognise_channel(table.columns[k].name, table.columns[k].unit);
    const bool wanted = !stated.count(named.channel) &&
                        (!statement.only_stated || named.channel == "time") &&
                        !(named.channel == "time" && (statement.sample_time || table.sample_time));
    if (named.channel.empty() || !wanted) {
      out.unused.emplace_back(
          k, "not used: " + (!named.problem.empty()   ? named.problem
                             : !named.channel.empty() ? "stated otherwise, or given by the format"
                                                      : "name not known"));
      continue;
    }

    auto same = std::find_if(claims.begin(), claims.end(), [&](const auto& c) {
      return c.front().named.channel == named.channel;
    });
    if (same == claims.end()) same = claims.insert(claims.end(), std::vector<Claim>{});
    same->push_back({k, named});
  }

  // One of those that claim the same channel is used, or the file is refused.
  for (const auto& group : claims) use_claims(group, table, out);
  return out;
}

}  // namespace dashpot
