#include "dashpot/damper/kinds/law/law_program.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <math.h>  // the C text says pow, not std::pow

namespace dashpot {
namespace {

#include "dashpot/damper/c_text/law_functions.h"

constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
// Inputs: x, v, the travel, the states; of a step x and v three times, h / 2, h and h / 6.
constexpr std::size_t kStates = 3, kStepX = kStates + kMaxStates, kStepV = kStepX + 3,
                      kHalf = kStepV + 3, kInputs = kHalf + 3;
/// Of one piece. A where() repeats what both of its ways need; beyond, both ways are computed.
constexpr std::size_t kMostOperations = 1000;
constexpr std::size_t kRegisters =
    2 * LawNodes::kMost + kMaxParams + kInputs + kMostOperations + 5 * LawNodes::kMost;

/// An operation in its form for numbers in registers, and in those that take the outcome of the
/// operation before as first or as second operand.
struct FormWithIt {
  LawOp plain, first, second;
};
constexpr std::array kFormsWithIt{
    FormWithIt{LawOp::Negate, LawOp::NegateIt, LawOp::Negate},
    FormWithIt{LawOp::Abs, LawOp::AbsOfIt, LawOp::Abs},
    FormWithIt{LawOp::Add, LawOp::AddToIt, LawOp::AddToIt},
    FormWithIt{LawOp::Subtract, LawOp::SubtractFromIt, LawOp::SubtractIt},
    FormWithIt{LawOp::Multiply, LawOp::MultiplyIt, LawOp::MultiplyIt},
    FormWithIt{LawOp::Divide, LawOp::DivideIt, LawOp::DivideByIt},
    FormWithIt{LawOp::Power, LawOp::PowerOfIt, LawOp::Power}};

/// What a thread computes in, and whose constants stand in it.
struct Machine {
  std::uint64_t program = 0;
  double registers[kRegisters] = {};
};
thread_local Machine machine;

}  // namespace

/// Writes the operations of one piece.
class LawProgram::Compiler {
 public:
  Compiler(const LawNodes& nodes, std::vector<std::uint16_t> places, std::size_t free, bool jumps)
      : nodes_(nodes), places_(std::move(places)), free_(free), jumps_(jumps), uses_(nodes.size()) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (std::size_t a = 0; a < nodes[k].arguments(); ++a) ++uses_[nodes[k].of[a]];
  }

  /// A node whose value is wanted as it is.
  void keep(std::uint16_t node) { ++uses_[node]; }

  /// The register with the value of a node.
  std::uint16_t value(std::uint16_t place) {
    if (places_[place] != kNowhere) return places_[place];
    const LawNode& node = nodes_[place];
    const std::uint16_t to = node.op == LawOp::Where && jumps_ ? either_way(node) : straight(node);
    places_[place] = to;
    return to;
  }

  /// The register with the outcome of one more operation.
  std::uint16_t apply(LawOp op, std::uint16_t a, std::uint16_t b) {
    return push({op, 0, a, b, 0}, false);
  }
  /// a * b + c
  std::uint16_t multiply_add(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    apply(LawOp::Multiply, a, b);
    return push({LawOp::Add, 0, operations.back().to, c, 0}, true);
  }

  /// From here on a node stands in this register, or nowhere yet.
  void place(std::size_t node, std::uint16_t in) { places_[node] = in; }

  bool is_too_long() const { return operations.size() > kMostOperations; }
  std::size_t first_free() const { return free_; }

  std::vector<Operation> operations;

 private:
  std::uint16_t new_register() { return static_cast<std::uint16_t>(free_++); }

  std::uint16_t straight(const LawNode& node) {
    std::array<std::uint16_t, 3> from{};
    for (std::size_t k = 0; k < node.arguments() && !is_too_long(); ++k)
      from[k] = value(node.of[k]);

    // A product that has just been computed for this sum alone becomes a part of it, and stands
    // nowhere by itself.
    bool joins = false;
    if (node.op == LawOp::Add && operations.size() > label_) {
      const std::size_t k = operations.back().to == from[0] ? 0 : 1;
      joins = operations.back().to == from[k] && uses_[node.of[k]] == 1 &&
              nodes_[node.of[k]].op == LawOp::Multiply;
      if (joins) places_[node.of[k]] = kNowhere;
    }
    return push({node.op, 0, from[0], from[1], from[2]}, joins);
  }

  /// Adds an operation, in the form that takes the outcome of the one before from where it is.
  std::uint16_t push(Operation made, bool joins) {
    made.to = new_register();
    if (operations.size() > label_) {
      Operation& before = operations.back();
      const bool first = before.to == made.a, second = before.to == made.b;
      if (joins && made.op == LawOp::Add && first != second &&
          (before.op == LawOp::Multiply || before.op == LawOp::MultiplyIt)) {
        before.c = first ? made.b : made.a;
        before.op = before.op == LawOp::Multiply ? LawOp::MultiplyAdd : LawOp::MultiplyItAdd;
        before.to = made.to;
        return made.to;
      }
      if (first != second && yields(before.op)) made = with_it(made, first);
    }
    operations.push_back(made);
    return made.to;
  }

  static bool yields(LawOp op) { return op != LawOp::Jump && op != LawOp::JumpUnless; }

  /// The form that takes the outcome before as its first operand or as its second.
  static Operation with_it(Operation made, bool first) {
    const auto form = std::ranges::find(kFormsWithIt, made.op, &FormWithIt::plain);
    if (form == kFormsWithIt.end()) return made;
    made.op = first ? form->first : form->second;
    if (!first && form->first == form->second) std::swap(made.a, made.b);
    return made;
  }

  /// Only the way that the condition chooses is worked through, so what one of them has computed
  /// is not there for anybody else.
  std::uint16_t either_way(const LawNode& node) {
    if (is_too_long()) return 0;
    const std::uint16_t condition = value(node.of[0]), to = new_register();
    const std::vector<std::uint16_t> before = places_;

    const std::size_t unless = operations.size();
    operations.push_back({LawOp::JumpUnless, 0, condition, 0, 0});
    label_ = operations.size();
    const std::uint16_t yes = value(node.of[1]);
    operations.push_back({LawOp::Move, to, yes, 0, 0});
    places_ = before;

    const std::size_t jump = operations.size();
    operations.push_back({LawOp::Jump, 0, 0, 0, 0});
    operations[unless].b = static_cast<std::uint16_t>(operations.size() - unless);
    label_ = operations.size();
    const std::uint16_t no = value(node.of[2]);
    operations.push_back({LawOp::Move, to, no, 0, 0});
    operations[jump].b = static_cast<std::uint16_t>(operations.size() - jump);
    label_ = operations.size();
    places_ = before;
    return to;
  }

  const LawNodes& nodes_;
  std::vector<std::uint16_t> places_;
  std::size_t free_;
  bool jumps_;
  std::vector<int> uses_;  ///< how many nodes and outputs take a node
  std::size_t label_ = 0;  ///< where several ways meet last: what was before is not known there
};

LawProgram::LawProgram(const LawNodes& nodes, std::size_t parameters, std::size_t states)
    : nodes_(nodes),
      parameters_(parameters),
      states_(states),
      id_([] {
        static std::atomic<std::uint64_t> made = 0;
        return ++made;
      }()),
      places_(nodes.size(), kNowhere) {
  // The registers: constants, parameters, inputs.
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k].op == LawOp::Number) {
      places_[k] = static_cast<std::uint16_t>(constants_.size());
      constants_.push_back(nodes[k].number);
    }
  first_parameter_ = constants_.size();
  first_input_ = first_parameter_ + parameters_;
  first_free_ = first_input_ + kInputs;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const LawNode& node = nodes[k];
    const std::size_t place = node.op == LawOp::Parameter      ? first_parameter_ + node.index
                              : node.op == LawOp::Displacement ? first_input_
                              : node.op == LawOp::Velocity     ? first_input_ + 1
                              : node.op == LawOp::Travel       ? first_input_ + 2
                              : node.op == LawOp::State        ? first_input_ + kStates + node.index
                                                               : kNowhere;
    if (place != kNowhere) places_[k] = static_cast<std::uint16_t>(place);
  }

  // What follows from parameters alone is computed beforehand.
  std::vector<bool> fixed(nodes.size());
  Compiler compiler(nodes, places_, first_free_, false);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const LawNode& node = nodes[k];
    fixed[k] = node.op == LawOp::Number || node.op == LawOp::Parameter;
    if (node.arguments() == 0) continue;
    fixed[k] = true;
    for (std::size_t a = 0; a < node.arguments(); ++a) fixed[k] = fixed[k] && fixed[node.of[a]];
    if (!fixed[k]) continue;
    compiler.keep(static_cast<std::uint16_t>(k));
    places_[k] = compiler.value(static_cast<std::uint16_t>(k));
  }
  of_parameters_ = std::move(compiler.operations);
  first_free_ = compiler.first_free();
}

LawProgram::Piece LawProgram::add(std::span<const std::uint16_t> outputs) {
  for (const bool jumps : {true, false}) {
    Compiler compiler(nodes_, places_, first_free_, jumps);
    Piece piece;
    for (const std::uint16_t output : outputs) compiler.keep(output);
    for (const std::uint16_t output : outputs) piece.outputs.push_back(compiler.value(output));
    if (jumps && compiler.is_too_long()) continue;
    return finished(std::move(piece), compiler);
  }
  return {};
}

LawProgram::Piece LawProgram::add_step(std::span<const std::uint16_t> rates) {
  const auto input = [&](std::size_t k) { return static_cast<std::uint16_t>(first_input_ + k); };
  const std::vector<bool> moves = moving();
  for (const bool jumps : {true, false}) {
    Compiler compiler(nodes_, places_, first_free_, jumps);
    for (const std::uint16_t rate : rates) compiler.keep(rate);
    std::vector<std::uint16_t> start;
    for (std::size_t k = 0; k < states_; ++k) start.push_back(input(kStates + k));

    // The rates at a place of the step. The middle is met twice: what no state moves stays then.
    std::size_t last_place = kMostOperations;
    const auto rates_at = [&](std::size_t place, const std::vector<std::uint16_t>& states) {
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const LawNode& node = nodes_[k];
        const bool again = place == last_place && !moves[k];
        if (node.op == LawOp::State)
          compiler.place(k, states[node.index]);
        else if (node.op == LawOp::Displacement)
          compiler.place(k, input(kStepX + place));
        else if (node.op == LawOp::Velocity)
          compiler.place(k, input(kStepV + place));
        else if (!again)
          compiler.place(k, places_[k]);
      }
      last_place = place;
      std::vector<std::uint16_t> slopes;
      for (const std::uint16_t rate : rates) slopes.push_back(compiler.value(rate));
      return slopes;
    };
    const auto moved = [&](std::uint16_t length, const std::vector<std::uint16_t>& slopes) {
      std::vector<std::uint16_t> states;
      for (std::size_t k = 0; k < states_; ++k)
        states.push_back(compiler.multiply_add(slopes[k], length, start[k]));
      return states;
    };

    // Slopes at the start, twice in the middle, and at the end; then their mean.
    const auto k1 = rates_at(0, start);
    const auto k2 = rates_at(1, moved(input(kHalf), k1));
    const auto k3 = rates_at(1, moved(input(kHalf), k2));
    const auto k4 = rates_at(2, moved(input(kHalf + 1), k3));
    std::vector<std::uint16_t> sums;
    for (std::size_t k = 0; k < states_; ++k) {
      const std::uint16_t middle = compiler.apply(LawOp::Add, k2[k], k3[k]),
                          twice = compiler.apply(LawOp::Add, middle, middle);
      sums.push_back(compiler.apply(LawOp::Add, compiler.apply(LawOp::Add, k1[k], twice), k4[k]));
    }
    Piece piece{.outputs = moved(input(kHalf + 2), sums)};
    if (jumps && compiler.is_too_long()) continue;
    return finished(std::move(piece), compiler);
  }
  return {};
}

std::vector<bool> LawProgram::moving() const {
  std::vector<bool> moves(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    moves[k] = nodes_[k].op == LawOp::State;
    for (std::size_t a = 0; a < nodes_[k].arguments(); ++a)
      moves[k] = moves[k] || moves[nodes_[k].of[a]];
  }
  return moves;
}

LawProgram::Piece LawProgram::finished(Piece piece, const Compiler& compiler) {
  piece.first = operations_.size();
  operations_.insert(operations_.end(), compiler.operations.begin(), compiler.operations.end());
  piece.last = operations_.size();
  return piece;
}

double* LawProgram::registers(const double* p) const {
  double* const r = machine.registers;
  double* const parameters = r + first_parameter_;
  const std::size_t bytes = parameters_ * sizeof(double);
  if (machine.program == id_ && std::memcmp(parameters, p, bytes) == 0) return r;

  // Another law was at work here, or other parameters.
  if (machine.program != id_) std::copy(constants_.begin(), constants_.end(), r);
  machine.program = id_;
  std::memcpy(parameters, p, bytes);
  work(of_parameters_.data(), of_parameters_.data() + of_parameters_.size(), r);
  return r;
}

void LawProgram::run(const Piece& piece, double* r, double x, double v, const double* z,
                     double travel) const {
  double* const inputs = r + first_input_;
  inputs[0] = x;
  inputs[1] = v;
  inputs[2] = travel;
  for (std::size_t k = 0; k < states_; ++k) inputs[kStates + k] = z[k];
  work(operations_.data() + piece.first, operations_.data() + piece.last, r);
}

void LawProgram::step(const Piece& piece, double* r, const double* x, const double* v, double h,
                      double* z) const {
  double* const inputs = r + first_input_;
  for (std::size_t k = 0; k < states_; ++k) inputs[kStates + k] = z[k];
  for (std::size_t k = 0; k < 3; ++k) {
    inputs[kStepX + k] = x[k];
    inputs[kStepV + k] = v[k];
  }
  inputs[kHalf] = h / 2;
  inputs[kHalf + 1] = h;
  inputs[kHalf + 2] = h / 6;
  work(operations_.data() + piece.first, operations_.data() + piece.last, r);
  for (std::size_t k = 0; k < states_; ++k) z[k] = r[piece.outputs[k]];
}

/// One case per operation, each a line of arithmetic; the outcome goes to its place in r.
void LawProgram::work(const Operation* at, const Operation* end, double* r) {
  double it = 0;  // the outcome of the operation before
  for (; at != end; ++at) {
    const auto a = [&] { return r[at->a]; };
    const auto b = [&] { return r[at->b]; };
    switch (at->op) {
      // Arithmetic, of two registers or of the outcome before and one.
      case LawOp::Negate:
        it = -a();
        break;
      case LawOp::NegateIt:
        it = -it;
        break;
      case LawOp::Add:
        it = a() + b();
        break;
      case LawOp::AddToIt:
        it = it + b();
        break;
      case LawOp::Subtract:
        it = a() - b();
        break;
      case LawOp::SubtractFromIt:
        it = it - b();
        break;
      case LawOp::SubtractIt:
        it = a() - it;
        break;
      case LawOp::Multiply:
        it = a() * b();
        break;
      case LawOp::MultiplyIt:
        it = it * b();
        break;
      case LawOp::MultiplyAdd:
        it = a() * b() + r[at->c];
        break;
      case LawOp::MultiplyItAdd:
        it = it * b() + r[at->c];
        break;
      case LawOp::Divide:
        it = a() / b();
        break;
      case LawOp::DivideIt:
        it = it / b();
        break;
      case LawOp::DivideByIt:
        it = a() / it;
        break;
      case LawOp::Power:
        it = law_power(a(), b());
        break;
      case LawOp::PowerOfIt:
        it = law_power(it, b());
        break;

      // Functions of the equations' language.
      case LawOp::Abs:
        it = fabs(a());
        break;
      case LawOp::AbsOfIt:
        it = fabs(it);
        break;
      case LawOp::Sign:
        it = law_sign(a());
        break;
      case LawOp::Sqrt:
        it = sqrt(a());
        break;
      case LawOp::Exp:
        it = exp(a());
        break;
      case LawOp::Log:
        it = log(a());
        break;
      case LawOp::Sin:
        it = sin(a());
        break;
      case LawOp::Cos:
        it = cos(a());
        break;
      case LawOp::Tan:
        it = tan(a());
        break;
      case LawOp::Tanh:
        it = tanh(a());
        break;
      case LawOp::Atan:
        it = atan(a());
        break;
      case LawOp::Atanh:
        it = atanh(a());
        break;
      case LawOp::Min:
        it = fmin(a(), b());
        break;
      case LawOp::Max:
        it = fmax(a(), b());
        break;

      // Conditions hold where they are not 0.
      case LawOp::Less:
        it = a() < b() ? 1 : 0;
        break;
      case LawOp::LessOrEqual:
        it = a() <= b() ? 1 : 0;
        break;
      case LawOp::Equal:
        it = a() == b() ? 1 : 0;
        break;
      case LawOp::And:
        it = a() != 0 && b() != 0 ? 1 : 0;
        break;
      case LawOp::Or:
        it = a() != 0 || b() != 0 ? 1 : 0;
        break;
      case LawOp::Where:
        it = a() != 0 ? b() : r[at->c];
        break;

      // The way through the list; a jump leaves no outcome.
      case LawOp::Move:
        it = a();
        break;
      case LawOp::Jump:
        at += at->b - 1;
        continue;
      case LawOp::JumpUnless:
        if (a() == 0) at += at->b - 1;
        continue;

      // Numbers, parameters, states and inputs stand in registers before the work begins.
      case LawOp::Number:
      case LawOp::Parameter:
      case LawOp::State:
      case LawOp::Displacement:
      case LawOp::Velocity:
      case LawOp::Travel:
        continue;
    }
    r[at->to] = it;
  }
}

}  // namespace dashpot
