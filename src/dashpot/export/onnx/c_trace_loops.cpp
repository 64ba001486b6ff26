#include <algorithm>

#include "dashpot/error.h"
#include "dashpot/export/onnx/c_trace.h"

namespace dashpot::trace {
namespace {

/// The most rounds that are unrolled of a loop whose body does not name its counter; further ones
/// become a loop of the graph.
constexpr double kMostUnrolled = 4;

/// Whether `name` stands in it.
bool names(const CExpr& expr, std::string_view name) {
  return (expr.kind == CExpr::Kind::Name && expr.text == name) ||
         std::ranges::any_of(expr.parts, [&](const CExpr& part) { return names(part, name); });
}

bool names(const CInitialiser& initialiser, std::string_view name) {
  const auto inside = [&](const auto& part) { return names(part, name); };
  return std::ranges::any_of(initialiser.value, inside) ||
         std::ranges::any_of(initialiser.list, inside);
}

bool names(const CStatement& statement, std::string_view name) {
  const auto inside = [&](const auto& part) { return names(part, name); };
  for (const auto* exprs : {&statement.exprs, &statement.start, &statement.step})
    if (std::ranges::any_of(*exprs, inside)) return true;
  for (const CDeclaration& declaration : statement.declarations)
    if (std::ranges::any_of(declaration.initialiser, inside)) return true;
  return std::ranges::any_of(statement.parts, inside);
}

bool has(const CStatement& statement, CStatement::Kind kind) {
  return statement.kind == kind ||
         std::ranges::any_of(statement.parts,
                             [&](const CStatement& part) { return has(part, kind); });
}

/// The name of the counter, k of for (k = ...; ...); empty where there is none.
std::string counter_of(const CStatement& loop) {
  const bool counts = loop.start.size() == 1 && loop.start[0].kind == CExpr::Kind::Assign &&
                      loop.start[0].parts[0].kind == CExpr::Kind::Name;
  return counts ? loop.start[0].parts[0].text : "";
}

/// Whether the body does not speak of the counter, which alone is stepped.
bool only_counts(const CStatement& loop) {
  const std::string counter = counter_of(loop);
  return !counter.empty() && loop.step.size() == 1 && loop.step[0].kind == CExpr::Kind::Unary &&
         !names(loop.parts[0], counter);
}

}  // namespace

/// Runs a loop. Its counter begins anew in the lanes at work, so that it stays a constant while
/// they count alike; behind the loop the other lanes get back what it was for them.
CTrace::Flow CTrace::run_loop(const CStatement& statement) {
  const std::string counter = counter_of(statement);
  if (counter.empty()) return run_rounds(statement);

  const std::size_t address = find(counter).address;
  const Cell was = memory_[address];
  memory_[address] = {.born = active_};
  const Flow flow = run_rounds(statement);

  Cell& cell = memory_[address];
  if (was.value.is_set && was.born != active_)
    cell.value.node = graph_.where(active_, cell.value.node, was.value.node);
  cell.born = was.born;
  return flow;
}

CTrace::Flow CTrace::run_rounds(const CStatement& statement) {
  const Node before = active_, outer = loop_entry_;
  if (!statement.start.empty()) evaluate(statement.start[0]);

  // A loop of the graph begins behind the rounds that were unrolled before, or takes their place:
  // then with the memory as it is now.
  const std::vector<Cell> begin = has(statement, CStatement::Kind::Break) || only_counts(statement)
                                      ? memory_
                                      : std::vector<Cell>{};

  // Unroll while all lanes go on alike.
  loop_entry_ = before;
  Flow flow = Flow::On;
  bool in_lanes = false;
  for (double round = 0; flow == Flow::On; ++round) {
    const Node goes_on = truth(statement.exprs[0]);
    if (graph_.is(goes_on, 0)) break;
    in_lanes = !graph_.is_constant(goes_on) ||
               (!unrolls_ && round >= kMostUnrolled && only_counts(statement));
    if (in_lanes) break;
    flow = run(statement.parts[0]);
    in_lanes = flow == Flow::On && active_ != before;
    if (in_lanes) break;
    if (flow == Flow::On && !statement.step.empty()) evaluate(statement.step[0]);
  }
  active_ = before;

  // The rest, where lanes part, is a loop of the graph.
  if (in_lanes) {
    if (!begin.empty()) memory_ = begin;
    run_lane_loop(statement);
  }
  loop_entry_ = outer;
  return flow == Flow::Broken ? Flow::On : flow;
}

/// Traces one round as the body of a new loop of the graph. False where the round changed what the
/// loop does not carry yet: then it carries more, and is traced again.
bool CTrace::run_body_once(const CStatement& statement, LaneLoop& loop) {
  // Into the body go the truth which lanes go on, then the carried cells.
  std::vector<Cell> other = memory_;
  const Node before = active_;
  std::vector<Node> starts{graph_.both(before, truth(statement.exprs[0]))}, ends;
  for (const std::size_t address : loop.carried) {
    const Value& value = memory_[address].value;
    starts.push_back(value.is_set ? graph_.as_number(value.node) : graph_.constant(0));
  }
  const std::size_t around = region_;
  loop.number = region_ = graph_.begin_loop(starts, around);
  const std::vector<Node> carried = graph_.loop(loop.number).carried;
  for (std::size_t k = 0; k < loop.carried.size(); ++k)
    memory_[loop.carried[k]].value = {.is_set = true, .node = carried[k + 1]};

  // The round, and whether there is another.
  active_ = loop_entry_ = carried[0];
  if (run(statement.parts[0]) != Flow::On) throw Error("C text", "has a loop of one round");
  if (!statement.step.empty()) evaluate(statement.step[0]);
  ends.push_back(graph_.both(active_, truth(statement.exprs[0])));

  // Copies take over what the pointers that moved see now; then the carried cells go out.
  for (const auto& [pointer, copy] : loop.copies) {
    const Value moved = memory_[pointer].value;
    for (std::size_t k = 0; k < moved.size; ++k)
      memory_[copy + k].value = memory_[moved.address + k].value;
    memory_[pointer].value.address = copy;
  }
  for (const std::size_t address : loop.carried)
    ends.push_back(graph_.as_number(memory_[address].value.node));
  graph_.end_loop(loop.number, std::move(ends));

  // Back to before the loop.
  memory_.swap(other);
  active_ = before;
  region_ = around;
  return !add_changed(other, loop);
}

/// `after`: the memory after a round; what differs from the memory now is carried from the next
/// attempt on.
bool CTrace::add_changed(const std::vector<Cell>& after, LaneLoop& loop) {
  const std::size_t known = loop.carried.size() + loop.copies.size(), size = memory_.size();
  for (std::size_t address = 0; address < size; ++address) {
    const Value was = memory_[address].value, is = after[address].value;
    // A pointer that moved is carried as a copy of what it sees, a number as it is.
    if (is.is_pointer && was.is_set && is.address != was.address) {
      const std::size_t copy = memory_.size();
      for (std::size_t k = 0; k < was.size; ++k) memory_.push_back(Cell(memory_[was.address + k]));
      loop.copies.emplace_back(address, copy);
      memory_[address].value.address = copy;
      memory_[address].value.end = copy + was.size;
    } else if (!is.is_pointer && is.is_set && (!was.is_set || is.node != was.node) &&
               std::ranges::find(loop.carried, address) == loop.carried.end()) {
      loop.carried.push_back(address);
    }
  }
  return loop.carried.size() + loop.copies.size() > known;
}

/// A loop of the graph, traced until it carries all that a round changes.
void CTrace::run_lane_loop(const CStatement& statement) {
  if (has(statement, CStatement::Kind::Return))
    throw Error("C text", "has a loop that data may leave by a return");
  LaneLoop loop;
  while (!run_body_once(statement, loop)) {
  }
  for (std::size_t k = 0; k < loop.carried.size(); ++k)
    memory_[loop.carried[k]].value = {.is_set = true, .node = graph_.result(loop.number, k + 1)};
}

}  // namespace dashpot::trace
