#include "status.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>

#include "dashpot/base/text.h"

namespace dashpot::capi {
namespace {

thread_local std::string last_error;

dashpot_status keep(dashpot_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();  // no memory for the message: the status must do
  }
  return status;
}

}  // namespace

dashpot_status keep_error() noexcept {
  try {
    throw;
  } catch (const NotUsable& error) {
    // NotUsable is an Error, so it has to be caught before it.
    return keep(DASHPOT_NOT_USABLE, error.what());
  } catch (const Error& error) {
    return keep(DASHPOT_BAD_INPUT, error.what());
  } catch (const Interrupted& stopped) {
    return keep(DASHPOT_CANCELLED, stopped.what());
  } catch (const std::bad_alloc&) {
    // From here on it is no fault of the input.
    return keep(DASHPOT_FAILED, "there is not enough memory");
  } catch (const std::exception& fault) {
    return keep(DASHPOT_FAILED, fault.what());
  } catch (...) {
    return keep(DASHPOT_FAILED, "an unknown fault");
  }
}

void require_finite(double value, const char* name) {
  if (!std::isfinite(value))
    throw Error(name, "is " + format_exact(value) + ", not a finite number");
}

char* copy_text(const std::string& text) {
  char* copy = static_cast<char*>(std::malloc(text.size() + 1));
  if (!copy) throw std::bad_alloc();
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

}  // namespace dashpot::capi

using namespace dashpot::capi;

const char* dashpot_version(void) { return DASHPOT_VERSION; }

const char* dashpot_last_error(void) { return last_error.c_str(); }

void dashpot_text_free(char** text) {
  if (!text) return;
  std::free(*text);
  *text = nullptr;
}
