#include "dashpot/identify/fit/network_design.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/find_row.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kMaxLayers = 10, kMaxMembers = 100, kMaxCount = 1'000'000;

template <class Choice>
struct Word {
  std::string_view name;
  Choice choice;
};
constexpr std::array kActivations{Word{"tanh", Activation::Tanh}, Word{"relu", Activation::Relu},
                                  Word{"sigmoid", Activation::Sigmoid},
                                  Word{"identity", Activation::Identity}};
constexpr std::array kTrainers{Word{"lm", Trainer::LevenbergMarquardt},
                               Word{"bayesian", Trainer::Bayesian},
                               Word{"lbfgs", Trainer::Lbfgs},
                               Word{"sgd", Trainer::Sgd},
                               Word{"momentum", Trainer::Momentum},
                               Word{"rmsprop", Trainer::RmsProp},
                               Word{"adam", Trainer::Adam},
                               Word{"adamw", Trainer::AdamW}};
constexpr std::array kSchedules{Word{"constant", RateSchedule::Constant},
                                Word{"step", RateSchedule::Step},
                                Word{"cosine", RateSchedule::Cosine}};
constexpr std::array kFeedbackTrainings{Word{"series_parallel", FeedbackTraining::SeriesParallel},
                                        Word{"free_run", FeedbackTraining::FreeRun}};

constexpr std::array kOutputRanges{Word{"linear", OutputRange::Linear},
                                   Word{"bounded", OutputRange::Bounded}};

template <class Choice, std::size_t N>
Choice parse_word(std::string_view text, const std::string& where,
                  const std::array<Word<Choice>, N>& words) {
  return find_row(words, text, "word", where).choice;
}

template <class Choice, std::size_t N>
std::string format_word(const std::optional<Choice>& choice,
                        const std::array<Word<Choice>, N>& words) {
  if (!choice) return {};
  return std::string(std::find_if(words.begin(), words.end(), [&](const Word<Choice>& word) {
                       return word.choice == *choice;
                     })->name);
}

double parse_positive(std::string_view text, const std::string& where, bool zero_too) {
  const std::optional<double> number = parse_number(text);
  if (!number || !std::isfinite(*number) || *number < 0 || (*number == 0 && !zero_too))
    throw Error(where, "is '" + std::string(text) + "'",
                zero_too ? "a number of 0 or more" : "a number above 0");
  return *number;
}

std::size_t parse_count(std::string_view text, const std::string& where, std::size_t least,
                        std::size_t most = kMaxCount) {
  const std::optional<double> number = parse_number(text);
  if (!number || *number != std::floor(*number) || *number < static_cast<double>(least) ||
      *number > static_cast<double>(most))
    throw Error(where, "is '" + std::string(text) + "'",
                "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::size_t>(*number);
}

std::vector<std::size_t> parse_layers(std::string_view text, const std::string& where) {
  std::vector<std::size_t> layers;
  for (const std::string& part : split(text, '-')) {
    layers.push_back(parse_count(part, where, 1));
    if (layers.back() > kMaxWidth || layers.size() > kMaxLayers)
      throw Error(where, "is '" + std::string(text) + "'",
                  "at most " + std::to_string(kMaxLayers) + " layers of at most " +
                      std::to_string(kMaxWidth));
  }
  return layers;
}

std::string format_layers(const std::vector<std::size_t>& layers) {
  std::vector<std::string> parts;
  for (const std::size_t layer : layers) parts.push_back(std::to_string(layer));
  return join(parts, "-");
}

/// A row for a number.
template <auto Member, std::size_t Least, std::size_t Most = kMaxCount>
constexpr NetworkSetting count_setting(std::string_view name, std::string_view meaning,
                                       std::string_view value) {
  return {name, meaning, value,
          [](std::string_view text, const std::string& where, NetworkDesign& design) {
            design.*Member = parse_count(text, where, Least, Most);
          },
          [](const NetworkDesign& design) {
            return design.*Member ? std::to_string(*(design.*Member)) : std::string();
          }};
}
template <auto Member, bool ZeroToo>
constexpr NetworkSetting number_setting(std::string_view name, std::string_view meaning,
                                        std::string_view value) {
  return {name, meaning, value,
          [](std::string_view text, const std::string& where, NetworkDesign& design) {
            design.*Member = parse_positive(text, where, ZeroToo);
          },
          [](const NetworkDesign& design) {
            return design.*Member ? format_exact(*(design.*Member)) : std::string();
          }};
}
template <auto Member, const auto& Words>
constexpr NetworkSetting word_setting(std::string_view name, std::string_view meaning,
                                      std::string_view value) {
  return {name, meaning, value,
          [](std::string_view text, const std::string& where, NetworkDesign& design) {
            design.*Member = parse_word(text, where, Words);
          },
          [](const NetworkDesign& design) { return format_word(design.*Member, Words); }};
}

constexpr std::array kSettings{
    NetworkSetting{"hidden", "neurons per hidden layer", "15-15-15",
                   [](std::string_view text, const std::string& where, NetworkDesign& design) {
                     design.hidden = parse_layers(text, where);
                   },
                   [](const NetworkDesign& design) { return format_layers(design.hidden); }},
    word_setting<&NetworkDesign::activation, kActivations>("activation", "of hidden layers",
                                                           "tanh, relu, sigmoid or identity"),
    word_setting<&NetworkDesign::trainer, kTrainers>(
        "trainer",
        "Levenberg-Marquardt, the same with Bayesian regularisation, L-BFGS, or mini-batches",
        "lm, bayesian, lbfgs, sgd, momentum, rmsprop, adam or adamw"),
    number_setting<&NetworkDesign::rate, false>(
        "rate", "learning rate of a batch trainer; 1e-3 unless set", "1e-3"),
    word_setting<&NetworkDesign::schedule, kSchedules>(
        "schedule",
        "of the rate: as it is, to a tenth after each third of the epochs, or down to 0 along a "
        "cosine, which is usual",
        "constant, step or cosine"),
    count_setting<&NetworkDesign::batch, 1>("batch", "samples of a mini-batch; 20 unless set",
                                            "20"),
    count_setting<&NetworkDesign::epochs, 1>(
        "epochs", "epochs (100 unless set), or iterations on all samples, at most", "100"),
    number_setting<&NetworkDesign::l1, true>(
        "l1", "weight decay by the weights' size, for batch trainers", "1e-5"),
    number_setting<&NetworkDesign::l2, true>("l2",
                                             "weight decay by the weights' squares; unless set, "
                                             "batch trainers have none and others find "
                                             "it by trials on held-back training records",
                                             "3e-4"),
    count_setting<&NetworkDesign::patience, 0>(
        "patience",
        "epochs without gain on held-back training records after which training stops; 0, which is "
        "usual: none is held back",
        "20"),
    count_setting<&NetworkDesign::members, 1, kMaxMembers>("members",
                                                           "networks whose mean is the model", "5"),
    count_setting<&NetworkDesign::delays, 0>("delays", "past samples of each input", "2"),
    count_setting<&NetworkDesign::feedback, 0>("feedback", "past outputs fed back", "2"),
    count_setting<&NetworkDesign::spacing, 1>("spacing", "samples from one past value to the next",
                                              "5"),
    word_setting<&NetworkDesign::training, kFeedbackTrainings>(
        "training", "what is fed back while it learns: the measured force, or its own output",
        "series_parallel or free_run"),
    count_setting<&NetworkDesign::window, 0>(
        "window", "steps in free run from a measured force on while it learns; 0: whole records",
        "100"),
    word_setting<&NetworkDesign::output, kOutputRanges>(
        "output",
        "whether the force of a network with fed-back outputs is held near that of its training",
        "linear or bounded")};

}  // namespace

std::span<const NetworkSetting> network_settings() { return kSettings; }

const NetworkSetting& find_network_setting(std::string_view name, const std::string& where) {
  return find_row(kSettings, name, "setting", where);
}

void parse_network_setting(std::string_view text, const std::string& option,
                           NetworkDesign& design) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw Error(option, "'" + std::string(text) + "' has no value",
                "as hidden=15-15 or trainer=adam");
  const std::string name(trim(text.substr(0, equals)));
  find_network_setting(name, option)
      .parse(trim(text.substr(equals + 1)), option + " " + name, design);
}

std::string format_design(const NetworkDesign& design) {
  std::vector<std::string> parts;
  for (const NetworkSetting& setting : kSettings)
    if (const std::string value = setting.format(design); !value.empty())
      parts.push_back(std::string(setting.name) + '=' + value);
  return join(parts, ",");
}

bool trains_on_batches(Trainer trainer) {
  return trainer != Trainer::LevenbergMarquardt && trainer != Trainer::Bayesian &&
         trainer != Trainer::Lbfgs;
}

std::string_view name_of(Trainer trainer) {
  return std::ranges::find(kTrainers, trainer, &Word<Trainer>::choice)->name;
}

bool has_use(Trainer trainer, std::string_view setting) {
  for (const std::string_view of_batches : {"rate", "schedule", "batch", "l1"})
    if (setting == of_batches) return trains_on_batches(trainer);
  return setting != "l2" || trainer != Trainer::Bayesian;  // which finds it by itself
}

void require_trainer(const NetworkDesign& design, Trainer usual) {
  const Trainer trainer = design.trainer.value_or(usual);
  const std::string which =
      "trainer=" + std::string(name_of(trainer)) + (design.trainer ? "" : ", the usual one,");
  for (const NetworkSetting& setting : kSettings)
    if (!setting.format(design).empty() && !has_use(trainer, setting.name))
      throw Error("--network " + std::string(setting.name), which + " has none",
                  setting.name == "l2" ? "it finds the weight decay by itself; trainer=lm has l2"
                                       : "choose a batch trainer, as trainer=adam");
}

}  // namespace dashpot
