#include <algorithm>
#include <array>

#include "dashpot/base/find_row.h"
#include "dashpot/export.h"
#include "dashpot/export/c/c_block.h"
#include "dashpot/export/c/c_source.h"
#include "dashpot/export/c/c_wrappers.h"
#include "dashpot/export/fmu/fmu.h"
#include "dashpot/export/js/js.h"
#include "dashpot/export/onnx/onnx.h"
#include "dashpot/export/tables/force_map.h"

namespace dashpot {
namespace {

std::vector<ExportedFile> write_c(const CBlockMaker& block, const ExportOptions& options) {
  return write_c_block(block(options), options.command);
}

constexpr std::array kExporters{
    Exporter{"c", "C99 for an ECU or a simulator", "every model, inverse and controller",
             "NAME.h, NAME.c and NAME_test.c, a main that checks them along a run", write_c_source,
             write_c},
    Exporter{"carsim", "damper table of CarSim", "every model, its states settled",
             "NAME_carsim.csv, settled force over the rate of compression, a column per current",
             write_carsim},
    Exporter{"dpr", "TeimOrbit damper curves of multibody programs",
             "every model, its states settled",
             "NAME_00.dpr ..., one curve of settled force over velocity per current", write_dpr},
    Exporter{
        "fmu2", "FMU of FMI 2.0 for a simulator",
        "every model, inverse and controller; model exchange for laws and models without a state",
        "NAME_fmi2.fmu with its sources and a binary for Linux", write_fmu2, write_fmu2_block},
    Exporter{
        "fmu3", "FMU of FMI 3.0 for a simulator",
        "every model, inverse and controller; model exchange for laws and models without a state",
        "NAME_fmi3.fmu with its sources and a binary for Linux", write_fmu3, write_fmu3_block},
    Exporter{"js", "JavaScript for a page or Node", "every model",
             "NAME.mjs, a module that steps it; a law's parameters can be set", write_js},
    Exporter{"mex", "C for MATLAB and Octave", "every model",
             "NAME.h, NAME.c and NAME_mex.c, which takes a matrix of inputs", write_mex},
    Exporter{"modelica", "Modelica package", "every model",
             "NAME/package.mo with a block and a force element, and its C code", write_modelica},
    Exporter{"onnx", "ONNX graphs for a runtime of networks", "every model, inverse and controller",
             "NAME.onnx, one step with its state, and NAME_rest.onnx, where a run begins",
             write_onnx, write_onnx_block},
    Exporter{"sfunction", "C for Simulink", "every model",
             "NAME.h, NAME.c and NAME_sfun.c, a level-2 S-function", write_sfunction},
    Exporter{"tables", "look-up tables", "every model, its states settled",
             "NAME_force.csv, NAME_current.csv (its inverse) and NAME.mat with both",
             write_tables}};

}  // namespace

void add_files(std::vector<ExportedFile> more, std::vector<ExportedFile>& files) {
  for (ExportedFile& file : more)
    if (std::ranges::find(files, file.name, &ExportedFile::name) == files.end())
      files.push_back(std::move(file));
}

std::span<const Exporter> exporters() { return kExporters; }

const Exporter& find_exporter(std::string_view name, const std::string& where) {
  return find_row(kExporters, name, "format", where);
}

}  // namespace dashpot
