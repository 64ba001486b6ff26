#include "guard.h"

#include <array>

#include <sys/random.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot::studio {
namespace {

/// 256 bits of the system's own, in hexadecimal.
std::string random_text() {
  std::array<unsigned char, 32> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error("studio", "the system gives no random numbers");
  std::string text;
  for (const unsigned char byte : bytes)
    for (const int half : {byte >> 4, byte & 15}) text += "0123456789abcdef"[half];
  return text;
}

/// In a time that tells nothing of where two texts differ.
bool same_text(std::string_view a, std::string_view b) {
  if (a.size() != b.size() || a.empty()) return false;
  unsigned char differs = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    differs = static_cast<unsigned char>(differs | (a[k] ^ b[k]));
  return differs == 0;
}

/// What anybody may ask for: the page without any data, and the exchange of a token.
bool is_open(const Asked& asked) {
  return (asked.method == "GET" && !asked.path.starts_with("/api/") &&
          !asked.path.starts_with("/report/")) ||
         (asked.method == "POST" && asked.path == "/api/session");
}

}  // namespace

Guard::Guard(int port)
    : port_(port), session_(random_text()), key_(random_text()), address_key_(random_text()) {}

std::string Guard::cookie_name() const { return "dashpot_studio_" + std::to_string(port_); }

std::string Guard::make_token() {
  const std::lock_guard lock(mutex_);
  return token_ = random_text();
}

std::optional<Session> Guard::exchange(std::string_view token) {
  const std::lock_guard lock(mutex_);
  if (!same_text(token, token_)) return std::nullopt;
  token_.clear();
  return Session{cookie_name() + "=" + session_ + "; HttpOnly; SameSite=Strict; Path=/", key_,
                 address_key_};
}

bool Guard::has_cookie(std::string_view cookie_header) const {
  const std::string name = cookie_name() + "=";
  for (std::size_t at = 0; at <= cookie_header.size();) {
    const std::size_t end = std::min(cookie_header.find(';', at), cookie_header.size());
    const std::string_view part = trim(cookie_header.substr(at, end - at));
    if (part.starts_with(name) && same_text(part.substr(name.size()), session_)) return true;
    at = end + 1;
  }
  return false;
}

bool Guard::has_session(const Asked& asked) const {
  // Reports, modules and downloads are opened by the browser, which sends no header of the page's.
  const bool is_opened =
      asked.method == "GET" && (asked.path.starts_with("/report/") || asked.path == "/api/module" ||
                                asked.path == "/api/exported");
  return has_cookie(asked.cookie) &&
         (same_text(asked.key, key_) || (is_opened && same_text(asked.address_key, address_key_)));
}

std::optional<Refusal> Guard::refuse(const Asked& asked) const {
  // A name that was bent to this machine by its owner's name server is not one of ours.
  const std::string port = ":" + std::to_string(port_);
  if (asked.host != "127.0.0.1" + port && asked.host != "localhost" + port)
    return Refusal{421, "the studio answers as 127.0.0.1" + port + " and localhost" + port};

  // Pages of others.
  if (!asked.origin.empty() && asked.origin != "http://" + asked.host)
    return Refusal{403, "asked by a page of another origin"};
  const bool is_own = asked.fetch_site.empty() || asked.fetch_site == "same-origin";
  const bool is_typed = asked.fetch_site == "none" && asked.method == "GET";
  if (!is_own && !is_typed) return Refusal{403, "asked by a page of another site"};

  // What changes something comes from the page's script, which sends its origin and a type that no
  // form can send.
  if (asked.method != "GET" && asked.method != "POST")
    return Refusal{405, "only GET and POST are known"};
  if (asked.method == "POST") {
    if (asked.origin.empty()) return Refusal{403, "asked without an origin"};
    if (asked.content_type != "application/json" &&
        asked.content_type != "application/octet-stream")
      return Refusal{415, "a body is application/json or application/octet-stream"};
  }

  // Whoever asks for data or work holds the cookie and the key.
  if (!is_open(asked) && !has_session(asked))
    return Refusal{401, "open the address that 'dashpot studio' printed"};
  return std::nullopt;
}

}  // namespace dashpot::studio
