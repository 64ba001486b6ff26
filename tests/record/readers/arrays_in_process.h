#pragma once
#include <cstring>
#include <filesystem>
#include <string>

#include "dashpot/record/readers/stored_arrays.h"

/// What dashpot-hdf5 does, without its process: for tests and fuzzers, which look for faults.
inline dashpot::StoredArrays arrays_of(void (*hand_over)(const std::filesystem::path&,
                                                         dashpot::StoredWriter&),
                                       const std::filesystem::path& path) {
  std::string bytes;
  dashpot::StoredWriter to([&](const void* from, std::size_t count) {
    bytes.append(static_cast<const char*>(from), count);
  });
  hand_over(path, to);
  to.end();

  dashpot::StoredArrays all;
  std::size_t at = 0;
  const auto take = [&](void* into, std::size_t count) {
    const std::size_t n = std::min(count, bytes.size() - at);
    std::memcpy(into, bytes.data() + at, n);
    at += n;
    return n;
  };
  const std::size_t most = 2 * dashpot::most_stored_bytes(std::filesystem::file_size(path));
  if (!dashpot::take_stored_arrays(take, most, all)) std::abort();
  return all;
}
