// One variable-length element, for a code of one's own: what the library needs to be given, and what it gives back.
// A cable element of 0.5 m, the far node of which slides along the material at 2 m/s; links vlbeam::core alone.
#include <cmath>
#include <iostream>

#include <vlbeam/core/element/beam_rule.hpp>
#include <vlbeam/core/element/moving_element.hpp>

namespace {

using namespace vlbeam;
constexpr int D = 2;
using Vector = Vec<double, D>;

int failures = 0;
void check(const char* what, double value, double bound) {
  const bool holds = std::abs(value) <= bound;
  failures += !holds;
  std::cout << (holds ? "holds  " : "FAILS  ") << what << ": " << std::abs(value) << " <= " << bound << '\n';
}

}  // namespace

int main() {
  // Coordinates: position and slope of both nodes, and the material coordinates of both ends; then their rates.
  const MovingCoordinates<double, D> q{{Vector(0, 0), Vector(1, 0), Vector(0.5, 0), Vector(1, 0)}, 0, 0.5};
  const double slide = 2;  // [m/s] of the node along the material, which is at rest: the node moves by r_x times that
  const MovingCoordinates<double, D> rate{{Vector(0, 0), Vector(0, 0), Vector(slide, 0), Vector(0, 0)}, 0, slide};

  // The weights of the element, as a function of the material on its interval; those of the polynomial element here.
  const WeightFunction weights{unit_weights, q.x_a, q.x_b};
  // The points of integration, and the shape functions at them: made once, and kept until the weights change.
  const ShapeTabulation table(beam_rule(5, AxialStrain::full), unit_weights);
  // What the element is of, and which equations are meant.
  MovingLaw<D> law;
  law.section.rhoA = 0.3;
  law.section.stiffness = Stiffness{1e4, 0};
  law.formulation = Formulation::variational;
  law.gravity = Vector(0, -9.81);

  const MovingEquations<double, D> eq = moving_equations<double, D>(q, rate, weights, table, law);

  // M q'' = Q: the block of the nodal coordinates is eq.mass (x) 1, coupled by eq.mass_a and eq.mass_b with x_A and
  // x_B.
  double mass = 0;  // of a rigid translation: both positions move
  for (const int i : {0, 2}) {
    for (const int j : {0, 2}) mass += eq.mass[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  check("the mass is that of the element's length", mass - 0.3 * 0.5, 1e-14);
  const Vector force = eq.force[0] + eq.force[2];
  check("the forces on both nodes are the weight", (force - Vector(0, -9.81 * mass)).norm(), 1e-12);
  // The material is at rest although the node is not: sliding a node along a straight beam costs nothing.
  check("a node that slides along matter at rest feels nothing along it", eq.force_b, 1e-12);
  return failures;
}
