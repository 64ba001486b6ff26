#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace dashpot::studio {

/// What of a request decides whether it is let in. Texts are "" where the header is missing.
struct Asked {
  std::string method, path, host, origin, fetch_site, cookie, content_type;
  std::string key;          ///< the header X-Dashpot-Key
  std::string address_key;  ///< "session" in an address that the browser itself opens
};

/// What a browser gets for a token: the text of the cookie to set, and keys that the page keeps for
/// its own origin. A browser sends cookies to every port of this machine, where programs of other
/// users may listen; these keys it does not.
struct Session {
  std::string cookie, key, address_key;
};

/// Why a request is refused, and the status that says so.
struct Refusal {
  int status;
  std::string why;
};

/// Lets in who holds the session's cookie and key, from the studio's own page, under its own name.
/// They are given once for each token; a token is 256 random bits and dies when it is used. Safe
/// from several threads.
class Guard {
 public:
  explicit Guard(int port);

  /// A new token, which can be exchanged once.
  std::string make_token();
  /// The session for a token that is alive; the token is dead afterwards.
  std::optional<Session> exchange(std::string_view token);
  /// Nothing where the request may pass.
  std::optional<Refusal> refuse(const Asked& asked) const;

 private:
  std::string cookie_name() const;
  bool has_cookie(std::string_view cookie_header) const;
  bool has_session(const Asked& asked) const;

  int port_;
  std::string session_;  ///< the value of the cookie
  std::string key_, address_key_;
  mutable std::mutex mutex_;
  std::string token_;  ///< "" when there is none alive
};

}  // namespace dashpot::studio
