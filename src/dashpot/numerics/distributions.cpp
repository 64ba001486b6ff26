#include "dashpot/numerics/distributions.h"

#include <cmath>
#include <numbers>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>

namespace dashpot {
namespace {

using boost::math::policies::policy;
using InDouble = policy<boost::math::policies::promote_double<false>>;

boost::math::binomial_distribution<double, InDouble> boosts(const Binomial& binomial) {
  return {binomial.trials, binomial.success};
}

}  // namespace

double normal_quantile(double p) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p, InDouble());
}

double students_t_quantile(double degrees, double p) {
  return quantile(boost::math::students_t_distribution<double, InDouble>(degrees), p);
}

double chi_squared_quantile(double degrees, double p) {
  return quantile(boost::math::chi_squared_distribution<double, InDouble>(degrees), p);
}

double normal_score(double degrees, double t) {
  // Of the smaller tail, where the probability has all its digits.
  const double tail =
      cdf(boost::math::students_t_distribution<double, InDouble>(degrees), -std::abs(t));
  constexpr double kFarthest = 38;  // where the tail is no number any more
  const double score = tail > 0 ? -normal_quantile(tail) : kFarthest;
  return t < 0 ? -score : score;
}

double Binomial::quantile(double p) const { return boost::math::quantile(boosts(*this), p); }
double Binomial::at_most(double count) const { return boost::math::cdf(boosts(*this), count); }

}  // namespace dashpot
