#include "work_routes.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "answers.h"
#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/controller.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/design/design_request.h"
#include "dashpot/error.h"
#include "dashpot/export.h"
#include "dashpot/physics/damper_description.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "export_files.h"
#include "job_kinds.h"

namespace fs = std::filesystem;

namespace dashpot::studio {
namespace {

using httplib::Request, httplib::Response;

Value rows_json(ParameterTable rows) {
  Value list = Value::array();
  for (const ParameterRow& row : rows)
    list.push_back(Value::object({{"name", row.name},
                                  {"unit", row.unit},
                                  {"default", row.value},
                                  {"lower", row.lower},
                                  {"upper", row.upper},
                                  {"meaning", row.meaning}}));
  return list;
}

Value choice_json(std::string_view name, std::string_view title, ParameterTable rows) {
  return Value::object({{"name", name}, {"title", title}, {"parameters", rows_json(rows)}});
}

/// Sets of numbers, then kinds with their defaults, each with what can be changed in it.
Value plants_json() {
  Value list = Value::array();
  for (const std::string& name : plant_set_names()) {
    const PlantSet set = load_plant_set(name);
    if (set.plant.tyres.empty()) continue;  // a building has no road
    Value choice = choice_json(name, set.plant.title, {});
    choice.add("kind", set.kind);
    Value values = Value::object();
    for (const auto& [value_name, value] : set.stated) values.add(value_name, value);
    choice.add("values", std::move(values));
    list.push_back(std::move(choice));
  }
  return list;
}

Value controllers_json() {
  Value list = Value::array();
  for (const ControlLaw* law : control_laws())
    list.push_back(choice_json(law->name, law->title, law->parameters));
  return list;
}

Value roads_json() {
  Value list = Value::array();
  for (const GroundSequence& sequence : ground_sequences())
    list.push_back(choice_json(sequence.info.name, sequence.info.title, sequence.info.params));
  return list;
}

/// Dampers that come with Dashpot: kinds, parameter sets, curves.
Value dampers_json() {
  Value list = Value::array();
  for (const SimpleDamper& damper : simple_dampers())
    list.push_back(choice_json(damper.name, damper.title, damper.parameters));
  for (const std::string& name : parameter_set_names())
    list.push_back(choice_json(name, load_parameter_set(name).damper, {}));
  for (const std::string& name : passive_curve_names())
    list.push_back(choice_json(name, "passive curve", {}));
  return list;
}

Value fields_json() {
  Value list = Value::array();
  for (const DescriptionField& field : description_fields())
    list.push_back(Value::object({{"name", field.name},
                                  {"unit", field.unit},
                                  {"default", field.value},
                                  {"lower", field.lower},
                                  {"upper", field.upper},
                                  {"meaning", field.meaning}}));
  return list;
}

Value quantities_json() {
  Value list = Value::array();
  for (const DesignQuantity& quantity : design_quantities())
    list.push_back(Value::object({{"name", quantity.name},
                                  {"unit", quantity.unit},
                                  {"shown_unit", shown_unit(quantity.unit).unit},
                                  {"meaning", quantity.meaning}}));
  return list;
}

/// The requests that come with Dashpot, as a form takes them.
Value requests_json() {
  Value list = Value::array();
  for (const std::string& name : request_names()) {
    const fs::path file = data_folder("designs") / (name + ".yaml");
    list.push_back(Value::object(
        {{"name", name}, {"request", parse_yaml(read_file(file), file.filename().string())}}));
  }
  return list;
}

Value fluids_json() {
  Value list = Value::array();
  for (const std::string& name : fluid_names()) list.push_back(name);
  return list;
}

/// A name for a browser's folder of downloads: RFC 5987.
std::string encoded(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-'
                ? std::string(1, c)
                : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return text;
}

}  // namespace

void act_on_job(Jobs& jobs, const JobKind& kind, const Value& body) {
  // What is neither of these is what the work is asked for.
  std::string action, name;
  Value asked = Value::object();
  for (const auto& [key, member] : body.members())
    if (key == "action")
      action = member.as_string();
    else if (key == "name")
      name = member.as_string();
    else
      asked.add(key, member);
  if (action == "start") return jobs.start(kind, name, asked);
  if (!asked.members().empty())
    throw Error("'" + asked.members().front().first + "'", "is not known here");
  if (action == "stop") return jobs.stop(kind, name);
  if (action == "go_on") return jobs.go_on(kind, name);
  throw Error("'" + action + "'", "is no action", "start, stop or go_on");
}

void WorkRoutes::add(httplib::Server& server) {
  add_work(server);
  add_machine(server);
  add_design(server);
  add_export(server);
}

void WorkRoutes::add_work(httplib::Server& server) {
  server.Get("/api/work/([a-z]+)", [this](const Request& request, Response& response) {
    answer(response, Value::object({{"work", jobs_.list(job_kind(request.matches[1].str()))}}));
  });
  server.Post("/api/work/([a-z]+)", [this](const Request& request, Response& response) {
    act_on_job(jobs_, job_kind(request.matches[1].str()), body_of(request));
    answer(response, Value::object({{"done", true}}));
  });

  // What a command wrote for programs, and for people.
  const auto result = [this](const Request& request) {
    const JobKind& kind = job_kind(request.matches[1].str());
    return project_.inside(std::string(kind.folder) + "/" + request.matches[2].str() + "/" +
                           std::string(kind.result));
  };
  server.Get("/api/result/([a-z]+)/([^/]+)", [result](const Request& request, Response& response) {
    response.set_content(read_file(result(request).replace_extension(".json")), "application/json");
  });
  server.Get("/report/([a-z]+)/([^/]+)", [result](const Request& request, Response& response) {
    answer_report(response, result(request));
  });
}

void WorkRoutes::add_machine(httplib::Server& server) {
  // What a vehicle can be put together of.
  server.Get("/api/machine", [](const Request&, Response& response) {
    Value kinds = Value::array();
    for (const PlantModel* model : plant_models())
      kinds.push_back(choice_json(model->name, model->title, model->parameters));
    answer(response, Value::object({{"plants", plants_json()},
                                    {"kinds", std::move(kinds)},
                                    {"controllers", controllers_json()},
                                    {"roads", roads_json()},
                                    {"dampers", dampers_json()},
                                    {"mounting", rows_json(mounting_settings())}}));
  });
  server.Get("/api/dampers", [this](const Request&, Response& response) {
    std::vector<std::string> models = project_.models("fits");
    for (const std::string& design : project_.models("designs")) models.push_back(design);
    answer(response, Value::object({{"models", Value::array(models)}}));
  });

  // One drive, and its signals as they are looked at.
  server.Post("/api/drive", [this](const Request& request, Response& response) {
    answer(response, drives_.drive(body_of(request)));
  });
  server.Get("/api/driven", [this](const Request& request, Response& response) {
    draw(SampleView(drives_.traces(request.get_param_value("key"))), request, response);
  });
}

void WorkRoutes::add_design(httplib::Server& server) {
  server.Get("/api/design", [](const Request&, Response& response) {
    answer(response, Value::object({{"requests", requests_json()},
                                    {"dampers", Value::array(description_names())},
                                    {"fields", fields_json()},
                                    {"fluids", fluids_json()},
                                    {"quantities", quantities_json()}}));
  });
}

void WorkRoutes::add_export(httplib::Server& server) {
  // The formats that there are, and the exports of this project.
  server.Get("/api/formats", [](const Request&, Response& response) {
    Value list = Value::array();
    for (const Exporter& exporter : exporters())
      list.push_back(Value::object({{"name", exporter.name},
                                    {"title", exporter.title},
                                    {"takes", exporter.takes},
                                    {"files", exporter.files}}));
    answer(response, Value::object({{"formats", std::move(list)}}));
  });
  server.Get("/api/exports", [this](const Request&, Response& response) {
    answer(response, Value::object({{"exports", exports(project_)}}));
  });

  // A new export, and one file of an export or all of them as an archive.
  server.Post("/api/export", [this](const Request& request, Response& response) {
    answer(response, export_model(project_, body_of(request)));
  });
  server.Get("/api/exported", [this](const Request& request, Response& response) {
    const Download download =
        exported(project_, request.get_param_value("folder"), request.get_param_value("file"));
    response.set_header("Content-Disposition",
                        "attachment; filename*=UTF-8''" + encoded(download.name));
    response.set_content(download.content, download.type);
  });
}

}  // namespace dashpot::studio
