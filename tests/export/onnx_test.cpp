#if defined(DASHPOT_ONNX)
#include <onnx/checker.h>
#include <onnx/defs/schema.h>
#include <onnx/onnx_pb.h>
#include <onnx/shape_inference/implementation.h>
#endif

#include "conformance/control_cases.h"
#include "dashpot/base/text.h"
#include "dashpot/export/onnx/onnx.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("ONNX: a model without a state is one file, one with a state brings where it begins" *
          doctest::test_suite("long")) {
  for (const ExampleModel& example : example_models()) {
    if (example.name != "mlp" && example.name != "narx") continue;
    const std::vector<ExportedFile> files = write_onnx(exported(*example.model), {.name = "x"});
    REQUIRE(files.size() == (example.name == "mlp" ? 1 : 2));
    CHECK(files[0].name == "x.onnx");
    if (files.size() > 1) CHECK(files[1].name == "x_rest.onnx");
  }
}

TEST_CASE("ONNX: what C does not know is refused as C does, and so is a wrong sample time") {
  const LawModel model = example_law(find_law("dahl"));
  CHECK(message_of([&] {
          write_onnx(exported(model), {.name = "2nd"});
        }).find("cannot begin names") != std::string::npos);
  CHECK(message_of([&] {
          write_onnx(exported(model), {.sample_time = -1});
        }).find("a positive number") != std::string::npos);
}

TEST_CASE("ONNX: a force that never changes is a graph, too") {
  const LawModel model = LawModel::constant(find_law("bingham"), {0, 0, 5, 0});
  CHECK(write_onnx(exported(model), {.name = "x"}).size() == 1);
}

#if defined(DASHPOT_ONNX)
namespace {

onnx::ModelProto parsed(const std::string& content) {
  onnx::ModelProto model;
  REQUIRE(model.ParseFromString(content));
  return model;
}

std::string metadata(const onnx::ModelProto& model, const std::string& key) {
  for (const auto& entry : model.metadata_props())
    if (entry.key() == key) return entry.value();
  return "none";
}

/// "velocity[batch,1] state[batch,4]"
std::string faces(const google::protobuf::RepeatedPtrField<onnx::ValueInfoProto>& values) {
  std::string out;
  for (const auto& value : values) {
    const auto& shape = value.type().tensor_type().shape();
    out += (out.empty() ? "" : " ") + value.name() + '[' + shape.dim(0).dim_param() + ',' +
           std::to_string(shape.dim(1).dim_value()) + ']';
  }
  return out;
}

void check_files(const std::vector<ExportedFile>& files, const std::string& of,
                 CPrecision precision) {
  CAPTURE(of);
  for (const ExportedFile& file : files) {
    CAPTURE(file.name);
    onnx::ModelProto model = parsed(file.content);
    CHECK(message_of([&] {
            onnx::checker::check_model(model);
            onnx::shape_inference::InferShapes(model, onnx::OpSchemaRegistry::Instance(),
                                               {true, 1, true});
          }) == "");
    CHECK(model.ir_version() <= 8);
    REQUIRE(model.opset_import_size() == 1);
    CHECK(model.opset_import(0).version() <= 17);
    const int type =
        precision == CPrecision::Single ? onnx::TensorProto::FLOAT : onnx::TensorProto::DOUBLE;
    for (const auto& input : model.graph().input())
      CHECK(input.type().tensor_type().elem_type() == type);
  }
}

}  // namespace

TEST_CASE(
    "ONNX: Debian's checker, with the shapes that it infers, finds nothing in any model or block" *
    doctest::test_suite("long")) {
  for (const CPrecision precision : {CPrecision::Single, CPrecision::Double}) {
    const ExportOptions options{.name = "x", .precision = precision};
    for (const ExampleModel& example : example_models())
      check_files(write_onnx(exported(*example.model), options), example.name, precision);
    for (const BlockCase& one : block_cases())
      check_files(write_onnx_block(one.block, options), one.name, precision);
  }
}

TEST_CASE(
    "ONNX: a block has a tensor per port, of a column per strut; what is not read is left out") {
  const Vehicle car = make_vehicle({.plant = "ikenaga2000",
                                    .dampers = {"ideal"},
                                    .controller = "feb",
                                    .sample_time = 2e-3,
                                    .sensors = {.in_car = true}});
  const std::vector<ExportedFile> files = write_onnx_block(
      [&](const ExportOptions& options) { return c_controller_block(car, options); },
      {.name = "x", .command = "dashpot export x", .version = "1"});
  REQUIRE(files.size() == 2);
  CHECK(files[1].name == "x_rest.onnx");
  const onnx::ModelProto step = parsed(files[0].content), rest = parsed(files[1].content);
  CHECK(faces(step.graph().input()) == "deflection[batch,4] state[batch,16]");
  CHECK(faces(step.graph().output()) == "command[batch,4] next_state[batch,16]");
  CHECK(faces(rest.graph().input()) == "deflection[batch,4]");
  CHECK(faces(rest.graph().output()) == "command[batch,4] state[batch,16]");
  CHECK(step.graph().input(0).doc_string() == "m, of the strut, extension positive");
  CHECK(step.doc_string() == "One step of 0.002 s of the controller feb for ikenaga2000");
  CHECK(metadata(step, "model") == "the controller feb for ikenaga2000");
  CHECK(metadata(step, "sample_time") == "0.002 s");
  CHECK(metadata(step, "units") == "deflection m");
  CHECK(metadata(step, "state").find("state_0, state_1") == 0);
  CHECK(metadata(step, "state_at_rest").find("0, 0") == 0);
  CHECK(metadata(step, "command") == "dashpot export x");
}

TEST_CASE(
    "ONNX: a block without a state is one file, in single precision if nothing else is said") {
  const LawModel law = example_law(find_law("bingham"));
  const auto rule = find_inverse("heaviside").make(law, {0, 2, 1e-3, 0});
  const std::vector<ExportedFile> files = write_onnx_block(
      [&](const ExportOptions& options) {
        return c_inverse_block({.model = *rule, .domain = exported(law).domain}, options);
      },
      {});
  REQUIRE(files.size() == 1);
  CHECK(files[0].name == "heaviside_inverse.onnx");
  const onnx::ModelProto model = parsed(files[0].content);
  CHECK(faces(model.graph().input()) ==
        "wanted[batch,1] displacement[batch,1] velocity[batch,1] current[batch,1]");
  CHECK(faces(model.graph().output()) == "command[batch,1]");
  CHECK(model.graph().input(0).type().tensor_type().elem_type() == onnx::TensorProto::FLOAT);
}

TEST_CASE("ONNX: inputs and outputs have names and a batch, metadata say what they are") {
  const LawModel law = example_law(find_law("bouc_wen"));
  const std::vector<ExportedFile> files =
      write_onnx(exported(law),
                 {.name = "x", .sample_time = 2e-3, .command = "dashpot export x", .version = "1"});
  const onnx::ModelProto step = parsed(files[0].content), rest = parsed(files[1].content);
  CHECK(faces(step.graph().input()) ==
        "displacement[batch,1] velocity[batch,1] current[batch,1] state[batch,4]");
  CHECK(faces(step.graph().output()) == "force[batch,1] next_state[batch,4]");
  CHECK(faces(rest.graph().input()) == "displacement[batch,1] velocity[batch,1] current[batch,1]");
  CHECK(faces(rest.graph().output()) == "force[batch,1] state[batch,4]");
  CHECK(step.graph().input(1).doc_string() == "m/s, extension positive");
  CHECK(step.producer_name() == "Dashpot");
  CHECK(step.producer_version() == "1");
  CHECK(metadata(step, "model") == "bouc_wen");
  CHECK(metadata(step, "sample_time") == "0.002 s");
  CHECK(metadata(step, "units") == "displacement m, velocity m/s, current A, force N");
  CHECK(metadata(step, "domain_velocity") == "-0.3 ... 0.3 m/s");
  CHECK(metadata(step, "state") == "previous_velocity, previous_current, z, coil_current");
  CHECK(metadata(step, "state_at_rest") == "0, 0, 0, 0");
  CHECK(metadata(step, "command") == "dashpot export x");
}

TEST_CASE("ONNX: layers are Gemm, whatever the C code says number by number") {
  const NetworkModel network("mlp_one_sensor", {"velocity", "current"}, {example_mlp(1)});
  const onnx::ModelProto model = parsed(write_onnx(exported(network), {.name = "x"})[0].content);
  std::string operators;
  for (const auto& node : model.graph().node()) operators += node.op_type() + ' ';
  CHECK(operators == "Concat Gemm Tanh Gemm Identity ");
}
#endif
