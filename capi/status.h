#pragma once
#include <exception>
#include <string>

#include "dashpot.h"
#include "dashpot/error.h"

namespace dashpot::capi {

/// It ran, but the result is not usable.
class NotUsable : public Error {
 public:
  using Error::Error;
};

/// Keeps the message of the exception at hand and returns its status. To be called in a handler.
dashpot_status keep_error() noexcept;

/// Runs `code` so that no exception leaves it.
template <class Code>
dashpot_status guarded(Code&& code) noexcept {
  try {
    code();
    return DASHPOT_OK;
  } catch (...) {
    return keep_error();
  }
}

/// Throws Error where a pointer is null.
inline void require(const void* pointer, const char* name) {
  if (!pointer) throw Error(name, "is null");
}

/// Throws Error where a number is not finite.
void require_finite(double value, const char* name);

/// The text as a char* that dashpot_text_free takes.
char* copy_text(const std::string& text);

}  // namespace dashpot::capi
