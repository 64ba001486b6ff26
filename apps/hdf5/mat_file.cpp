#include <matio.h>
#include <memory>

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/record/mat_bytes.h"
#include "dashpot/record/readers/mat_guard.h"
#include "made_files.h"

namespace dashpot {
namespace {

using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using MatData = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

[[noreturn]] void fail_to_write(const std::string& what) {
  throw Error("MAT file", "matio cannot write " + what,
              "is the memory full, or a limit on the size of files too small?");
}

void add_variable(mat_t* file, const MatVariable& variable) {
  std::size_t size[2] = {variable.rows, variable.columns};
  if (variable.is_text) size[0] = 1, size[1] = variable.text.size();
  const void* data = variable.is_text ? static_cast<const void*>(variable.text.data())
                                      : static_cast<const void*>(variable.values.data());
  const MatData written(
      Mat_VarCreate(variable.name.c_str(), variable.is_text ? MAT_C_CHAR : MAT_C_DOUBLE,
                    variable.is_text ? MAT_T_UTF8 : MAT_T_DOUBLE, 2, size, const_cast<void*>(data),
                    MAT_F_DONT_COPY_DATA),
      Mat_VarFree);
  if (!written || Mat_VarWrite(file, written.get(), MAT_COMPRESSION_NONE) != 0)
    fail_to_write(variable.name);
}

std::size_t variables_in(const std::string& name) {
  const MatFile file(Mat_Open(name.c_str(), MAT_ACC_RDONLY), Mat_Close);
  std::size_t count = 0;
  while (file && MatData(Mat_VarReadNextInfo(file.get()), Mat_VarFree)) ++count;
  return count;
}

/// A variable as mat_bytes hands it over.
MatVariable variable_of(UnpackedBytes& request) {
  MatVariable variable;
  variable.name = request.text();
  variable.is_text = request.number() != 0;
  variable.rows = request.number();
  variable.columns = request.number();
  variable.values = request.column();
  variable.text = request.text();
  return variable;
}

}  // namespace

std::string mat_file(UnpackedBytes request) {
  const std::string header = request.text();
  std::vector<MatVariable> variables(request.number());
  for (MatVariable& variable : variables) variable = variable_of(request);

  // Matio writes to names only, and does not look at what its writes return.
  const MemoryFile memory;
  {
    const MatFile file(Mat_CreateVer(memory.name().c_str(),
                                     header.empty() ? nullptr : header.c_str(), MAT_FT_MAT5),
                       Mat_Close);
    if (!file) fail_to_write("to memory");
    for (const MatVariable& variable : variables) add_variable(file.get(), variable);
  }

  // So what it wrote is looked at: every variable is there, and as long as it says.
  std::string bytes = memory.content();
  const auto is_whole = [&] {
    try {
      check_mat(bytes, "MAT file");
      return variables_in(memory.name()) == variables.size();
    } catch (const Error&) {
      return false;
    }
  };
  if (!is_whole()) fail_to_write("all of it");
  return bytes;
}

}  // namespace dashpot
