#include <cstdint>
#include <cstdio>

#include "fuzz.h"

// The targets for libFuzzer: $DASHPOT_FUZZ names the one to attack; "list" prints their names.

namespace {

const FuzzTarget& chosen_target() {
  const char* name = std::getenv("DASHPOT_FUZZ");
  if (const FuzzTarget* target = find_fuzz_target(name ? name : "")) return *target;
  const bool listed = name && std::string_view(name) == "list";
  if (!listed) std::fputs("DASHPOT_FUZZ names none of the targets:\n", stderr);
  for (const FuzzTarget* target : fuzz_targets())
    std::fprintf(listed ? stdout : stderr, "%s\n", std::string(target->name()).c_str());
  std::exit(listed ? 0 : 2);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  (void)chosen_target();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FuzzTarget& target = chosen_target();
  target.run(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
