#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Longest step of "generalized-alpha" at an accuracy of 1e-4, by what drives a scene [s]: 1/400 of a swing under
/// gravity over the beam's length, 1/50 of ramps, 1/100 of the periods of loads, drives and motions, 1/5 of the time in
/// which what is driven, or starts with a velocity, passes an element, 1/10 of the time in which a body passes through
/// where friction fades; where there is nothing of that, a hundred times a wave's time along the beam. Neither the
/// duration nor the output matters, nor how fast the beam itself may vibrate: the error estimate finds that.
double longest_implicit_step(const Scene& scene);

/// What `"integrator": "auto"` stands for: of "generalized-alpha" and "dopri5" the one that takes less work for
/// `accuracy`, of the beam's length and of the motion, as far as the scene allows both. A trial of the first instants
/// tells, which counts evaluations of the equations, not time, and so chooses alike on every machine; where the fastest
/// wave in an element would force dopri5 to so many steps that no trial is needed, there is none. Its tolerances, the
/// longest step and where Newton's iteration ends follow from the accuracy. Throws InvalidInput where the scene allows
/// neither.
IntegratorSpec automatic_integrator(const Scene& scene, double accuracy = 1e-4);

}  // namespace vlbeam
