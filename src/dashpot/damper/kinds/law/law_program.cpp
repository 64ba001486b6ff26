#include "dashpot/damper/kinds/law/law_program.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <math.h>  // the C text says pow, not std::pow

#include "dashpot/error.h"

namespace dashpot {
namespace {

#include "dashpot/damper/c_text/law_functions.h"

constexpr std::uint16_t kNowhere = std::numeric_limits<std::uint16_t>::max();
constexpr std::size_t kInputs = 3 + kMaxStates;  // x, v, travel, states
/// Of one piece. A where() repeats what both of its ways need; beyond, both ways are computed.
constexpr std::size_t kMostOperations = 1000;
constexpr std::size_t kRegisters =
    2 * LawNodes::kMost + kMaxParams + kInputs + kMostOperations + LawNodes::kMost;

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
      : nodes_(nodes), places_(std::move(places)), free_(free), jumps_(jumps) {}

  /// The register with the value of a node.
  std::uint16_t value(std::uint16_t place) {
    if (places_[place] != kNowhere) return places_[place];
    const LawNode& node = nodes_[place];
    const std::uint16_t to = node.op == LawOp::Where && jumps_ ? either_way(node) : straight(node);
    places_[place] = to;
    return to;
  }

  bool is_too_long() const { return operations.size() > kMostOperations; }
  std::uint16_t place_of(std::uint16_t node) const { return places_[node]; }
  std::size_t first_free() const { return free_; }

  std::vector<Operation> operations;

 private:
  std::uint16_t new_register() { return static_cast<std::uint16_t>(free_++); }

  std::uint16_t straight(const LawNode& node) {
    std::array<std::uint16_t, 3> from{};
    for (std::size_t k = 0; k < node.arguments() && !is_too_long(); ++k)
      from[k] = value(node.of[k]);
    const std::uint16_t to = new_register();
    operations.push_back({node.op, to, from[0], from[1], from[2]});
    return to;
  }

  /// Only the way that the condition chooses is worked through, so what one of them has computed
  /// is not there for anybody else.
  std::uint16_t either_way(const LawNode& node) {
    if (is_too_long()) return 0;
    const std::uint16_t condition = value(node.of[0]), to = new_register();
    const std::vector<std::uint16_t> before = places_;

    const std::size_t unless = operations.size();
    operations.push_back({LawOp::JumpUnless, 0, condition, 0, 0});
    operations.push_back({LawOp::Move, to, value(node.of[1]), 0, 0});
    places_ = before;

    const std::size_t jump = operations.size();
    operations.push_back({LawOp::Jump, 0, 0, 0, 0});
    operations[unless].b = static_cast<std::uint16_t>(operations.size() - unless);
    operations.push_back({LawOp::Move, to, value(node.of[2]), 0, 0});
    operations[jump].b = static_cast<std::uint16_t>(operations.size() - jump);
    places_ = before;
    return to;
  }

  const LawNodes& nodes_;
  std::vector<std::uint16_t> places_;
  std::size_t free_;
  bool jumps_;
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
                              : node.op == LawOp::State        ? first_input_ + 3 + node.index
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
    if (fixed[k]) places_[k] = compiler.value(static_cast<std::uint16_t>(k));
  }
  of_parameters_ = std::move(compiler.operations);
  first_free_ = compiler.first_free();
}

LawProgram::Piece LawProgram::add(std::span<const std::uint16_t> outputs) {
  for (const bool jumps : {true, false}) {
    Compiler compiler(nodes_, places_, first_free_, jumps);
    Piece piece;
    for (const std::uint16_t output : outputs) piece.outputs.push_back(compiler.value(output));
    if (jumps && compiler.is_too_long()) continue;
    piece.first = operations_.size();
    operations_.insert(operations_.end(), compiler.operations.begin(), compiler.operations.end());
    piece.last = operations_.size();
    return piece;
  }
  return {};
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
  for (std::size_t k = 0; k < states_; ++k) inputs[3 + k] = z[k];
  work(operations_.data() + piece.first, operations_.data() + piece.last, r);
}

void LawProgram::work(const Operation* at, const Operation* end, double* r) {
  for (; at != end; ++at) {
    const double a = r[at->a];
    switch (at->op) {
      case LawOp::Number:
      case LawOp::Parameter:
      case LawOp::State:
      case LawOp::Displacement:
      case LawOp::Velocity:
      case LawOp::Travel:
        break;  // they stand in registers
      case LawOp::Negate:
        r[at->to] = -a;
        break;
      case LawOp::Add:
        r[at->to] = a + r[at->b];
        break;
      case LawOp::Subtract:
        r[at->to] = a - r[at->b];
        break;
      case LawOp::Multiply:
        r[at->to] = a * r[at->b];
        break;
      case LawOp::Divide:
        r[at->to] = a / r[at->b];
        break;
      case LawOp::Power:
        r[at->to] = law_power(a, r[at->b]);
        break;
      case LawOp::Abs:
        r[at->to] = fabs(a);
        break;
      case LawOp::Sign:
        r[at->to] = law_sign(a);
        break;
      case LawOp::Sqrt:
        r[at->to] = sqrt(a);
        break;
      case LawOp::Exp:
        r[at->to] = exp(a);
        break;
      case LawOp::Log:
        r[at->to] = log(a);
        break;
      case LawOp::Sin:
        r[at->to] = sin(a);
        break;
      case LawOp::Cos:
        r[at->to] = cos(a);
        break;
      case LawOp::Tan:
        r[at->to] = tan(a);
        break;
      case LawOp::Tanh:
        r[at->to] = tanh(a);
        break;
      case LawOp::Atan:
        r[at->to] = atan(a);
        break;
      case LawOp::Atanh:
        r[at->to] = atanh(a);
        break;
      case LawOp::Min:
        r[at->to] = fmin(a, r[at->b]);
        break;
      case LawOp::Max:
        r[at->to] = fmax(a, r[at->b]);
        break;
      case LawOp::Less:
        r[at->to] = a < r[at->b] ? 1 : 0;
        break;
      case LawOp::LessOrEqual:
        r[at->to] = a <= r[at->b] ? 1 : 0;
        break;
      case LawOp::Equal:
        r[at->to] = a == r[at->b] ? 1 : 0;
        break;
      case LawOp::And:
        r[at->to] = a != 0 && r[at->b] != 0 ? 1 : 0;
        break;
      case LawOp::Or:
        r[at->to] = a != 0 || r[at->b] != 0 ? 1 : 0;
        break;
      case LawOp::Where:
        r[at->to] = a != 0 ? r[at->b] : r[at->c];
        break;
      case LawOp::Move:
        r[at->to] = a;
        break;
      case LawOp::Jump:
        at += at->b - 1;
        break;
      case LawOp::JumpUnless:
        if (a == 0) at += at->b - 1;
        break;
    }
  }
}

}  // namespace dashpot
