#include "dashpot/record/build_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "dashpot/base/escape.h"
#include "dashpot/base/sensor_unit.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/differentiate.h"
#include "dashpot/record/inertia.h"
#include "dashpot/record/integrate.h"
#include "dashpot/record/joint_velocity.h"
#include "dashpot/record/side_passes.h"
#include "dashpot/record/time_base.h"
#include "dashpot/record/unit_doubts.h"

namespace dashpot {
namespace {

std::string label(const RawColumn& column, std::size_t index) {
  return column.name.empty() ? "column " + std::to_string(index + 1) : column.name;
}

const ColumnUse* find_use(const ColumnUses& uses, std::string_view channel) {
  for (const ColumnUse& use : uses.used)
    if (use.channel == channel) return &use;
  return nullptr;
}

/// Whether columns without a force are what sensors of a plant show: some count accelerations.
bool is_of_plant(const RawTable& table) {
  const Dimension acceleration = parse_sensor_unit("m/s^2")->dimension;
  return std::ranges::any_of(table.columns, [&](const RawColumn& column) {
    const auto parts = parts_by_brackets(column.name);
    const auto unit = parse_sensor_unit(parts ? parts->unit : column.unit);
    return unit && unit->dimension == acceleration;
  });
}

/// Empty when the table is a recording of a damper, that is when it has a motion and a force; else
/// why not, and what to state in a dataset file, which arrays (`as_given`) do not have.
std::string refusal(const RawTable& table, const ColumnUses& uses, bool as_given) {
  constexpr std::size_t kToldColumns = 3;
  const bool motion = find_use(uses, "displacement") || find_use(uses, "velocity");
  const bool force = find_use(uses, "force");
  if (motion && force) return {};

  // A current that was logged by itself, and not beside columns whose unit was refused.
  const bool alone = std::ranges::none_of(uses.unused, [](const auto& unused) {
    return unused.second.find("unit") != std::string::npos;
  });
  if (!motion && !force && alone)
    for (const char* drive : {"current", "voltage"})
      if (const ColumnUse* use = find_use(uses, drive))
        return "it holds a " + use->channel + " ('" +
               label(table.columns[use->column], use->column) +
               "') with neither motion nor force, and two files are not joined: state its level in "
               "the name of the file with the motion (run_0.5A.csv) or in manifest.csv, or put the "
               "column into that file";

  const std::string missing = !motion && !force ? "displacement (or velocity) and force"
                              : motion          ? "force"
                                                : "displacement (or velocity)";
  const std::string how = as_given ? "names tell channel and unit: 'force [N]', 'x [mm]'"
                          : table.named()
                              ? "state in a dataset file which columns they are: 'channels: "
                                "{displacement: {column: NAME, unit: mm}, force: {column: NAME, "
                                "unit: N}}'"
                              : "no line names the columns: state them by number in a "
                                "dataset file: 'channels: {displacement: {column: 1, unit: mm}, "
                                "force: {column: 2, unit: N}}'";
  // Familiar names that were refused tell more than the list of all names.
  const auto is_told = [](const std::string& why) {
    return std::ranges::any_of(
        std::array{"unit", "may be", "not a measurement"},
        [&](const char* word) { return why.find(word) != std::string::npos; });
  };
  std::string refused;
  std::size_t told = 0;
  for (const auto& [column, why] : uses.unused)
    if (is_told(why) && told++ < kToldColumns)
      refused += ", '" + label(table.columns[column], column) + "' " + why;
  return "no column is " + missing + " by its name (it has " + table.column_list() + refused +
         "); " +
         (!force && !as_given && is_of_plant(table) ? "where it was recorded in a car, a building "
                                                      "or a rig, 'dashpot identify --in PLANT' "
                                                      "finds the damper there; else "
                                                    : "") +
         how;
}

void require_numbers(const RawTable& table, const ColumnUse& use, bool as_given) {
  const RawColumn& column = table.columns[use.column];
  if (!column.bad) return;
  const std::string what = use.channel + " (" + label(column, use.column) + ") is ";

  // A number with the other sign: nobody knows whether it stands before decimals.
  for (const auto& [sign, usual] : {std::pair{'.', ','}, {',', '.'}})
    if (column.bad->text.find(sign) != std::string::npos && parse_number(column.bad->text, sign))
      throw Error(table.where(column.bad->row),
                  what + "'" + column.bad->text + "', and the file's decimal sign is '" + usual +
                      "': in thousands, or with decimals",
                  "write all numbers with one decimal sign and nothing between thousands");
  throw Error(table.where(column.bad->row),
              what + (column.bad->text.empty() ? "empty"
                                               : "'" + column.bad->text + "', not a finite number"),
              as_given ? "leave that sample out"
                       : "write it as 12.5, or leave such rows out: dataset.yaml beside the "
                         "recordings, 'files: [{match: \"" +
                             std::filesystem::path(table.file).filename().string() +
                             "\", on_bad_row: drop}]'");
}

/// "Ts" of "test.Ts": what stands in a structure is known by its own name.
std::string_view last_part(std::string_view name) {
  return name.substr(name.rfind('.') + 1);  // npos + 1 is 0
}

/// Throws Error at a step without a unit that is no second of any test: a logger's ms, most likely.
void require_plausible_step(double step, const std::string& what, const std::string& file,
                            const std::string& right) {
  if (step < kLongestBetweenSamples) return;
  throw Error(
      file, what + " of " + format_number(step, 3) + ", which are no seconds in a test of a damper",
      right);
}

/// A single number beside the columns whose name says that it is a sample time or a rate.
struct ScalarStep {
  std::string name;
  bool is_rate = false;
  double seconds = 0;
};
std::optional<ScalarStep> step_of_scalars(const RawTable& table) {
  for (const auto& [name, value] : table.scalars) {
    const std::string word = lower(last_part(name));
    const bool step = word == "ts" || word == "dt" || word == "sample_time" || word == "sampletime";
    const bool rate = word == "fs" || word == "sample_rate" || word == "samplerate";
    if ((step || rate) && value > 0 && std::isfinite(value))
      return ScalarStep{name, rate, rate ? 1 / value : value};
  }
  return std::nullopt;
}

/// The same of a time column whose unit is assumed.
void require_plausible_stamps(const std::vector<double>& stamps, const RawTable& table,
                              const ColumnUse& use) {
  if (use.basis.find("assumed SI") == std::string::npos || stamps.size() < 2) return;
  const std::string name = label(table.columns[use.column], use.column);
  const double step = (stamps.back() - stamps.front()) / static_cast<double>(stamps.size() - 1);
  const std::string unit(likelier_time_unit(step));
  require_plausible_step(step, "time (" + name + ") has no unit and steps", table.file,
                         "name it " + name + "_" + unit +
                             ", or state its unit in a dataset file: 'time: {column: " +
                             yaml_string(name) + ", unit: " + unit + "}'");
}

/// Whether stamps, `factor` s their unit, agree with a sample time: their median step does, or the
/// mean where they are printed to few digits.
bool agree_with(std::span<const double> stamps, double factor, double step) {
  constexpr double kAlike = 0.01;
  const double mean = (stamps.back() - stamps.front()) / static_cast<double>(stamps.size() - 1);
  return std::abs(factor * usual_step(stamps) / step - 1) < kAlike ||
         std::abs(factor * mean / step - 1) < kAlike;
}

/// What a time column that does not count says against the sample time that does; "" where there
/// is none, or where it agrees.
std::string contradicting_stamps(const RawTable& table, const ColumnUses& uses, double step) {
  for (const auto& [index, why] : uses.unused) {
    const RawColumn& column = table.columns[index];
    const NamedChannel named = recognise_channel(column.name, column.unit);
    const auto unit = parse_unit(named.unit.empty() ? "s" : named.unit);
    if (named.channel != "time" || !unit || column.bad || column.values.size() < 3) continue;
    const double stamped = unit->factor * usual_step(column.values);
    if (stamped > 0 && !agree_with(column.values, unit->factor, step))
      return "samples are taken as " + format_number(step) + " s apart, not as " +
             format_number(stamped) + " s, which the column '" + label(column, index) + "' says";
  }
  return {};
}

/// Takes the time column or makes the time stamps. Returns in words how time was understood. A
/// stated sample time goes before a time column, a time column before the file's own interval.
std::string set_time(Record& record, RawTable& table, const ColumnUses& uses,
                     const BuildContext& context) {
  std::string basis = "stated";
  std::optional<double> step = context.statement->sample_time;

  // A time column: keep its stamps where they are not uniform, else put them on the uniform grid
  // that its printed digits round.
  if (const ColumnUse* use = find_use(uses, "time"); use && !step) {
    record.time = std::move(table.columns[use->column].values);
    require_increasing(record.time, table);
    require_plausible_stamps(record.time, table, *use);
    record.sample_time = uniform_step(record.time) * use->factor;
    for (double& stamp : record.time) stamp = use->factor * (stamp - use->raw_offset);
    const auto beside = step_of_scalars(table);
    if (beside && record.size() > 2 && !agree_with(record.time, 1, beside->seconds))
      record.notes.push_back("samples are taken as " + format_number(usual_step(record.time)) +
                             " s apart, as the column '" +
                             label(table.columns[use->column], use->column) +
                             "' says; the number '" + beside->name + "' means " +
                             format_number(beside->seconds) + " s");
    if (!(record.sample_time > 0)) return "not uniform: kept as it is";
    make_uniform(record.time, record.time[0], record.sample_time);
    return "uniform within the printed digits";
  }

  // No time column: the sample time that the format states, then one beside the columns.
  if (!step && (step = table.sample_time)) {
    basis = "row times the file's sampling interval";
    require_plausible_step(*step, "the file states steps", table.file,
                           "state the rate in a dataset file: 'time: {sample_rate: 1000}'");
  }
  if (const auto beside = step_of_scalars(table); !step && beside) {
    step = beside->seconds;
    basis = (beside->is_rate ? "row divided by " : "row times ") + beside->name;
    require_plausible_step(*step, beside->name + " has no unit and means steps", table.file,
                           "state the rate in a dataset file: 'time: {sample_rate: 1000}'");
  }
  if (!step)
    throw Error(table.file, "no column is time by its name (it has " + table.column_list() + ")",
                context.as_given ? "give a sample_time in s, or name a column 'time [s]'"
                                 : "state in a dataset file 'time: {sample_rate: 1000}' or 'time: "
                                   "{column: NAME, unit: s}'");

  if (std::string other = contradicting_stamps(table, uses, *step); !other.empty())
    record.notes.push_back(std::move(other));
  record.sample_time = *step;
  record.time.resize(table.rows());
  make_uniform(record.time, 0, *step);
  return basis;
}

/// Refuses numbers that no damper has: their squares and products would leave the range of a
/// double.
void require_scale(const Channel& channel, const RawTable& table, const ColumnUse& use) {
  constexpr double kLargest = 1e30, kSmallest = 1e-30;
  double largest = 0;
  for (const double value : channel.samples) largest = std::max(largest, std::abs(value));
  const bool measured =
      channel.name == "force" || channel.name == "displacement" || channel.name == "velocity";
  if (largest <= kLargest && (largest == 0 || largest >= kSmallest || !measured)) return;

  throw Error(table.file,
              channel.name + " (" + label(table.columns[use.column], use.column) + ") reaches " +
                  format_number(largest) + " " + channel.unit + ", which no test gives",
              "state its unit or scale in a dataset file: 'channels: {" + channel.name +
                  ": {column: NAME, unit: UNIT}}'");
}

/// Moves the used columns into channels, in SI and in Dashpot's signs.
void take_channels(Record& record, RawTable& table, const ColumnUses& uses) {
  for (const ColumnUse& use : uses.used) {
    if (use.channel == "time") continue;
    RawColumn& column = table.columns[use.column];
    Channel channel{use.channel, use.si_unit, std::move(column.values),
                    "column " + label(column, use.column)};
    if (use.unit != use.si_unit) channel.origin += ", " + use.unit + " -> " + use.si_unit;
    if (use.factor < 0) channel.origin += ", sign flipped";

    for (double& value : channel.samples) value = use.factor * (value - use.raw_offset);
    require_scale(channel, table, use);
    record.channels.push_back(std::move(channel));
  }
}

const Channel& motion_channel(const Record& record) {
  const Channel* displacement = record.find("displacement");
  return displacement ? *displacement : record.channel("velocity");
}

/// Applies the stated cuts, first by time, then by rest at both ends of the motion.
void cut(Record& record, const FileStatement& statement) {
  const double from = statement.cut_from.value_or(record.time.front());
  const double to = statement.cut_to.value_or(record.time.back());
  auto first = static_cast<std::size_t>(
      std::lower_bound(record.time.begin(), record.time.end(), from) - record.time.begin());
  auto last = static_cast<std::size_t>(
      std::upper_bound(record.time.begin(), record.time.end(), to) - record.time.begin());

  if (last < first + 2)
    throw Error(
        record.name,
        "the cut from " + format_number(from) + " s to " + format_number(to) + " s leaves nothing",
        "the record runs from " + format_number(record.time.front()) + " s to " +
            format_number(record.time.back()) + " s");

  // Rest is looked for within what the times leave.
  if (statement.cut_rest) {
    const std::size_t n = last - first;
    const auto [begin, end] =
        moving_part(std::span(record.time).subspan(first, n),
                    std::span(motion_channel(record).samples).subspan(first, n));
    last = first + end;
    first += begin;
  }

  if (first == 0 && last == record.size()) return;
  const std::string note =
      "cut to " + format_number(record.time[first], 6) + "..." +
      format_number(record.time[last - 1], 6) + " s" +
      (statement.cut_rest ? ", without the rest before and after the motion" : ", as stated");
  record.keep(first, last);
  record.notes.push_back(note);
}

using Records = std::vector<BuiltRecord>;

/// Mean of a channel over all stretches of a recording, which have one sensor and one zero.
double shared_mean(const Records& stretches, std::string_view channel) {
  double sum = 0, count = 0;
  for (const BuiltRecord& built : stretches) {
    const std::vector<double>& samples = built.record.channel(channel).samples;
    sum = std::accumulate(samples.begin(), samples.end(), sum);
    count += static_cast<double>(samples.size());
  }
  return sum / count;
}

void move_by(Record& record, std::string_view channel, double by) {
  for (double& value : record.find(channel)->samples) value -= by;
}

void centre(Records& stretches, const ColumnUses& uses) {
  for (const ColumnUse& use : uses.used) {
    if (!use.centre || !stretches.front().record.find(use.channel)) continue;
    const double mean = shared_mean(stretches, use.channel);
    for (BuiltRecord& built : stretches) {
      move_by(built.record, use.channel, mean);
      built.record.notes.push_back(use.channel + " centred: mean " + format_number(mean) + " " +
                                   use.si_unit + " subtracted");
    }
  }
}

/// A stroke that is read from one end of the damper lies far from 0, where no law looks for the
/// middle of the motion. Centres one that nobody has placed: its mean is beyond 80 % of its half
/// range, and neither 'offset' nor 'centre' was stated. All stretches of a recording have one
/// middle.
void centre_stroke(Records& stretches, const ColumnUses& uses, bool as_given) {
  constexpr double kFar = 0.8, kMillimetres = 1e3;
  const ColumnUse* use = find_use(uses, "displacement");
  if (!use || use->placed) return;

  // Where the stroke lies, beside its range.
  double least = INFINITY, greatest = -INFINITY;
  for (const BuiltRecord& built : stretches) {
    const auto [low, high] = std::ranges::minmax(built.record.channel("displacement").samples);
    least = std::min(least, low), greatest = std::max(greatest, high);
  }
  const double mean = shared_mean(stretches, "displacement");
  if (!(std::abs(mean) > kFar * 0.5 * (greatest - least)) || least == greatest) return;

  const std::string stroke = "displacement of " + format_number(kMillimetres * least, 3) + " ... " +
                             format_number(kMillimetres * greatest, 3) +
                             " mm is an absolute stroke";
  for (BuiltRecord& built : stretches) {
    if (as_given) {
      built.record.notes.push_back(stroke + ": laws of displacement expect its middle at 0");
      continue;
    }
    move_by(built.record, "displacement", mean);
    built.centred = mean;
    built.record.notes.push_back(stroke + ": centred, its mean of " +
                                 format_number(kMillimetres * mean, 4) +
                                 " mm subtracted ('centre: none' keeps it, 'offset' places it)");
  }
}

/// Notes displacement and velocity in memory that run opposite ways; of files that is a doubt.
void doubt_directions(Record& record, const ColumnUses& uses) {
  if (!find_use(uses, "displacement") || !find_use(uses, "velocity")) return;
  const std::vector<double>& x = record.channel("displacement").samples;
  const std::vector<double>& v = record.channel("velocity").samples;
  double along = 0, either = 0;
  for (std::size_t k = 1; k < record.size(); ++k) {
    const double part = v[k] * (x[k] - x[k - 1]);
    along += part;
    either += std::abs(part);
  }
  if (along < -0.5 * either)
    record.notes.push_back(
        "displacement falls where velocity is positive: one of the two has the other sign; state "
        "'sign: -1' for it in a dataset file");
}

/// Notes motions with rests between them: several tests in one recording, most likely, which every
/// later room takes as one. A rest stays within 0.5 % of the half range for a second at least; a
/// motion goes through the middle of its range to both sides.
void doubt_one_test(Record& record) {
  constexpr double kRest = 1, kStill = 0.005, kBand = 0.2;  // s, of the half range
  const std::vector<double>& x = motion_channel(record).samples;
  const auto [low, high] = std::ranges::minmax(x);
  const double half = 0.5 * (high - low);
  if (half == 0) return;

  // Each stretch that stays near its first sample is a rest, or a part of a motion.
  std::size_t motions = 0;
  double longest = 0;
  const SidePasses none{0.5 * (high + low), kBand * half};
  SidePasses passes = none;
  const auto end_motion = [&] {
    constexpr std::size_t kCycle = 3;  // to one side, the other and back
    motions += passes.count >= kCycle;
    passes = none;
  };
  for (std::size_t k = 0, end = 0; k < x.size(); k = end) {
    for (end = k + 1; end < x.size() && std::abs(x[end] - x[k]) <= kStill * half;) ++end;
    if (const double rest = record.time[end - 1] - record.time[k]; rest >= kRest) {
      if (motions + passes.count > 0 && end < x.size()) longest = std::max(longest, rest);
      end_motion();
      continue;
    }
    passes.see(x[k]);
  }
  end_motion();

  if (motions > 1)
    record.notes.push_back(
        "the damper rests for up to " + format_number(longest, 2) + " s between " +
        std::to_string(motions) +
        " motions, taken as one record: if these are tests of their own, give each a file, or a "
        "part in 'roles' of a dataset file ('{role: training, from: 0, to: 5}')");
}

/// Derives velocity from displacement where no column gives it. The cut-off is that of the dataset
/// file, else the caller's, else chosen from the motion.
void add_velocity(Record& record, const BuildContext& context) {
  if (record.find("velocity")) return;
  const std::vector<double>& x = record.channel("displacement").samples;
  if (!(record.sample_time > 0)) {
    const LostSamples lost = lost_samples(record.time);
    const std::string rate = format_number(1 / usual_step(record.time), 4);
    throw Error(record.source,
                "velocity cannot be derived: the time stamps are not uniform" +
                    (lost.places > 0 ? ", " + describe(lost) : ""),
                lost.places > 0
                    ? "state in a dataset file 'resample: " + rate +
                          "', which fills the gaps with straight lines, or a velocity column"
                    : "state in a dataset file a velocity column, 'resample: RATE' (Hz), or the "
                      "'sample_rate' when the stamps are wrong");
  }

  double cutoff = context.statement->velocity_cutoff_hz;
  std::string basis = "stated";
  if (!(cutoff > 0) && context.velocity_cutoff_hz > 0)
    cutoff = context.velocity_cutoff_hz, basis = "as asked";
  if (!(cutoff > 0)) basis = "chosen from the motion";

  try {
    Derivative velocity = smooth_derivative(x, record.sample_time, cutoff);
    record.channels.push_back({"velocity", "m/s", std::move(velocity.slope),
                               "derived from displacement, " +
                                   format_number(velocity.cutoff_hz, 3) + " Hz zero-phase (" +
                                   basis + ")"});
  } catch (const Error& error) {
    throw Error(record.source, error.what());
  }
}

/// Takes noise off a velocity that was recorded beside the displacement.
void join_velocity(BuiltRecord& built, const ColumnUses& uses) {
  constexpr double kMillimetres = 1e3;
  Record& record = built.record;
  const ColumnUse* use = find_use(uses, "velocity");
  if (!use || use->keeps_noise || !find_use(uses, "displacement") || record.sample_time <= 0)
    return;
  Channel& velocity = *std::ranges::find(record.channels, "velocity", &Channel::name);
  std::optional<JointVelocity> joint =
      joint_velocity(record.channel("displacement").samples, velocity.samples, record.sample_time);
  if (!joint) return;
  velocity.samples = std::move(joint->velocity);
  velocity.origin += ", its noise of " + format_number(kMillimetres * joint->own_noise, 2) +
                     " mm/s brought to " + format_number(kMillimetres * joint->noise, 2) +
                     " by the displacement";
  for (ColumnReading& reading : built.readings)
    if (reading.channel == "velocity") reading.basis += "; the displacement takes noise off it";
}

/// Integrates displacement from velocity where no column gives it. Where that cannot be done the
/// record stays without one, with a note that says why: many models need none.
void add_displacement(Record& record) {
  if (record.find("displacement")) return;
  const std::string without = "no displacement, and none can be integrated from the velocity: ";
  if (!(record.sample_time > 0)) {
    record.notes.push_back(without +
                           "the time stamps are not uniform ('resample: RATE' in a dataset file)");
    return;
  }
  try {
    IntegratedDisplacement integrated =
        integrate_without_drift(record.channel("velocity").samples, record.sample_time);
    record.channels.push_back({"displacement", "m", std::move(integrated.x),
                               "integrated from velocity, " + describe(integrated)});
  } catch (const Error& error) {
    record.notes.push_back(without + error.what());
  }
}

/// A damper takes energy out. When nobody stated the sign of the force and the recording puts
/// energy in, it was recorded the other way round. A net energy below 20 % of what goes to and fro
/// decides nothing: a spring or noise can make it.
void settle_sign(Records& stretches, const ColumnUses& uses) {
  double energy = 0, throughput = 0;
  for (const BuiltRecord& built : stretches) {
    const Record& record = built.record;
    const std::vector<double>& force = record.channel("force").samples;
    const std::vector<double>& v = record.channel("velocity").samples;
    for (std::size_t k = 1; k < record.size(); ++k) {
      const double part = force[k] * v[k] * (record.time[k] - record.time[k - 1]);
      energy += part;
      throughput += std::abs(part);
    }
  }

  if (energy > -0.2 * throughput || throughput == 0) return;
  for (BuiltRecord& built : stretches) {
    if (find_use(uses, "force")->stated) {
      built.record.notes.push_back(
          "the damper puts energy in, with the force's sign as stated: is it right?");
      continue;
    }
    Channel* force = built.record.find("force");
    for (double& value : force->samples) value = -value;
    force->origin += ", sign flipped";
    built.record.notes.push_back(
        "force sign flipped: as recorded the damper would put energy in (state 'sign: 1' to keep "
        "it)");
  }
}

/// Mean force, N, while the motion turns: gas, and the zero of the load cell.
double force_at_rest(const Record& record) {
  constexpr double kTurning = 0.05;  // of the top speed
  const std::vector<double>& v = record.channel("velocity").samples;
  const std::vector<double>& force = record.channel("force").samples;
  double top = 0, sum = 0, count = 0;
  for (const double speed : v) top = std::max(top, std::abs(speed));
  for (std::size_t k = 0; k < v.size(); ++k)
    if (std::abs(v[k]) <= kTurning * top) sum += force[k], ++count;
  return count > 0 ? sum / count : 0;
}

/// Notes which direction counts as extension where nobody has stated it, since energy tells only
/// that motion and force fit each other: turned round together they fit as well, with rebound and
/// compression exchanged. Gas is the only hint: it pushes outwards.
void note_direction(Record& record, const RawTable& table, const ColumnUses& uses) {
  const ColumnUse* displacement = find_use(uses, "displacement");
  const ColumnUse* motion = displacement ? displacement : find_use(uses, "velocity");
  if (motion->directed) return;

  // The signs that would turn the record round.
  const bool turned = record.channel("force").origin.find("sign flipped") != std::string::npos;
  const std::string other = "state 'sign: -1' for " + motion->channel +
                            " and 'sign: " + (turned ? "1" : "-1") +
                            "' for force in a dataset file";

  record.notes.push_back("extension is taken as the direction in which '" +
                         label(table.columns[motion->column], motion->column) +
                         (displacement ? "' grows" : "' is positive") + "; were it compression, " +
                         other);

  // What speaks for or against it.
  constexpr double kNoticed = 0.05;  // of the force's half span
  const std::vector<double>& force = record.channel("force").samples;
  const auto [low, high] = std::minmax_element(force.begin(), force.end());
  const double at_rest = force_at_rest(record);
  if (std::abs(at_rest) > kNoticed * 0.5 * (*high - *low))
    record.notes.push_back(std::string("the force at rest resists ") +
                           (at_rest < 0 ? "compression" : "extension") + " by " +
                           format_number(std::abs(at_rest), 3) + " N, which speaks " +
                           (at_rest < 0 ? "for" : "against") +
                           " that direction if it is gas, which pushes outwards, and not the load "
                           "cell's zero");
}

/// Takes the inertia between load cell and damper off where that mass is stated; notes what a
/// kilogram of it adds where nobody has and where it would be felt.
void settle_inertia(Record& record, const ColumnUses& uses) {
  if (const double mass = find_use(uses, "force")->moving_mass; mass > 0) {
    if (!take_off_inertia(record, mass))
      throw Error(record.source,
                  "'moving_mass' needs an acceleration, and none can be derived: the time stamps "
                  "are not uniform",
                  "a column of acceleration, or 'resample: RATE' (Hz)");
    return;
  }

  // Most records are so slow that their plain differences tell that it is not felt.
  constexpr double kFelt = 0.02;  // of the force's half span
  const auto [low, high] = std::ranges::minmax_element(record.channel("force").samples);
  const double half_span = 0.5 * (*high - *low);
  if (greatest_acceleration(record) <= kFelt * half_span) return;

  const std::vector<double> acceleration = acceleration_of(record);
  if (acceleration.empty()) return;
  const double usual = usual_acceleration(acceleration);
  if (half_span > 0 && usual > kFelt * half_span)
    record.notes.push_back("each kilogram that moves between load cell and damper adds up to " +
                           format_number(usual, 3) + " N (" +
                           format_number(100 * usual / half_span, 2) +
                           " % of the force's half span); where there is such a mass, "
                           "'moving_mass' of force takes it off");
}

double mean_of(const Channel& channel) {
  return std::accumulate(channel.samples.begin(), channel.samples.end(), 0.0) /
         static_cast<double>(channel.samples.size());
}

/// Whether a recorded drive is not the level that somebody wrote down, sensors and their zeros
/// aside: the zero of a sensor for a few mA is a better one.
bool contradicts(const Channel& drive, double level) {
  constexpr double kZero = 0.05, kZeroShare = 0.5, kShare = 0.1;
  const double zero = level == 0 ? kZero : std::min(kZero, kZeroShare * std::abs(level));
  return std::abs(mean_of(drive) - level) > std::max(zero, kShare * std::abs(level));
}

/// The level that is known from beside the table, after the recorded drive has been heard: a column
/// goes before a name. `note` gets what people should know of it. Throws Error where a name may
/// mean two levels and no column tells.
std::optional<KnownLevel> heard_level(const Record& record, const std::optional<KnownLevel>& level,
                                      std::string& note) {
  if (!level) return std::nullopt;
  const Channel* drive = record.find(drive_channel(level->unit));

  // No column to ask.
  if (!drive) {
    const bool other = record.find("current") || record.find("voltage");
    if (!level->doubt.empty() && !other)
      throw Error(record.source, "the drive is in doubt: " + level->doubt,
                  "state it in dataset.yaml beside the recordings, 'files: [{match: \"" +
                      std::filesystem::path(record.source).filename().string() +
                      "\", level: NUMBER}]', or write the name as run_0.5A");
    if (!level->doubt.empty()) return std::nullopt;
    note = level->note;
    return level;
  }

  if (!level->doubt.empty()) {
    note = "the recorded " + drive->name + " counts, not the name: " + level->doubt;
    return std::nullopt;
  }
  if (!contradicts(*drive, level->value)) return level;
  const std::string differ = "the recorded " + drive->name + " is " +
                             format_number(mean_of(*drive), 3) + " " + drive->unit +
                             " in the mean, the " + level->basis + " says " +
                             format_number(level->value) + " " + drive->unit + ": ";
  note = differ + (level->of_name ? "the column counts"
                                  : "the level is as stated, the samples are the column's");
  return level->of_name ? std::nullopt : level;
}

/// Adds the drive as a channel where it is known from beside the table. A level that only the
/// samples tell is found when all records are there (drive_levels.h).
void add_drive(Record& record, const std::optional<KnownLevel>& known, std::string& note) {
  const std::optional<KnownLevel> level = heard_level(record, known, note);
  if (!note.empty()) record.notes.push_back(note);
  if (!level) return;
  const std::string& name = drive_channel(level->unit);
  record.drive_level = level->value;
  if (!record.find(name))
    record.channels.push_back({name, to_string(level->unit),
                               std::vector<double>(record.size(), level->value),
                               "constant, from " + level->basis});
}

/// One row for each column of the file: how it was used, or why not.
std::vector<ColumnReading> readings_of(const RawTable& table, const ColumnUses& uses,
                                       const std::string& time_basis) {
  std::vector<ColumnReading> readings;
  for (const ColumnUse& use : uses.used) {
    ColumnReading reading{table.file,  label(table.columns[use.column], use.column),
                          use.channel, use.unit,
                          use.factor,  use.raw_offset,
                          use.basis};
    if (use.channel == "time") reading.basis += "; " + time_basis;
    if (use.centre) reading.basis += "; mean of the record subtracted";
    readings.push_back(std::move(reading));
  }

  if (!find_use(uses, "time"))
    readings.push_back({table.file, "(row)", "time", "s", 1, 0, time_basis});
  for (const auto& [column, why] : uses.unused)
    readings.push_back({table.file, label(table.columns[column], column), "", "", 1, 0, why});
  return readings;
}

/// Name, conditions, time and channels of one table, cut and resampled as stated. Takes its
/// columns.
void take_table(BuiltRecord& built, RawTable& table, const ColumnUses& uses,
                const BuildContext& context) {
  for (const ColumnUse& use : uses.used) require_numbers(table, use, context.as_given);
  if (table.rows() < 2)
    throw Error(table.file, "has " + counted(table.rows(), "sample"),
                "a recording has at least 2, and hundreds to be of use");

  // Name and conditions: those of the file, then those of the dataset file.
  Record& record = built.record;
  record.name = context.name;
  record.source = table.place();
  record.conditions = table.conditions;
  record.conditions.insert(record.conditions.end(), context.statement->conditions.begin(),
                           context.statement->conditions.end());
  record.notes = table.notes;

  // Time and channels, which take over the columns' memory; unused columns give theirs back.
  built.readings = readings_of(table, uses, set_time(record, table, uses, context));
  for (const auto& [column, why] : uses.unused)
    std::vector<double>().swap(table.columns[column].values);
  take_channels(record, table, uses);

  // Cut before anything that depends on what is left: resampling, means, the filter's cut-off.
  cut(record, *context.statement);
  if (context.statement->resample_hz) resample(record, *context.statement->resample_hz);
}

}  // namespace

std::optional<KnownLevel> level_of_scalars(const RawTable& table) {
  std::optional<KnownLevel> found;
  for (const auto& [name, value] : table.scalars) {
    const NamedChannel named = recognise_channel(name, "");
    const bool is_drive = named.channel == "current" || named.channel == "voltage";
    const bool is_clear = !named.unit.empty() || last_part(name).size() > 1;
    if (!is_drive || !is_clear || !named.problem.empty() || !std::isfinite(value)) continue;

    const Unit unit = named.unit.empty() ? Unit{} : require_unit(named.unit, table.file);
    const KnownLevel level{.value = unit.factor * value + unit.offset,
                           .unit = named.channel == "current" ? DriveUnit::Ampere : DriveUnit::Volt,
                           .basis = "single number '" + name + "'",
                           .of_name = true,
                           .doubt = {},
                           .note = {}};
    if (!found)
      found = level;
    else if (found->value != level.value || found->unit != level.unit)
      found->doubt = "the " + found->basis + " and the " + level.basis + " may be it";
  }
  return found;
}

std::vector<BuiltRecord> build_records(std::vector<RawTable> stretches,
                                       std::span<const BuildContext> contexts) {
  // Understand the columns, and refuse what is no recording before looking at its numbers.
  std::vector<BuiltRecord> all(stretches.size());
  const BuildContext& shared = contexts.front();
  const ColumnUses uses =
      understand_columns(stretches.front(), *shared.statement, shared.stated_in);
  all.front().refusal = refusal(stretches.front(), uses, shared.as_given);
  if (!all.front().refusal.empty()) return all;

  // What each stretch holds by itself.
  for (std::size_t k = 0; k < stretches.size(); ++k)
    take_table(all[k], stretches[k], uses, contexts[k]);

  // One sensor has one zero and one sign, whatever gaps time has.
  centre(all, uses);
  centre_stroke(all, uses, shared.as_given);
  for (BuiltRecord& built : all) {
    if (shared.as_given) doubt_directions(built.record, uses);
    doubt_one_test(built.record);
    if (!shared.as_given) join_velocity(built, uses);
    add_velocity(built.record, shared);
    if (!shared.as_given) add_displacement(built.record);
  }
  settle_sign(all, uses);

  for (std::size_t k = 0; k < stretches.size(); ++k) {
    Record& record = all[k].record;
    settle_inertia(record, uses);
    if (!shared.as_given) note_direction(record, stretches[k], uses);
    add_drive(record, contexts[k].level, all[k].drive_note);
  }
  return all;
}

}  // namespace dashpot
