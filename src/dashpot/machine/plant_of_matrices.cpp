#include "dashpot/machine/plant_of_matrices.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/plants/assemble.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

/// Numbers of a matrix's parameters lie within this, SI.
constexpr double kWidest = 1e15;

/// The three matrices, by what they multiply.
enum MatrixKind { kMassMatrix, kDampingMatrix, kStiffnessMatrix };
struct MatrixWords {
  std::string_view name, meaning, what;
  std::string_view unit[3];  ///< by how many of row and column are angles
};
constexpr MatrixWords kMatrices[] = {
    {"mass", "in the mass matrix", "positive definite", {"kg", "kg*m", "kg*m^2"}},
    {"damping", "in the damping matrix", "positive semi-definite", {"N*s/m", "N*s", "N*m*s"}},
    {"stiffness", "in the stiffness matrix", "positive semi-definite", {"N/m", "N", "N*m"}}};

/// A constant, and behind it the factor of each parameter.
using LinearSum = std::vector<double>;

double value_of(const LinearSum& sum, std::span<const double> parameters) {
  double value = sum[0];
  for (std::size_t k = 0; k < parameters.size(); ++k) value += sum[k + 1] * parameters[k];
  return value;
}

/// n x n, row by row.
using MatrixOfSums = std::vector<LinearSum>;

std::vector<double> numbers_of(const MatrixOfSums& matrix, std::span<const double> parameters) {
  std::vector<double> numbers;
  for (const LinearSum& sum : matrix) numbers.push_back(value_of(sum, parameters));
  return numbers;
}

/// A spring and a dashpot between the plant and a ground that moves.
struct OnGround {
  LinearSum stiffness, damping;
};

/// All that a plant of matrices is made of.
struct MatrixPlant {
  Plant frame;                              ///< all but its numbers
  std::array<MatrixOfSums, 3> whole, free;  ///< with what stands on a ground, and without
  std::vector<OnGround> on_ground;          ///< per tyre of the frame
};

Plant plant_with(const MatrixPlant& matrices, std::span<const double> parameters) {
  Plant plant = matrices.frame;
  plant.mass = numbers_of(matrices.free[kMassMatrix], parameters);
  plant.damping = numbers_of(matrices.free[kDampingMatrix], parameters);
  plant.stiffness = numbers_of(matrices.free[kStiffnessMatrix], parameters);
  for (std::size_t k = 0; k < plant.tyres.size(); ++k) {
    plant.tyres[k].stiffness = value_of(matrices.on_ground[k].stiffness, parameters);
    plant.tyres[k].damping = value_of(matrices.on_ground[k].damping, parameters);
  }
  return plant;
}

bool is_a_name(std::string_view text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// How many characters of a text are the number that it begins with: "2" of "2*k", "1e-3" of
/// "1e-3 kg".
std::size_t length_of_number(std::string_view text) {
  const auto digits_from = [&](std::size_t k) {
    while (k < text.size() && std::isdigit(static_cast<unsigned char>(text[k]))) ++k;
    return k;
  };
  std::size_t end = digits_from(0);
  if (end < text.size() && text[end] == '.') end = digits_from(end + 1);
  if (end == 0 || end >= text.size() || std::tolower(text[end]) != 'e') return end;
  std::size_t power = end + 1;
  if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
  return digits_from(power) > power ? digits_from(power) : end;
}

/// The terms of "k1 - 2*k2 + 20 N/mm", each with its sign. A sign within a number ("1e-3") or
/// behind a power ("s^-1") begins no term.
std::vector<std::string> terms_of(std::string_view text) {
  std::vector<std::string> terms = {""};
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::string_view so_far = trim(terms.back());
    const bool is_sign = text[k] == '+' || text[k] == '-';
    const bool within =
        k > 0 && (text[k - 1] == '^' ||
                  (std::tolower(text[k - 1]) == 'e' && so_far.size() > 1 &&
                   std::isdigit(static_cast<unsigned char>(so_far[so_far.size() - 2]))));
    if (is_sign && !within && !so_far.empty()) terms.emplace_back();
    terms.back() += text[k];
  }
  return terms;
}

/// Reads a plant of matrices from its file.
class MatrixReader {
 public:
  MatrixReader(PlantOfMatrices& plant, const std::vector<std::string>& parameters,
               const std::string& source)
      : plant_(plant), parameters_(parameters), source_(source), found_in_(parameters.size()) {}

  void read(ObjectReader& reader);

 private:
  const Value* keep(ObjectReader& reader, const std::string& key);
  void read_coordinates(const Value& value);
  void read_matrix(ObjectReader& reader, MatrixKind kind);
  void read_ground(const Value& value);
  void read_shaken(const Value& value);
  void read_damper(const Value& value, bool is_only);
  LinearSum read_sum(const Value& value, MatrixKind kind, int angles);
  void add_term(const std::string& term, const std::string& where, MatrixKind kind, int angles,
                LinearSum& sum);
  std::vector<double> read_place(const Value& value) const;
  void add_rows();

  /// Row and unit in which a parameter was met first.
  struct FoundIn {
    const MatrixWords* matrix = nullptr;
    std::string_view unit;
  };

  PlantOfMatrices& plant_;
  const std::vector<std::string>& parameters_;
  const std::string& source_;
  std::vector<FoundIn> found_in_;
  std::shared_ptr<MatrixPlant> matrices_ = std::make_shared<MatrixPlant>();
};

/// An optional value of the file, kept for when the setup is written again.
const Value* MatrixReader::keep(ObjectReader& reader, const std::string& key) {
  const Value* value = reader.optional(key);
  if (value) plant_.file.emplace_back(key, *value);
  return value;
}

bool is_angle(const Coordinate& coordinate) { return coordinate.unit == "rad"; }

void MatrixReader::read_coordinates(const Value& value) {
  auto& coordinates = matrices_->frame.coordinates;
  for (const Value& item : value.items()) {
    // A name alone is a length.
    Coordinate one{"", "m"};
    if (item.kind() == Value::Kind::Object) {
      ObjectReader reader(item, "a coordinate");
      one.name = reader.string("name");
      one.unit = reader.string("unit", "m");
      reader.finish();
    } else {
      one.name = item.as_string();
    }
    if (one.unit != "m" && one.unit != "rad")
      throw Error(item.where(), "'" + one.unit + "' is no unit of a coordinate", "m or rad");
    if (!is_a_name(one.name) || one.name == "ground")
      throw Error(item.where(), "'" + one.name + "' is no name of a coordinate",
                  "letters, digits and _, a letter first, and not 'ground'");
    if (std::ranges::find(coordinates, one.name, &Coordinate::name) != coordinates.end())
      throw Error(item.where(), "'" + one.name + "' stands twice", "a name for each coordinate");
    coordinates.push_back(std::move(one));
  }
  if (coordinates.empty())
    throw Error(value.where(), "names no coordinate", "coordinates: [table, mass]");
}

void MatrixReader::add_term(const std::string& text, const std::string& where, MatrixKind kind,
                            int angles, LinearSum& sum) {
  // Sign, number, and what stands behind it: nothing, a parameter or a unit.
  std::string_view term = trim(text);
  double factor = 1;
  while (!term.empty() && (term.front() == '+' || term.front() == '-')) {
    if (term.front() == '-') factor = -factor;
    term = trim(term.substr(1));
  }
  const std::size_t length = length_of_number(term);
  const bool has_number = length > 0;
  const auto number = has_number ? parse_number(term.substr(0, length)) : std::optional(1.0);
  std::string_view rest = trim(term.substr(length));
  const bool multiplies = has_number && rest.starts_with('*');
  if (multiplies) rest = trim(rest.substr(1));
  const MatrixWords& matrix = kMatrices[kind];
  const std::string_view unit = matrix.unit[angles];
  const std::string right = "a sum of numbers and names, as 2*k + 20 " + std::string(unit);
  if (!number || (rest.empty() && (!has_number || multiplies)))
    throw Error(where, "cannot read '" + text + "'", right);

  // A number, with or without its unit.
  const auto known = std::ranges::find(parameters_, rest);
  if (known == parameters_.end()) {
    if (is_a_name(rest) && (!has_number || multiplies || !parse_unit(rest)))
      throw Error(where, "'" + std::string(rest) + "' is no parameter of this plant",
                  parameters_.empty() ? "state it under 'parameters', known or unknown"
                                      : suggest(rest, parameters_));
    if (!has_number || multiplies) throw Error(where, "cannot read '" + text + "'", right);
    sum[0] += factor * parse_quantity(term, unit, where);
    return;
  }

  // A parameter, by a number.
  const auto place = static_cast<std::size_t>(known - parameters_.begin());
  if (const auto as_unit = parse_unit(rest); as_unit && has_number && !multiplies)
    throw Error(
        where, "'" + std::string(rest) + "' is a parameter and a unit",
        "'" + std::string(term.substr(0, length)) + "*" + std::string(rest) + "', or another name");
  FoundIn& first = found_in_[place];
  if (first.matrix && first.matrix != &matrix)
    throw Error(where,
                *known + " stands in the " + std::string(first.matrix->name) + " and in the " +
                    std::string(matrix.name),
                "a name for each: they have different units");
  if (!first.matrix) first = {&matrix, unit};
  sum[place + 1] += factor * *number;
}

LinearSum MatrixReader::read_sum(const Value& value, MatrixKind kind, int angles) {
  LinearSum sum(parameters_.size() + 1);
  if (value.kind() == Value::Kind::Number) {
    sum[0] = read_quantity(value, kMatrices[kind].unit[angles]);
  } else {
    for (const std::string& term : terms_of(value.as_string()))
      add_term(term, value.where(), kind, angles, sum);
  }
  if (sum[0] != 0) plant_.states_a_number = true;
  return sum;
}

void MatrixReader::read_matrix(ObjectReader& reader, MatrixKind kind) {
  const auto& coordinates = matrices_->frame.coordinates;
  const std::size_t n = coordinates.size();
  const std::string key(kMatrices[kind].name);
  MatrixOfSums& matrix = matrices_->whole[kind];
  if (kind != kDampingMatrix) reader.required(key);
  const Value* value = keep(reader, key);

  // No damping but the damper's is a usual plant.
  if (!value) {
    matrix.assign(n * n, LinearSum(parameters_.size() + 1));
    return;
  }
  const std::string right = std::to_string(n) + ", one per coordinate";
  if (value->items().size() != n)
    throw Error(value->where(), "has " + std::to_string(value->items().size()) + " rows", right);
  for (std::size_t i = 0; i < n; ++i) {
    const Value& row = value->items()[i];
    if (row.items().size() != n)
      throw Error(row.where(), "has " + std::to_string(row.items().size()) + " numbers", right);
    for (std::size_t j = 0; j < n; ++j)
      matrix.push_back(read_sum(row.items()[j], kind,
                                int(is_angle(coordinates[i])) + int(is_angle(coordinates[j]))));
  }

  // Symmetric, but for how a unit's factor rounds.
  constexpr double kSame = 1e-12;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k <= parameters_.size(); ++k) {
        const double below = matrix[i * n + j][k], above = matrix[j * n + i][k];
        if (std::abs(below - above) > kSame * std::max(std::abs(below), std::abs(above)))
          throw Error(value->where(),
                      "is not symmetric: row " + std::to_string(i + 1) + ", column " +
                          std::to_string(j + 1) + " differs from row " + std::to_string(j + 1) +
                          ", column " + std::to_string(i + 1),
                      "the same at both places");
      }
}

/// A point of the plant as a row: a coordinate, or a sum of them by factors, which for angles are
/// lengths.
std::vector<double> MatrixReader::read_place(const Value& value) const {
  const auto& coordinates = matrices_->frame.coordinates;
  std::vector<std::string> known;
  for (const Coordinate& one : coordinates) known.push_back(one.name);
  std::vector<double> row(coordinates.size());
  const auto place_of = [&](const std::string& name) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end())
      throw Error(value.where(), "the plant has no coordinate '" + name + "'",
                  suggest(name, known));
    return static_cast<std::size_t>(found - known.begin());
  };

  if (value.kind() == Value::Kind::Object) {
    for (const auto& [name, factor] : value.members()) {
      const std::size_t k = place_of(name);
      row[k] = read_quantity(factor, is_angle(coordinates[k]) ? "m" : "1");
    }
    return row;
  }
  const std::size_t k = place_of(value.as_string());
  if (is_angle(coordinates[k]))
    throw Error(value.where(), known[k] + " is an angle, and a place is a height",
                "with its lever: {body: 1, " + known[k] + ": -1.3 m}");
  row[k] = 1;
  return row;
}

void MatrixReader::read_ground(const Value& value) {
  // Each spring and dashpot on the ground by its place; all on one ground, or each on its own.
  Plant& frame = matrices_->frame;
  const std::size_t parameters = parameters_.size();
  for (const Value& item : value.items()) {
    ObjectReader reader(item, "what stands on the ground");
    Tyre tyre{.name = reader.string("name", "")};
    tyre.row = read_place(reader.required("at"));
    OnGround on{LinearSum(parameters + 1), LinearSum(parameters + 1)};
    if (const Value* stiffness = reader.optional("stiffness"))
      on.stiffness = read_sum(*stiffness, kStiffnessMatrix, 0);
    if (const Value* damping = reader.optional("damping"))
      on.damping = read_sum(*damping, kDampingMatrix, 0);
    if (const Value* behind = reader.optional("behind")) tyre.behind = read_quantity(*behind, "m");
    reader.finish();
    if (tyre.behind < 0)
      throw Error(item.where(), "is behind by less than 0", "the first place has none");
    if (std::ranges::find(frame.tyres, tyre.name, &Tyre::name) != frame.tyres.end() &&
        !tyre.name.empty())
      throw Error(item.where(), "the name '" + tyre.name + "' stands twice", "a name for each");

    // The matrices hold it; apart, it is what the ground moves.
    const std::size_t n = frame.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k <= parameters; ++k) {
          const double by = tyre.row[i] * tyre.row[j];
          matrices_->free[kStiffnessMatrix][i * n + j][k] -= by * on.stiffness[k];
          matrices_->free[kDampingMatrix][i * n + j][k] -= by * on.damping[k];
        }
    frame.tyres.push_back(std::move(tyre));
    matrices_->on_ground.push_back(std::move(on));
  }
  if (frame.tyres.empty())
    throw Error(value.where(), "names nothing", "ground: [{at: wheel, stiffness: 200 kN/m}]");

  // Names make places of their own: behind the first, or else beside it.
  const auto named = std::ranges::count_if(frame.tyres, [](const Tyre& t) { return t.name != ""; });
  if (named != 0 && named != std::ssize(frame.tyres))
    throw Error(value.where(), "some have a name and some have none",
                "a name for each place with a road of its own, or none where it is one ground");
  for (std::size_t k = 0; k < frame.tyres.size(); ++k) {
    if (named > 1 && frame.tyres[k].behind == 0) frame.tyres[k].track = std::min<std::size_t>(k, 1);
    if (named == 0) frame.tyres[k].name = "ground";
  }
}

void MatrixReader::read_shaken(const Value& value) {
  if (!matrices_->frame.tyres.empty())
    throw Error(value.where(), "the plant has both a ground that moves and one that shakes it",
                "'ground' where its height is measured, 'shaken' where its acceleration is");
  std::vector<double>& ground = matrices_->frame.ground;
  ground.assign(matrices_->frame.size(), 0);
  for (const Value& name : value.items()) {
    const std::vector<double> row = read_place(name);
    for (std::size_t k = 0; k < row.size(); ++k) ground[k] += row[k];
  }
}

void MatrixReader::read_damper(const Value& value, bool is_only) {
  Plant& frame = matrices_->frame;
  ObjectReader reader(value, "a damper's place");
  Strut strut{.name = is_only ? reader.string("name", "damper") : reader.string("name")};
  const Value& from = reader.required("from");
  const Value& to = reader.required("to");
  reader.finish();
  const auto is_ground = [](const Value& end) {
    return end.kind() == Value::Kind::String && end.as_string() == "ground";
  };

  // It extends as its end 'to' moves forward.
  if (is_ground(to))
    throw Error(to.where(),
                "a damper extends as its end 'to' moves, and the ground is no coordinate",
                "from: ground, to: the coordinate");
  strut.body_row = read_place(to);
  if (!is_ground(from)) {
    strut.wheel_row = read_place(from);
  } else if (!frame.tyres.empty()) {
    if (has_several_roads(frame))
      throw Error(from.where(), "the ground is at several places", "a damper between coordinates");
    strut.track = 0;
  }
  strut.row = difference(strut.body_row, strut.wheel_row);
  if (std::ranges::all_of(strut.row, [](double one) { return one == 0; }))
    throw Error(value.where(), "both ends are at one place", "from one coordinate to another");

  const auto is_taken = [&](const auto& parts, auto name) {
    return std::ranges::find(parts, strut.name, name) != parts.end();
  };
  if (!is_a_name(strut.name) || is_taken(frame.struts, &Strut::name) ||
      is_taken(frame.coordinates, &Coordinate::name))
    throw Error(value.where(), "'" + strut.name + "' cannot be its name",
                "letters, digits and _; no other damper's and no coordinate's");
  frame.struts.push_back(std::move(strut));
}

/// The table: a row for each parameter.
void MatrixReader::add_rows() {
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    if (!found_in_[k].matrix)
      throw Error(source_ + ", parameters, " + parameters_[k], "stands in no matrix",
                  "use it in one, or leave it out");
    plant_.names.push_back(parameters_[k]);
    plant_.model.parameters.push_back({plant_.names.back(), found_in_[k].unit, 0, -kWidest, kWidest,
                                       found_in_[k].matrix->meaning});
  }
}

void MatrixReader::read(ObjectReader& reader) {
  for (const std::string& name : parameters_)
    if (!is_a_name(name))
      throw Error(source_ + ", parameters, " + name, "is no name",
                  "letters, digits and _, a letter first");
  reader.required("coordinates");
  read_coordinates(*keep(reader, "coordinates"));
  for (const MatrixKind kind : {kMassMatrix, kDampingMatrix, kStiffnessMatrix})
    read_matrix(reader, kind);

  // What moves with the ground, before the dampers, which may stand on it.
  matrices_->free = matrices_->whole;
  if (const Value* ground = keep(reader, "ground")) read_ground(*ground);
  if (const Value* shaken = keep(reader, "shaken")) read_shaken(*shaken);
  const Value* one = keep(reader, "damper");
  const Value* several = keep(reader, "dampers");
  if ((one != nullptr) == (several != nullptr))
    throw Error(source_ + ", damper",
                one ? "stands beside 'dampers'" : "says not where the damper is",
                "damper: {from: table, to: mass}, or a list of such places with names: 'dampers'");
  if (one) read_damper(*one, true);
  constexpr std::size_t kMost = 4;
  if (several) {
    for (const Value& item : several->items()) read_damper(item, false);
    if (several->items().empty() || several->items().size() > kMost)
      throw Error(several->where(), "has " + std::to_string(several->items().size()) + " dampers",
                  "one to " + std::to_string(kMost));
  }

  add_rows();
  plant_.model.name = kOfMatrices;
  plant_.model.title = "A plant of its own matrices";
  plant_.model.source = "its file";
  plant_.model.make = [matrices = matrices_](std::span<const double> parameters) {
    return plant_with(*matrices, parameters);
  };
}

/// Whether a symmetric matrix is positive definite, or semi-definite, as its kind asks for. Rows
/// and columns are divided by the roots of these diagonals, so that lengths and angles count alike.
bool is_of_a_structure(MatrixKind kind, std::vector<double> matrix,
                       const std::vector<double>& with_diagonal) {
  constexpr double kRounding = 1e-9;
  const std::size_t n = std::size_t(std::lround(std::sqrt(double(matrix.size()))));
  std::vector<double> size;
  for (std::size_t k = 0; k < n; ++k)
    size.push_back(with_diagonal[k * n + k] > 0 ? std::sqrt(with_diagonal[k * n + k]) : 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] /= size[i] * size[j];
  const double least = eigenvalues(matrix, diagonal(std::vector<double>(n, 1.0)), n).front();
  return kind == kMassMatrix ? least > kRounding : least >= -kRounding;
}

/// Throws Error where a matrix, with these numbers of the parameters, is none of a structure.
void require_structure(const PlantModel& model, MatrixKind kind, std::span<const double> numbers,
                       const std::string& at, const std::string& where) {
  const auto matrix_of = [kind](const auto& plant) {
    return kind == kMassMatrix      ? plant.mass
           : kind == kDampingMatrix ? plant.damping
                                    : plant.stiffness;
  };
  const Plant plant = model.make(numbers);
  const std::vector<double> whole = matrix_of(linear_plant(plant));
  const MatrixWords& words = kMatrices[kind];
  const std::string name = where + ", " + std::string(words.name);

  // As it stands in the file.
  if (!is_of_a_structure(kind, whole, whole))
    throw Error(name, "is not " + std::string(words.what) + at,
                kind == kMassMatrix ? "every motion has an energy above 0"
                                    : "no motion gives energy: a spring between two coordinates "
                                      "adds to both diagonals what it takes beside them");

  // Without what stands on the ground, which has no mass.
  if (kind == kMassMatrix) return;
  for (const Tyre& tyre : plant.tyres)
    if ((kind == kDampingMatrix ? tyre.damping : tyre.stiffness) < 0)
      throw Error(where + ", ground", std::string(words.name) + " is below 0" + at, "0 or more");
  if (!is_of_a_structure(kind, matrix_of(plant), whole))
    throw Error(name,
                "is not " + std::string(words.what) + " without what stands on the ground" + at,
                "the matrices with the ground's springs and dashpots in them, as where it rests");
}

}  // namespace

std::shared_ptr<PlantOfMatrices> read_plant_of_matrices(ObjectReader& reader,
                                                        const std::vector<std::string>& parameters,
                                                        const std::string& source) {
  auto plant = std::make_shared<PlantOfMatrices>();
  MatrixReader(*plant, parameters, source).read(reader);
  return plant;
}

void settle_unknowns(PlantOfMatrices& plant, InPlantSetup& setup, const std::string& where) {
  // Where each search begins and how far it goes.
  constexpr double kFar = 1000;
  auto& rows = plant.model.parameters;
  for (PlantUnknown& unknown : setup.unknown) {
    const bool has_range = unknown.lower > -kWidest && unknown.upper < kWidest;
    if (!unknown.about && has_range && unknown.lower > 0)
      unknown.about = std::sqrt(unknown.lower * unknown.upper);
    ParameterRow& row = rows[row_named(rows, unknown.name, kOfMatrices, where)];
    if (!unknown.about || (!has_range && *unknown.about <= 0))
      throw Error(where + ", parameters, " + unknown.name,
                  "is unknown, and nothing says where it is expected",
                  "{about: ...} in " + std::string(row.unit) + ", above 0, or with from: and to:");
    if (unknown.lower <= -kWidest) unknown.lower = *unknown.about / kFar;
    if (unknown.upper >= kWidest) unknown.upper = *unknown.about * kFar;
    row.value = *unknown.about;
  }

  // What is so at all corners of the ranges is so between them: these sets of matrices are convex.
  const std::vector<double> expected = with_values(rows, setup.known, kOfMatrices, where);
  for (const MatrixKind kind : {kMassMatrix, kDampingMatrix, kStiffnessMatrix}) {
    std::vector<std::pair<std::size_t, const PlantUnknown*>> free;
    for (const PlantUnknown& unknown : setup.unknown)
      if (const std::size_t row = row_named(rows, unknown.name, kOfMatrices, where);
          rows[row].meaning == kMatrices[kind].meaning)
        free.emplace_back(row, &unknown);
    constexpr std::size_t kMost = 10;
    if (free.size() > kMost)
      throw Error(where + ", " + std::string(kMatrices[kind].name),
                  "has " + std::to_string(free.size()) + " unknown numbers",
                  "at most " + std::to_string(kMost));
    require_structure(plant.model, kind, expected, "", where);
    for (std::size_t corner = 0; corner < (std::size_t{1} << free.size()); ++corner) {
      std::vector<double> numbers = expected;
      std::string at;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto& [row, unknown] = free[k];
        numbers[row] = corner >> k & 1 ? unknown->upper : unknown->lower;
        at += (at.empty() ? " at " : ", ") + unknown->name + " = " + format_number(numbers[row]) +
              " " + std::string(rows[row].unit);
      }
      require_structure(plant.model, kind, numbers, at, where);
    }
  }
}

}  // namespace dashpot
