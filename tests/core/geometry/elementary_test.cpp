#include "core/geometry/elementary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vlbeam {
namespace {

/// Digits of mpmath with 60 places, rounded once: the same on every machine.
TEST(Elementary, IsRoundedOnce) {
  constexpr std::array<double, 3> at{0.1, 0.3, 0.7};
  struct Known {
    double (*function)(double);
    std::array<double, 3> values;
  };
  const Known all[] = {
      {portable::acos, {0x1.787b22ce3f590p+0, 0x1.441f5ecbeef59p+0, 0x1.973e83f5d5c9bp-1}},
      {portable::cosh, {0x1.0147f40224b38p+0, 0x1.0b9b4e0b6ec4cp+0, 0x1.4152c1862342fp+0}},
      {portable::asinh, {0x1.98eb9e7e5fc3ep-4, 0x1.2ec4ea565fcc1p-2, 0x1.4e2a4fe9085ddp-1}},
      {portable::exp, {0x1.1aec7b35a00d4p+0, 0x1.599058c8c1a96p+0, 0x1.01c2a61268987p+1}},
      {portable::log, {-0x1.26bb1bbb55515p+1, -0x1.34378fcbda721p+0, -0x1.6d3c324e13f50p-2}},
      {portable::log10, {-1.0, -0x1.0bb6c34d81502p-1, -0x1.3d3d3d21ccf04p-3}},
      {[](double x) { return portable::pow(x, -0.2); },
       {0x1.95bb8f6d46053p+0, 0x1.45b2cebaf5211p+0, 0x1.12edcad97ef6ap+0}},
      {[](double x) { return portable::atan2(x, 0.3); },
       {0x1.4978fa3269ee2p-2, 0x1.921fb54442d18p-1, 0x1.2a78b84fbf5fcp+0}},
  };
  for (const Known& known : all) {
    for (std::size_t i = 0; i < at.size(); ++i) EXPECT_EQ(known.function(at[i]), known.values[i]);
  }
}

/// Against mpmath, too.
TEST(Elementary, HasTheHyperbolicTangentToItsLastDigits) {
  constexpr std::array<std::array<double, 2>, 6> known{{{1e-9, 0x1.12e0be826d695p-30},
                                                        {0.1, 0x1.983d7795f413ap-4},
                                                        {0.3, 0x1.2a4dda7d914fap-2},
                                                        {0.7, 0x1.356fb17af2e91p-1},
                                                        {3, 0x1.fd77d111a0b00p-1},
                                                        {19, 1}}};
  for (const auto& [x, value] : known) {
    EXPECT_NEAR(portable::tanh(x), value, 1e-15 * value) << x;
    EXPECT_EQ(portable::tanh(-x), -portable::tanh(x));
  }
  EXPECT_EQ(portable::tanh(0), 0);
  EXPECT_EQ(portable::tanh(1e300), 1);
  EXPECT_TRUE(std::isnan(portable::tanh(std::nan(""))));
}

}  // namespace
}  // namespace vlbeam
