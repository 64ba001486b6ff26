#include "dashpot/export/c/c_block.h"

#include "dashpot/base/escape.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_rewrite.h"

namespace dashpot {
namespace {

constexpr const char* kBlockTest =
    R"(/* Steps through a run and compares the commands with those of Dashpot @version@ in
 * double precision. Returns 0 when they agree within @tolerance@ of their range wherever a command
 * makes a difference. */
#include "@prefix@.h"

#include <math.h>
#include <stdio.h>

#define STEPS @steps@
#define INPUTS @inputs@
#define COMMANDS @commands@

/* what is known, field by field; the commands; 1 where they make a difference */
static const double kRun[STEPS][INPUTS + COMMANDS + 1] = {
@rows@};
@scales@
static void read_input(const double* row, damper_input* input) {
@reads@}

int main(void) {
  damper_model model;
  double largest = 0.0;
  int k, j;
  for (k = 0; k < STEPS; ++k) {
    damper_input input;
    double commands[COMMANDS];
    read_input(kRun[k], &input);
    if (k == 0) {
      damper_reset(&model, &input);
    }
    @step@
    for (j = 0; j < COMMANDS; ++j) {
      const double difference = fabs(commands[j] - kRun[k][INPUTS + j])@scaled@;
      if (!(difference <= @range@)) {
        return 2;
      }
      largest = fmax(largest, difference * kRun[k][INPUTS + COMMANDS]);
    }
  }
  printf("largest difference %g, range %g\n", (double)largest, (double)@range@);
  return (largest <= @tolerance@ * @range@) ? 0 : 1;
}
)";

std::string rows_of(const CBlock& block) {
  std::string rows;
  for (const CBlock::Sample& sample : block.samples) {
    std::vector<double> row = sample.inputs;
    row.insert(row.end(), sample.commands.begin(), sample.commands.end());
    row.push_back(sample.matters ? 1 : 0);
    rows += "    " + c_numbers(row) + ",\n";
  }
  return rows;
}

std::string finished(const CBlock& block, const std::string& text, const std::string& name,
                     const std::string& command) {
  return filled(
      with_prefix(in_precision(filled(text, {{"prefix", CText::own(name)}}), block.precision),
                  name),
      {{"command", c_comment(command)}});
}

}  // namespace

std::string CPort::at(std::size_t which) const {
  const std::size_t mark = place.find('#');
  return mark == std::string::npos ? place
                                   : std::string(place).replace(mark, 1, std::to_string(which));
}

std::string c_block_reads(const CBlock& block) {
  std::string lines;
  std::size_t place = 0;
  for (const CPort& port : block.inputs)
    for (std::size_t k = 0; k < port.count; ++k)
      lines += "  input->" + port.at(k) + " = row[" + std::to_string(place++) + "];\n";
  return lines;
}

std::vector<ExportedFile> c_block_sources(const CBlock& block, const std::string& name,
                                          const std::string& command) {
  if (name != "damper") require_free_names(name, block.source);
  return {{name + ".h", finished(block, block.header, name, command)},
          {name + ".c", finished(block, block.source, name, command)}};
}

std::vector<ExportedFile> write_c_block(const CBlock& block, const std::string& command) {
  std::vector<ExportedFile> files = c_block_sources(block, block.name, command);
  const std::string test =
      filled(kBlockTest,
             {{"version", c_comment(block.version)},
              {"steps", CText::own(std::to_string(block.samples.size()))},
              {"inputs", CText::own(std::to_string(block.samples.front().inputs.size()))},
              {"commands", CText::own(std::to_string(block.samples.front().commands.size()))},
              {"reads", CText::own(c_block_reads(block))},
              {"step", CText::own(block.step)},
              {"range", CText::own(c_number(block.range))},
              {"tolerance", CText::own(c_number(block.tolerance))},
              {"scaled", CText::own(block.scales.empty() ? "" : " / kScales[j]")},
              {"scales", CText::own(block.scales.empty() ? "" : c_table("kScales", block.scales))},
              {"rows", CText::own(rows_of(block))}});
  files.push_back({block.name + "_test.c", finished(block, test, block.name, command)});
  return files;
}

}  // namespace dashpot
