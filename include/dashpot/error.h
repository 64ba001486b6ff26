// Layer: base
#pragma once

// The two exceptions that Dashpot throws: at input that cannot be used, and when the caller stops
// long work. An expected numerical outcome, such as a fit that does not converge, is a status in a
// report instead.

#include <stdexcept>
#include <string>

namespace dashpot {

/// Input that cannot be used. The message reads "where: what; right", for example
/// "run3.csv:118: force is 'abc', not a number; write it as 12.5 or leave the row out".
class Error : public std::runtime_error {
 public:
  /// where: file, file:line, key or option (may be empty). what: what is wrong with it.
  /// right: what would be right (may be empty).
  Error(const std::string& where, const std::string& what, const std::string& right = {});
};

/// The caller's monitor asked long work to stop.
class Interrupted : public std::runtime_error {
 public:
  Interrupted();
};

}  // namespace dashpot
