#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dashpot.h"
#include "support.h"

/// Gives back what it holds, so that the sanitizers see no leak.
template <class Handle, void (*give_back)(Handle**)>
struct Held {
  Handle* handle = nullptr;
  Held() = default;
  Held(Held&& other) noexcept : handle(std::exchange(other.handle, nullptr)) {}
  ~Held() { give_back(&handle); }
  Handle** operator&() { return &handle; }
  operator Handle*() const { return handle; }
};
using Model = Held<dashpot_model, dashpot_model_free>;
using Recordings = Held<dashpot_recordings, dashpot_recordings_free>;
using HeldRanking = Held<dashpot_ranking, dashpot_ranking_free>;
using Text = Held<char, dashpot_text_free>;

/// A published set; its law has a state.
inline Model published(const char* name = "spencer1997_bouc_wen") {
  Model model;
  REQUIRE(dashpot_model_published(name, &model) == DASHPOT_OK);
  return model;
}

/// The message of a call that must end with `expected`.
inline std::string message_of(dashpot_status expected, dashpot_status status) {
  REQUIRE(status == expected);
  return dashpot_last_error();
}

/// Sine motions at constant currents, of a Bingham damper: 400 N + 200 N/A at yield, 1000 N s/m.
struct BinghamBench {
  explicit BinghamBench(double current, double frequency = 2) {
    constexpr double kPi = 3.14159265358979323846, kAmplitude = 0.02;
    for (int k = 0; k < 400; ++k) {
      const double phase = 2 * kPi * frequency * k * 0.005 + 0.1;  // v is never 0
      x.push_back(kAmplitude * std::sin(phase));
      v.push_back(2 * kPi * frequency * kAmplitude * std::cos(phase));
      i.push_back(current);
      f.push_back((400 + 200 * current) * (v.back() > 0 ? 1 : -1) + 1000 * v.back());
    }
  }
  std::vector<double> x, v, i, f;

  /// Adds it to the recordings under that name.
  dashpot_status add_to(dashpot_recordings* recordings, const char* name) const {
    const dashpot_named_column columns[] = {{"displacement [m]", {x.data(), 1}},
                                            {"velocity [m/s]", {v.data(), 1}},
                                            {"current [A]", {i.data(), 1}},
                                            {"force [N]", {f.data(), 1}}};
    const dashpot_table table = {name, x.size(), 0.005, columns, 4, nullptr};
    return dashpot_recordings_add(recordings, &table);
  }
};
