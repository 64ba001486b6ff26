#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "studies/family/family_study.h"

// Parts of the family study's page, and the figures of the paper that it stands beside.
namespace dashpot {

/// The figures that the paper prints, and the errors of the networks published with it on the
/// samples that they learnt from.
namespace family_paper {
inline constexpr std::size_t kSamples = 13333;
inline constexpr double kR2 = 0.9577;
/// A bar of the paper's charts.
struct Bar {
  const char* architecture;
  double error;  ///< N, "mean error"
};
inline constexpr std::array<Bar, 4> kSingle{
    {{"h1x10", 1.355}, {"h2x9", 0.5794}, {"h3x10", 0.6126}, {"h3x20", 0.91155}}};  // figure 8
inline constexpr std::array<Bar, 9> kFamily{{{"h1x10", 1.9978},
                                             {"h1x50", 1.7343},
                                             {"h2x9", 1.725},
                                             {"h2x100", 0.9038},
                                             {"h3x10", 0.9064},
                                             {"h3x15", 0.5115},
                                             {"h3x20", 0.5579},
                                             {"h3x30", 0.7696},
                                             {"h3x100", 2.047}}};  // figure 9
/// A network published with the paper, judged on the samples that it learnt from.
struct Published {
  const char* architecture;
  double mae, r2;  ///< N; 1
};
inline constexpr std::array<Published, 3> kPublished{
    {{"h3x15", 0.714, 0.9919}, {"h3x20", 0.581, 0.9944}, {"h3x30", 0.729, 0.9913}}};
}  // namespace family_paper

/// The paper's error for an architecture, N; nothing when the paper has no such bar.
template <class Bars>
std::optional<double> paper_error(const Bars& bars, const std::string& architecture) {
  for (const auto& bar : bars)
    if (architecture == bar.architecture) return bar.error;
  return std::nullopt;
}
/// nullptr when no such network is published.
const family_paper::Published* published_network(const std::string& architecture);

/// "0.262 (0.249 ... 0.274)"; "-" without an outcome. R2 has four decimals.
std::string mae_text(const FamilyOutcome* outcome);
std::string r2_text(const FamilyOutcome* outcome);
std::string median_mae_text(const FamilyOutcome* outcome);
std::string median_r2_text(const FamilyOutcome* outcome);
/// The value with `count` decimals.
std::string decimals(double value, int count);

DocumentSection family_protocol_section(const FamilyStudy& study);
DocumentSection single_damper_section(const FamilyStudy& study);  // figure 8
DocumentSection architecture_section(const FamilyStudy& study);   // figure 9
DocumentSection penalty_section(const FamilyStudy& study);        // figure 11
DocumentSection grid_section(const FamilyStudy& study);           // rate and batch
DocumentSection history_section(const FamilyStudy& study);        // figure 12
DocumentSection comparison_section(const FamilyStudy& study);     // figures 13 to 16
DocumentSection determination_section(const FamilyStudy& study);  // R2
DocumentSection left_out_section(const FamilyStudy& study);  // geometries and fluids never seen
/// What the best of the models is worth beside those that know nothing of geometry or fluid, or no
/// more than a line, in words; empty where none of these was judged.
std::string skill_verdict(const FamilyStudy& study);
DocumentSection limits_section(const FamilyStudy& study);  // table 2, and what cannot be repeated

}  // namespace dashpot
