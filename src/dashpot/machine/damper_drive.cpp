#include "dashpot/machine/damper_drive.h"

#include <algorithm>

namespace dashpot {

std::vector<double> drive_samples(const DamperDrive& drive, const PlantRecording& recording) {
  if (drive.channel.empty()) return std::vector<double>(recording.samples, drive.level);
  return recording.channel(drive.channel).samples;
}

InPlantSetup with_held_drives(InPlantSetup setup, std::span<const PlantRecording> recordings) {
  for (DamperDrive& drive : setup.drives) {
    if (drive.channel.empty() || recordings.empty()) continue;
    const double level = recordings.front().channel(drive.channel).samples.front();
    const bool is_held = std::ranges::all_of(recordings, [&](const PlantRecording& recording) {
      const std::vector<double>& samples = recording.channel(drive.channel).samples;
      return std::ranges::count(samples, level) == std::ssize(samples);
    });
    if (is_held) drive = {.channel = {}, .level = level};
  }
  return setup;
}

std::vector<std::optional<double>> held_levels(const InPlantSetup& setup) {
  std::vector<std::optional<double>> levels;
  for (std::size_t kind = 0; kind < setup.kinds.size(); ++kind) {
    const std::vector<std::size_t> dampers = setup.kinds.struts(kind, setup.dampers());
    const double level = setup.drive_of(dampers.front()).level;
    const bool is_held = std::ranges::all_of(dampers, [&](std::size_t damper) {
      const DamperDrive& drive = setup.drive_of(damper);
      return drive.channel.empty() && drive.level == level;
    });
    levels.push_back(is_held ? std::optional(level) : std::nullopt);
  }
  return levels;
}

std::vector<LawModel> at_held_levels(std::vector<LawModel> laws,
                                     std::span<const std::optional<double>> levels) {
  for (std::size_t kind = 0; kind < laws.size(); ++kind) {
    if (!levels[kind]) continue;
    LawModel& law = laws[kind];
    std::vector<double> parameters(law.law().params.size());
    law.parameters_at(*levels[kind], parameters.data());
    law = LawModel::constant(law.law(), parameters);
  }
  return laws;
}

}  // namespace dashpot
