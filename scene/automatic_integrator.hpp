#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// The accuracy of a run that says none, for which numbers of steps are given.
constexpr double usual_accuracy = 1e-4;
constexpr double finest_accuracy = 1e-10, coarsest_accuracy = 1e-2;  ///< that may be asked

/// Longest step of "generalized-alpha" at an accuracy of 1e-4 [s]. It is the least of these times, each over the number
/// of steps that automatic_integrator.cpp states for it: a swing under gravity over the beam's length; the time in
/// which gravity grows; periods of loads, drives and motions; the time in which a driven or a thrown body passes an
/// element; the time in which its velocity passes the range where friction fades. If there is none of these, it is a
/// hundred times a wave's time along the beam, or an eightieth of the shortest ramp or interval of a table where that
/// is longer. While these last, the timetable of the scene holds the steps shorter (scene/timetable.hpp). Duration and
/// output do not matter, nor do the beam's own vibrations: the error estimate finds those.
double longest_implicit_step(const Scene& scene);

/// What `"integrator": "auto"` stands for: of "generalized-alpha" and "dopri5", as far as the scene allows both, the
/// one that needs less work for `accuracy` (relative to the beam's length and to the motion). A trial of the first
/// instants decides. It counts evaluations of the equations, not time, and so chooses alike on every machine. There is
/// no trial if the fastest wave in an element would force dopri5 to far more steps anyway. Tolerances, longest step and
/// Newton's stopping rule follow from the accuracy. Throws InvalidInput if the scene allows neither.
IntegratorSpec automatic_integrator(const Scene& scene, double accuracy = usual_accuracy);

}  // namespace vlbeam
