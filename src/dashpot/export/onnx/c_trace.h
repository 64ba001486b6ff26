#pragma once
#include <string_view>
#include <vector>

#include "dashpot/export/c_subset/c_syntax.h"
#include "dashpot/export/onnx/graph.h"

namespace dashpot::trace {

/// Runs C code with nodes of a graph in place of numbers, for many runs ("lanes") at once. What a
/// branch writes is taken in the lanes where its condition holds. Loops whose end is known are
/// unrolled; others become loops of the graph, which go on while any lane does. Where a pointer
/// depends on the data, it points to a copy of what each lane means. Throws Error at what a graph
/// cannot express.
class CTrace {
 public:
  /// `program` and `graph` must outlive the trace. `unrolls`: loops of many rounds, too, which is
  /// right where all inputs are constants.
  CTrace(const CProgram& program, Graph& graph, bool unrolls = false);

  /// The address of a new array of these numbers, to which the code may be given a pointer.
  std::size_t room(const std::vector<Node>& values);
  Node number(std::size_t address) const { return memory_[address].value.node; }
  /// An argument: a pointer to such an array, or a number.
  struct Argument {
    bool is_pointer = true;
    std::size_t address = 0;
    Node number = 0;
  };
  /// Calls a function of the program, which must be there; gives what it returns, or 0 where that
  /// is void.
  Node call(std::string_view function, const std::vector<Argument>& arguments);

 private:
  struct Value {
    bool is_set = false, is_pointer = false;
    Node node = 0;
    /// For a pointer: where it points, where the array it points into ends, and the size of an
    /// element of that.
    std::size_t address = 0, end = 0, size = 1;
  };
  struct Cell {
    Value value;
    Node born = 0;  ///< the lanes that were at work when it came into being
    /// For a copy of what lies at one of several places, lane by lane: the lanes and their place,
    /// to which what is written here is written, too.
    std::vector<std::pair<Node, std::size_t>> through;
  };
  /// The result of an expression: a value, or a place in the memory.
  struct Result {
    CType type;
    bool is_place = false;
    Value value;
    std::size_t address = 0, end = 0;
  };
  struct Variable {
    CType type;
    std::size_t address = 0;
  };
  /// How a statement ends for the lanes at work.
  enum class Flow { On, Broken, Returned };

  // Memory.
  std::size_t allocate(const CType& type);
  void store(std::size_t address, const Value& value);
  void store_pointer(std::size_t address, const Value& value);
  /// Writes a value of this type, a struct field by field.
  void give(const Result& from, const CType& type, std::size_t to);
  Value load(const Result& result);
  Node number_of(const Result& result);
  const Variable& find(std::string_view name) const;

  // Statements.
  void declare(const CDeclaration& declaration);
  void initialise(const CType& type, std::size_t address, const CInitialiser& initialiser);
  void clear(const CType& type, std::size_t address);
  Flow run(const CStatement& statement);
  Flow run_block(const CStatement& statement);
  Flow run_if(const CStatement& statement);
  Flow run_loop(const CStatement& statement);
  Flow run_rounds(const CStatement& statement);
  Flow run_return(const CStatement& statement);
  void run_lane_loop(const CStatement& statement);
  /// A loop of the graph: the cells that it carries, the pointers that it moves with the copies of
  /// what they point to, and its number.
  struct LaneLoop {
    std::vector<std::size_t> carried;
    std::vector<std::pair<std::size_t, std::size_t>> copies;
    std::size_t number = 0;
  };
  bool run_body_once(const CStatement& statement, LaneLoop& loop);
  bool add_changed(const std::vector<Cell>& after, LaneLoop& loop);

  // Expressions.
  Result evaluate(const CExpr& expr);
  Result unary(const CExpr& expr);
  Result binary(const CExpr& expr);
  Result arithmetic(std::string_view mark, const Result& a, const Result& b);
  Result assign(const CExpr& expr);
  Result choose(const CExpr& expr);
  Result index(const CExpr& expr);
  Result index_by_lane(const Value& pointer, const CType& element, Node which);
  Result member(const CExpr& expr);
  Result cast(const CExpr& expr);
  Result call(const CExpr& expr);
  Result call_function(const CFunction& function, const std::vector<Result>& arguments);
  Result place(const CType& type, std::size_t address, std::size_t end) const;
  Result of_number(Node node, CType::Kind kind) const;
  Node truth(const CExpr& expr);

  const CProgram& program_;
  Graph& graph_;
  const bool unrolls_;
  std::vector<Cell> memory_;
  std::vector<std::vector<std::pair<std::string, Variable>>>
      scopes_;               ///< the globals, then the function's
  Node active_;              ///< the lanes at work
  Node loop_entry_ = 0;      ///< those when the innermost loop began
  Node function_entry_ = 0;  ///< and the innermost function
  std::size_t region_ = 0;   ///< the innermost loop of the graph
  Variable returned_;        ///< what the innermost function returns
};

}  // namespace dashpot::trace
