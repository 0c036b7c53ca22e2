#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <type_traits>

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

  std::string name() const {
    return std::string(rational ? "unequal" : "unit") + " weights, " +
           (transport == WeightTransport::frozen ? "frozen" : "transported") + ", " +
           (law == StrainLaw::green ? "green" : "engineering");
  }
};

inline constexpr std::array<ElementKindUnderTest, 8> element_family{
    {{false, WeightTransport::frozen, StrainLaw::green},
     {false, WeightTransport::frozen, StrainLaw::engineering},
     {false, WeightTransport::transported, StrainLaw::green},
     {false, WeightTransport::transported, StrainLaw::engineering},
     {true, WeightTransport::frozen, StrainLaw::green},
     {true, WeightTransport::frozen, StrainLaw::engineering},
     {true, WeightTransport::transported, StrainLaw::green},
     {true, WeightTransport::transported, StrainLaw::engineering}}};

}  // namespace vlbeam::test
