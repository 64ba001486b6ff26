#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "dashpot/base/part.h"
#include "dashpot/base/store.h"
#include "dashpot/dataset.h"
#include "dashpot/identify.h"
#include "dashpot/identify/many/damper_folders.h"
#include "dashpot/identify/many/population.h"

// A night of production: the same models fitted to each of many dampers, one at a time, and each
// damper judged against all. docs/many.md describes it for its users.
namespace dashpot {

struct ManyOptions {
  std::vector<std::string> models;
  IdentifyOptions fit;  ///< of every damper; its threads are those over dampers
  LoadOptions load;
  /// m/s, ascending: where forces are compared. Empty: the speeds of the first pilot damper.
  std::vector<double> speeds;
  /// How many of the first dampers are fitted from all starts before the others. The fit of every
  /// damper then starts from one of them; 0: every damper is fitted from all starts.
  std::size_t pilot = 8;
  double false_alarms = 1e-3;  ///< as judge_population has it
};

/// What is known of one damper. Where `failure` is not empty there are no numbers.
struct DamperRow {
  std::string name;
  double serial = 0;
  std::string failure;         ///< why there is no result
  bool is_unread = false;      ///< since a file of it could not be read
  bool restarted = false;      ///< fitted from all starts after all: the warm one led nowhere good
  double seconds = 0;          ///< CPU time of its fits
  std::vector<double> values;  ///< by quantity; not a number where it has none
};

struct ManyReport {
  ManyOptions options;
  DamperFolders folders;
  std::vector<Quantity> quantities;
  std::vector<DamperRow> rows;  ///< in the order of the folders
  PopulationReport population;
  std::size_t kept = 0;  ///< rows found in the store
  double wall_seconds = 0;
  double pilot_seconds = 0;    ///< CPU time of the fits of the pilot
  std::size_t pilot_fits = 0;  ///< of them, dampers that gave a model

  std::size_t fitted() const;  ///< rows with numbers
  double values_of(std::size_t damper, std::size_t quantity) const {
    return rows[damper].values.empty() ? kNoNumber : rows[damper].values[quantity];
  }
  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
};

/// Finished dampers in one file. A row is found again only for the same contents of the damper's
/// files, and for the same pilot.
constexpr StoreFormat kManyFormat{"production", 1, "begin anew with --fresh"};
/// All that the rows depend on beyond the dampers' files: the basis of the store.
NamedTexts describe_many(const ManyOptions& options, const std::string& program);

/// Fits every damper and judges all. The same report, times aside, whatever the number of threads
/// and machines, the order of the work and what the store held. A damper that cannot be read or
/// fitted is a row with its reason. Throws Error where no pilot damper gives a model (the first
/// reason), where the disk cannot take a result, and Interrupted when the monitor stops it. Memory:
/// that of the dampers in work, and some 100 bytes and 8 per quantity for each damper.
ManyReport identify_many(const DamperFolders& folders, const ManyOptions& options, Store& store);
/// Makes and keeps the rows of one part, and judges nothing.
PartReport identify_many_part(const DamperFolders& folders, const ManyOptions& options,
                              Store& store, const Part& part);

}  // namespace dashpot
