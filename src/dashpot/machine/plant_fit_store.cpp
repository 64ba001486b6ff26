#include "dashpot/machine/plant_fit_store.h"

#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "dashpot/base/file.h"
#include "dashpot/base/packed_bytes.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

template <class T>
constexpr bool kIsList = false;
template <class T>
constexpr bool kIsList<std::vector<T>> = true;

// The members of what a report holds, once for both ways: `bytes` takes them, or fills them.

template <class Bytes>
void pass(Bytes& bytes, FittedParameter& p) {
  bytes(p.name, p.unit, p.meaning, p.value, p.low, p.high, p.fixed, p.at_bound, p.weak);
}

template <class Bytes>
void pass(Bytes& bytes, Knowable& k) {
  bytes(k.unknowns, k.singular_values, k.without_effect, k.confounded);
}

template <class Bytes>
void pass(Bytes& bytes, PlantAddition& a) {
  bytes(a.what, a.intervals, a.most, a.of_most);
}

template <class Bytes>
void pass(Bytes& bytes, ParameterProfile& p) {
  bytes(p.name, p.unit, p.value, p.misfit, p.low, p.high);
}

template <class Bytes>
void pass(Bytes& bytes, PlantAdvice& a) {
  bytes(a.grade, a.worst, a.sensors, a.rides, a.profiles);
}

template <class Bytes>
void pass(Bytes& bytes, FoundNoise& n) {
  bytes(n.channel, n.unit, n.deviation, n.zero);
}

template <class Bytes>
void pass(Bytes& bytes, SensorFigures& s) {
  bytes(s.recording, s.channel, s.unit, s.rms, s.training, s.held_back, s.offset);
}

template <class Bytes>
void pass(Bytes& bytes, DamperTrace& d) {
  bytes(d.strut, d.deflection, d.velocity, d.force, d.current);
}

template <class Bytes>
void pass(Bytes& bytes, InPlantTrace& t) {
  bytes(t.recording, t.sample_time, t.first, t.training, t.measured, t.modelled, t.dampers);
}

template <class Bytes>
void pass(Bytes& bytes, Domain& d) {
  bytes(d.displacement_min, d.displacement_max, d.velocity_min, d.velocity_max, d.current_min,
        d.current_max);
}

/// All but the model, which is a text of its own.
template <class Bytes>
void pass(Bytes& bytes, FoundDamper& d) {
  bytes(d.name, d.struts, d.domain);
}

/// By name, so that a new member does not compile until it is dealt with here.
template <class Bytes>
void pass(Bytes& bytes, InPlantReport& report) {
  auto& [status, message, kinds, plant, damper, nuisances, plant_beside_any_force, knowable, advice,
         noise, sensors, traces, warnings, road_measured, force_error, lacks, along, iterations,
         seconds, steps, method, step_error] = report;
  bytes(status, message, kinds, plant, damper, nuisances, plant_beside_any_force, knowable, advice,
        noise, sensors, traces, warnings, road_measured, force_error, lacks, along, iterations,
        seconds, steps, method, step_error);
}

/// Takes members one behind the other.
class Taker {
 public:
  template <class... Members>
  void operator()(Members&... members) {
    (take(members), ...);
  }
  const std::string& bytes() const { return packed_.bytes(); }

 private:
  template <class T>
  void take(T& member) {
    if constexpr (std::is_same_v<T, double>) {
      packed_.add(std::size_t{std::bit_cast<std::uint64_t>(member)});
    } else if constexpr (std::is_scalar_v<T>) {
      packed_.add(static_cast<std::size_t>(member));
    } else if constexpr (std::is_same_v<T, std::string>) {
      packed_.add(std::string_view(member));
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      packed_.add(member);
    } else if constexpr (kIsList<T>) {
      packed_.add(member.size());
      for (auto& one : member) take(one);
    } else {
      pass(*this, member);
    }
  }

  PackedBytes packed_;
};

/// Fills members from what a Taker took. Throws Error where the bytes end before.
class Filler {
 public:
  explicit Filler(std::string_view bytes) : packed_(bytes) {}

  template <class... Members>
  void operator()(Members&... members) {
    (fill(members), ...);
  }

 private:
  template <class T>
  void fill(T& member) {
    if constexpr (std::is_same_v<T, double>) {
      member = std::bit_cast<double>(std::uint64_t{packed_.number()});
    } else if constexpr (std::is_scalar_v<T>) {
      member = static_cast<T>(packed_.number());
    } else if constexpr (std::is_same_v<T, std::string>) {
      member = packed_.text();
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      member = packed_.column();
    } else if constexpr (kIsList<T>) {
      member.clear();
      for (std::size_t left = packed_.number(); left > 0; --left) fill(member.emplace_back());
    } else {
      pass(*this, member);
    }
  }

  UnpackedBytes packed_;
};

/// A model as a file of its own holds it.
std::string model_text(const PlantFitStore::Request& request, const FoundDamper& damper) {
  ModelFile file;
  file.model = damper.model->with_offset(0);
  file.drive_unit = request.setup.drive_unit;
  file.domain = damper.domain;
  return format_model(file);
}

/// Changes with every sample and channel.
std::string fingerprint_of(const PlantRecording& recording) {
  std::string text = recording.name + ' ' + format_exact(recording.sample_time);
  for (const Channel& channel : recording.channels) {
    const auto* samples = reinterpret_cast<const char*>(channel.samples.data());
    text += '\n' + channel.name + ' ' + channel.unit + ' ' +
            sha256({samples, channel.samples.size() * sizeof(double)});
  }
  return sha256(text);
}

/// Every option that changes a fit, likewise by name.
std::string text_of(const InPlantOptions& options) {
  const auto& [choices, network, asymmetric, starts, iterations, seed, threads, steps, grade,
               profiles, monitor] = options;
  (void)threads, (void)monitor;
  std::vector<std::string> parts{std::to_string(iterations), std::to_string(steps), grade,
                                 join(profiles, ",")};
  const IdentifyOptions shared{.choices = choices,
                               .asymmetric = asymmetric,
                               .network = network,
                               .starts = starts,
                               .seed = seed};
  for (const auto& [name, value] : describe_options(shared)) parts.push_back(value);
  return join(parts, "\n");
}

}  // namespace

PlantFitStore::PlantFitStore(const std::filesystem::path& path, std::string program)
    : program_(std::move(program)), store_(path, kFormat) {}

std::string PlantFitStore::key_of(const Request& request) const {
  std::vector<std::string> parts{program_,
                                 request.model,
                                 request.along,
                                 format_json(to_json(request.setup), false),
                                 text_of(request.options),
                                 std::string(name_of(simd_levels().back()))};
  for (const PlantRecording& recording : request.recordings)
    parts.push_back(fingerprint_of(recording));
  for (const std::string& name : {request.model, request.along})
    if (const Law* law = name.empty() ? nullptr : law_inside(name); law && law->text)
      parts.push_back(format_json(law->text->definition()));
  return request.model + ' ' + sha256(join(parts, "\n"));
}

std::optional<InPlantReport> PlantFitStore::load(const Request& request) const {
  const std::string key = key_of(request);
  const std::optional<std::string> bytes = store_.load(key);
  if (!bytes) return std::nullopt;

  // A damaged fit is as good as none: the caller makes it again and saves it in this one's place.
  try {
    InPlantReport report;
    std::vector<std::string> models;
    Filler filler(*bytes);
    filler(models, report);
    for (std::size_t kind = 0; kind < report.kinds.size(); ++kind)
      report.kinds[kind].model = parse_model(models.at(kind), key).model;
    return report;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void PlantFitStore::save(const Request& request, const InPlantReport& report) {
  if (!report.has_models()) return;
  std::vector<std::string> models;
  for (const FoundDamper& damper : report.kinds) models.push_back(model_text(request, damper));
  InPlantReport kept = report;
  Taker taker;
  taker(models, kept);
  store_.save(key_of(request), taker.bytes());
}

}  // namespace dashpot
