#pragma once

#include <array>

#include "core/element/active.hpp"
#include "mechanics/frames/moving_frame.hpp"

namespace vlbeam {

/// What the strains of an element's rest shape change by at its material points, by x_A' and by x_B' [1/m]: K_y, K_z
/// and the torsion at both points of the table, each with its derivatives by x_A and x_B. The rest curve bends at an
/// end as the element at rest does there only within what elements can; an end that moves along it so seems to strain
/// the material, at rest as in motion.
using FrameRestRates = std::array<std::array<Active<2>, 6>, 2>;

/// `bends` is r_xx at both ends by r_B - r_A, s_A, s_B, in an element of length 1; `along` tells how sections stand.
FrameRestRates frame_rest_rates(const FrameTable& unit, const FrameSection& section,
                                const std::array<FrameRestEnd, 2>& ends,
                                const std::array<std::array<double, 3>, 2>& bends, const RestTriads& along);

}  // namespace vlbeam
