#pragma once
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/error.h"

namespace dashpot {

/// Numbers, texts and columns one behind the other, for another process of this machine.
class PackedBytes {
 public:
  void add(std::size_t number) { put(&number, sizeof number); }
  void add(std::string_view text) {
    add(text.size());
    put(text.data(), text.size());
  }
  void add(const std::vector<double>& column) {
    add(column.size());
    put(column.data(), column.size() * sizeof(double));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void put(const void* from, std::size_t count) {
    bytes_.append(static_cast<const char*>(from), count);
  }

  std::string bytes_;
};

/// They come out in the order in which they went in. Throws Error where the bytes end before.
class UnpackedBytes {
 public:
  explicit UnpackedBytes(std::string_view bytes) : bytes_(bytes) {}

  std::size_t number() {
    std::size_t value;
    std::memcpy(&value, take(1, sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number(), 1)); }
  std::vector<double> column() {
    const std::size_t count = number();
    const std::string_view from = take(count, sizeof(double));
    std::vector<double> values(count);
    if (count > 0) std::memcpy(values.data(), from.data(), from.size());
    return values;
  }

 private:
  std::string_view take(std::size_t count, std::size_t size) {
    if (count > bytes_.size() / size) throw Error("", "what was handed over breaks off");
    const std::string_view taken = bytes_.substr(0, count * size);
    bytes_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace dashpot
