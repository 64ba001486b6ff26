#include "studies/family/training_store.h"

#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/identify/rank/fit_identity.h"
#include "dashpot/value.h"

namespace dashpot {

TrainingStore::TrainingStore(const std::filesystem::path& path, const std::string& program,
                             const std::vector<Record>& data)
    : basis_(sha256(program + '\n' + fingerprint(data)) + ' '), store_(path, kFormat) {}

bool TrainingStore::load(const std::string& key, StudiedNetwork& network) const {
  const std::optional<std::string> bytes = store_.load(basis_ + key);
  if (!bytes) return false;

  // A damaged training is as good as none: the caller makes it again and saves it in this one's
  // place.
  try {
    const Value value = parse_json(*bytes, key);
    ObjectReader reader(value, "a kept training");
    std::vector<double> parameters = reader.required("parameters").as_numbers();
    if (parameters.size() != Mlp::parameter_count(network.mlp.layers)) return false;
    network.history = reader.required("history").as_numbers();
    network.seconds = reader.number("seconds");
    network.mlp.parameters = std::move(parameters);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void TrainingStore::save(const std::string& key, const StudiedNetwork& network) {
  store_.save(basis_ + key,
              format_json(Value::object({{"parameters", Value::array(network.mlp.parameters)},
                                         {"history", Value::array(network.history)},
                                         {"seconds", network.seconds}}),
                          false));
}

}  // namespace dashpot
