#pragma once
#include <array>
#include <cstdarg>
#include <cstdint>
#include <dlfcn.h>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>
#include <zip.h>

#include <pugixml.hpp>

#include "dashpot/export/c/c_block.h"
#include "export/example_models.h"
#include "support.h"

/// The files in a zip archive. Throws where it is none.
inline std::map<std::string, std::string> unzipped(const std::string& archive) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(archive.data(), archive.size(), 0, &error);
  zip_t* zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (!zip) {
    zip_source_free(source);
    throw std::runtime_error(std::string("zip: ") + zip_error_strerror(&error));
  }
  std::map<std::string, std::string> files;
  for (zip_int64_t k = 0; k < zip_get_num_entries(zip, 0); ++k) {
    zip_stat_t about;
    zip_stat_index(zip, static_cast<zip_uint64_t>(k), 0, &about);
    std::string& content = files[about.name];
    content.resize(about.size);
    zip_file_t* file = zip_fopen_index(zip, static_cast<zip_uint64_t>(k), 0);
    REQUIRE(zip_fread(file, content.data(), about.size) == static_cast<zip_int64_t>(about.size));
    zip_fclose(file);
  }
  zip_discard(zip);
  return files;
}

/// An FMU as an importer has it: its files, its description and its library.
class LoadedFmu {
 public:
  explicit LoadedFmu(const std::string& archive) : files(unzipped(archive)) {
    REQUIRE(description_.load_string(files.at("modelDescription.xml").c_str()));
    version = root().attribute("fmiVersion").value()[0] - '0';
    for (const auto& [name, content] : files) {
      if (!name.ends_with(".so")) continue;
      const std::filesystem::path path = folder_.write("fmu.so", content);
      library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (!library_) FAIL(dlerror());
    }
  }
  LoadedFmu(const LoadedFmu&) = delete;
  LoadedFmu& operator=(const LoadedFmu&) = delete;
  ~LoadedFmu() {
    if (library_) dlclose(library_);
  }

  pugi::xml_node root() const { return description_.child("fmiModelDescription"); }
  /// "{...}"
  std::string token() const {
    return root().attribute(version == 2 ? "guid" : "instantiationToken").value();
  }
  bool exchanges() const { return !root().child("ModelExchange").empty(); }
  unsigned reference(const std::string& name) const {
    for (const pugi::xml_node variable : root().child("ModelVariables"))
      if (variable.attribute("name").value() == name)
        return variable.attribute("valueReference").as_uint();
    FAIL("no variable " << name);
    return 0;
  }
  std::string library_path() const { return (folder_.path() / "fmu.so").string(); }

  /// Calls "fmi2" or "fmi3" + name: each argument must have the type that the function takes.
  template <class Result = int, class... Arguments>
  Result call(const std::string& name, Arguments... arguments) const {
    void* function = dlsym(library_, ((version == 2 ? "fmi2" : "fmi3") + name).c_str());
    if (!function) FAIL(name << " is not exported");
    return reinterpret_cast<Result (*)(Arguments...)>(function)(arguments...);
  }

  int version = 0;
  std::map<std::string, std::string> files;

 private:
  TemporaryFolder folder_;
  pugi::xml_document description_;
  void* library_ = nullptr;
};

using Messages = std::vector<std::string>;
using Log2 = void (*)(void*, const char*, int, const char*, const char*, ...);
using Log3 = void (*)(void*, int, const char*, const char*);
inline void log2(void* messages, const char*, int, const char*, const char* text, ...) {
  static_cast<Messages*>(messages)->push_back(text);
}
inline void log3(void* messages, int, const char*, const char* text) {
  static_cast<Messages*>(messages)->push_back(text);
}

struct Callbacks2 {
  Log2 logger;
  void* (*allocate)(std::size_t, std::size_t);
  void (*release)(void*);
  void (*finished)(void*, int);
  void* environment;
};

/// One instance, whichever version it speaks. Calls return FMI's status: 0 is fine, 3 an error.
class FmuInstance {
 public:
  FmuInstance(const LoadedFmu& fmu, bool exchange, const std::string& token = {}) : fmu_(fmu) {
    const std::string own = token.empty() ? fmu.token() : token;
    void* log = &messages;
    if (fmu.version == 2) {
      callbacks_ = {log2, std::calloc, std::free, nullptr, log};
      handle = fmu.call<void*>("Instantiate", "one", exchange ? 0 : 1, own.c_str(), "",
                               static_cast<const Callbacks2*>(&callbacks_), 0, 0);
    } else if (exchange) {
      handle = fmu.call<void*>("InstantiateModelExchange", "one", own.c_str(), "", false, false,
                               log, Log3(log3));
    } else {
      handle = fmu.call<void*>("InstantiateCoSimulation", "one", own.c_str(), "", false, false,
                               false, false, static_cast<const unsigned*>(nullptr), std::size_t{0},
                               log, Log3(log3), static_cast<void*>(nullptr));
    }
  }
  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;
  ~FmuInstance() { fmu_.call<void>("FreeInstance", handle); }

  int set(std::vector<unsigned> references, std::vector<double> values) {
    const unsigned* vr = references.data();
    const double* v = values.data();
    return fmu_.version == 2
               ? fmu_.call("SetReal", handle, vr, references.size(), v)
               : fmu_.call("SetFloat64", handle, vr, references.size(), v, values.size());
  }
  int get(std::vector<unsigned> references, std::vector<double>& values) {
    values.resize(references.size());
    const unsigned* vr = references.data();
    return fmu_.version == 2 ? fmu_.call("GetReal", handle, vr, references.size(), values.data())
                             : fmu_.call("GetFloat64", handle, vr, references.size(), values.data(),
                                         values.size());
  }
  int set_inputs(const std::vector<double>& inputs) {
    std::vector<unsigned> references(inputs.size());
    std::iota(references.begin(), references.end(), 1U);
    return set(references, inputs);
  }
  int set(const dashpot::DamperInput& input) {
    return set_inputs({input.displacement, input.velocity, input.current});
  }
  double get(const std::string& name) {
    std::vector<double> value;
    CHECK(get({fmu_.reference(name)}, value) == 0);
    return value[0];
  }
  int enter_initialization(double start = 0) {
    if (fmu_.version == 3)
      return fmu_.call("EnterInitializationMode", handle, false, 0.0, start, false, 0.0);
    const int status = fmu_.call("SetupExperiment", handle, 0, 0.0, start, 0, 0.0);
    return status ? status : fmu_.call("EnterInitializationMode", handle);
  }
  int exit_initialization() { return fmu_.call("ExitInitializationMode", handle); }
  void initialize_at(const std::vector<double>& inputs) {
    CHECK(enter_initialization() == 0);
    CHECK(set_inputs(inputs) == 0);
    CHECK(exit_initialization() == 0);
  }
  void initialize(const dashpot::DamperInput& input) {
    initialize_at({input.displacement, input.velocity, input.current});
  }
  int step(double time, double length) {
    if (fmu_.version == 2) return fmu_.call("DoStep", handle, time, length, 0);
    std::array<bool, 3> answers{};
    double last = 0;
    return fmu_.call("DoStep", handle, time, length, false, &answers[0], &answers[1], &answers[2],
                     &last);
  }

  void* handle = nullptr;
  Messages messages;

 private:
  const LoadedFmu& fmu_;
  Callbacks2 callbacks_{};
};

/// The archive of a model, as a user gets it.
inline std::string shipped_fmu_of(const dashpot::ExportedModel& model, int version,
                                  const dashpot::ExportOptions& options = {}) {
  const dashpot::Exporter& exporter = dashpot::find_exporter(version == 2 ? "fmu2" : "fmu3");
  return exporter.write(model, options).front().content;
}

/// Its library compiled quickly, and with sanitizers where the tests are.
inline dashpot::ExportOptions compiled_quickly(dashpot::ExportOptions options) {
#ifdef __SANITIZE_ADDRESS__
  // By the compiler of the tests: sanitizers of two compilers cannot be in one program.
  options.compiler = own_c_compiler() +
                     " -fsanitize=address,undefined -fno-sanitize-recover=undefined -Wl,-z,undefs";
#endif
  options.compiler += " -O0";
  return options;
}

inline std::string fmu_of(const dashpot::ExportedModel& model, int version,
                          const dashpot::ExportOptions& options = {}) {
  return shipped_fmu_of(model, version, compiled_quickly(options));
}

inline std::string fmu_of(const dashpot::CBlockMaker& block, int version,
                          const dashpot::ExportOptions& options = {}) {
  const dashpot::Exporter& exporter = dashpot::find_exporter(version == 2 ? "fmu2" : "fmu3");
  return exporter.write_block(block, compiled_quickly(options)).front().content;
}

inline bool has_compiler() {
  if (run_program("cc --version").exit_code == 0) return true;
  MESSAGE("SKIPPED: no C compiler is here");
  return false;
}
