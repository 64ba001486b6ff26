#include <algorithm>

#include <hdf5.h>

#include "dashpot/error.h"
#include "dashpot/report/column_table.h"
#include "made_files.h"

namespace dashpot {
namespace {

/// One of HDF5's handles, closed at its end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw Error("HDF5", "could not make " + what);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const {
    return id_;
  }  // NOLINT(google-explicit-constructor): HDF5 takes its handles

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require_done(herr_t status, const std::string& what) {
  if (status < 0) throw Error("HDF5", "could not write " + what);
}

/// UTF-8 of any length, as h5py, MATLAB and Julia read it.
class TextType {
 public:
  TextType() : type_(H5Tcopy(H5T_C_S1), H5Tclose, "a type") {
    H5Tset_size(type_, H5T_VARIABLE);
    H5Tset_cset(type_, H5T_CSET_UTF8);
  }
  operator hid_t() const { return type_; }  // NOLINT(google-explicit-constructor)

 private:
  Handle type_;
};

void add_attribute(hid_t owner, const std::string& name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "a space");
  const TextType type;
  const Handle attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, name);
  const char* value = text.c_str();
  require_done(H5Awrite(attribute, type, &value), name);
}

void add_column(hid_t group, const DataColumn& column) {
  const hsize_t rows = column.size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "a space");
  const Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "options");
  H5Pset_obj_track_times(options, false);  // the same content, the same bytes
  const TextType text_type;
  const hid_t type = column.is_text() ? static_cast<hid_t>(text_type) : H5T_IEEE_F64LE;
  const Handle set(
      H5Dcreate2(group, column.name.c_str(), type, space, H5P_DEFAULT, options, H5P_DEFAULT),
      H5Dclose, column.name);

  // Unit and meaning stay with the column.
  add_attribute(set, "unit", column.unit);
  add_attribute(set, "meaning", column.meaning);
  if (rows == 0) return;
  std::vector<const char*> texts;
  for (const std::string& text : column.texts) texts.push_back(text.c_str());
  require_done(
      column.is_text()
          ? H5Dwrite(set, text_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data())
          : H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.numbers.data()),
      column.name);
}

void add_table(hid_t file, const ColumnTable& table) {
  // Columns keep their order.
  const Handle options(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "options");
  H5Pset_link_creation_order(options, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(options, false);
  const Handle group(H5Gcreate2(file, table.name.c_str(), H5P_DEFAULT, options, H5P_DEFAULT),
                     H5Gclose, table.name);
  add_attribute(group, "title", table.title);
  for (const DataColumn& column : table.columns) add_column(group, column);
}

/// A column as write_hdf5 hands it over.
DataColumn column_of(UnpackedBytes& request) {
  DataColumn column{.name = request.text(),
                    .unit = request.text(),
                    .meaning = request.text(),
                    .numbers = request.column()};
  for (std::size_t k = request.number(); k > 0; --k) column.texts.push_back(request.text());
  return column;
}

ColumnTable table_of(UnpackedBytes& request) {
  ColumnTable table{.name = request.text(), .title = request.text()};
  for (std::size_t k = request.number(); k > 0; --k) table.columns.push_back(column_of(request));
  return table;
}

}  // namespace

std::string hdf5_file(UnpackedBytes request) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are thrown as an Error, not printed
  constexpr std::size_t kGrowth = std::size_t{1} << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "options");
  require_done(H5Pset_fapl_core(access, kGrowth, false), "to memory");
  const Handle file(H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a file");
  for (std::size_t k = request.number(); k > 0; --k) {
    const std::string name = request.text();
    add_attribute(file, name, request.text());
  }
  for (std::size_t k = request.number(); k > 0; --k) add_table(file, table_of(request));
  require_done(H5Fflush(file, H5F_SCOPE_LOCAL), "the file");

  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file, bytes.data(), bytes.size()) != size)
    throw Error("HDF5", "could not give the file");
  return bytes;
}

}  // namespace dashpot
