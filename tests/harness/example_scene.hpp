#pragma once

#include "io/json.hpp"

namespace vlbeam {

/// A scene in which every key is given that may stand beside the others.
inline Json example_scene() {
  return parse_json(R"({
    "schema": "vlbeam.scene/1", "title": "Falling beam with a sliding mass", "dimension": 2,
    "gravity": [0, -9.81], "gravity_ramp": 0.1,
    "beam": {"curve": {"type": "line", "start": [0, 0], "end": [1, 0]},
             "section": {"type": "circle", "radius": 0.01},
             "material": {"density": 7200, "youngs_modulus": 2e7, "damping": 0, "curvature_regularization": 0},
             "elements": 20, "element": "ALE-RANCF", "rest_shape": "as-built", "strain_law": "green",
             "quadrature_points": 5, "weights": [1, 1, 1, 1]},
    "supports": [{"at": "start", "type": "clamp", "clamp": "full"}],
    "sliding_mass": {"mass": 0.8, "position": 0.1, "velocity": 0.5, "slopes": "continuous",
                     "friction": {"coefficient": 0.2, "velocity": 0.002}, "separation_distance": 0.002},
    "formulation": "virtual-work", "weights": "frozen",
    "length_control": {"enabled": true, "upper": 1.5, "hysteresis": 0.001, "merge": "point-fit"},
    "integrator": {"type": "cash-karp", "rtol": 1e-9, "atol": 1e-8},
    "duration": 0.5, "output": {"interval": 0.005, "configurations": [0, 0.25, 0.5]}
  })");
}

}  // namespace vlbeam
