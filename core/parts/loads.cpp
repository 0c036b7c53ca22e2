#include "core/parts/loads.hpp"

#include <sstream>
#include <string>

#include "core/error.hpp"

namespace vlbeam {
namespace {

std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

}  // namespace

template <int D>
void check_places(const std::vector<PointLoad<D>>& loads, double until, double slack,
                  const std::function<std::pair<double, double>(double t)>& ends) {
  constexpr int instants = 2000;
  for (const PointLoad<D>& load : loads) {
    for (int i = 0; load.x && i <= instants; ++i) {
      const double t = until * i / instants, x = load.x(t);
      const auto [first, last] = ends(t);
      if (x >= first - slack && x <= last + slack) continue;
      throw InvalidInput("/loads", "one at the material coordinate " + text(x) + " m at t = " + text(t) + " s",
                         "it must be a point of the beam, " + text(first) + " to " + text(last) + " m at that time");
    }
  }
}

template <int D>
double Loads<D>::add_forces(const ChainView<D>& beam, double t, double* force, double* on_marks) const {
  double power = 0;
  for (const PointLoad<D>& load : points) {
    const double x = load.place(beam, t);
    const int k = beam.element_at(x);
    const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), x);
    PointForce<double, D> f{load.force_on(at.r_x, t), Vec<double, D>::Zero()};
    if constexpr (D == 2) {
      if (load.moment) f.on_slope = turning_force<double>(load.moment(t), at.r_x);
    }
    add_point_force(beam, k, at, f, force);
    power += f.on_r.dot(at.v) + f.on_slope.dot(at.v_x);
    if (on_marks == nullptr) continue;
    on_marks[k] += f.on_r.dot(at.y_a) + f.on_slope.dot(at.y_a_x);
    on_marks[k + 1] += f.on_r.dot(at.y_b) + f.on_slope.dot(at.y_b_x);
  }
  return power;
}

template <int D>
typename Loads<D>::ElementMatrix Loads<D>::tangent(const PointLoad<D>& load, const ChainView<D>& beam, int k,
                                                   double t) const {
  constexpr int X = point_coordinates<D> - 1;
  const double x = load.place(beam, t);
  const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), x);
  const Eigen::Matrix<double, D, D> turning = load.turning(at.r_x, t);
  ElementMatrix matrix = ElementMatrix::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      matrix.template block<D, D>(D * i, D * j) =
          -at.s[static_cast<std::size_t>(i)] * at.s_x[static_cast<std::size_t>(j)] * turning;
    }
  }
  if (!beam.at_joint(k)) return matrix;

  const bool a_moves = k == beam.joint;
  const Vec<double, D> force = load.force_on(at.r_x, t), y = a_moves ? at.y_a : at.y_b,
                       y_x = a_moves ? at.y_a_x : at.y_b_x;
  // how the shape functions change with the mark, and the second derivative of r by it: the kinematics of unit nodal
  // vectors, and of the mark alone at unit rate
  using Row = Eigen::Vector4d;
  const MovingCoordinates<double, D> q = beam.coordinates(k);
  const MovingCoordinates<double, 4> unit{{Row::Unit(0), Row::Unit(1), Row::Unit(2), Row::Unit(3)}, q.x_a, q.x_b};
  const MovingCoordinates<double, 4> still{{Row::Zero(), Row::Zero(), Row::Zero(), Row::Zero()}, 0, 0};
  MovingCoordinates<double, D> alone{
      {Vec<double, D>::Zero(), Vec<double, D>::Zero(), Vec<double, D>::Zero(), Vec<double, D>::Zero()}, 0, 0};
  (a_moves ? alone.x_a : alone.x_b) = 1;
  const auto units = point_at<double, 4>(MovingKinematics<double, 4>(unit, still, beam.transport, beam.weights(k)), x);
  const Row s_mark = a_moves ? units.y_a : units.y_b;
  const Vec<double, D> second =
      point_at<double, D>(MovingKinematics<double, D>(q, alone, beam.transport, beam.weights(k)), x).remainder;
  for (int i = 0; i < 4; ++i) {
    const auto ii = static_cast<std::size_t>(i);
    matrix.template block<D, 1>(D * i, X) = -(s_mark[i] * force + at.s[ii] * (turning * y_x));
    matrix.template block<1, D>(X, D * i) = -(s_mark[i] * force + at.s_x[ii] * (turning.transpose() * y)).transpose();
  }
  matrix(X, X) = -(second.dot(force) + y.dot(turning * y_x));
  return matrix;
}

template <int D>
typename Loads<D>::ElementMatrix Loads<D>::moment_tangent(const PointLoad<D>& load, const ChainView<D>& beam, int k,
                                                          double t) {
  if constexpr (D == 2) {
    return point_tangent<D>(beam, k, load.place(beam, t), beam.rate, 0, 0,
                            [&](const auto& at, const auto& /*acceleration*/) {
                              using Real = typename std::decay_t<decltype(at.r_x)>::Scalar;
                              PointForce<Real, D> force;
                              force.on_slope = turning_force<Real>(load.moment(t), at.r_x);
                              return force;
                            });
  } else {
    return ElementMatrix::Zero();
  }
}

template <int D>
std::vector<Vec<double, D>> Loads<D>::places(const ChainView<D>& beam, double t) const {
  std::vector<Vec<double, D>> result;
  for (const PointLoad<D>& load : points) {
    const double x = load.place(beam, t);
    result.push_back(point_at<double, D>(beam.kinematics(beam.element_at(x)), x).r);
  }
  return result;
}

template <int D>
Vec<double, D> swept(const MovingKinematics<double, D>& element, const ShapeTabulation& table, bool reshaped,
                     Formulation formulation) {
  Vec<double, D> sum = Vec<double, D>::Zero();
  const bool fixed_points = formulation == Formulation::virtual_work;
  const RestKinematics<double, D, MovingEnds::both>* none = nullptr;
  const auto motion = [&](double u, const ShapeTable<double>& shape) { return element.at(u, shape); };
  for_each_point(element, table, reshaped, none, motion, [&](const auto& point, const auto& at, const auto*) {
    sum += point.weight * at.v;
    if (!fixed_points) sum += point.weight * point.mesh_velocity * at.r_x + point.weight_rate * at.r;
  });
  return sum;
}

template void check_places(const std::vector<PointLoad<2>>&, double, double,
                           const std::function<std::pair<double, double>(double)>&);
template void check_places(const std::vector<PointLoad<3>>&, double, double,
                           const std::function<std::pair<double, double>(double)>&);
template struct Loads<2>;
template struct Loads<3>;
template Vec<double, 2> swept(const MovingKinematics<double, 2>&, const ShapeTabulation&, bool, Formulation);
template Vec<double, 3> swept(const MovingKinematics<double, 3>&, const ShapeTabulation&, bool, Formulation);

}  // namespace vlbeam
