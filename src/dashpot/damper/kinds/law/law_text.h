#pragma once
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_expression.h"
#include "dashpot/damper/kinds/law/law_program.h"
#include "dashpot/damper/law.h"
#include "dashpot/value.h"

namespace dashpot {

/// A law from a file: its equations as text, read by a small parser, checked, and run as a
/// LawProgram. docs/laws-from-a-file.md is its contract. Immutable; whoever holds its law() holds
/// the text as well (LawModel does).
class LawText : public std::enable_shared_from_this<LawText> {
 public:
  /// Checks all that can be checked without data: names, units, bounds, that every parameter is
  /// used, that the law rests, and that its example runs. Throws Error with the place in the file.
  static std::shared_ptr<const LawText> make(const Value& definition);

  LawText(const LawText&) = delete;
  LawText& operator=(const LawText&) = delete;
  ~LawText() = default;

  const Law& law() const { return law_; }
  /// What a model file holds of it: the same law is made from it again.
  const Value& definition() const { return definition_; }

  // For who writes the equations in another language: places of nodes, one per state.
  const LawNodes& nodes() const { return nodes_; }
  const std::vector<std::uint16_t>& rates() const { return rates_; }
  const std::vector<std::uint16_t>& rests() const { return rests_; }
  std::uint16_t force() const { return force_; }
  std::uint16_t rate() const { return rate_; }  ///< meant only with states
  /// The closed form of a law with one state, and the condition on parameters under which it holds.
  struct Travel {
    std::uint16_t value = 0;
    std::optional<std::uint16_t> holds;
  };
  const std::optional<Travel>& travel() const { return travel_; }

 private:
  friend class LawTextReader;
  friend struct LawTextRun;
  LawText() = default;

  std::deque<std::string> words_;  ///< what the views of law_ look at
  Law law_, sided_;
  Value definition_;
  LawNodes nodes_;
  std::vector<std::uint16_t> rates_, rests_;
  std::uint16_t force_ = 0, rate_ = 0;
  std::optional<Travel> travel_;

  std::unique_ptr<LawProgram> program_;
  LawProgram::Piece rates_piece_, rests_piece_, force_piece_, flow_piece_, rate_piece_, step_piece_,
      travel_piece_, holds_piece_;
};

/// Whether a word that may name a model names the file of a law: it ends in .yaml, .yml or .json.
bool is_law_file(std::string_view word);
/// Reads such a file, YAML or JSON. Throws Error.
std::shared_ptr<const LawText> load_law_text(const std::filesystem::path& path);
std::shared_ptr<const LawText> parse_law_text(std::string_view text, const std::string& source);

}  // namespace dashpot
