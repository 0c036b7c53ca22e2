#pragma once

#include "mechanics/time/timetable.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// What a scene announces of its course: where tables have entries, where ramps end, where a function of time goes on
/// evenly, and how long steps may be while one of these changes: a tenth of that time, an eightieth of it in runs of
/// generalized-alpha whose steps the program chooses (see longest_implicit_step()). What oscillates or turns has ten
/// steps a period.
Timetable timetable(const Scene& scene);

/// The shortest of these times, without periods [s]; infinite where there are none.
double shortest_change(const Scene& scene);

}  // namespace vlbeam
