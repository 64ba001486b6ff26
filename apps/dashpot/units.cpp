#include "units.h"

#include "dashpot/error.h"

namespace dashpot::cli {
namespace {

PrintUnits parsed(const std::string& stated) {
  try {
    return PrintUnits::parse(stated, "");
  } catch (const Error& error) {
    throw UsageError("--units", error.what());
  }
}

}  // namespace

Option units_option(std::string& units) {
  return {.names = "--units",
          .target = &units,
          .help = "units of force and speed, as lbf,in/s or kN,m/s; JSON and models stay in SI",
          .value = "FORCE,SPEED",
          .default_text = "N,mm/s; in CSV SI"};
}

PrintUnits page_units(const std::string& stated) {
  return stated.empty() ? PrintUnits() : parsed(stated);
}

PrintUnits file_units(const std::string& stated) {
  return stated.empty() ? PrintUnits::si() : parsed(stated);
}

}  // namespace dashpot::cli
