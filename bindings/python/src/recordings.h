#pragma once
#include "arrays.h"

namespace dashpot_python {

/// Columns by their names, which live as long as this; `arrays` keeps the samples.
struct NamedColumns {
  NamedColumns(const py::dict& table, Columns& arrays) {
    std::vector<dashpot_column> samples;
    for (const auto& [key, values] : table) {
      names.push_back(py::str(key));
      samples.push_back(
          arrays.add(py::reinterpret_borrow<py::object>(values), names.back().c_str()));
    }
    for (std::size_t k = 0; k < names.size(); ++k)
      columns.push_back({names[k].c_str(), samples[k]});
  }
  NamedColumns(const NamedColumns&) = delete;
  NamedColumns& operator=(const NamedColumns&) = delete;

  std::vector<std::string> names;
  std::vector<dashpot_named_column> columns;
};

/// Recordings: what dashpot.Recordings builds on.
class Recordings : public Owner<dashpot_recordings, dashpot_recordings_free> {
 public:
  static Recordings load(const std::vector<std::string>& paths, const std::string& options) {
    std::vector<const char*> texts;
    for (const std::string& path : paths) texts.push_back(path.c_str());
    Recordings recordings;
    dashpot_status status = DASHPOT_OK;
    {
      const py::gil_scoped_release others_may_run;
      status =
          dashpot_recordings_load(texts.data(), texts.size(), options.c_str(), recordings.out());
    }
    check(status);
    return recordings;
  }
  static Recordings empty() {
    Recordings recordings;
    check(dashpot_recordings_new(recordings.out()));
    return recordings;
  }

  size_t count() const { return dashpot_recordings_count(get()); }

  /// `table`: name -> array.
  void add(const py::dict& table, const py::object& name, const py::object& sample_time,
           const py::object& conditions) {
    Columns arrays;
    const NamedColumns named(table, arrays);
    const std::string own_name = name.is_none() ? "" : argument<std::string>(name, "name");
    const std::string stated = conditions.is_none() ? "" : conditions.cast<std::string>();
    dashpot_table copied = {};
    copied.name = name.is_none() ? nullptr : own_name.c_str();
    copied.samples = arrays.samples();
    copied.sample_time = sample_time.is_none() ? 0 : argument<double>(sample_time, "sample_time");
    copied.columns = named.columns.data();
    copied.column_count = named.columns.size();
    copied.conditions = conditions.is_none() ? nullptr : stated.c_str();
    check(dashpot_recordings_add(get(), &copied));
  }

  std::string describe() const {
    Text text;
    check(dashpot_recordings_describe(get(), text.out()));
    return text.take();
  }

  std::string unread() const {
    Text text;
    check(dashpot_recordings_unread(get(), text.out()));
    return text.take();
  }

  std::string suspects() const {
    Text text;
    check(dashpot_recordings_suspects(get(), text.out()));
    return text.take();
  }

  /// Name, condition, sample time and columns of one: views of the library's memory, which `self`
  /// keeps.
  static py::dict record(const py::object& self, size_t place) {
    const auto* recordings = self.cast<const Recordings&>().get();
    dashpot_record_info info = {};
    check(dashpot_recordings_get_info(recordings, place, &info));
    py::dict columns;
    columns["time [s]"] = view(info.time, info.samples, self);
    for (size_t k = 0; k < info.channel_count; ++k) {
      dashpot_channel channel = {};
      check(dashpot_recordings_channel(recordings, place, k, &channel));
      columns[py::str(std::string(channel.name) + " [" + channel.unit + "]")] =
          view(channel.data, info.samples, self);
    }
    py::dict record;
    record["name"] = info.name;
    record["condition"] = info.condition;
    record["sample_time"] = info.sample_time;
    record["columns"] = columns;
    return record;
  }

 private:
  static Array view(const double* data, size_t samples, const py::object& owner) {
    Array array(static_cast<py::ssize_t>(samples), data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
  }
};

}  // namespace dashpot_python
