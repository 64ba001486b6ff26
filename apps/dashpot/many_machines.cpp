#include "many_machines.h"

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/ranks.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"

namespace dashpot::cli {

std::vector<Option> many_machines_options(ManyMachines& settings) {
  return {{.names = "--part",
           .target = &settings.part,
           .help = "do this share of the work only, as 3/16, and keep it in DIR: 'dashpot merge' "
                   "joins the parts, and the same command without --part goes on from there",
           .value = "K/N",
           .default_text = "all of it"},
          {.names = "--simd",
           .target = &settings.simd,
           .help = "the processor's instructions to use: sse2, avx2 or avx512. Unlike processors "
                   "give the same bits only with the same ones",
           .value = "LEVEL",
           .choices = {"sse2", "avx2", "avx512"},
           .default_text = "the widest that this processor has"}};
}

Part settle_machines(const ManyMachines& settings) {
  try {
    if (!settings.simd.empty()) use_simd(settings.simd, "--simd");
    return settings.part.empty() ? Part() : parse_part(settings.part, "--part");
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }
}

bool are_dealt_out(const Part& part) { return !part.is_all() || !ranks().is_alone(); }

int finish_part(const PartReport& report, const Part& part, const std::string& what,
                const std::filesystem::path& store, Console& console) {
  console.print(fmt::format(
      "Part {}: {} of {}{}, kept in {}\n", format_part(part), report.tasks,
      counted(report.all, what),
      report.kept ? fmt::format(" ({} of them from before)", report.kept) : "", store.string()));
  console.talk(
      "When all parts are there: 'dashpot merge PART... --output DIR', then the same command with "
      "--output DIR and without --part.\n");
  if (console.json)
    console.print_json(Value::object({{"part", part.number},
                                      {"parts", part.of},
                                      {"tasks", report.tasks},
                                      {"all_tasks", report.all},
                                      {"kept", report.kept},
                                      {"store", store.string()}}));
  return kDone;
}

}  // namespace dashpot::cli
