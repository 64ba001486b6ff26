#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "dashpot.h"
#include "dashpot/identify/rank/model_choice.h"
#include "fuzz.h"
#include "words.h"

// The C boundary, called with whatever, in whatever order: a status and a message, never a crash.
// What C cannot check stays true: an array holds as many numbers as the call says.

namespace {

constexpr std::size_t kMostSamples = 24, kHandles = 2;

/// Takes the input apart into numbers, sizes and texts; ends with zeros.
class Bytes {
 public:
  explicit Bytes(const std::string& input) : input_(input) {}
  bool is_empty() const { return at_ >= input_.size(); }
  unsigned byte() { return is_empty() ? 0 : static_cast<unsigned char>(input_[at_++]); }
  std::size_t size(std::size_t most) { return byte() % (most + 1); }
  /// Plain numbers mostly, and those that break what is not careful.
  double number() {
    constexpr double kOdd[] = {0,
                               -0.0,
                               1e-300,
                               1e300,
                               -1e300,
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};
    const unsigned kind = byte();
    if (kind >= 248) return kOdd[kind - 248];
    return (static_cast<double>(kind) - 124) / 250;
  }
  /// Up to the next zero; null where it says "null".
  const char* text(std::string& kept) {
    const std::size_t end = std::min(input_.find('\0', at_), input_.size());
    kept = input_.substr(std::min(at_, end), end - std::min(at_, end));
    at_ = end + 1;
    return kept == "null" ? nullptr : kept.c_str();
  }

 private:
  const std::string& input_;
  std::size_t at_ = 0;
};

/// Samples of a column: none, one, or as many as asked, forwards or backwards.
struct Samples {
  std::vector<double> values;
  dashpot_column column{};

  Samples(Bytes& bytes, std::size_t count) {
    const unsigned kind = bytes.byte() % 8;
    if (kind == 0) return;
    const std::ptrdiff_t stride = kind == 1 ? 0 : kind == 2 ? 2 : kind == 3 ? -1 : 1;
    const std::size_t length =
        std::max<std::size_t>(1, stride == 0 ? 1 : count * (stride == 2 ? 2 : 1));
    const double step = bytes.number(), odd = bytes.number();
    for (std::size_t k = 0; k < length; ++k) values.push_back(step * static_cast<double>(k % 7));
    values[bytes.size(length - 1)] = odd;
    column = {stride < 0 ? &values.back() : values.data(), stride};
  }
};

dashpot_input input_of(Bytes& bytes) {
  dashpot_input input;
  input.displacement = bytes.number();
  input.velocity = bytes.number();
  input.current = bytes.number();
  return input;
}

/// A caller with some handles, who calls what the bytes say.
class Caller {
 public:
  explicit Caller(const std::string& input) : bytes_(input) {}
  ~Caller() {
    for (dashpot_model*& model : models_) dashpot_model_free(&model);
    for (dashpot_recordings*& recordings : recordings_) dashpot_recordings_free(&recordings);
  }

  void call_all() {
    using Call = dashpot_status (Caller::*)();
    constexpr Call kCalls[] = {&Caller::make_model,  &Caller::tell_model,  &Caller::rest,
                               &Caller::advance,     &Caller::force,       &Caller::run,
                               &Caller::new_records, &Caller::add,         &Caller::tell_recordings,
                               &Caller::evaluate,    &Caller::refused_fit, &Caller::export_model,
                               &Caller::understand,  &Caller::give_back};
    for (int calls = 0; calls < 24 && !bytes_.is_empty(); ++calls) {
      const Call call = kCalls[bytes_.byte() % std::size(kCalls)];
      const dashpot_status status = (this->*call)();
      require_true(status >= DASHPOT_OK && status <= DASHPOT_FAILED && status != DASHPOT_CANCELLED);
      require_true(status == DASHPOT_OK || std::strlen(dashpot_last_error()) > 0);
    }
  }

 private:
  /// One of two, or null.
  template <class Handle>
  Handle* any(std::array<Handle*, kHandles>& of) {
    const unsigned which = bytes_.byte() % 4;
    return which < kHandles ? of[which] : which == 2 ? of[0] : nullptr;
  }
  dashpot_model*& model_slot() { return models_[bytes_.byte() % kHandles]; }
  dashpot_recordings*& recordings_slot() { return recordings_[bytes_.byte() % kHandles]; }

  dashpot_status make_model() {
    dashpot_model*& slot = model_slot();
    dashpot_model_free(&slot);
    std::string kept;
    const unsigned way = bytes_.byte() % 4;
    const char* text = bytes_.text(kept);
    if (way == 0) return dashpot_model_parse(text, &slot);
    if (way == 1) return dashpot_model_load("/nonexistent/model.json", &slot);
    if (way == 2) return dashpot_model_parse(text, nullptr);
    return dashpot_model_published(text, &slot);
  }

  dashpot_status tell_model() {
    const dashpot_model* model = any(models_);
    dashpot_model_info info;
    char* text = nullptr;
    (void)dashpot_model_text(model, bytes_.byte() % 4 == 0 ? nullptr : &text);
    dashpot_text_free(&text);
    return dashpot_model_get_info(model, bytes_.byte() % 4 == 0 ? nullptr : &info);
  }

  /// Of the model's size mostly, each state a number; the array is as long as the call will say.
  std::vector<double> state_for(const dashpot_model* model) {
    dashpot_model_info info{};
    if (model) (void)dashpot_model_get_info(model, &info);
    const unsigned how = bytes_.byte();
    std::vector<double> state(how % 8 == 0 ? how / 8 : info.state_size);
    if (how % 8 == 1)
      for (double& value : state) value = bytes_.number();
    return state;
  }

  dashpot_status rest() {
    const dashpot_model* model = any(models_);
    std::vector<double> state = state_for(model);
    const dashpot_input input = input_of(bytes_);
    return dashpot_rest(model, bytes_.byte() % 8 == 0 ? nullptr : &input, state.data(),
                        state.size());
  }

  dashpot_status advance() {
    const dashpot_model* model = any(models_);
    std::vector<double> state = state_for(model);
    const dashpot_input from = input_of(bytes_), to = input_of(bytes_);
    return dashpot_advance(model, &from, bytes_.byte() % 8 == 0 ? nullptr : &to, bytes_.number(),
                           state.data(), state.size());
  }

  dashpot_status force() {
    const dashpot_model* model = any(models_);
    const std::vector<double> state = state_for(model);
    const dashpot_input input = input_of(bytes_);
    double newton = 0;
    return dashpot_force(model, &input, state.data(), state.size(),
                         bytes_.byte() % 8 == 0 ? nullptr : &newton);
  }

  dashpot_status run() {
    const dashpot_model* model = any(models_);
    dashpot_motion motion{};
    motion.samples = bytes_.size(kMostSamples);
    motion.sample_time = bytes_.number();
    const Samples time(bytes_, motion.samples), x(bytes_, motion.samples),
        v(bytes_, motion.samples), i(bytes_, motion.samples);
    motion.time = time.column, motion.displacement = x.column;
    motion.velocity = v.column, motion.current = i.column;
    std::vector<double> force(motion.samples), half(motion.samples), state = state_for(model);
    const unsigned wanted = bytes_.byte();
    const dashpot_response response = {wanted % 8 == 0 ? nullptr : force.data(),
                                       wanted & 16 ? half.data() : nullptr,
                                       wanted & 32 ? state.data() : nullptr, state.size()};
    return dashpot_run(model, &motion, &response);
  }

  dashpot_status new_records() {
    dashpot_recordings*& slot = recordings_slot();
    dashpot_recordings_free(&slot);
    if (bytes_.byte() % 4 > 0) return dashpot_recordings_new(&slot);
    std::string kept;
    const char* path = "/nonexistent";
    return dashpot_recordings_load(bytes_.byte() % 2 ? &path : nullptr, bytes_.size(1),
                                   bytes_.text(kept), &slot);
  }

  dashpot_status add() {
    dashpot_recordings* to = any(recordings_);
    dashpot_table table{};
    table.samples = bytes_.size(kMostSamples);
    table.sample_time = bytes_.number();
    table.column_count = bytes_.size(4);
    std::vector<Samples> samples;
    std::vector<std::string> names(table.column_count + 2);
    std::vector<dashpot_named_column> columns;
    for (std::size_t k = 0; k < table.column_count; ++k)
      samples.emplace_back(bytes_, table.samples);
    for (std::size_t k = 0; k < table.column_count; ++k)
      columns.push_back({bytes_.text(names[k]), samples[k].column});
    table.columns = columns.data();
    table.name = bytes_.text(names[table.column_count]);
    table.conditions = bytes_.text(names[table.column_count + 1]);
    return dashpot_recordings_add(to, bytes_.byte() % 16 == 0 ? nullptr : &table);
  }

  dashpot_status tell_recordings() {
    const dashpot_recordings* recordings = any(recordings_);
    char* text = nullptr;
    (void)dashpot_recordings_describe(recordings, &text);
    dashpot_text_free(&text);
    dashpot_record_info info;
    (void)dashpot_recordings_get_info(recordings, bytes_.size(4), &info);
    dashpot_channel channel;
    return dashpot_recordings_channel(recordings, bytes_.size(4), bytes_.size(8), &channel);
  }

  dashpot_status evaluate() {
    std::string kept;
    char* report = nullptr;
    const dashpot_status status =
        dashpot_evaluate(any(models_), any(recordings_), bytes_.text(kept),
                         bytes_.byte() % 8 == 0 ? nullptr : &report);
    dashpot_text_free(&report);
    return status;
  }

  /// Options of every kind, and no recordings: fits would take the time that calls are for.
  dashpot_status refused_fit() {
    std::string kept;
    const char* options = bytes_.text(kept);
    dashpot_recordings* empty = nullptr;
    (void)dashpot_recordings_new(&empty);
    dashpot_model* model = nullptr;
    dashpot_ranking* ranking = nullptr;
    char* report = nullptr;
    require_true(dashpot_fit(empty, options, nullptr, &model, &report) != DASHPOT_OK && !model);
    require_true(dashpot_ranking_model(ranking, bytes_.byte(), &model) != DASHPOT_OK);
    require_true(dashpot_ranking_report(ranking, options, &report) != DASHPOT_OK && !report);
    const dashpot_status status = dashpot_identify(empty, options, nullptr, &ranking);
    dashpot_recordings_free(&empty);
    return status;
  }

  /// To a folder that cannot be: files of any name are none of a fuzzer's.
  dashpot_status export_model() {
    constexpr const char* kOptions[] = {
        R"({"to": ["c", "dpr", "tables"], "folder": "/dev/null/no"})",
        R"({"to": ["fmu3"], "sources_only": true, "folder": "/dev/null/no"})", nullptr};
    char* report = nullptr;
    const dashpot_model* model = any(models_);
    const dashpot_status status = dashpot_export(model, kOptions[bytes_.byte() % 3], &report);
    require_true(status != DASHPOT_OK && !report);
    return status;
  }

  dashpot_status understand() {
    std::string kept;
    dashpot_column_meaning meaning;
    return dashpot_understand_column(bytes_.text(kept),
                                     bytes_.byte() % 8 == 0 ? nullptr : &meaning);
  }

  /// Twice, as a caller who lost count.
  dashpot_status give_back() {
    for (int times = 0; times < 2; ++times) {
      dashpot_model_free(&models_[0]);
      dashpot_recordings_free(&recordings_[0]);
    }
    dashpot_model_free(nullptr);
    dashpot_recordings_free(nullptr);
    return DASHPOT_OK;
  }

  Bytes bytes_;
  std::array<dashpot_model*, kHandles> models_{};
  std::array<dashpot_recordings*, kHandles> recordings_{};
};

/// A vehicle in words: understood or refused; short rides are driven.
void drive_options(const std::string& input) {
  const dashpot::capi::DriveOptions options = dashpot::capi::read_drive_options(input.c_str());
  if (names_a_device(input)) return;
  (void)dashpot::make_vehicle(options.vehicle);
}

/// The option texts of fits, of reading and of evaluation; conditions of a recording.
void fit_options(const std::string& input) {
  using namespace dashpot;
  const capi::FitOptions options = capi::read_fit_options(input.c_str());
  (void)identify_options(options.words, choose_models(options.words.models, {}).names, "options, ");
}

const FuzzTarget targets[] = {
    {"capi", [](const std::string& input) { Caller(input).call_all(); }},
    {"drive_options", drive_options},
    {"fit_options", fit_options},
    {"load_options",
     [](const std::string& input) { dashpot::capi::read_load_options(input.c_str()); }},
    {"export_options",
     [](const std::string& input) { dashpot::capi::read_export_options(input.c_str()); }},
    {"evaluate_options",
     [](const std::string& input) { dashpot::capi::read_evaluate_options(input.c_str()); }},
    {"conditions",
     [](const std::string& input) { dashpot::capi::read_conditions(input.c_str()); }}};

}  // namespace
