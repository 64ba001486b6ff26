#include "dashpot/machine/plant_at_line.h"

#include <array>
#include <cassert>
#include <cmath>

namespace dashpot {
namespace {

using Complex = std::complex<double>;

/// The inverse of a small matrix, row by row, by elimination with pivots.
void invert(std::vector<Complex>& a, std::vector<Complex>& inverse, std::size_t n) {
  inverse.assign(n * n, 0);
  for (std::size_t k = 0; k < n; ++k) inverse[k * n + k] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    // The row with the largest number in this column comes up, and that number becomes 1.
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::norm(a[i * n + k]) > std::norm(a[pivot * n + k])) pivot = i;
    for (std::size_t j = 0; j < n && pivot != k; ++j) {
      std::swap(a[k * n + j], a[pivot * n + j]);
      std::swap(inverse[k * n + j], inverse[pivot * n + j]);
    }
    const Complex scale = 1.0 / a[k * n + k];
    for (std::size_t j = 0; j < n; ++j) {
      a[k * n + j] *= scale;
      inverse[k * n + j] *= scale;
    }

    // It is taken off all other rows.
    for (std::size_t i = 0; i < n; ++i) {
      const Complex factor = a[i * n + k];
      if (i == k || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
}

}  // namespace

std::optional<StandIn> stand_in_of(std::span<const DamperInput> motion,
                                   std::span<const double> force) {
  double mean[3] = {}, product[3][3] = {};
  const auto at = [&](std::size_t k) {
    return std::array{motion[k].displacement, motion[k].velocity, force[k]};
  };
  for (std::size_t k = 0; k < force.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) mean[i] += at(k)[i] / static_cast<double>(force.size());
  for (std::size_t k = 0; k < force.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        product[i][j] += (at(k)[i] - mean[i]) * (at(k)[j] - mean[j]);
  const double dd = product[0][0], dv = product[1][0], vv = product[1][1];
  const double determinant = dd * vv - dv * dv;
  if (!(determinant > 0)) return {};
  return StandIn{.stiffness = (product[2][0] * vv - product[2][1] * dv) / determinant,
                 .damping = (product[2][1] * dd - product[2][0] * dv) / determinant};
}

PlantAtLine::PlantAtLine(const DrivenPlant& plant, const InPlantSetup& setup,
                         std::span<const StandIn> stand_ins)
    : plant_(plant),
      setup_(setup),
      stand_ins_(stand_ins),
      admittance_(stand_ins.size()),
      late_(setup.sensors.size()) {
  assert(stand_ins.size() == plant.dampers().size());
}

void PlantAtLine::move_to(double w) {
  const std::size_t n = plant_.size();
  w_ = w;
  for (std::size_t d = 0; d < stand_ins_.size(); ++d)
    admittance_[d] = stand_ins_[d].stiffness + iw() * stand_ins_[d].damping;
  matrix_.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      matrix_[i * n + k] = plant_.stiffness()[i * n + k] + iw() * plant_.damping()[i * n + k];
      for (std::size_t d = 0; d < admittance_.size(); ++d) {
        const DamperPlace& damper = plant_.dampers()[d];
        matrix_[i * n + k] += damper.by_force[i] * admittance_[d] * damper.row[k];
      }
    }
    matrix_[i * n + i] -= w * w;
  }
  invert(matrix_, inverse_, n);
  for (std::size_t s = 0; s < late_.size(); ++s)
    late_[s] = response_at(setup_.sensors[s].filter, w) * std::exp(-iw() * setup_.sensors[s].delay);
}

/// Of a push at each coordinate that comes from this input, this damper, or neither.
template <class Push>
void PlantAtLine::respond(const Push& push, std::size_t input, std::size_t damper,
                          std::vector<Complex>& shows) {
  const std::size_t n = plant_.size();
  q_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) q_[i] += inverse_[i * n + k] * push(k);
  for (std::size_t s = 0; s < shows.size(); ++s)
    shows[s] = late_[s] * seen(setup_.sensors[s].place, input, damper);
}

void PlantAtLine::of_force(std::size_t damper, std::vector<Complex>& shows) {
  const std::vector<double>& by_force = plant_.dampers()[damper].by_force;
  respond([&](std::size_t k) { return -by_force[k]; }, kNone, damper, shows);
}

void PlantAtLine::of_input(std::size_t u, std::vector<Complex>& shows) {
  respond(
      [&](std::size_t k) {
        Complex sum = plant_.by_value()[u][k] + iw() * plant_.by_rate()[u][k];
        for (std::size_t d = 0; d < admittance_.size(); ++d) {
          const DamperPlace& damper = plant_.dampers()[d];
          sum += damper.by_force[k] * admittance_[d] * damper.on_ground[u];
        }
        return sum;
      },
      u, kNone, shows);
}

void PlantAtLine::of_push(std::size_t at, std::vector<Complex>& shows) {
  respond([&](std::size_t k) { return k == at ? 1.0 : 0.0; }, kNone, kNone, shows);
}

Complex PlantAtLine::seen(const PlantSensorPlace& place, std::size_t input,
                          std::size_t damper) const {
  // Where the sensor's damper goes, and the force that is asked for.
  const DamperPlace& own = plant_.dampers()[place.strut];
  const auto way = [&] {
    Complex sum = input == kNone ? 0 : -own.on_ground[input];
    for (std::size_t k = 0; k < plant_.size(); ++k) sum += own.row[k] * q_[k];
    return sum;
  };
  const double carried = input == kNone ? 0 : plant_.carried()[input][place.coordinate],
               force = damper == place.strut ? 1 : 0;
  switch (place.quantity) {
    case PlantQuantity::Displacement:
      return q_[place.coordinate];
    case PlantQuantity::Velocity:
      return iw() * q_[place.coordinate];
    case PlantQuantity::Acceleration:
      return -w_ * w_ * q_[place.coordinate] + carried;
    case PlantQuantity::Deflection:
      return way();
    case PlantQuantity::DeflectionVelocity:
      return iw() * way();
    case PlantQuantity::DamperForce:
      return force + admittance_[place.strut] * way();
  }
  return 0;
}

void add_noise(const std::vector<Complex>& shows, double density, Complex* covariance) {
  const std::size_t m = shows.size();
  for (std::size_t s = 0; s < m; ++s)
    for (std::size_t k = 0; k <= s; ++k)
      covariance[s * m + k] += density * shows[s] * std::conj(shows[k]);
}

void add_shared_noise(const std::vector<Complex>& one, const std::vector<Complex>& other,
                      double shared, Complex* covariance) {
  const std::size_t m = one.size();
  for (std::size_t s = 0; s < m; ++s)
    for (std::size_t k = 0; k <= s; ++k)
      covariance[s * m + k] +=
          shared * (one[s] * std::conj(other[k]) + other[s] * std::conj(one[k]));
}

bool factorise(Complex* a, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k)
      for (std::size_t i = j; i < n; ++i) a[i * n + j] -= a[i * n + k] * std::conj(a[j * n + k]);
    const double pivot = a[j * n + j].real();
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double root = std::sqrt(pivot);
    for (std::size_t i = j; i < n; ++i) a[i * n + j] /= root;
  }
  return true;
}

void solve_lower(const Complex* factor, std::size_t n, Complex* x, std::size_t stride) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i * stride] -= factor[i * n + k] * x[k * stride];
    x[i * stride] /= factor[i * n + i].real();
  }
}

}  // namespace dashpot
