#pragma once

#include <string>

#include "mechanics/statics/static_equations.hpp"

namespace vlbeam {

/// How the loads move the beam where nothing holds it, or else how it moves where it is held least, in words.
template <int D>
std::string free_direction(const BeamSystem<D>& system, StaticEquations<D>& equations, const Eigen::VectorXd& u,
                           double factor);

}  // namespace vlbeam
