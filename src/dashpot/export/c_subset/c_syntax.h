#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::trace {

/// A type of the C that exported models are made of.
struct CType {
  enum class Kind { Void, Int, Real, Struct };
  Kind kind = Kind::Void;
  std::size_t structure = 0;  ///< of a struct: its place in CProgram::structs
  int pointers = 0;
  bool is_array = false;
  std::size_t count = 0;  ///< of an array; 0 until its initialiser says

  bool is_pointer() const { return !is_array && pointers > 0; }
  bool is_struct() const { return kind == Kind::Struct && pointers == 0 && !is_array; }
};

struct CExpr {
  enum class Kind { Number, Name, Unary, Binary, Assign, Conditional, Call, Index, Member, Cast };
  Kind kind = Kind::Number;
  std::string text;         ///< a name, an operator, a field
  double number = 0;        ///< of Number
  bool is_integer = false;  ///< of Number
  CType type;               ///< of Cast
  std::vector<CExpr> parts;
};

struct CInitialiser {
  std::vector<CExpr> value;  ///< one, or none where there is a list
  std::vector<CInitialiser> list;
};

struct CDeclaration {
  std::string name;
  CType type;
  std::vector<CInitialiser> initialiser;  ///< none or one
};

struct CStatement {
  enum class Kind { Block, Declaration, Expression, If, Loop, Break, Return };
  Kind kind = Kind::Block;
  std::vector<CDeclaration> declarations;
  std::vector<CExpr> exprs;        ///< Expression, If, Return: one at most
  std::vector<CExpr> start, step;  ///< of Loop, none or one
  std::vector<CStatement> parts;   ///< of Block; If: then, else; Loop: its body
};

struct CStruct {
  std::string name;
  std::vector<CDeclaration> fields;
};

struct CFunction {
  CType result;
  std::vector<CDeclaration> parameters;
  std::vector<CStatement> body;  ///< one
};

struct CProgram {
  std::vector<CStruct> structs;
  std::map<std::string, CFunction, std::less<>> functions;
  std::vector<CDeclaration> globals;

  /// Numbers and pointers in it.
  std::size_t size_of(const CType& type) const;
  std::size_t size_of_struct(std::string_view name) const;
};

/// The part of C99 in which the texts of exported models are written: structs, functions, tables,
/// if, for, while. Throws Error at anything else.
CProgram parse_c(std::string_view code);

}  // namespace dashpot::trace
