#pragma once
#include <string>
#include <vector>

namespace dashpot {

/// Who gets to see a part of a document. A terminal has little room, and a page can be sorted and
/// zoomed, so that some parts are for one of them only. Text: terminal and Markdown; Files:
/// Markdown and page.
enum class Audience { Everyone, Text, Files, Terminal, Markdown, Page };

/// Whether a part for `audience` is shown in `medium`: Terminal, Markdown or Page.
bool reaches(Audience audience, Audience medium);

/// A column of a table.
struct TextColumn {
  std::string title;
  bool numeric = false;   ///< right-aligned
  int priority = 0;       ///< the greatest go first when a terminal is too narrow; 0 always stays
  bool elastic = false;   ///< may be shortened on a terminal, to 20 characters
  std::string hint = {};  ///< shown when a page's reader points at the title
  Audience audience = Audience::Everyone;
  bool descending = false;  ///< a page sorts it by falling values first: more is better
};

/// Places of the columns that a medium shows.
std::vector<std::size_t> columns_for(const std::vector<TextColumn>& columns, Audience medium);

/// Aligned columns for a terminal, two spaces apart, with a rule below the titles, within `width`
/// characters where titles on several lines, shortening (in the middle of what begins alike) and
/// leaving out columns can.
std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows, int width);

/// Titles of the columns that text_table() leaves out, each once.
std::vector<std::string> columns_without_room(const std::vector<TextColumn>& columns,
                                              const std::vector<std::vector<std::string>>& rows,
                                              int width);

/// All columns that Markdown shows.
std::string markdown_table(const std::vector<TextColumn>& columns,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace dashpot
