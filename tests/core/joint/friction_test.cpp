// Friction along the beam: its share of the contact force around a kink, and what presses.
#include "mechanics/motion/joint/friction.hpp"

#include <gtest/gtest.h>

#include <unsupported/Eigen/AutoDiff>

namespace vlbeam {
namespace {

using Plane = Eigen::Vector2d;

double sine_square_of_half(double angle) { return std::pow(std::sin(angle / 2), 2); }

// Tensions around a drum, T_+ = T_- e^(mu phi), and the force between them.
TEST(Capstan, TakesTheDifferenceOfTheTensions) {
  for (const double mu : {0.05, 0.3, 1.0}) {
    for (const double angle : {1e-5, 1e-3, 0.1, 1.0, 2.5, 3.1, M_PI}) {
      const double low = 3, high = low * std::exp(mu * angle);
      const Plane before(1, 0), behind(std::cos(angle), std::sin(angle));
      const double whole = (high * behind - low * before).norm();
      const double share = capstan_share(mu, sine_square_of_half(angle));
      // two nearly equal tensions lose digits here
      EXPECT_NEAR(share * whole, low * std::expm1(mu * angle), 1e-12 * high + 1e-10 * share * whole)
          << mu << ' ' << angle;
      EXPECT_DOUBLE_EQ(capstan_share(-mu, sine_square_of_half(angle)), -share);
    }
  }
}

TEST(Capstan, IsCoulombsLawWhereTheBeamIsSmooth) {
  for (const double mu : {0.1, 0.7}) {
    const double normal = 2, friction = mu * normal;
    EXPECT_NEAR(capstan_share(mu, 0.0) * std::hypot(normal, friction), friction, 1e-15);
    EXPECT_NEAR(capstan_share(mu, 0.999e-8), capstan_share(mu, 1.001e-8), 1e-11) << "series and function meet";
  }
}

TEST(Capstan, HasTheDerivativeOfItsDifferences) {
  using Real = Eigen::AutoDiffScalar<Eigen::Vector2d>;
  for (const double k : {1e-12, 1e-9, 1e-4, 0.3, 0.99}) {
    const double mu = 0.4, d_mu = 1e-4, d_k = 1e-4 * k * (1 - k);
    const Real share = capstan_share(Real(mu, 2, 0), Real(k, 2, 1));
    EXPECT_NEAR(share.derivatives()[0], (capstan_share(mu + d_mu, k) - capstan_share(mu - d_mu, k)) / (2 * d_mu), 1e-7);
    const double tolerance = 1e-15 / d_k + 1e-6;  // rounding of a difference
    EXPECT_NEAR(share.derivatives()[1], (capstan_share(mu, k + d_k) - capstan_share(mu, k - d_k)) / (2 * d_k),
                tolerance);
  }
  const Real folded = capstan_share(Real(0.4, 2, 0), Real(1.0, 2, 1));
  EXPECT_TRUE(folded.derivatives().allFinite()) << "a cable that goes back the way it came";
}

TEST(Contact, FeelsTheNormalForceOrTheWholeOne) {
  const Plane before(1.1, 0), behind(0.9, 0), up(0, 0.9), force(3, 4);
  const Contact<double, 2> smooth(before, behind, false), straight(before, behind, true), corner(before, up, true);
  EXPECT_NEAR(smooth.pressing(force).norm(), 4, 1e-14);
  EXPECT_NEAR(corner.pressing(force).norm(), 5, 1e-14);
  for (const auto& contact : {smooth, straight, corner}) EXPECT_NEAR(contact.stretch(), 1, 1e-14);
  const AxialFriction friction{0.3, 1e-3};
  EXPECT_NEAR(smooth.share(friction, 1), 0.3, 1e-14);
  EXPECT_NEAR(straight.share(friction, -1), -0.3 / std::hypot(1, 0.3), 1e-14);
  EXPECT_NEAR(corner.share(friction, 1), capstan_share(0.3, 0.5), 1e-14);
}

TEST(Friction, JamsWhereItPressesTheMassOnHarderThanItResists) {
  const Plane p(0, 2), harder(0, -1);
  EXPECT_NEAR(*pressing_force<2>(p, harder, 0.5), 4, 1e-14);  // N = |2 + N/2|
  EXPECT_NEAR(*pressing_force<2>(p, harder, -0.5), 4.0 / 3, 1e-14);
  EXPECT_EQ(*pressing_force<2>(Plane::Zero(), harder, 0.5), 0);
  EXPECT_FALSE(pressing_force<2>(p, harder, 1));
}

}  // namespace
}  // namespace vlbeam
