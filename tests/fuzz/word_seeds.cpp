#include <map>
#include <vector>

#include "dashpot/base/file.h"
#include "dashpot/controller.h"
#include "dashpot/record/excitation.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "fuzz.h"

namespace {

/// A call of the C boundary's target: bytes, then texts that end with zero.
std::string bytes(std::initializer_list<int> values, const std::string& text = {}) {
  std::string all;
  for (const int value : values) all += static_cast<char>(value);
  return text.empty() ? all : all + text + '\0';
}

/// A published damper, at rest, a step on, its force, a run; recordings of three columns,
/// evaluated.
std::string calls() {
  std::string add = bytes({7, 0, 20, 125, 3, 7, 150, 130, 3, 7, 150, 120, 1, 7, 130, 140, 2});
  add += bytes({}, "x_mm") + bytes({}, "F_N") + bytes({}, "u_V") + bytes({}, "one") +
         bytes({}, "{\"gap\": 1}");
  return bytes({0, 0, 3}, "spencer1997") + bytes({2, 0, 2, 130, 140, 150, 1}) +
         bytes({3, 0, 2, 130, 140, 150, 131, 141, 151, 1, 125}) +
         bytes({4, 0, 2, 130, 140, 150, 1}) +
         bytes({5, 0, 20, 125, 0, 4, 130, 140, 1, 5, 140, 150, 2, 1, 150, 150, 0, 2, 1}) +
         bytes({6, 0, 1}) + add + bytes({1, 0, 1, 1}) + bytes({8, 0, 0, 1}) +
         bytes({9, 0, 0}, "{\"threads\": 1}") + bytes({1}) + bytes({12}, "velocity [mm/s]") +
         bytes({1, 13});
}

const std::map<std::string, std::vector<std::string>> kSeeds{
    {"capi", {calls()}},
    {"units", {"mm", "N*s/m", "kN", "cm^-2", "degC", "displacement [mm]", "m/s\u00b2"}},
    {"quantity", {"72km/h", "0.004", "5 mm/s"}},
    {"json", {R"({"a": [1, -2.5e-3, true, null, "\u00e9"], "b": {"c": {}}})", "[[[[]]]]"}},
    {"yaml", {"a: [1, 2]\nb:\n  - c: &x 1\n  - *x\n", "- 'it''s'\n- \"\\\n\"\n"}},
    {"leave_out",
     {"current=0.87,1.98", "fraction=0.3", "record=a,b", "roles", "condition",
      "each=gap,pole_length"}},
    {"file_name", {"sine_5mm_3Hz_0.25A", "run 7 (2V)", "a_-1.5mA_b"}},
    {"road_file",
     {"distance [m],height [mm]\n0,0\n0.1,1\n0.2,-1\n0.3,0\n",
      "x_m z_m x_m z_m\n0 0 0 0\n1 0.1 1 0.2\n2 0.1 2 0.1\n"}},
    {"earthquake_file", {"time [s],acceleration [g0]\n0,0\n0.02,0.1\n0.04,-0.1\n0.06,0\n"}},
    {"curve_file", {"velocity [mm/s];force [N]\n-1000;-900\n0;0\n1000;1500\n"}},
    {"ground_words",
     {"iso8608,class=C,speed=72km/h", "step,height=3cm", "sine,frequency=2", "bump", "chirp",
      "iso8608_fft,class=A", "filtered,class=E", "measured,file=road.txt,speed=72km/h",
      "earthquake,file=el_centro.dat,unit=g0"}},
    {"controller_words",
     {"skyhook", "mix1,crossover=1.9Hz", "selector(skyhook/add),crossover=1.9Hz", "sh_add", "lqr",
      "fe_linear"}},
    {"damper_words",
     {"spencer1997,x0=0", "viscous,damping=1500", "ideal,damping_min=300,damping_max=3900",
      "suv_front,motion_ratio=0.7", "kwok2006"}},
    {"network_words",
     {"hidden=15-15,activation=relu", "trainer=adam,rate=1e-3,schedule=cosine,batch=64",
      "members=5", "l2=1e-4,patience=20", "training=free_run,window=100", "output=bounded"}},
    {"search_words", {"hidden=5,10,10-10", "l2=1e-5:1e-2", "members=1:5", "activation=tanh,relu"}},
    {"parameter_words",
     {"alpha=exponential\nn=2\nA\nc0=0:5000\nk0=500+-100", "bouc_wen.alpha=cubic\nk0=5N/cm"}},
    {"motion_words", {"AM", "AM,carrier=10,amplitude=4mm", "sine", "chirp", "RP"}},
    {"drive_words", {"constant", "SC", "RP", "ICPS,low=0.1"}},
    {"drive_options",
     {R"({"plant": "savaresi_spelta", "set": ["sprung_mass=350kg"], "dampers": ["viscous,damping=1500"],
          "controller": "mix1,crossover=1.9Hz", "inverse": "numeric", "current": 0, "current_max": 0,
          "lag_rate": -1, "sample_time": 0.001, "in_car": true, "delay": 0.01, "road": "step", "duration": 20,
          "output_step": 0.001, "seed": 1})",
      R"({"dampers": ["spencer1997"], "current": 1})"}},
    {"fit_options",
     {R"({"models": ["bouc_wen"], "force_offset": "record", "form": ["alpha=exponential"], "fix": ["n=2"],
          "free": [], "bounds": ["c0=0:5000"], "prior": ["k0=500+-100"], "network": [], "starts": 4, "search": 0,
          "seed": 1, "threads": 0, "command": "TEXT", "leave_out": "fraction=0.3"})",
      R"({"models": ["usual", "mlp_one_sensor"], "network": ["hidden=5", "trainer=adam"]})"}},
    {"load_options", {R"({"dataset": "FILE", "recognise": true, "velocity_cutoff": 20})"}},
    {"evaluate_options", {R"({"force_offset": "none", "threads": 2})"}},
    {"export_options",
     {R"({"to": ["c", "fmu3"], "folder": "out", "name": "front", "precision": "float",
                            "sample_time": 0.001, "compiler": "cc", "sources_only": true})"}},
    {"conditions", {R"({"gap": 0.001, "pole_length": 2e-3})"}}};

void write(const std::filesystem::path& folder, const char* target, std::string_view name) {
  dashpot::write_file(folder / target / ("name_" + std::string(name)), std::string(name));
}

}  // namespace

void write_word_seeds(const std::filesystem::path& folder) {
  // The names alone, from the tables.
  for (const auto& sequence : dashpot::motion_sequences())
    write(folder, "motion_words", sequence.info.name);
  for (const auto& sequence : dashpot::drive_sequences())
    write(folder, "drive_words", sequence.info.name);
  for (const auto& sequence : dashpot::ground_sequences())
    write(folder, "ground_words", sequence.info.name);
  for (const auto* law : dashpot::control_laws()) write(folder, "controller_words", law->name);
  for (const auto& [target, texts] : kSeeds)
    for (std::size_t k = 0; k < texts.size(); ++k)
      dashpot::write_file(folder / target / ("words_" + std::to_string(k)), texts[k]);
}
