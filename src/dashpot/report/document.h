#pragma once
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/base/escape.h"
#include "dashpot/base/print_units.h"
#include "dashpot/damper_model.h"
#include "dashpot/report/text_table.h"
#include "dashpot/value.h"

// A Document is the whole of a result, before it becomes text for a terminal, Markdown, a page or
// JSON. A command fills it; the renderers below know nothing of models or recordings, and the
// page's program (page/) draws these parts and no others.
//
// Parts may depend on what the reader of a page has chosen: a model, a record. Terminal and page
// open with the first choice; Markdown has the parts of every option of a choice, one option after
// the other.
namespace dashpot {

/// A part is shown while each choice named here has one of these options; empty: always.
using When = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

/// Something that the reader of a page chooses; drawn at the head of its section.
struct DocumentChoice {
  std::string name, label;
  std::vector<std::string> options;
  std::size_t chosen = 0;  ///< as the document opens
};

struct DocumentTable {
  std::string title;
  std::vector<TextColumn> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note = {};                         ///< below it
  std::vector<std::vector<double>> keys = {};    ///< by row and column, to sort by; NaN: the text
  std::vector<std::vector<double>> shades = {};  ///< by row and column, 0 ... 1; NaN: none
  std::vector<bool> warnings = {};               ///< by row: drawn as one to beware of
  std::vector<bool> leaders = {};                ///< by row: drawn bold
  /// By row, what a click on it chooses; and the section that the page then shows.
  std::vector<std::vector<std::pair<std::string, std::size_t>>> chooses = {};
  std::string leads_to = {};
  std::vector<std::size_t> brief = {};  ///< the rows that a terminal shows; empty: all
  When when = {};
  Audience audience = Audience::Everyone;
  bool folded = false;  ///< a page shows it when asked to
};

/// A cell and the number to sort it by, where that is not the number in its text.
struct DocumentCell {
  std::string text;
  double key = std::numeric_limits<double>::quiet_NaN();
};
void add_row(DocumentTable& table, const std::vector<DocumentCell>& cells);

/// {"gap": 0.001, ...}, in SI.
Value conditions_json(const Conditions& conditions);

/// Samples that several series of a page share, such as the time of a record.
struct SharedSamples {
  std::vector<double> values;
  bool is_exact = false;  ///< kept as float32; else to 1/65534 of their range
  std::string unit = {};  ///< in SI; shown in that of the document
};

/// Places in Document::samples that a series is made of: y of x, from sample `first` on.
struct SharedCurve {
  std::size_t x = 0, y = 0;
  std::optional<std::size_t> minus = {};       ///< subtracted from y
  std::optional<std::size_t> half_width = {};  ///< an area from y - half_width to y + half_width
  std::size_t first = 0;
};

/// A curve or a cloud of points. Numbers that are not finite break a line.
struct FigureSeries {
  /// Bars stand side by side at the panel's places, else centred on x. A span shades the panel
  /// between the least and the greatest x.
  enum class Mark { Line, Dashes, Dots, Rings, Bars, Area, Span };
  std::string label;  ///< equal labels share one entry of the legend; empty: none
  /// A name of the page's palette: "measured", "modelled", "series-1" ... "series-8"; or
  /// "level-2-5", the second of five levels.
  std::string colour;
  std::vector<double> x, y;
  Mark mark = Mark::Line;
  double width = 1.5;                     ///< of a line; of dots and rings their radius
  std::vector<std::string> names = {};    ///< of the points, for the read-out
  std::string reading = {};               ///< the label in the read-out, where it is another
  bool is_listed = true, is_read = true;  ///< in the legend; by the read-out
  double opacity = 1;
  std::optional<SharedCurve> shared = {};  ///< instead of x and y; on a page only
  When when = {};
};

struct FigurePanel {
  std::string title, x_label, y_label;
  std::vector<FigureSeries> series;
  std::vector<std::string> places = {};  ///< words at x = 0, 1, ... instead of numbers
  std::string note = {};                 ///< below it, on a page
  bool x_log = false, y_log = false;     ///< logarithmic axes
  bool reads_along_x = false;            ///< the read-out has every series at one x
  int height = 300;                      ///< px
  std::string empty = {};                ///< stands there when no series has samples
  /// SI units of the series' own numbers, which stand behind the labels and are shown in those of
  /// the document; empty: the labels say all.
  std::string x_unit = {}, y_unit = {};
};

struct DocumentFigure {
  std::string name;            ///< of its files: "figure-8"
  std::string title, caption;  ///< a few words; what is seen
  std::vector<FigurePanel> panels;
  std::size_t columns = 1;  ///< panels abreast
  Audience audience = Audience::Everyone;
};

/// Points in a plane whose axes the reader of a page chooses among several quantities.
struct DocumentPlane {
  struct Quantity {
    std::string name, label;      ///< to choose by; of the axis, with its unit
    std::vector<double> values;   ///< one per point
    std::vector<double> second;   ///< by another model; empty: none
    std::optional<double> bound;  ///< a line to be drawn
  };
  std::string title, note;
  std::vector<Quantity> quantities;  ///< the first two are the axes at first
  std::vector<std::string> names;    ///< of the points
  std::vector<bool> outstanding;     ///< points to be ringed
  std::string points_label, outstanding_label, second_label;
  std::string choice;  ///< its chosen option is the point to be marked
};

/// Models that run in a page: the reader sets a motion and the parameters of a law, and sees the
/// loops of force at once. On a page only.
struct DocumentSliders {
  struct Model {
    std::string name;
    JsText program;  ///< as export/js/js.h writes it
  };
  /// A record at constant drive, whose loop stands under those of the models. Of its samples in
  /// Document::samples those from `first` on.
  struct Loop {
    std::string name;
    double drive = 0;       ///< A or V
    Conditions conditions;  ///< of the record: of a family they state its damper
    std::size_t displacement = 0, velocity = 0, force = 0, first = 0;
  };
  std::vector<Model> models;
  std::vector<Loop> loops = {};
};

/// Lines of words. Without a title one paragraph each, else a list below the title.
struct DocumentList {
  std::string title;
  std::vector<std::string> lines;
  When when = {};
  Audience audience = Audience::Everyone;
  bool folded = false;
};

/// In this order: words, choices, plane, sliders, tables, figures, remarks, lists, facts.
struct DocumentSection {
  std::string name, title;
  std::vector<std::string> paragraphs;
  std::vector<DocumentTable> tables = {};
  std::vector<DocumentFigure> figures = {};
  std::vector<std::string> remarks = {};
  std::string lead = {};  ///< how to use this part of a page; on a page only, before all else
  std::vector<DocumentChoice> choices = {};
  std::optional<DocumentPlane> plane = {};  ///< after the choices
  std::optional<DocumentSliders> sliders = {};
  std::vector<DocumentList> lists = {};
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< a term and what it means
  std::string plain = {};  ///< text with lines of its own, for terminal and Markdown, before tables
  Audience audience = Audience::Everyone;
};

/// A number that stands large at the head of a page.
struct KeyFigure {
  std::string value, unit, label;
};

struct Document {
  std::string title, subtitle;
  std::string verdict;  ///< a few sentences: the result; lines that begin with "* " are a list
  std::vector<DocumentSection> sections;
  std::string command;  ///< that makes all of it again; empty: Markdown does not say
  std::string version, date;
  std::string kind = "study";  ///< of document, above a page's title
  std::vector<KeyFigure> key_figures = {};
  /// The last part of a page, below the command.
  DocumentSection provenance = {"provenance", "Provenance", {}};
  std::vector<SharedSamples> samples = {};
  /// Of every quantity in its words (quantity.h), panels and samples, which are in SI until a
  /// renderer shows them.
  PrintUnits units = {};
  Value data = {};  ///< for programs; where there is none they get the words and tables
};

/// For a terminal of so many columns: the verdict and the sections that hold tables or plain text,
/// as a page opens. `bold` sets titles off.
std::string document_text(const Document& document, int width,
                          const std::function<std::string(std::string_view)>& bold = {});

/// `figures`: the folder of the figures as a link has it; empty: without figures. `level`: of the
/// title, 2 in a part of a page. Has no date, so that it can be kept under version control.
std::string markdown_document(const Document& document, const std::string& figures = "",
                              int level = 1);

/// One self-contained page (styles, script and data inside; it asks the network for nothing), its
/// tables to be sorted, its plots to be zoomed and read.
std::string html_document(const Document& document);

/// The document's data as JSON can hold them; else titles, words and the tables' cells as text.
Value document_json(const Document& document);

/// Every figure of a document without choices as <name>.svg and <name>.pdf, drawn by gnuplot.
/// Returns the paths. Throws Error when gnuplot is missing.
std::vector<std::filesystem::path> write_document_figures(const Document& document,
                                                          const std::filesystem::path& folder);

/// The document as people see it: every quantity in the document's units. The renderers do this.
Document in_units(Document document);

/// Whether a part is shown as the document opens.
bool is_open(const Document& document, const When& when);

}  // namespace dashpot
