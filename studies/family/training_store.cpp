#include "studies/family/training_store.h"

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

constexpr std::string_view kFormat = "dashpot training 1";

}  // namespace

TrainingStore::TrainingStore(std::filesystem::path folder, std::string program,
                             const std::vector<Record>& data)
    : folder_(std::move(folder)), basis_(std::move(program) + '\n' + fingerprint(data) + '\n') {}

std::filesystem::path TrainingStore::file_of(const std::string& key) const {
  return folder_ / (sha256(basis_ + key).substr(0, 24) + ".json");
}

bool TrainingStore::load(const std::string& key, StudiedNetwork& network) const {
  const std::filesystem::path path = file_of(key);
  if (!std::filesystem::exists(path)) return false;
  try {
    const Value document = parse_json(read_file(path), path.string());
    ObjectReader reader(document, "a kept training");
    if (reader.string("format") != kFormat || reader.string("key") != key) return false;
    std::vector<double> parameters = reader.required("parameters").as_numbers();
    if (parameters.size() != Mlp::parameter_count(network.mlp.layers)) return false;
    network.history = reader.required("history").as_numbers();
    network.seconds = reader.number("seconds");
    network.mlp.parameters = std::move(parameters);
    return true;
  } catch (const Error&) {  // damaged or from elsewhere: the training is made again
    return false;
  }
}

void TrainingStore::save(const std::string& key, const StudiedNetwork& network) const {
  write_file(file_of(key),
             format_json(Value::object({{"format", kFormat},
                                        {"key", key},
                                        {"parameters", Value::array(network.mlp.parameters)},
                                        {"history", Value::array(network.history)},
                                        {"seconds", network.seconds}}),
                         false));
}

}  // namespace dashpot
