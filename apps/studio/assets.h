#pragma once
#include <span>
#include <string_view>

namespace dashpot::studio {

/// A file of the page, embedded when the program is built (page/embed.cmake).
struct Asset {
  std::string_view path, type, content;
};
std::span<const Asset> assets();

}  // namespace dashpot::studio
