// The forces of manufactured motions, by another way than automatic differentiation: differences of the energy of the
// whole beam.
#include <gtest/gtest.h>

#include <cmath>

#include "core/element/quadrature.hpp"
#include "studies/manufactured/solution.hpp"

namespace vlbeam::manufactured {
namespace {

const ChosenMotion motion({{{0.06, 0.02}, 1.3, 3, 0.2}, {{-0.03, 0.25}, 1.1, -5, 0.7}});
constexpr Properties properties{40, 2, 3, 0.4};
constexpr double length = 2, now = 0.3;

/// A change of the shape with its first two derivatives by x; beyond the ends of the beam it does not stop.
struct Change {
  Vector direction;
  double centre, width;  ///< [m]

  Vector operator()(double x, int derivative) const {
    const double s = (x - centre) / width, bell = std::exp(-s * s);
    const double by = derivative == 0   ? bell
                      : derivative == 1 ? -2 * s * bell / width
                                        : (4 * s * s - 2) * bell / (width * width);
    return by * direction;
  }
};

template <class Function>
double integral(const Function& function) {
  constexpr int pieces = 40;
  double sum = 0;
  for (int k = 0; k < pieces; ++k) {
    for (const auto& [u, weight] : gauss_legendre(10))
      sum += weight * length / pieces * function((k + u) * length / pieces);
  }
  return sum;
}

double energy(const Change& change, double by) {
  return integral([&](double x) {
    const Vector slope = motion.derivative(x, now, 1) + by * change(x, 1),
                 bend = motion.derivative(x, now, 2) + by * change(x, 2);
    const double strain = (slope.squaredNorm() - 1) / 2;
    const double curvature =
        (slope[0] * bend[1] - slope[1] * bend[0]) / std::pow(slope.norm(), 3) - properties.rest_curvature;
    return properties.EA / 2 * strain * strain + properties.EI / 2 * curvature * curvature;
  });
}

/// Hamilton's principle: what the energy gains by a change of the shape is the work of all forces but inertia.
TEST(Manufactured, ForcesAreTheVariationOfTheEnergy) {
  const Forces forces(motion, properties);
  for (const Change& change : {Change{{1, 0.3}, 0.9, 0.3}, Change{{-0.4, 1}, 0.1, 0.5}, Change{{0.7, 0.7}, 2.1, 0.4}}) {
    constexpr double h = 1e-5;
    const double gain = (energy(change, h) - energy(change, -h)) / (2 * h);
    double work = integral([&](double x) {
      const Vector inertia = properties.rhoA * motion.derivative(x, now, 0, 2);
      return (forces.body(x, now) - inertia).dot(change(x, 0));
    });
    const auto start = forces.cut(0, now), end = forces.cut(length, now);
    work += end.on_r.dot(change(length, 0)) + end.on_slope.dot(change(length, 1));
    work -= start.on_r.dot(change(0, 0)) + start.on_slope.dot(change(0, 1));
    EXPECT_NEAR(work, gain, 1e-8 * std::abs(gain));
    EXPECT_GT(std::abs(gain), 1e-2);
  }
}

TEST(Manufactured, DerivativesAreThoseOfTheMotion) {
  constexpr double h = 1e-4, x = 0.7;
  for (int order = 0; order < 4; ++order) {
    const Vector by_x = (motion.derivative(x + h, now, order) - motion.derivative(x - h, now, order)) / (2 * h);
    const Vector by_t = (motion.derivative(x, now + h, order) - motion.derivative(x, now - h, order)) / (2 * h);
    EXPECT_LE((motion.derivative(x, now, order + 1) - by_x).norm(), 1e-7);
    EXPECT_LE((motion.derivative(x, now, order, 1) - by_t).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace vlbeam::manufactured
