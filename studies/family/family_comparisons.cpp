// Figures 13 to 16 of the family paper: one quantity varies, measured and modelled.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "studies/family/family_parts.h"

namespace dashpot {
namespace {

/// A damper of the family (m, m, Pa*s) at one of its field levels, counted from 0.
struct Choice {
  double length, gap, viscosity;
  std::size_t level;
};

struct Shown {
  std::string label;
  std::size_t cycle;
};

struct Comparison {
  std::string name, title, fixed;
  FamilyProtocol unseen;  ///< how the damper can be left out
  std::vector<Shown> shown;
};

std::vector<double> values_of(const FamilySamples& family, const char* condition) {
  std::set<double> values;
  for (std::size_t c = 0; c < family.cycles.size(); ++c)
    values.insert(family.condition(c, condition));
  return {values.begin(), values.end()};
}

std::optional<std::size_t> cycle_of(const FamilySamples& family, const Choice& choice) {
  std::size_t level = 0;
  for (std::size_t c = 0; c < family.cycles.size(); ++c)
    if (family.condition(c, "pole_length") == choice.length &&
        family.condition(c, "gap") == choice.gap &&
        family.condition(c, "viscosity") == choice.viscosity && level++ == choice.level)
      return c;
  return std::nullopt;
}

class Comparisons {
 public:
  explicit Comparisons(const FamilySamples& family)
      : family_(family),
        lengths_(values_of(family, "pole_length")),
        gaps_(values_of(family, "gap")),
        viscosities_(values_of(family, "viscosity")),
        middle_{lengths_[lengths_.size() / 2], gaps_[gaps_.size() / 2], viscosities_.back(), 3} {}

  std::vector<Comparison> all() const {
    // The four comparisons, each titled by what stays fixed.
    const std::string gap = fmt::format("h = {:g} mm", 1000 * middle_.gap),
                      length = fmt::format("L = {:g} mm", 1000 * middle_.length),
                      fluid = fmt::format("{:g} Pa*s", middle_.viscosity),
                      level = "fourth field level";
    std::vector<Comparison> all{{"figure-13",
                                 "Figure 13: three lengths",
                                 gap + ", " + fluid + ", " + level,
                                 FamilyProtocol::Geometries,
                                 {}},
                                {"figure-14",
                                 "Figure 14: three gaps",
                                 length + ", " + fluid + ", " + level,
                                 FamilyProtocol::Geometries,
                                 {}},
                                {"figure-15",
                                 "Figure 15: two fluids",
                                 length + ", " + gap + ", " + level,
                                 FamilyProtocol::Fluids,
                                 {}},
                                {"figure-16",
                                 "Figure 16: three fields",
                                 length + ", " + gap + ", " + fluid,
                                 FamilyProtocol::Geometries,
                                 {}}};

    // Lengths, gaps and fluids vary one at a time from the middle damper.
    for (const double value : lengths_)
      add(all[0], fmt::format("L = {:g} mm", 1000 * value), &Choice::length, value);
    for (const double value : gaps_)
      add(all[1], fmt::format("h = {:g} mm", 1000 * value), &Choice::gap, value);
    for (const double value : viscosities_)
      add(all[2], fmt::format("{:g} Pa*s", value), &Choice::viscosity, value);

    // The middle damper at its first, third and sixth field level.
    for (const std::size_t field : {0, 2, 5}) {
      Choice choice = middle_;
      choice.level = field;
      if (const auto cycle = cycle_of(family_, choice))
        all[3].shown.push_back(
            {fmt::format("{:g} kPa", family_.condition(*cycle, "yield_stress") / 1000), *cycle});
    }
    return all;
  }

 private:
  void add(Comparison& comparison, const std::string& label, double Choice::* varied,
           double value) const {
    Choice choice = middle_;
    choice.*varied = value;
    if (const auto cycle = cycle_of(family_, choice)) comparison.shown.push_back({label, *cycle});
  }

  const FamilySamples& family_;
  std::vector<double> lengths_, gaps_, viscosities_;
  Choice middle_;
};

std::vector<std::size_t> samples_of(const FamilySamples& family, std::size_t cycle) {
  std::vector<std::size_t> indices(family.first[cycle + 1] - family.first[cycle]);
  std::iota(indices.begin(), indices.end(), family.first[cycle]);
  return indices;
}

/// Forces on a cycle by the network of the median seed whose division leaves the cycle to be
/// judged.
std::vector<double> judged_forces(const FamilyStudy& study, FamilyProtocol protocol,
                                  std::size_t cycle) {
  const FamilyOutcome* outcome = study.outcome(protocol, own_rule(chosen_architecture()));
  if (!outcome) return {};
  const std::vector<FamilyDivision> divided = divisions_of(study.family, protocol);
  for (std::size_t d = 0; d < divided.size(); ++d)
    if (std::ranges::binary_search(divided[d].judged, study.family.first[cycle]))
      return forces_at(outcome->networks[outcome->median_seed()][d]->mlp, study.family.samples,
                       samples_of(study.family, cycle));
  return {};
}

std::vector<double> scaled(const std::vector<double>& samples, double factor) {
  std::vector<double> result;
  for (const double sample : samples) result.push_back(factor * sample);
  return result;
}

struct Curves {
  std::vector<double> seen, unseen;
};

void draw(DocumentFigure& figure, const FamilyStudy& study, const Shown& shown,
          const Curves& curves, std::size_t index) {
  const Record& cycle = study.family.cycles[shown.cycle];
  const std::string colour = fmt::format("series-{}", index + 1);
  const std::vector<double>& measured = cycle.channel("force").samples;
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<double> x =
        scaled(cycle.channel(p == 0 ? "displacement" : "velocity").samples, 1000);
    auto& series = figure.panels[p].series;
    series.push_back({"", colour, x, measured, FigureSeries::Mark::Dots, 2});
    series.push_back({shown.label, colour, x, curves.seen, FigureSeries::Mark::Line, 1.6});
    if (!curves.unseen.empty())
      series.push_back({"", colour, x, curves.unseen, FigureSeries::Mark::Dashes, 1});
  }
}

std::vector<std::string> errors_row(const Comparison& comparison, const FamilyStudy& study,
                                    const Shown& shown, const Curves& curves) {
  const std::vector<std::size_t> indices = samples_of(study.family, shown.cycle);
  std::vector<std::string> row{comparison.name, shown.label};
  for (const std::vector<double>* forces : {&curves.seen, &curves.unseen}) {
    if (forces->empty()) {
      row.insert(row.end(), {"-", "-"});
      continue;
    }
    const Metrics m = metrics(errors_at(study.family.samples, indices, *forces));
    row.insert(row.end(), {decimals(m.mae, 2), decimals(m.max_error, 2)});
  }
  return row;
}

}  // namespace

DocumentSection comparison_section(const FamilyStudy& study) {
  DocumentSection section{"figures-13-16", "Figures 13 to 16: length, gap, fluid and field", {}};

  // One table gathers the errors of all figures.
  DocumentTable table{
      "h3x15 on what figures 13 to 16 show",
      {{"Figure"},
       {"Damper or field"},
       {"Learnt from: MAE N", true},
       {"max N", true},
       {"Not seen: MAE N", true},
       {"max N", true}},
      {},
      "The paper states one figure: a largest error of 1 N between two fluids (figure 15A)."};

  // A figure each: both curves over displacement and over velocity.
  for (const Comparison& comparison : Comparisons(study.family).all()) {
    DocumentFigure figure{
        comparison.name,
        comparison.title,
        comparison.fixed +
            ". Dots: measured. Lines: h3x15, which learnt from them. Dashes: h3x15 that has not "
            "seen this " +
            (comparison.unseen == FamilyProtocol::Fluids ? "fluid." : "geometry."),
        {{"Force against displacement", "Displacement (mm)", "Force (N)", {}},
         {"Force against velocity", "Velocity (mm/s)", "Force (N)", {}}},
        2};

    // Measured, modelled by a network that learnt from the record, and by one that did not.
    for (std::size_t k = 0; k < comparison.shown.size(); ++k) {
      const Shown& shown = comparison.shown[k];
      const Curves curves{judged_forces(study, FamilyProtocol::AllSamples, shown.cycle),
                          judged_forces(study, comparison.unseen, shown.cycle)};
      draw(figure, study, shown, curves, k);
      table.rows.push_back(errors_row(comparison, study, shown, curves));
    }
    section.figures.push_back(std::move(figure));
  }

  // The paper's own claim, and how ours differs.
  section.tables.push_back(std::move(table));
  section.paragraphs.push_back(
      "The paper shows its network on records that it learnt from. Dashed beside it here: the same "
      "network, trained without these dampers.");
  return section;
}

}  // namespace dashpot
