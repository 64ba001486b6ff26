#include "dashpot/machine/duhem_law.h"

#include <cmath>

namespace dashpot {
namespace {

struct DuhemParameters {
  double w;               // N/m
  double c;               // N*s/m
  double k3;              // N/m^3
  double a1, a2, a3, a4;  // 1/m ... 1/m^4
  double b1, b3;          // 1/m, 1/m^3
};

double duhem_force(const DuhemParameters* p, double x, double v, const double* z) {
  return p->w * z[0] + p->c * v + p->k3 * x * x * x;
}

void duhem_derivative(const DuhemParameters* p, double, double v, const double* z, double* dz) {
  const double s = v > 0 ? z[0] : -z[0], u = std::abs(s);
  const double slope =
      1 + s * (p->a1 + s * (p->a2 + s * (p->a3 + s * p->a4))) + u * (p->b1 + u * u * p->b3);
  dz[0] = v * slope;
}

void duhem_rest(const DuhemParameters*, double, double, double* z) { z[0] = 0; }

double duhem_rate(const DuhemParameters* p, double v) {
  return std::abs(v) * (std::abs(p->a1) + std::abs(p->b1));
}

const LawTable<DuhemParameters> kDuhemTable = {
    .name = "duhem",
    .title = "Polynomial Duhem operator",
    .equation =
        "z' = v f(z) where v > 0, v f(-z) where v < 0\n"
        "f(z) = 1 + a1 z + a2 z^2 + a3 z^3 + a4 z^4 + b1 |z| + b3 |z|^3\n"
        "F = w z + c v + k3 x^3",
    .source = "Jayawardhana, Logemann, Ryan 2008, for the class",
    .remarks = "A black box.",
    .states = {{"z", "m"}},
    .params = {
        {&DuhemParameters::w, "w", "N/m", 1e4, 0, 1e12, 1, Form::Constant, "strength"},
        {&DuhemParameters::c, "c", "N*s/m", 0, 0, 1e9, 0.01, Form::Constant, "dashpot"},
        {&DuhemParameters::k3, "k3", "N/m^3", 0, -1e20, 1e20, 0, Form::Constant, "spring"},
        {&DuhemParameters::a1, "a1", "1/m", -100, -1e9, 1e9, -1, Form::Constant, "slope"},
        {&DuhemParameters::a2, "a2", "1/m^2", 0, -1e18, 1e18, 0, Form::Constant, "slope"},
        {&DuhemParameters::a3, "a3", "1/m^3", 0, -1e27, 1e27, 0, Form::Constant, "slope"},
        {&DuhemParameters::a4, "a4", "1/m^4", 0, -1e36, 1e36, 0, Form::Constant, "slope"},
        {&DuhemParameters::b1, "b1", "1/m", 0, -1e9, 1e9, 0, Form::Constant, "slope"},
        {&DuhemParameters::b3, "b3", "1/m^3", 0, -1e27, 1e27, 0, Form::Constant, "slope"},
    }};

}  // namespace

const Law& duhem_law() {
  static const Law kLaw =
      state_law<DuhemParameters, duhem_force, duhem_derivative, duhem_rest, duhem_rate>(
          kDuhemTable);
  return kLaw;
}

}  // namespace dashpot
