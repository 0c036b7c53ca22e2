#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <type_traits>

#include "core/element/beam_rule.hpp"
#include "core/element/strain_law.hpp"
#include "core/element/transport.hpp"

namespace vlbeam::test {

/// Types that typed tests run over: the plane and space.
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

struct DimensionNames {
  template <class Dimension>
  static std::string GetName(int) {
    return Dimension::value == 2 ? "Planar" : "Spatial";
  }
};

inline constexpr std::array<Formulation, 2> formulations{Formulation::variational, Formulation::virtual_work};

/// One member of the element family.
struct ElementKindUnderTest {
  bool rational;  ///< unequal weights
  WeightTransport transport;
  StrainLaw law;
  AxialStrain axial = AxialStrain::full;

  std::string name() const {
    return std::string(rational ? "unequal" : "unit") + " weights, " +
           (transport == WeightTransport::frozen ? "frozen" : "transported") + ", " +
           (law == StrainLaw::green ? "green" : "engineering") +
           (axial == AxialStrain::lobatto ? ", sampled stretch" : "");
  }
};

/// All of them.
inline constexpr auto element_family = [] {
  std::array<ElementKindUnderTest, 16> family{};
  std::size_t i = 0;
  for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
    for (const bool rational : {false, true}) {
      for (const WeightTransport transport : {WeightTransport::frozen, WeightTransport::transported}) {
        for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
          family[i++] = {rational, transport, law, axial};
        }
      }
    }
  }
  return family;
}();

}  // namespace vlbeam::test
