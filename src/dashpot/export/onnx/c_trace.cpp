#include "dashpot/export/onnx/c_trace.h"

#include "dashpot/error.h"

namespace dashpot::trace {

CTrace::CTrace(const CProgram& program, Graph& graph, bool unrolls)
    : program_(program), graph_(graph), unrolls_(unrolls), active_(graph.truth(true)) {
  scopes_.emplace_back();
  for (const CDeclaration& global : program.globals) declare(global);
}

// Memory.

std::size_t CTrace::room(const std::vector<Node>& values) {
  const std::size_t address = memory_.size();
  for (const Node value : values) memory_.push_back({{.is_set = true, .node = value}, active_, {}});
  return address;
}

std::size_t CTrace::allocate(const CType& type) {
  const std::size_t address = memory_.size();
  memory_.resize(address + program_.size_of(type), {.born = active_});
  return address;
}

void CTrace::store(std::size_t address, const Value& value) {
  if (memory_.at(address).value.is_set && memory_[address].value.is_pointer)
    return store_pointer(address, value);

  // Lanes that are not at work keep what they have; there are none where the cell is as young as
  // the branch.
  Cell& cell = memory_[address];
  if (!cell.value.is_set || active_ == cell.born)
    cell.value = value;
  else
    cell.value.node = graph_.where(active_, value.node, cell.value.node);

  // A copy hands on what is written to it, lane by lane.
  const Node before = active_;
  for (const auto& [lanes, target] : std::vector(cell.through)) {
    active_ = graph_.both(before, lanes);
    store(target, value);
  }
  active_ = before;
}

/// Writes a pointer. If lanes would point to different places, all point to a copy of what each
/// would see.
void CTrace::store_pointer(std::size_t address, const Value& value) {
  const Value was = memory_[address].value;
  if (value.address == was.address || active_ == memory_[address].born) {
    memory_[address].value = value;
    return;
  }

  // Copy what either points to, number by number.
  const std::size_t copy_at = memory_.size();
  for (std::size_t k = 0; k < value.size; ++k) {
    const Value seen = memory_[value.address + k].value, other = memory_[was.address + k].value;
    if (seen.is_pointer || other.is_pointer)
      throw Error("C text", "has a pointer that depends on the data");
    const Node both = other.is_set ? graph_.where(active_, seen.node, other.node) : seen.node;
    memory_.push_back({{.is_set = seen.is_set || other.is_set, .node = both}, active_, {}});
  }
  memory_[address].value = {true, true, 0, copy_at, memory_.size(), value.size};
}

void CTrace::give(const Result& from, const CType& type, std::size_t to) {
  if (!type.is_struct()) return store(to, load(from));
  for (std::size_t k = 0; k < program_.size_of(type); ++k)
    if (const Value value = memory_[from.address + k].value; value.is_set) store(to + k, value);
}

CTrace::Value CTrace::load(const Result& result) {
  if (!result.is_place) return result.value;
  if (result.type.is_array)
    return {.is_set = true,
            .is_pointer = true,
            .address = result.address,
            .end = result.address + program_.size_of(result.type),
            .size = program_.size_of(result.type) / result.type.count};
  const Value& value = memory_.at(result.address).value;
  // No lane looks at a cell that was never written: any value will do.
  return value.is_set ? value : Value{.is_set = true, .node = graph_.constant(0)};
}

Node CTrace::number_of(const Result& result) {
  const Value value = load(result);
  if (value.is_pointer || result.type.is_struct())
    throw Error("C text", "has a pointer or struct where a number should stand");
  return value.node;
}

const CTrace::Variable& CTrace::find(std::string_view name) const {
  for (const auto* scope : {&scopes_.back(), &scopes_.front()})
    for (auto entry = scope->rbegin(); entry != scope->rend(); ++entry)
      if (entry->first == name) return entry->second;
  throw Error("C text", "has a name without a declaration: '" + std::string(name) + "'");
}

// Statements.

void CTrace::declare(const CDeclaration& declaration) {
  const Variable variable{declaration.type, allocate(declaration.type)};
  if (!declaration.initialiser.empty())
    initialise(variable.type, variable.address, declaration.initialiser[0]);
  scopes_.back().emplace_back(declaration.name, variable);
}

void CTrace::clear(const CType& type, std::size_t address) {
  for (std::size_t k = 0; k < program_.size_of(type); ++k)
    store(address + k, {.is_set = true, .node = graph_.constant(0)});
}

void CTrace::initialise(const CType& type, std::size_t address, const CInitialiser& initialiser) {
  if (!initialiser.value.empty()) {
    return give(evaluate(initialiser.value[0]), type, address);
  }

  // A list: the elements of an array or the fields of a struct; what it leaves out is zero.
  clear(type, address);
  CType element = type;
  element.is_array = false;
  for (std::size_t k = 0; k < initialiser.list.size(); ++k) {
    if (!type.is_array) element = program_.structs[type.structure].fields.at(k).type;
    initialise(element, address, initialiser.list[k]);
    address += program_.size_of(element);
  }
}

CTrace::Flow CTrace::run(const CStatement& statement) {
  switch (statement.kind) {
    case CStatement::Kind::Block:
      return run_block(statement);
    case CStatement::Kind::Declaration:
      for (const CDeclaration& declaration : statement.declarations) declare(declaration);
      return Flow::On;
    case CStatement::Kind::Expression:
      evaluate(statement.exprs[0]);
      return Flow::On;
    case CStatement::Kind::If:
      return run_if(statement);
    case CStatement::Kind::Loop:
      return run_loop(statement);

    // If all lanes of the loop or function leave it, the run leaves it; else some sleep.
    case CStatement::Kind::Break:
      if (active_ == loop_entry_) return Flow::Broken;
      active_ = graph_.truth(false);
      return Flow::On;
    case CStatement::Kind::Return:
      return run_return(statement);
  }
  return Flow::On;
}

CTrace::Flow CTrace::run_block(const CStatement& statement) {
  const std::size_t names = scopes_.back().size();
  Flow flow = Flow::On;
  for (const CStatement& part : statement.parts) {
    if (graph_.is(active_, 0)) break;
    flow = run(part);
    if (flow != Flow::On) break;
  }
  scopes_.back().resize(names);
  return flow;
}

CTrace::Flow CTrace::run_if(const CStatement& statement) {
  const Node condition = truth(statement.exprs[0]), before = active_;
  const Node yes = graph_.both(before, condition),
             no = graph_.both(before, graph_.opposite(condition));
  const bool has_else = statement.parts.size() > 1;

  // If all lanes agree, only their branch is run.
  if (graph_.is(no, 0) || yes == before) return run(statement.parts[0]);
  if (graph_.is(yes, 0) || no == before) return has_else ? run(statement.parts[1]) : Flow::On;

  // Else both are, each with its lanes at work; those that neither left meet again.
  active_ = yes;
  run(statement.parts[0]);
  const Node after_yes = active_;
  active_ = no;
  if (has_else) run(statement.parts[1]);
  active_ = after_yes == yes && active_ == no ? before : graph_.either(after_yes, active_);
  return Flow::On;
}

CTrace::Flow CTrace::run_return(const CStatement& statement) {
  if (!statement.exprs.empty())
    give(evaluate(statement.exprs[0]), returned_.type, returned_.address);
  if (active_ == function_entry_) return Flow::Returned;
  active_ = graph_.truth(false);
  return Flow::On;
}

// Functions.

CTrace::Result CTrace::call_function(const CFunction& function,
                                     const std::vector<Result>& arguments) {
  // Remember the caller, and make room for the result, which outlives what the function declares.
  const std::size_t mark = memory_.size();
  const Variable caller = returned_;
  const Node caller_entry = function_entry_;
  returned_ = {function.result, allocate(function.result)};

  // Bind the arguments, and run the body.
  scopes_.emplace_back();
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const CDeclaration& parameter = function.parameters.at(k);
    declare({.name = parameter.name, .type = parameter.type});
    give(arguments[k], parameter.type, find(parameter.name).address);
  }
  function_entry_ = active_;
  run(function.body[0]);

  // Return to the caller: all lanes that came in are at work again.
  active_ = function_entry_;
  function_entry_ = caller_entry;
  scopes_.pop_back();
  const std::size_t size = program_.size_of(function.result);
  memory_.resize(mark + size);
  const Variable result = returned_;
  returned_ = caller;
  return place(result.type, result.address, result.address + size);
}

Node CTrace::call(std::string_view name, const std::vector<Argument>& arguments) {
  const CFunction& function = program_.functions.find(name)->second;
  std::vector<Result> values;
  for (std::size_t k = 0; k < arguments.size(); ++k)
    values.push_back({.type = function.parameters.at(k).type,
                      .value = {.is_set = true,
                                .is_pointer = arguments[k].is_pointer,
                                .node = arguments[k].number,
                                .address = arguments[k].address,
                                .end = memory_.size()}});
  return number_of(call_function(function, values));
}

}  // namespace dashpot::trace
