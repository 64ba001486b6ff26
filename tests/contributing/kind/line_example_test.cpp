#include "contributing/kind/line_example_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/identify.h"
#include "model_sheet.h"
#include "support.h"

using namespace dashpot;

namespace {

Dataset bench() {
  BenchOptions options;
  options.motions = {{0.01, 1}};
  options.drive_levels = {0.5, 1};
  options.sample_rate = 100;
  return run_virtual_bench(load_parameters("kwok2006"), DriveUnit::Ampere, options);
}

}  // namespace

TEST_CASE("the example kind: its rows list it, fit it, print it and make C of it") {
  CHECK(model_info("line_example").kind == ModelKind::LineExample);
  CHECK(name_of(ModelKind::LineExample) == "line_example");
  CHECK(cli::model_sheet("line_example").numbers == 1);
  CHECK(c_model(LineExampleModel(1000, 5)).code.find("input->velocity") != std::string::npos);
  const FitReport fit = identify("line_example", bench().records, DriveUnit::Ampere, {});
  REQUIRE(fit.status == FitReport::Status::Converged);
  CHECK(model_as<LineExampleModel>(*fit.model)->damping() > 0);
}

TEST_CASE("the example kind: its file comes back as it was") {
  ModelFile saved;
  saved.model = std::make_unique<LineExampleModel>(1000.0 / 3, 5);
  const std::string text = format_model(saved);
  CHECK(text.find("\"kind\": \"line_example\"") != std::string::npos);
  CHECK(format_model(parse_model(text, "m.json")) == text);
}
