#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/model_file.h"
#include "dashpot/physics/damper_physics.h"

namespace dashpot {

/// Why no damper has the forces that a fitted model tells.
enum class Refusal {
  None,
  NoResistance,  ///< they do not resist the motion, with the current or without, or are no numbers
  LessWithCurrent,
  Leap,      ///< one lies beyond kMostLeap, or the damper of the model's file has none there
  RangeLeap  ///< neither does, and their ratio does
};

/// What a model says of a drawing at one operating point.
struct Appraisal {
  DamperPhysics physics;
  /// Where the model's force has a band: the same at the ends of both forces' bands at which the
  /// current does least (force low, off_force high) and most.
  std::optional<DamperPhysics> weak, strong;
  /// Where there is one, physics.force, off_force and dynamic_range are NaN.
  Refusal refusal = Refusal::None;
};

/// Computes a design's figures (SI) from its drawing. Immutable: several threads ask it at a time.
class DesignModel {
 public:
  virtual ~DesignModel() = default;
  virtual std::string name() const = 0;
  /// The description must be possible (require_possible). A model that knows only forces takes the
  /// other figures from evaluate_physics. A figure that it cannot know is not finite, which counts
  /// as a constraint that fails.
  virtual Appraisal appraise(const DamperDescription& description,
                             const DamperOperation& operation) const = 0;
  /// The middle of the bands alone.
  DamperPhysics evaluate(const DamperDescription& description,
                         const DamperOperation& operation) const {
    return appraise(description, operation).physics;
  }

  /// The force alone, N, without a look at whether it is one that a damper can have.
  virtual double force(const DamperDescription& description,
                       const DamperOperation& operation) const {
    return evaluate(description, operation).force;
  }

  /// True of a model that was fitted on dampers, beyond which it extrapolates.
  virtual bool is_fitted() const { return false; }
  /// How far a drawing lies outside of those dampers, in shares of their ranges; 0 or less within.
  virtual double outside(const DamperDescription&) const { return 0; }
  /// The fields in which a drawing does, in words.
  virtual std::vector<std::string> extrapolations(const DamperDescription&) const { return {}; }
  /// The current or speed that lies beyond those that it was fitted on, in words; else empty.
  virtual std::vector<std::string> extrapolations(const DamperOperation&) const { return {}; }
  /// Whether the model of this damper takes energy out in every cycle that its fit has seen the
  /// like of (dissipation() in model_file.h).
  virtual bool dissipates(const DamperDescription&, int /*threads*/) const { return true; }
  /// The largest current and speed that it was fitted on.
  virtual DamperOperation usual_operation() const { return {}; }
  /// Whether its force has a band, at whose pessimistic end constraints and goals are met.
  virtual bool has_band() const { return false; }
  /// Whether it has refused a force, as one of 0 or less or beyond physics is.
  virtual bool has_refused() const { return false; }
  /// The model of this damper for other commands; none where a law has to be fitted to the forces
  /// (law_of_design).
  virtual std::optional<ModelFile> model_of(const DamperDescription&) const { return std::nullopt; }
};

/// "physics" is what the description asks for; "physics:plate", "physics:moving_wall" and
/// "physics:paper" take that law of the flow. A word with a dot or a slash is the file of a
/// family's model; `insist` as load_family_design_model() has it. Throws Error(where, ...) on
/// another name, or where the file holds something else.
std::unique_ptr<DesignModel> make_design_model(const std::string& name, const std::string& where,
                                               bool insist = false);
std::vector<std::string> design_model_names();  ///< those that are no files

/// How many times further from the plate flow's force, and from its dynamic range, a design's may
/// lie than that of a damper of the family's fit does: beyond it a fitted model leaps, as one does
/// whose force goes to 0.
constexpr double kMostLeap = 10;

/// A fitted family's force in place of that of first principles, from which all other figures
/// come, with the band of its file. Refused are forces that do not resist the motion, with the
/// current or without, and those that the current makes smaller; unless the caller insists, also
/// those that lie beyond kMostLeap, or where the damper with which the file stands has no force to
/// be held against. Throws Error where the file holds no family, or one that is not driven by a
/// current in A.
std::unique_ptr<DesignModel> load_family_design_model(const std::filesystem::path& path,
                                                      bool insist = false);

}  // namespace dashpot
