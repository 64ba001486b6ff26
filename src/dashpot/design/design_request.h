#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/design/design_ride.h"
#include "dashpot/design/quantities.h"

namespace dashpot {

/// One thing that may vary, SI: a field within a range, in steps where a step is given; a field
/// with several values to choose from; the fluid.
struct DesignVariable {
  const DescriptionField* field = nullptr;  ///< nullptr: the fluid
  double from = 0, to = 0, step = 0;        ///< step 0: any value
  std::vector<double> values;               ///< a choice of numbers
  std::vector<std::shared_ptr<const Fluid>> fluids;

  std::string name() const { return field ? std::string(field->name) : "fluid"; }
  /// Values that can be chosen; 0: any of the range.
  std::size_t levels() const;
};

/// Which of two models a figure comes from.
enum class ToldBy { First, Second };

/// One bound of one quantity at one operating point; a request's min and max are two.
struct DesignConstraint {
  const DesignQuantity* quantity = nullptr;
  DamperOperation at;
  bool at_least = true;  ///< else at most
  double bound = 0;
  ToldBy by = ToldBy::First;
};

/// A quantity to be made large or small at one operating point.
struct DesignGoal {
  const DesignQuantity* quantity = nullptr;
  DamperOperation at;
  bool maximise = true;
  ToldBy by = ToldBy::First;
};

/// How far a made part may lie from its drawing: anywhere within +- width, all places alike.
struct DesignTolerance {
  const DescriptionField* field = nullptr;
  double width = 0;
};

/// A field that others determine: constant + sum of factor times field, SI.
struct FollowingField {
  const DescriptionField* field = nullptr;
  double constant = 0;
  std::vector<std::pair<const DescriptionField*, double>> terms;
};

/// A damper that is asked for: what may vary in it, what it must hold, what it is to be best in.
struct DesignRequest {
  std::string name, note;
  DamperDescription damper;  ///< what does not vary
  std::vector<DesignVariable> variables;
  std::vector<FollowingField> following;  ///< none before one that it follows
  std::vector<DesignConstraint> constraints;
  std::vector<DesignGoal> goals;
  std::vector<DesignTolerance> tolerances;
  DesignRidePointer ride;  ///< that `comfort` is of; null: there is none
  /// Share of the dampers made that must hold the constraints and reach the goals; 0: the drawn
  /// damper alone counts.
  double share = 0;
  int samples = 32;  ///< dampers that stand for those made
};

/// Whether a quantity is of the ride, and so takes long to compute; and whether any goal or
/// constraint is.
bool is_of_ride(const DesignQuantity& quantity);
bool asks_comfort(const DesignRequest& request);

/// "force at least 1500 N at 2 A, 0.3 m/s, by the second model"; the same of a goal: "largest
/// dynamic_range at ..."
std::string describe(const DesignConstraint& constraint);
std::string describe(const DesignGoal& goal);
/// " at 2 A, 0.3 m/s, by the second model"; empty for what is the same everywhere.
std::string place_of(const DesignQuantity& quantity, const DamperOperation& at, ToldBy by);

/// Whether a request has to say what it is for: next_drawings() asks for no goal.
enum class Goals { Required, Optional };

/// YAML as docs/design.md describes. `folder`: where a damper's file is looked for; read_ride: who
/// reads a ride that a design is asked about, null where none can be. Throws Error that names file
/// and line.
DesignRequest parse_request(std::string_view text, const std::string& source,
                            const std::filesystem::path& folder = {}, Goals goals = Goals::Required,
                            RideReader read_ride = nullptr);
DesignRequest load_request(const std::filesystem::path& path, Goals goals = Goals::Required,
                           RideReader read_ride = nullptr);
/// One that comes with Dashpot, in data/designs. Throws Error on a name that is not among
/// request_names().
DesignRequest named_request(const std::string& name);
std::vector<std::string> request_names();

}  // namespace dashpot
