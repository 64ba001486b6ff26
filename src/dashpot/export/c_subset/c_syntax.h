#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot {

// The meaning of a text in the subset of C99 whose grammar docs/c-subset.md writes down: the
// equations of every exported model, inverse and controller are in it, not how they are called.

/// A type: void, int (enumerations, too), a real number or a struct; pointers to one of these, or
/// an array of them with one dimension.
struct CType {
  enum class Kind { Void, Int, Real, Struct };
  Kind kind = Kind::Void;
  std::size_t structure = 0;  ///< for Struct: its place in CProgram::structs
  int pointers = 0;           ///< the number of stars
  bool is_array = false;
  std::size_t count = 0;  ///< for an array: how many; 0 until its initialiser says

  bool is_pointer() const { return !is_array && pointers > 0; }
  bool is_struct() const { return kind == Kind::Struct && pointers == 0 && !is_array; }
};

/// An expression; `parts` are its operands in the order of the text. a->b is read as (*a).b.
struct CExpr {
  enum class Kind {
    Number,       ///< number, is_integer
    Name,         ///< text: the name
    Unary,        ///< text: - ! & * ++ --; one part. ++ and -- stand in front only
    Binary,       ///< text: the operator, or "," ; two parts
    Assign,       ///< text: "" for =, "+" for +=; the place, then the value
    Conditional,  ///< the condition, then the values where it holds and where not
    Call,         ///< text: the function; its arguments
    Index,        ///< the array or pointer, then which
    Member,       ///< text: the field; the struct
    Cast          ///< type; one part
  };
  Kind kind = Kind::Number;
  std::string text;
  double number = 0;
  bool is_integer = false;
  CType type;
  std::vector<CExpr> parts;
};

/// One value, or a list in braces.
struct CInitialiser {
  std::vector<CExpr> value;  ///< one, or none where there is a list
  std::vector<CInitialiser> list;
};

/// A variable, a parameter or a field.
struct CDeclaration {
  std::string name;
  CType type;
  std::vector<CInitialiser> initialiser;  ///< none or one
};

struct CStatement {
  enum class Kind { Block, Declaration, Expression, If, Loop, Break, Return };
  Kind kind = Kind::Block;
  std::vector<CDeclaration> declarations;  ///< of a Declaration
  std::vector<CExpr> exprs;        ///< Expression: it; If, Loop: the condition; Return: none or one
  std::vector<CExpr> start, step;  ///< for Loop: none or one each
  std::vector<CStatement> parts;   ///< Block: all; If: then, else; Loop: its body
};

struct CStruct {
  std::string name;
  std::vector<CDeclaration> fields;
};

struct CFunction {
  CType result;
  std::vector<CDeclaration> parameters;
  std::vector<CStatement> body;  ///< one Block
};

struct CProgram {
  std::vector<CStruct> structs;
  std::map<std::string, CFunction, std::less<>> functions;  ///< those that have a body
  std::vector<CDeclaration> globals;  ///< tables and constants; the names of enumerations, too

  /// How many numbers and pointers a variable of this type holds.
  std::size_t size_of(const CType& type) const;
  /// Throws Error where no struct has this name.
  std::size_t size_of_struct(std::string_view name) const;
};

/// Reads a text. Throws Error at what is outside of the subset: "C text:12: has 'do', which is
/// outside of the subset of C; while". Whether names are declared is not checked here.
CProgram parse_c(std::string_view code);

}  // namespace dashpot
