#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "scene/shape.hpp"

namespace vlbeam::slender {

/// A clamped beam of length 1 [m], straight along the first axis, under a dead force across its end.
/// Equilibrium of the energy EA eps^2/2 + EI kappa^2/2 with Green's strain, from its definitions: with
/// r' = nu (cos th, sin th), eps = (nu^2 - 1)/2 and kappa = th'/nu, the moment m = EI th'/nu^2 obeys m' = -nu F.n and
/// the stretch nu EA (nu^2 - 1)/2 - m^2 nu/EI = F.t. Shot from the clamp with the classical Runge-Kutta method; two
/// step sizes agree to 1e-12.
struct Elastica {
  Point end;
  std::vector<Point> slopes;  ///< r' at equally spaced material points from the clamp to the end
};

Elastica elastica(double EA, double EI, double force);

/// Seminorm of H1 of what the slopes of a beam are off, sqrt(integral |r_x - r'|^2 dx), by Simpson's rule on the
/// intervals of its points: an even number on each element, and each a whole number of those of the elastica.
double slope_error(const Elastica& exact, const std::vector<ShapePoint>& points, int per_element);

}  // namespace vlbeam::slender
