#include "dashpot/record/channel_names.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/record.h"

namespace dashpot {
namespace {

struct Names {
  std::string_view channel;
  /// Words at the start or end of a name; English, Spanish, Portuguese, German.
  std::string_view words;
  std::string_view exact;  ///< only as the whole name, case kept
};

constexpr Names kNames[] = {
    {"time", "time tiempo tempo zeit timestamp", "t tout Tout"},
    {"displacement",
     "displacement displace displ disp dist stroke position pos desplazamiento deslocamento "
     "posicion posicao carrera curso weg hub extension travel",
     "x X d D s"},
    {"velocity", "velocity vel speed velocidad velocidade geschwindigkeit xdot dxdt", "v"},
    {"acceleration", "acceleration accel aceleracion aceleracao beschleunigung", "a acc Acc ACC"},
    {"force", "force forc fuerza forca kraft load carga loadcell", "F f"},
    {"current", "current corriente corrente strom amperage", "I i"},
    {"voltage", "voltage volts voltaje tension tensao spannung", "E u U"},
    {"temperature", "temperature temp temperatura temperatur", "Temp"},
};

/// A name that may mean two things; the unit must decide.
struct Ambiguous {
  std::string_view name, first, second;
};
constexpr Ambiguous kAmbiguous[] = {
    {"V", "velocity", "voltage"}, {"A", "acceleration", "current"}, {"T", "time", "temperature"}};

constexpr std::string_view kWishes =
    "target reference ref setpoint set command cmd commanded desired demand demanded error min max "
    "mean average avg std peak valley amplitude soll sollwert vorgabe consigna deseado desejado";

bool contains_word(std::string_view list, std::string_view word) {
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    if (list.substr(at, end - at) == word) return true;
    at = end + 1;
  }
  return false;
}

/// Letters with accents (UTF-8 or Latin-1) as plain ones: the names stand without.
std::string fold_accents(std::string_view text) {
  // The letters from U+00C0 on, and from U+00E0 on, without their accents.
  static constexpr std::string_view kPlain = "aaaaaaaceeeeiiiidnooooo*ouuuuyps";
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    auto byte = static_cast<unsigned char>(text[k]);
    const auto next = static_cast<unsigned char>(k + 1 < text.size() ? text[k + 1] : 0);
    const bool in_utf8 = (next & 0xC0) == 0x80;
    if (byte == 0xC2 && in_utf8) continue;  // before a sign as "²"
    if (byte == 0xC3 && in_utf8) byte = next | 0xC0, ++k;
    out += byte >= 0xC0 ? kPlain[byte & 0x1f] : static_cast<char>(byte);
  }
  return out;
}

std::vector<std::string> words_of(std::string_view name) {
  std::string spaced;
  for (const char c : lower(fold_accents(name)))
    spaced += (c >= 'a' && c <= 'z') || c == '\'' ? c : ' ';
  std::vector<std::string> words = split(spaced, ' ');
  std::erase(words, "");
  return words;
}

/// The channels of a name without its unit: none when unknown, and two where its first word names
/// one and its last another, "load displacement".
std::vector<std::string> channels_of(std::string_view name) {
  for (const Names& known : kNames)
    if (contains_word(known.exact, name)) return {std::string(known.channel)};
  const std::vector<std::string> words = words_of(name);
  std::vector<std::string> channels;
  if (words.empty()) return channels;
  for (const std::string& end : {words.front(), words.back()})
    for (const Names& known : kNames)
      if (contains_word(known.words, end) &&
          std::ranges::find(channels, known.channel) == channels.end())
        channels.emplace_back(known.channel);
  return channels;
}

/// The channel of "I meas" or "F_damper", a symbol and words that say how or where it is measured;
/// "" of any other name. Its unit must fit: symbols have many meanings.
std::string channel_of_symbol(std::string_view name) {
  constexpr std::string_view kMeasured =
      "measured meas actual act filtered filt raw damper coil mr";
  const std::size_t end = name.find_first_of(" _");
  if (end == std::string_view::npos) return {};
  const std::vector<std::string> words = words_of(name.substr(end));
  if (words.empty() || !std::ranges::all_of(words, [&](const std::string& word) {
        return contains_word(kMeasured, word);
      }))
    return {};
  for (const Names& known : kNames)
    if (contains_word(known.exact, name.substr(0, end))) return std::string(known.channel);
  return {};
}

/// The first of them; "" when unknown.
std::string channel_of(std::string_view name) {
  const std::vector<std::string> channels = channels_of(name);
  return channels.empty() ? "" : channels.front();
}

bool is_wish(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& w) { return contains_word(kWishes, w); });
}

/// Words of a name that say whose quantity it is, where it is not the damper's: of a drive those of
/// the bench and of sensors that answer with a voltage, of a force those of its parts.
bool is_of_another(std::string_view name, std::string_view channel) {
  constexpr std::string_view kNotOfCoil =
      "motor actuator shaker pump servo spindle lvdt cell loadcell bridge strain gauge "
      "potentiometer laser accelerometer";
  constexpr std::string_view kNotOfDamper = "gas spring inertia inertial lateral transverse";
  const bool is_drive = channel == "current" || channel == "voltage";
  if (!is_drive && channel != "force") return false;
  const std::vector<std::string> words = words_of(name);
  return std::ranges::any_of(words, [&](const std::string& word) {
    return contains_word(is_drive ? kNotOfCoil : kNotOfDamper, word);
  });
}

bool fits(std::string_view channel, const Unit& unit) {
  return parse_unit(si_unit(channel))->dimension == unit.dimension;
}

/// The ways in which a column name may hold a unit, the plainest first: "x [mm]", "x (mm)", "x/mm",
/// "x, mm", "x in mm", "F_N", "v_mm_s". Only texts that parse as a unit count.
std::vector<ColumnParts> possible_parts(std::string_view column) {
  std::vector<ColumnParts> parts;
  const auto add = [&](std::string_view name, std::string unit) {
    unit = std::string(trim(unit));
    const bool fahrenheit = unit == "F" && channel_of(trim(name)) == "temperature";
    if (!trim(name).empty() && (parse_unit(unit) || fahrenheit))
      parts.push_back({std::string(trim(name)), unit});
  };

  // In brackets.
  for (const auto& [open, close] :
       {std::pair{'[', ']'}, std::pair{'(', ')'}, std::pair{'{', '}'}}) {
    const std::size_t from = column.find(open), to = column.rfind(close);
    if (from != std::string_view::npos && to != std::string_view::npos && to > from)
      add(column.substr(0, from), std::string(column.substr(from + 1, to - from - 1)));
  }

  // Behind the first mark.
  for (const std::string_view mark : {"/", ",", " in ", " ", "_"})
    if (const std::size_t at = column.find(mark); at != std::string_view::npos)
      add(column.substr(0, at), std::string(column.substr(at + mark.size())));

  // Behind the last underscore, or the last two as a quotient: "v_mm_s" is in mm/s.
  if (const std::size_t last = column.rfind('_'); last != std::string_view::npos && last > 0) {
    add(column.substr(0, last), std::string(column.substr(last + 1)));
    if (const std::size_t before = column.rfind('_', last - 1); before != std::string_view::npos)
      add(column.substr(0, before), std::string(column.substr(before + 1, last - before - 1)) +
                                        "/" + std::string(column.substr(last + 1)));
  }

  if (const std::size_t last = column.rfind(' '); last != std::string_view::npos)
    add(column.substr(0, last), std::string(column.substr(last + 1)));
  return parts;
}

/// Channel of a name and its unit, which may be empty. The problem says why a familiar name is not
/// used.
NamedChannel resolve(const std::string& name, const std::string& given) {
  // "F" is a unit of temperature only, and no farad; the g of an accelerometer is no gram.
  const std::string known = channel_of(name);
  std::string unit = given;
  if (given == "F" && known == "temperature") unit = "degF";
  if ((given == "g" || given == "G") && known == "acceleration") unit = "g0";
  const auto parsed = unit.empty() ? std::nullopt : parse_unit(unit);
  for (const Ambiguous& word : kAmbiguous) {
    if (word.name != name) continue;
    for (const std::string_view channel : {word.first, word.second})
      if (parsed && fits(channel, *parsed)) return {std::string(channel), unit, {}, true};
    return {{},
            unit,
            "'" + name + "' may be " + std::string(word.first) + " or " + std::string(word.second),
            false};
  }

  // Of two channels the unit decides, and of a symbol that more is said of.
  std::vector<std::string> channels = channels_of(name);
  if (channels.empty() && parsed)
    if (const std::string channel = channel_of_symbol(name);
        !channel.empty() && fits(channel, *parsed))
      return {channel, unit, {}, false};
  if (channels.empty()) return {};
  if (channels.size() > 1 && parsed)
    std::erase_if(channels, [&](const std::string& one) { return !fits(one, *parsed); });
  if (channels.size() > 1)
    return {{}, unit, "'" + name + "' may be " + channels[0] + " or " + channels[1], false};

  // Refuse what is no measurement, and units of another dimension.
  const std::string channel = channels.empty() ? known : channels.front();
  if (is_wish(name)) return {{}, unit, "'" + name + "' is not a measurement by its name", false};
  if (is_of_another(name, channel))
    return {{}, unit, "'" + name + "' is not the damper's by its name", false};
  if (parsed && !fits(channel, *parsed))
    return {{}, unit, "unit '" + unit + "' does not fit " + channel, false};

  const bool letters_only = std::none_of(name.begin(), name.end(),
                                         [](char c) { return (c >= '0' && c <= '9') || c == '('; });
  return {channel, unit, {}, letters_only && words_of(name).size() == 1};
}

/// Words behind a name that say how it was measured and are no unit: "Force (filtered)".
constexpr std::string_view kRemarks =
    "measured meas actual filtered filt raw abs absolute rel relative lvdt cell load sensor "
    "channel ch ai top bottom left right front rear upper lower piston rod damper coil rms nominal "
    "signal input output in out total dynamic static axial hhmmss iso date datetime clock local "
    "utc x y z no nr";

bool is_remark(std::string_view text) {
  constexpr std::string_view kClock = "hh mm ss";  // "hh:mm:ss"; alone "mm" is a unit
  const std::vector<std::string> words = words_of(text);
  const bool is_inch_mark = words.empty() && text.find('"') != std::string_view::npos;
  const bool is_clock = std::ranges::find(words, "hh") != words.end();
  return !is_inch_mark && std::all_of(words.begin(), words.end(), [&](const std::string& w) {
    return contains_word(kRemarks, w) || (is_clock && contains_word(kClock, w));
  });
}

/// The units that people write for a channel, the commonest first.
std::string_view usual_units(std::string_view channel) {
  static constexpr std::pair<std::string_view, std::string_view> kUsual[] = {
      {"time", "s ms us min h"},
      {"displacement", "mm m cm um in ft"},
      {"velocity", "m/s mm/s cm/s in/s ft/s"},
      {"acceleration", "m/s^2 mm/s^2 g0 in/s^2"},
      {"force", "N kN daN kgf kp lbf lbs"},
      {"current", "A mA"},
      {"voltage", "V mV"},
      {"temperature", "degC K degF C F"}};
  for (const auto& [name, units] : kUsual)
    if (name == channel) return units;
  return {};
}

/// "the unknown unit 'lbx' of force; nearest: 'lbf', 'N' ..."
std::string unknown_unit(const std::string& unit, std::string_view channel) {
  std::vector<std::string> known = split(std::string(usual_units(channel)), ' ');
  const auto near = closest(lower(unit), known);
  const auto same = std::find_if(known.begin(), known.end(),
                                 [&](const std::string& k) { return lower(k) == lower(unit); });
  const std::string first = same != known.end() ? *same : near.value_or("");
  std::erase(known, first);
  if (!first.empty()) known.insert(known.begin(), first);
  for (std::string& k : known) k = "'" + k + "'";
  return "the unknown unit '" + unit + "' of " + std::string(channel) +
         "; nearest: " + join(known, ", ");
}

/// Whether the last word of a name was meant as a unit: it is one but for its capitals, or a unit
/// that Dashpot does not know.
bool meant_as_unit(std::string_view text, std::string_view channel) {
  constexpr std::string_view kForeign =
      "tonf tf ton kip kips pdl dyn ozf ips fps mph kmh kph knots mil mils thou pt cts counts "
      "count bits bit adc lsb digits klbf klb klbs kg kgs lbsf nt kgforce mas hrs rankine degr r "
      "pound pounds kilogram kilograms newton newtons kilonewton kilonewtons micron microns mms "
      "cms mps mmps cmps inps minute minutes hour hours minuten sekunden stunden millisekunden "
      "minutos segundos horas zoll zentimeter pulgadas polegadas milimetros centimetros metros \" "
      "''";
  const std::vector<std::string> usual = split(std::string(usual_units(channel)), ' ');
  std::string word = lower(text);
  if (const bool is_quotient = word.ends_with("-1"); is_quotient) word.resize(word.size() - 2);
  return contains_word(kForeign, word) ||
         std::any_of(usual.begin(), usual.end(),
                     [&](const std::string& unit) { return lower(unit) == word; });
}

/// A familiar name with a unit that nobody knows, wherever people write it. The channel is empty
/// where there is none: such a column may not be taken as SI.
NamedChannel with_unknown_unit(std::string_view column) {
  const auto refuse = [](std::string_view name, std::string_view unit) -> NamedChannel {
    const std::string channel = channel_of(trim(name));
    if (channel.empty() || is_wish(name)) return {};
    return {channel, {}, unknown_unit(std::string(trim(unit)), channel), false};
  };

  // In brackets everything but a remark is a unit.
  for (const auto& [open, close] :
       {std::pair{'[', ']'}, std::pair{'(', ')'}, std::pair{'{', '}'}}) {
    const std::size_t from = column.find(open), to = column.rfind(close);
    if (from == std::string_view::npos || to == std::string_view::npos || to < from) continue;
    const std::string_view inside = trim(column.substr(from + 1, to - from - 1));
    const std::string_view name = column.substr(0, from);
    const bool is_unit = meant_as_unit(inside, channel_of(trim(name)));  // "IN", inputs elsewhere
    if (inside.empty() || (is_remark(inside) && !is_unit)) return {};
    return refuse(name, inside);
  }

  // Behind a comma or a slash as well; behind a blank or an underscore only what looks like one.
  for (const char mark : {',', '/', '_', ' '}) {
    const std::size_t at = column.rfind(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view behind = trim(column.substr(at + 1)), name = column.substr(0, at);
    const std::string channel = channel_of(trim(name));
    if (behind.empty() || channel.empty()) continue;
    const bool surely = mark == ',' && !is_remark(behind);
    if (surely || meant_as_unit(behind, channel)) return refuse(name, behind);
  }
  return {};
}

/// The pieces of a name between blanks, underscores, commas, semicolons, bars and brackets.
std::vector<std::string> pieces_of(std::string_view name) {
  constexpr std::string_view kBetween = " _,;:|<>()[]{}";
  std::string spaced(name);
  std::ranges::replace_if(
      spaced, [&](char c) { return kBetween.find(c) != std::string_view::npos; }, ' ');
  std::vector<std::string> pieces = split(spaced, ' ');
  std::erase(pieces, "");
  return pieces;
}

/// A usual unit of the channel that stands as a word anywhere in a name, "kN force" or
/// "Force_kN_filt", or a quotient that is one, "velocity mm/s filt"; "" where there is none, or
/// more than one. A letter alone, or "in", may mean anything; behind a number stands the range of a
/// sensor: "10 kN load cell".
std::string unit_among_words(std::string_view name, std::string_view channel) {
  const std::string usual(usual_units(channel));
  if (usual.empty()) return {};
  std::string found;
  const auto is_another = [&](const std::string& unit) {
    if (!found.empty() && found != unit) return true;
    found = unit;
    return false;
  };

  // Quotients.
  for (const std::string& piece : pieces_of(name)) {
    const auto unit = piece.find_first_of("/^-.") == std::string::npos || piece.size() < 3
                          ? std::nullopt
                          : parse_unit(piece);
    if (unit && fits(channel, *unit) && is_another(piece)) return {};
  }
  if (!found.empty()) return found;

  // Words.
  std::string spaced, before;
  for (const char c : name) spaced += std::isalnum(static_cast<unsigned char>(c)) ? c : ' ';
  for (const std::string& word : split(spaced, ' ')) {
    const bool is_range = std::exchange(before, word).find_first_of("0123456789") == 0;
    const bool is_unit = word.size() >= 2 && word != "in" && contains_word(usual, word);
    if (is_unit && !is_range && is_another(word)) return {};
  }
  return found;
}

/// "x1000", "*10", "1000x", "/10", "1/10", or two pieces "x 1000": a factor between what stands in
/// the file and the unit, which may be there to be multiplied or to be divided by. "x1" is the
/// first of several channels.
std::string factor_among(std::string_view name) {
  constexpr std::string_view kMarks = "xX*/";
  constexpr double kFewest = 10;
  const auto is_factor = [](std::string_view text) {
    const auto number = parse_number(text);
    return number && std::isfinite(*number) && *number > 0 && (*number >= kFewest || *number < 1);
  };
  std::string spelled(name);
  for (const auto& [sign, mark] : {std::pair{"\u00d7", "x"}, {"\u00b7", "*"}})
    for (std::size_t at; (at = spelled.find(sign)) != std::string::npos;)
      spelled.replace(at, 2, mark);

  const std::vector<std::string> pieces = pieces_of(spelled);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const std::string& piece = pieces[k];
    const bool marked = kMarks.find(piece.front()) != std::string_view::npos;
    if (marked && is_factor(std::string_view(piece).substr(1))) return piece;
    if (marked && piece.size() == 1 && k + 1 < pieces.size() && is_factor(pieces[k + 1]))
      return piece + " " + pieces[k + 1];
    // "1/10 mm" and "1/10mm".
    const std::size_t end = piece.find_first_not_of("0123456789", 2);
    if (piece.starts_with("1/") && is_factor(std::string_view(piece).substr(2, end - 2)))
      return piece.substr(0, end);
    const bool ends_marked = piece.back() == 'x' || piece.back() == 'X';
    if (ends_marked && is_factor(std::string_view(piece).substr(0, piece.size() - 1))) return piece;
  }

  // "Force/1000" and "Force*10" in one piece.
  for (const std::string& piece : pieces)
    if (const std::size_t at = piece.find_last_of("*/");
        at != std::string::npos && at > 0 &&
        std::isalpha(static_cast<unsigned char>(piece[at - 1])) &&
        is_factor(std::string_view(piece).substr(at + 1)))
      return piece.substr(at);
  return {};
}

/// "10 kN" at the end of a name: the unit of its numbers, or the range of the sensor; "" where both
/// mean the same. A small number counts channels; one below 1 is a resolution.
std::string range_at_end(std::string_view name, std::string_view channel) {
  constexpr double kLeast = 5, kMost = 1;
  const std::vector<std::string> pieces = pieces_of(name);
  const bool has_range = channel != "time" && channel != "temperature";
  if (!has_range || name.find_first_of("[({") != std::string_view::npos || pieces.size() < 3)
    return {};
  const std::string& unit = pieces.back();
  const auto number = parse_number(pieces[pieces.size() - 2]);
  const auto parsed = parse_unit(unit);
  const bool is_count = number && *number >= kMost && *number < kLeast;
  if (!number || is_count || !parsed || parsed->factor == 1) return {};
  return pieces[pieces.size() - 2] + " " + unit;
}

/// Why a familiar name may not tell the size of what is below it; "" where nothing speaks against.
std::string doubt_of_size(std::string_view name, std::string_view channel) {
  if (const std::string factor = factor_among(name); !factor.empty())
    return "a factor '" + factor +
           "' in its name, by which its numbers may have been multiplied, or are to be ('scale' in "
           "a dataset file says which)";
  if (const std::string range = range_at_end(name, channel); !range.empty())
    return "'" + range +
           "' in its name, a range or resolution of the sensor or the unit of the numbers";
  return {};
}

/// A name as people type it: other programs have no-break blanks in it, or marks in the place of
/// brackets and blanks ("Force_kN_" and "force..kN." for "Force (kN)").
std::string as_typed(std::string_view column) {
  constexpr std::string_view kNoBreak = "\xC2\xA0", kMarks = "_. ";
  std::string name(column);
  for (std::size_t at; (at = name.find(kNoBreak)) != std::string::npos;)
    name.replace(at, kNoBreak.size(), " ");
  name = trim(name);
  if (name.find_first_of("[({/") != std::string::npos) return name;
  if (!name.empty() && kMarks.find(name.back()) != std::string_view::npos) {
    const std::size_t last = name.find_last_not_of(kMarks);
    if (last != std::string::npos) name.erase(last + 1);
  }

  // "per" between words that underscores join.
  for (std::size_t at; (at = name.find("_per_")) != std::string::npos;) name.replace(at, 5, "/");

  // Points before a letter as one underscore; "force.1" and "0.5A" keep theirs, and "mm.s-1" does.
  std::vector<std::string> pieces = pieces_of(name);
  const bool has_product = std::ranges::any_of(pieces, [](const std::string& piece) {
    return piece.find('.') != std::string::npos && piece.find_first_of("^-") != std::string::npos &&
           parse_unit(piece);
  });
  if (has_product) return name;
  std::string typed;
  for (std::size_t k = 0; k < name.size(); ++k) {
    const std::size_t next = name.find_first_not_of('.', k);
    if (next == k || next >= name.size() || !std::isalpha(static_cast<unsigned char>(name[next]))) {
      typed += name[k];
      continue;
    }
    typed += '_';
    k = next - 1;
  }
  return typed;
}

/// "I_A" of "data.I_A", a field of a structure; "" of any other name.
std::string_view own_name_of_field(std::string_view column) {
  const std::size_t point = column.rfind('.');
  const auto is_word = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
  if (point == std::string_view::npos || point == 0 || point + 1 == column.size() ||
      !std::isalpha(static_cast<unsigned char>(column[point + 1])) ||
      !std::ranges::all_of(column, is_word))
    return {};
  return column.substr(point + 1);
}

/// "x(2)": one column of a matrix in a MAT file.
bool is_matrix_column(std::string_view name) {
  const std::size_t open = name.rfind('(');
  return open != std::string_view::npos && open > 0 && name.back() == ')' &&
         name.substr(open).find_first_not_of("()0123456789") == std::string_view::npos &&
         name.size() - open > 2;
}

}  // namespace

std::string_view si_unit(std::string_view channel) {
  if (channel == "time") return "s";
  for (const StandardChannel& standard : standard_channels())
    if (standard.name == channel) return standard.unit;
  return {};
}

std::optional<ColumnParts> parts_by_brackets(std::string_view column) {
  if (column.empty() || std::string_view("])}").find(column.back()) == std::string_view::npos)
    return std::nullopt;
  std::vector<ColumnParts> parts = possible_parts(column);
  if (parts.empty()) return std::nullopt;
  return std::move(parts.front());
}

NamedChannel recognise_channel(std::string_view column, std::string_view row_unit) {
  // A field "time" of whatever channel's structure.
  if (lower(trim(column)).ends_with(".time")) return recognise_channel("time", row_unit);
  const std::string whole = as_typed(column), row(row_unit);
  if (is_matrix_column(whole))
    return {{}, {}, "a column of a matrix has no name of its own", false};

  // Try the ways to split name and unit; the first that is a channel counts, and the first problem
  // is kept. A name may leave the size of its numbers open.
  const auto sized = [&](NamedChannel found) {
    if (!found.channel.empty() && found.problem.empty())
      found.problem = doubt_of_size(column, found.channel);
    return found;
  };
  NamedChannel refused;
  for (const ColumnParts& parts : possible_parts(whole)) {
    NamedChannel found = resolve(parts.name, parts.unit);
    const bool two_units =
        !found.channel.empty() && !row.empty() && parse_unit(row) && row != found.unit;
    if (two_units)
      found.problem = "two units: '" + found.unit + "' in its name and '" + row + "' below it";
    if (!found.channel.empty()) return sized(std::move(found));
    if (refused.problem.empty()) refused = found;
  }

  // No unit in the name: it is the whole name, with the unit of the row below.
  if (!refused.problem.empty()) return refused;
  NamedChannel found = resolve(whole, row);
  const bool known = row.empty() || parse_unit(row) || found.unit == "degF";
  if (!known && !found.channel.empty()) found.problem = unknown_unit(row, found.channel);
  if (!known && found.channel.empty()) found.problem = "unit '" + row + "' is unknown";
  if (!known) found.unit.clear();
  if (!row.empty()) return sized(std::move(found));

  // A name that holds a unit which nobody knows is not taken as SI.
  NamedChannel unknown = with_unknown_unit(whole);
  if (!unknown.channel.empty()) return unknown;
  if (found.unit.empty()) found.unit = unit_among_words(whole, found.channel);

  // A letter is a name by itself only: that of a structure before it says where it stands.
  const std::string_view own = own_name_of_field(trim(column));
  if (found.channel.empty() && found.problem.empty() && !own.empty() && !is_wish(whole))
    return recognise_channel(own, row_unit);
  return sized(std::move(found));
}

}  // namespace dashpot
