#include "dashpot/export/onnx/c_trace.h"

#include <math.h>  // the C texts say fabs, not std::fabs

#include "dashpot/base/random.h"
#include "export/onnx/graph_evaluator.h"
#include "support.h"

using namespace dashpot;
using namespace dashpot::trace;

namespace {

// C that the compiler takes in and the tracer reads: what it should compute is what the compiler
// says.
#define TRACED(name, ...) \
  namespace name {        \
  __VA_ARGS__             \
  }                       \
  constexpr const char* name##_text = #__VA_ARGS__;

TRACED(
    branches, static double f(double x, double y) {
      double z = 1;
      int side = (x > 0) - (x < 0);
      if (x < 0.5 && (y > -0.5 || x < -1)) {
        z += y > 0 ? y * y : -3;
        if (y > 1) {
          z -= x;
        } else {
          z *= 2;
        }
      } else if (y > 0) {
        return z / (2 + y);
      }
      return z + side;
    })

TRACED(
    early,
    static double inner(double x) {
      if (x > 1) return 1;
      x *= 2;
      if (x < -1) {
        return -1 + 0.1 * x;
      }
      return x;
    } static double f(double x, double y) {
      return inner(x) + (y > 0 ? inner(y - 0.5) : inner(-y));
    })

TRACED(
    search, static double f(double x, double y) {
      double low = 0, high = 4 + fabs(x);
      int k;
      for (k = 0; k < 80; ++k) {
        const double middle = 0.5 * (low + high);
        if (middle * middle * middle + y * y * middle > fabs(x)) {
          high = middle;
        } else {
          low = middle;
        }
        if (high - low < 1e-3) break;
      }
      return low + 100 * k;
    })

TRACED(
    counts, static double f(double x, double y) {
      const int count = (int)fmin(6, 1 + 3 * fabs(x));
      double sum = 0, step = 1;
      int k;
      for (k = 0; k < count; ++k) {
        int j;
        if (y > 0.2 * k) {
          for (j = 0; j < 3; ++j) sum += step * j;
        }
        sum += k % 2;
        step = -step / 2;
      }
      return sum;
    })

TRACED(
    pointers,
    typedef struct Pair {
      double first;
      double second[2];
    } Pair;
    static const Pair kPairs[] = {{1, {2, 3}}, {-1, {0.5, 4}}};
    static void fill(const Pair* from, double x, Pair* to) {
      to->first = from->first + x;
      to->second[0] = from->second[1];
      to->second[1] = x;
    } static double f(double x, double y) {
      Pair ends[2];
      Pair start = {0, {0}};
      const Pair* at = &start;
      double table[3];
      double* third = &table[1] + 1;
      int k;
      const int count = y > 0 ? 5 : 4;
      for (k = 0; k < count; ++k) {
        Pair* end = &ends[k % 2];
        fill(at, x, end);
        at = end;
      }
      table[0] = at->first;
      table[1] = x > 0 ? kPairs[1].second[0] : kPairs[0].second[1];
      *third = at->second[0];
      return table[0] + table[1] * table[2] + table[count - 4];
    })

TRACED(
    functions, static double f(double x, double y) {
      const double u = fabs(x);
      return expm1(0.01 * x) + log1p(u) + log1p(1e-9 * u) * 1e9 + atan2(u, y * y) + copysign(2, y) +
             atan(y) + atanh(0.4 * y) + tan(0.5 * x) + cos(x) + pow(u, 1.5) + ceil(x) + floor(y) +
             sqrt(u) + tanh(x);
    })

TRACED(
    blocks, typedef enum Kind{Least, Most} Kind; typedef Kind Choice; typedef struct Wish {
      Choice kind;
      double value;
    } Wish;
    typedef struct Wishes {
      Wish each[1 + 2];
      const double* from;
    } Wishes;
    static Wish wish_of(Choice kind, double value); static double granted(Wish wish, double held) {
      wish.value = wish.kind == Most ? fmax(wish.value, held) : fmin(wish.value, held);
      return wish.value;
    } static Wish wish_of(Choice kind, double value) {
      Wish wish;
      wish.kind = kind;
      wish.value = value;
      return wish;
    } static double f(double x, double y) {
      const double values[2] = {x, y};
      Wishes all;
      Wish last;
      double sum = 0;
      int k;
      all.from = values;
      for (k = 0; k < 2; ++k) {
        all.each[k] = wish_of(k == 0 ? Most : Least, all.from[k]);
        last = all.each[k];
        sum += granted(last, 0.5) + last.value;
      }
      if ((isfinite(1 / (x - x)) != 0) || (isnan(x) != 0)) sum = 0;
      return sum + ((isfinite(y) != 0) ? 1 : 0);
    })

using Calculation = double (*)(double x, double y);

/// The text in a graph, for inputs that only its evaluation knows, against the compiled text.
void check_traced(const char* text, Calculation compiled, double tolerance) {
  const CProgram program = parse_c(text);
  Graph graph(false);
  CTrace trace(program, graph);
  const Node result = trace.call("f", {{.is_pointer = false, .number = graph.input(0)},
                                       {.is_pointer = false, .number = graph.input(1)}});
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
    CAPTURE(x);
    CAPTURE(y);
    CHECK_CLOSE(GraphEvaluator(graph, {x, y})(result), compiled(x, y), tolerance, tolerance);
    Graph folded(false);
    CTrace constants(program, folded, true);
    const Node value = constants.call("f", {{.is_pointer = false, .number = folded.constant(x)},
                                            {.is_pointer = false, .number = folded.constant(y)}});
    REQUIRE(folded.is_constant(value));
    CHECK_CLOSE(folded.value(value), compiled(x, y), tolerance, tolerance);
  }
}

}  // namespace

TEST_CASE(
    "tracing C: branches, returns, loops, pointers and functions give what the compiler's code "
    "gives") {
  check_traced(branches_text, branches::f, 1e-14);
  check_traced(early_text, early::f, 1e-14);
  check_traced(search_text, search::f, 1e-14);
  check_traced(counts_text, counts::f, 1e-14);
  check_traced(pointers_text, pointers::f, 1e-14);
  check_traced(functions_text, functions::f, 1e-12);
  check_traced(blocks_text, blocks::f, 1e-14);
}

TEST_CASE(
    "tracing C: the same is computed once, sums of multiples become one, what is known is folded") {
  const CProgram program = parse_c(
      "#define SIZE 2\n/* a, b */ static const double kRow[SIZE] = {2.0F, 0.5};\n"
      "double f(const double* v) { double s = 0; int k; for (k = 0; k < SIZE; ++k) { s += kRow[k] "
      "* v[k]; } "
      "return s + 3 * (v[0] - 1) + tanh(v[1]) - tanh(v[1]) + sqrt(16); }");
  Graph graph(false);
  CTrace trace(program, graph);
  const std::size_t at = trace.room({graph.input(0), graph.input(1)});
  const Node sum = trace.call("f", {{.address = at}});
  CHECK(graph.at(sum).op == Op::Affine);
  CHECK(graph.at(sum).numbers == std::vector<double>{5, 0.5, 1});
}

TEST_CASE("tracing C: what is no number is told from what is") {
  const CProgram program = parse_c(
      "#ifdef __cplusplus\nextern \"C\" {\n#endif\n"
      "double f(double x) { return 2 * (isfinite(x) != 0) + (isnan(x) != 0); }");
  Graph graph(false);
  CTrace trace(program, graph);
  const Node kind = trace.call("f", {{.is_pointer = false, .number = graph.input(0)}});
  for (const auto& [x, expected] :
       {std::pair{1e300, 2.}, {NAN, 1.}, {HUGE_VAL, 0.}, {-HUGE_VAL, 0.}})
    CHECK(GraphEvaluator(graph, {x})(kind) == expected);
}

TEST_CASE("tracing C: what no graph has is refused") {
  const auto traced = [](const char* text) {
    return message_of([&] {
      const CProgram program = parse_c(text);
      Graph graph(false);
      CTrace trace(program, graph);
      trace.call("f", {{.is_pointer = false, .number = graph.input(0)}});
    });
  };
  CHECK(
      traced("double f(double x) { return gamma(x); }").find("calls 'gamma', which no graph has") !=
      std::string::npos);
  CHECK(traced("typedef struct P { double a; } P; double f(double x) { P p = {1}; P q = {2}; p = x "
               "> 0 ? p : "
               "q; return p.a; }")
            .find("has a pointer or struct where") != std::string::npos);
  CHECK(
      traced("double f(double x) { double a[2 - 1]; return x; }").find("a constant is expected") !=
      std::string::npos);
  CHECK(traced("double f(double x) { return y; }").find("without a declaration: 'y'") !=
        std::string::npos);
  CHECK(
      traced("double f(double x) { while (x > 2) { return 1; } return x; }").find("by a return") !=
      std::string::npos);
}
