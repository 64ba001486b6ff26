#include "dashpot/error.h"
#include "dashpot/export/onnx/c_functions.h"
#include "dashpot/export/onnx/c_trace.h"

namespace dashpot::trace {

CTrace::Result CTrace::place(const CType& type, std::size_t address, std::size_t end) const {
  return {.type = type, .is_place = true, .address = address, .end = end};
}

CTrace::Result CTrace::of_number(Node node, CType::Kind kind) const {
  return {.type = {.kind = kind}, .value = {.is_set = true, .node = node}};
}

Node CTrace::truth(const CExpr& expr) { return graph_.as_truth(number_of(evaluate(expr))); }

CTrace::Result CTrace::evaluate(const CExpr& expr) {
  switch (expr.kind) {
    case CExpr::Kind::Number:
      return of_number(graph_.constant(expr.number),
                       expr.is_integer ? CType::Kind::Int : CType::Kind::Real);
    // A name is a place: what stands there is loaded when it is asked for.
    case CExpr::Kind::Name: {
      const Variable& variable = find(expr.text);
      return place(variable.type, variable.address,
                   variable.address + program_.size_of(variable.type));
    }
    case CExpr::Kind::Unary:
      return unary(expr);
    case CExpr::Kind::Binary:
      return binary(expr);
    case CExpr::Kind::Assign:
      return assign(expr);
    case CExpr::Kind::Conditional:
      return choose(expr);
    case CExpr::Kind::Call:
      return call(expr);
    case CExpr::Kind::Index:
      return index(expr);
    case CExpr::Kind::Member:
      return member(expr);
    case CExpr::Kind::Cast:
      return cast(expr);
  }
  return {};
}

CTrace::Result CTrace::unary(const CExpr& expr) {
  const Result of = evaluate(expr.parts[0]);

  // Pointers: to a place, and the place that one points to.
  if (expr.text == "&") {
    CType type = of.type;
    ++type.pointers;
    return {.type = type,
            .value = {.is_set = true,
                      .is_pointer = true,
                      .address = of.address,
                      .end = of.end,
                      .size = program_.size_of(of.type)}};
  }
  if (expr.text == "*") {
    const Value pointer = load(of);
    CType type = of.type;
    if (!type.is_array) --type.pointers;
    type.is_array = false;
    return place(type, pointer.address, pointer.end);
  }

  // Numbers, and counters that go up or down before they are used.
  if (expr.text == "!")
    return of_number(graph_.opposite(graph_.as_truth(number_of(of))), CType::Kind::Int);
  if (expr.text == "-") return of_number(graph_.scaled(number_of(of), -1), of.type.kind);
  const Node changed = graph_.add(number_of(of), graph_.constant(expr.text == "++" ? 1 : -1));
  store(of.address, {.is_set = true, .node = changed});
  return of;
}

CTrace::Result CTrace::binary(const CExpr& expr) {
  // The right side of && and || is computed by those lanes alone that the left does not decide.
  if (expr.text == "&&" || expr.text == "||") {
    const Node a = truth(expr.parts[0]), before = active_;
    const bool both = expr.text == "&&";
    if (graph_.is(a, both ? 0 : 1)) return of_number(a, CType::Kind::Int);
    active_ = graph_.both(before, both ? a : graph_.opposite(a));
    const Node b = truth(expr.parts[1]);
    active_ = before;
    return of_number(both ? graph_.both(a, b) : graph_.either(a, b), CType::Kind::Int);
  }

  const Result a = evaluate(expr.parts[0]), b = evaluate(expr.parts[1]);
  return expr.text == "," ? b : arithmetic(expr.text, a, b);
}

CTrace::Result CTrace::arithmetic(std::string_view mark, const Result& a, const Result& b) {
  // A pointer moves by whole elements, as far as the text alone says.
  const Value left = load(a);
  if (left.is_pointer) {
    const Node offset = number_of(b);
    if (mark != "+" || !graph_.is_constant(offset))
      throw Error("C text", "has a pointer that depends on the data");
    CType type = a.type, element = a.type;
    element.is_array = false;
    if (type.is_array) {
      type = element;
      ++type.pointers;
    } else {
      --element.pointers;
    }
    const auto steps = static_cast<std::size_t>(graph_.value(offset));
    Value moved = left;
    moved.address += steps * program_.size_of(element);
    return {.type = type, .value = moved};
  }

  // Comparisons.
  const Node x = left.node, y = number_of(b);
  const auto is_truth = [&](Node node) { return of_number(node, CType::Kind::Int); };
  if (mark == "<") return is_truth(graph_.less(x, y));
  if (mark == ">") return is_truth(graph_.less(y, x));
  if (mark == "<=") return is_truth(graph_.less_or_equal(x, y));
  if (mark == ">=") return is_truth(graph_.less_or_equal(y, x));
  if (mark == "==") return is_truth(graph_.equal(x, y));
  if (mark == "!=") return is_truth(graph_.opposite(graph_.equal(x, y)));

  // Arithmetic; / and % of whole numbers cut, which is floor for counts: they are positive.
  const bool whole = a.type.kind == CType::Kind::Int && b.type.kind == CType::Kind::Int;
  const auto kind = whole ? CType::Kind::Int : CType::Kind::Real;
  if (mark == "+") return of_number(graph_.add(x, y), kind);
  if (mark == "-") return of_number(graph_.subtract(x, y), kind);
  if (mark == "*") return of_number(graph_.multiply(x, y), kind);
  const Node ratio = graph_.divide(x, y);
  if (!whole) return of_number(ratio, kind);
  const Node times = graph_.apply(Op::Floor, ratio);
  return of_number(mark == "/" ? times : graph_.subtract(x, graph_.multiply(times, y)), kind);
}

CTrace::Result CTrace::assign(const CExpr& expr) {
  const Result to = evaluate(expr.parts[0]);
  Result from = evaluate(expr.parts[1]);
  if (!expr.text.empty()) from = arithmetic(expr.text, to, from);
  give(from, to.type, to.address);
  return to;
}

CTrace::Result CTrace::choose(const CExpr& expr) {
  const Node condition = truth(expr.parts[0]), before = active_;
  const Node yes = graph_.both(before, condition),
             no = graph_.both(before, graph_.opposite(condition));

  // If all lanes agree, only what they choose is computed.
  if (graph_.is(no, 0) || yes == before) return evaluate(expr.parts[1]);
  if (graph_.is(yes, 0) || no == before) return evaluate(expr.parts[2]);

  // Else each lane takes its own of the two.
  active_ = yes;
  const Result a = evaluate(expr.parts[1]);
  const Node of_yes = number_of(a);
  active_ = no;
  const Result b = evaluate(expr.parts[2]);
  const Node of_no = number_of(b);
  active_ = before;
  const bool whole = a.type.kind == CType::Kind::Int && b.type.kind == CType::Kind::Int;
  return of_number(graph_.where(condition, of_yes, of_no),
                   whole ? CType::Kind::Int : CType::Kind::Real);
}

CTrace::Result CTrace::index(const CExpr& expr) {
  const Result of = evaluate(expr.parts[0]), at = evaluate(expr.parts[1]);
  const Value pointer = load(of);
  CType element = of.type;
  if (!element.is_array) --element.pointers;
  element.is_array = false;
  const Node which = number_of(at);
  if (graph_.is_constant(which))
    return place(
        element,
        pointer.address + static_cast<std::size_t>(graph_.value(which)) * program_.size_of(element),
        pointer.end);
  return index_by_lane(pointer, element, which);
}

/// The place of a copy of the element that each lane means. What is written to it goes to the
/// element itself (Cell::through).
CTrace::Result CTrace::index_by_lane(const Value& pointer, const CType& element, Node which) {
  const std::size_t size = program_.size_of(element),
                    count = (pointer.end - pointer.address) / size;
  const std::size_t address = allocate(element);
  for (std::size_t k = count; k-- > 0;) {
    const Node lanes = graph_.equal(which, graph_.constant(static_cast<double>(k)));
    for (std::size_t part = 0; part < size; ++part) {
      const std::size_t from = pointer.address + k * size + part;
      const Value seen = memory_[from].value;
      Cell& cell = memory_[address + part];

      // Lanes that mean this element see it; the others keep what they saw.
      if (seen.is_pointer) throw Error("C text", "has a pointer that depends on the data");
      if (seen.is_set)
        cell.value = {.is_set = true,
                      .node = cell.value.is_set ? graph_.where(lanes, seen.node, cell.value.node)
                                                : seen.node};
      cell.through.emplace_back(lanes, from);
    }
  }
  return place(element, address, address + size);
}

CTrace::Result CTrace::member(const CExpr& expr) {
  const Result of = evaluate(expr.parts[0]);
  std::size_t address = of.address;
  for (const CDeclaration& field : program_.structs.at(of.type.structure).fields) {
    const std::size_t end = address + program_.size_of(field.type);
    if (field.name == expr.text) return place(field.type, address, end);
    address = end;
  }
  throw Error("C text", "has no field '" + expr.text + "'");
}

CTrace::Result CTrace::cast(const CExpr& expr) {
  Result of = evaluate(expr.parts[0]);
  // (void)x says that x is not used; a pointer stays what it is.
  if (expr.type.kind == CType::Kind::Void && expr.type.pointers == 0) return {};
  if (expr.type.pointers > 0) return {.type = expr.type, .value = load(of)};

  // A real number that becomes whole is cut towards zero.
  const Node number = number_of(of);
  if (expr.type.kind == CType::Kind::Int && of.type.kind == CType::Kind::Real) {
    const Node whole =
        graph_.where(graph_.less(number, graph_.constant(0)), graph_.apply(Op::Ceil, number),
                     graph_.apply(Op::Floor, number));
    return of_number(whole, CType::Kind::Int);
  }
  return of_number(number, expr.type.kind);
}

CTrace::Result CTrace::call(const CExpr& expr) {
  std::vector<Result> arguments;
  for (const CExpr& part : expr.parts) arguments.push_back(evaluate(part));
  if (!is_c_function(expr.text)) {
    const auto function = program_.functions.find(expr.text);
    if (function != program_.functions.end()) return call_function(function->second, arguments);
    throw Error("C text", "calls '" + expr.text + "', which no graph has");
  }
  std::vector<Node> numbers;
  for (const Result& argument : arguments) numbers.push_back(number_of(argument));
  return of_number(c_function(graph_, expr.text, numbers), CType::Kind::Real);
}

}  // namespace dashpot::trace
