#include "dashpot/suspension/bound/bound.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/error.h"
#include "dashpot/numerics/interval.h"
#include "dashpot/suspension/bound/optimum.h"
#include "dashpot/suspension/bound/relaxation.h"

namespace dashpot {
namespace {

constexpr const char* kStage = "bound what is possible";

class SharePlayer final : public Controller {
 public:
  explicit SharePlayer(std::vector<double> shares) : shares_(std::move(shares)) {}
  std::size_t state_size() const noexcept override { return 1; }
  void reset(std::span<double> state) const noexcept override { state[0] = 0; }
  void step(std::span<const StrutSignals>, std::span<const double>, std::span<double> state,
            std::span<DamperDemand> demands) const noexcept override {
    const auto place = std::min(static_cast<std::size_t>(state[0]), shares_.size() - 1);
    for (DamperDemand& demand : demands) demand = {DamperDemand::Kind::Current, shares_[place]};
    ++state[0];
  }

 private:
  std::vector<double> shares_;
};

/// A few outputs per step: between them the body's acceleration has no jumps.
Trace simulated(const Plant& plant, const GroundMotion& ground, const ForceRange& range,
                const std::vector<double>& shares, const BoundOptions& options) {
  const std::vector<MountedDamper> dampers{mounted(range)};
  const ControllerPointer player = play_shares(shares);
  return simulate({plant, dampers, ground, player.get()}, {.duration = options.duration,
                                                           .output_step = options.step / 4,
                                                           .step = {},
                                                           .sensors = {},
                                                           .limits = {.sample_time = options.step},
                                                           .monitor = {}});
}

double trapezes(const std::vector<double>& time, const std::vector<double>& values, double less) {
  double sum = 0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double a = values[k - 1] - less, b = values[k] - less;
    sum += 0.5 * (a * a + b * b) * (time[k] - time[k - 1]);
  }
  return sum / (time.back() - time.front());
}

/// The cells at the start of a ride in which nothing moves, whatever the damper does; two of the
/// search at least are left after them.
std::size_t standing_cells(const SampledPlant& car, const ForceRange& range,
                           const BoundOptions& options) {
  if (!stands(range)) return 0;
  std::size_t cells = 0;
  while (cells < car.cells() && car.road(cells).height == 0 && car.road(cells).slope == 0) ++cells;
  const auto last = static_cast<std::size_t>(std::ceil(2 * options.search_step / options.step));
  return std::min(cells, car.cells() - std::min(last, car.cells()));
}

/// The best that some courses lead to. The starts begin so many cells before the car does.
Course best_course(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                   const std::vector<std::vector<double>>& starts, std::size_t before) {
  constexpr double kSteady[] = {0, 0.1, 0.3, 1};
  Course best{.value = INFINITY, .shares = {}};
  const auto attempt = [&](std::vector<double> shares) {
    shares.resize(car.cells(), shares.back());
    Course found = improve(car, range, index, {0, std::move(shares)});
    if (found.value < best.value) best = std::move(found);
  };
  for (const double share : kSteady) attempt({share});
  for (const std::vector<double>& start : starts)
    if (start.size() > before)
      attempt({start.begin() + static_cast<std::ptrdiff_t>(before), start.end()});
  return best;
}

/// What the best limits prove. A climb may end at an edge that only its cells have: then those that
/// it passed on its way are tried, which lie further from it, pulled a little towards the limits
/// that stay; and in the end less and less of these.
std::optional<double> certified_best(const Plant& plant, const SampledPlant& car,
                                     const SampledPlant& coarse, const ForceRange& range,
                                     const RideIndex& index, Relaxation relaxed,
                                     const MotionSquares& motion, double size) {
  const auto certified = [&](const LimitCourse& limits, double room) {
    return certified_minimum(plant, car, range, index,
                             on_cells(limits, car.cells(), coarse.step() / car.step()), motion,
                             size, room);
  };

  // The room in the proof is lost in every motion, and one that costs the index nothing may then
  // gain without end. Less room takes more pieces.
  constexpr double kRooms[] = {kUsualRoom, 3e-6, 3e-7};
  constexpr double kMostTimesTheMedian = 30;
  constexpr double kPulls[] = {0.001, 0.002, 0.004, 0.007, 0.012, 0.02}, kLongestPull = 0.03;
  const auto pulled = [&](const LimitCourse& course, double room) {
    const auto by = [&](double pull) {
      return certified(mixed(course, relaxed.constant, pull, 1), room);
    };
    std::optional<double> least = by(0);
    if (least) return least;

    // Where the longest pull leads nowhere, none does.
    const std::optional<double> furthest = by(kLongestPull);
    if (!furthest) return furthest;
    for (const double pull : kPulls)
      if ((least = by(pull))) return least;
    return furthest;
  };
  for (; !relaxed.path.empty(); relaxed.path.pop_back()) {
    // As they are, and with those made smaller that are many times as large as usual: they make the
    // Riccati equation stiff, but others may rely on them.
    const LimitCourse& best = relaxed.path.back();
    LimitCourse tamed = best;
    tame(tamed, kMostTimesTheMedian);
    for (const double room : kRooms)
      for (const LimitCourse* const course : {&best, &std::as_const(tamed)})
        if (const auto least = pulled(*course, room)) return least;
  }

  // Ever less of those that stay.
  constexpr double kLeastPart = 1e-6;
  for (double part = 1; part > kLeastPart && !relaxed.constant.limits.empty(); part /= 10)
    for (const double room : kRooms)
      if (const auto least = certified(mixed(relaxed.constant, relaxed.constant, 1, part), room))
        return least;
  return {};
}

}  // namespace

RideSquares ride_squares(const Trace& trace, const Plant& plant) {
  const Record& record = trace.record;
  const std::string body = plant.coordinates.front().name, tyre = plant.tyres.front().name;
  return {trapezes(record.time, record.channel(body + "_acceleration").samples, 0),
          trapezes(record.time, record.channel(tyre + "_load").samples,
                   plant.tyres.front().static_load)};
}

void StrutMotion::include(const StrutMotion& other) {
  travel = std::max(travel, other.travel);
  speed = std::max(speed, other.speed);
}

StrutMotion strut_motion(const Trace& trace, const Plant& plant) {
  const std::string& strut = plant.struts.front().name;
  const auto greatest = [&](const char* channel) {
    const auto [least, most] = std::ranges::minmax(trace.record.channel(strut + channel).samples);
    return std::max(-least, most);
  };
  return {greatest("_deflection"), greatest("_velocity")};
}

StrutMotion motion_of(const ForceRange& range) {
  return {range.travel, range.ends ? range.velocity.back() : INFINITY};
}

RideIndex weighted_index(double comfort, const RideSquares& reference) {
  return {comfort / reference.acceleration, (1 - comfort) / reference.tyre_force};
}

ControllerPointer play_shares(std::vector<double> shares) {
  if (shares.empty()) throw Error("clairvoyant bound", "there are no demands to play");
  return std::make_unique<SharePlayer>(std::move(shares));
}

ClairvoyantBound clairvoyant_bound(const Plant& plant, const GroundMotion& ground,
                                   const ForceRange& range, const RideIndex& index,
                                   const BoundOptions& options) {
  // The range's spring works beside the plant's own.
  require_quarter_car(plant);
  const Plant sprung = with_spring(plant, range.stiffness);
  const SampledPlant whole(sprung, ground, options.duration, options.step);

  // What stands before the road moves adds nothing, and is left out: limits of that time would have
  // to be without end to say so, as a motion that they let through could make ready for the road.
  const std::size_t standing = standing_cells(whole, range, options);
  const double begin = static_cast<double>(standing) * options.step;
  const SampledPlant car(sprung, ground, options.duration - begin, options.step, begin);
  ClairvoyantBound found{.index = index, .squares = {}, .shares = {}};

  // The optimum: demands that the search finds, simulated.
  const auto report = [&](double share) { options.monitor.report(kStage, share); };
  report(0);
  const Course course = best_course(car, range, index, options.starts, standing);
  found.shares.assign(standing, 0.0);
  found.shares.insert(found.shares.end(), course.shares.begin(), course.shares.end());
  const Trace best = simulated(plant, ground, range, found.shares, options);
  found.squares = ride_squares(best, plant);
  found.optimum = found.squares.of(index);
  found.motion = strut_motion(best, plant);
  const StrutMotion within = motion_of(range);
  found.leaves = found.motion.travel > within.travel || found.motion.speed > within.speed;

  // With nothing to choose there is one motion.
  if (!has_width(range)) {
    found.bound = found.optimum;
    return found;
  }
  if (found.leaves) return found;

  // The bound: limits sought on coarser cells, certified on the fine ones; the better of two ways
  // to seek them.
  const SampledPlant coarse(sprung, ground, options.duration - begin, options.search_step, begin);
  const MotionSquares motion = motion_under(car, range, course.shares);
  constexpr double kShareOfOptimum = 0.1, kShareOfWay = 0.45;  // of the time, roughly
  double share = kShareOfOptimum;
  std::optional<double> least;
  for (const RelaxationStart start : {RelaxationStart::Staying, RelaxationStart::Short}) {
    report(std::exchange(share, share + kShareOfWay));
    const Relaxation relaxed =
        relax(coarse, range, index,
              {.start = start, .iterations = options.iterations, .size = course.value});
    const std::optional<double> one =
        certified_best(sprung, car, coarse, range, index, relaxed, motion, course.value);
    if (one && (!least || *one > *least)) least = one;
    if (!range.ends) break;  // the two are one
  }
  if (!least) return found;
  const double duration = whole.step() * static_cast<double>(whole.cells());
  found.bound = std::max(0.0, (Interval(*least) / Interval(duration)).low);
  found.proven = found.bound > 0;
  return found;
}

std::vector<ClairvoyantBound> clairvoyant_front(const Plant& plant, const GroundMotion& ground,
                                                const ForceRange& range,
                                                const std::vector<RideIndex>& indices,
                                                const BoundOptions& options) {
  // How far each index is, and all of them; said by one thread at a time.
  std::vector<ClairvoyantBound> front(indices.size());
  std::vector<double> shares(indices.size());
  const auto say = [&](std::size_t k, double share) {
    shares[k] = share;
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    options.monitor.on_progress({kStage, sum / static_cast<double>(shares.size())});
  };

  parallel_for(indices.size(), options.threads, [&](std::size_t k) {
    BoundOptions own = options;
    if (options.monitor.on_progress)
      own.monitor.on_progress = [&, k](const Progress& now) { say(k, now.fraction); };
    front[k] = clairvoyant_bound(plant, ground, range, indices[k], own);
    own.monitor.report(kStage, 1);
  });
  return front;
}

double share_of_possible(double passive, double controller, double optimum) {
  if (!(passive - optimum >= kLeastPossible * passive)) return NAN;
  return (passive - controller) / (passive - optimum);
}

}  // namespace dashpot
