#pragma once

#include "core/scene/scene.hpp"

namespace vlbeam::slender {

/// The end of a clamped beam of length 1 [m], straight along the first axis, under a dead force across it.
/// Equilibrium of the energy EA eps^2/2 + EI kappa^2/2 with Green's strain, from its definitions: with
/// r' = nu (cos th, sin th), eps = (nu^2 - 1)/2 and kappa = th'/nu, the moment m = EI th'/nu^2 obeys m' = -nu F.n and
/// the stretch nu EA (nu^2 - 1)/2 - m^2 nu/EI = F.t. Shot from the clamp with the classical Runge-Kutta method; two
/// step sizes agree to 1e-12.
Point end_of_elastica(double EA, double EI, double force);

}  // namespace vlbeam::slender
