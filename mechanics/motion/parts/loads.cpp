#include "mechanics/motion/parts/acting_loads.hpp"

#include <limits>
#include <string>

#include "core/error.hpp"

namespace vlbeam {
template <int D>
void check_places(const std::vector<PointLoad<D>>& loads, double until, double beyond,
                  const std::function<std::pair<double, double>(double t)>& ends) {
  constexpr int instants = 2000;
  for (const PointLoad<D>& load : loads) {
    for (int i = 0; load.x && i <= instants; ++i) {
      const double t = until * i / instants, x = load.x(t);
      const auto [first, last] = ends(t);
      if (x >= first - beyond && x <= last + beyond) continue;
      throw ModelError(
          "loads", "one at the material coordinate " + six_digits(x) + " m at t = " + six_digits(t) + " s",
          "it must be a point of the beam, " + six_digits(first) + " to " + six_digits(last) + " m at that time");
    }
  }
}

template <int D>
double Loads<D>::add_forces(const ChainView<D>& beam, double t, double* force, double* on_marks) const {
  double power = 0;
  for (const PointLoad<D>& load : points) {
    const double x = load.place(beam, t);
    if (!load.acts_at(x, beam)) continue;
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
  const double x = load.place(beam, t);
  const Vec<double, D> r_x = point_at<double, D>(beam.kinematics(k), x).r_x;
  return constant_force_tangent<D>(beam, k, x, load.force_on(r_x, t), load.turning(r_x, t));
}

template <int D>
PointMatrix<D> constant_force_tangent(const ChainView<D>& beam, int k, double x, const Vec<double, D>& force,
                                      const Eigen::Matrix<double, D, D>& turning) {
  constexpr int X = point_coordinates<D> - 2;
  const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), x);
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      matrix.template block<D, D>(D * i, D * j) =
          -at.s[static_cast<std::size_t>(i)] * at.s_x[static_cast<std::size_t>(j)] * turning;
    }
  }
  if (!beam.at_joint(k)) return matrix;

  const std::array<bool, 2> moves{beam.joint_at(k) != nullptr, beam.joint_at(k + 1) != nullptr};
  const std::array<Vec<double, D>, 2> y{at.y_a, at.y_b}, y_x{at.y_a_x, at.y_b_x};
  // how the shape functions change with the marks, and the second derivatives of r by them: the kinematics of unit
  // nodal vectors, and of the marks alone at unit rates
  using Row = Eigen::Vector4d;
  const MovingCoordinates<double, D> q = beam.coordinates(k);
  const MovingCoordinates<double, 4> unit{{Row::Unit(0), Row::Unit(1), Row::Unit(2), Row::Unit(3)}, q.x_a, q.x_b};
  const MovingCoordinates<double, 4> still{{Row::Zero(), Row::Zero(), Row::Zero(), Row::Zero()}, 0, 0};
  const auto second = [&](double a_rate, double b_rate) -> Vec<double, D> {
    const Vec<double, D> none = Vec<double, D>::Zero();
    const MovingCoordinates<double, D> alone{{none, none, none, none}, a_rate, b_rate};
    return point_at<double, D>(MovingKinematics<double, D>(q, alone, beam.transport, beam.weights(k)), x).remainder;
  };
  const auto units = point_at<double, 4>(MovingKinematics<double, 4>(unit, still, beam.transport, beam.weights(k)), x);
  for (std::size_t e = 0; e < 2; ++e) {
    if (!moves[e]) continue;
    const Eigen::Index to = X + static_cast<Eigen::Index>(e);
    const Row s_mark = e == 0 ? units.y_a : units.y_b;
    for (int i = 0; i < 4; ++i) {
      const auto ii = static_cast<std::size_t>(i);
      matrix.template block<D, 1>(D * i, to) = -(s_mark[i] * force + at.s[ii] * (turning * y_x[e]));
      matrix.template block<1, D>(to, D * i) =
          -(s_mark[i] * force + at.s_x[ii] * (turning.transpose() * y[e])).transpose();
    }
    matrix(to, to) = -(second(e == 0 ? 1 : 0, e == 0 ? 0 : 1).dot(force) + y[e].dot(turning * y_x[e]));
  }
  if (moves[0] && moves[1]) {
    const double mixed = (second(1, 1) - second(1, 0) - second(0, 1)).dot(force) / 2;
    matrix(X, X + 1) = -(mixed + y[0].dot(turning * y_x[1]));
    matrix(X + 1, X) = -(mixed + y[1].dot(turning * y_x[0]));
  }
  return matrix;
}

template <int D>
typename Loads<D>::ElementMatrix Loads<D>::moment_tangent(const PointLoad<D>& load, const ChainView<D>& beam, int k,
                                                          double t) {
  if constexpr (D == 2) {
    return point_tangent<D>(beam, k, load.place(beam, t), beam.rate, {1, 0, 0},
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
    if (!load.acts_at(x, beam)) {
      result.push_back(Vec<double, D>::Constant(std::numeric_limits<double>::quiet_NaN()));
      continue;
    }
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
    if (point.feels == Feels::stretch) return;
    sum += point.weight * at.v;
    if (!fixed_points) sum += point.weight * point.mesh_velocity * at.r_x + point.weight_rate * at.r;
  });
  return sum;
}

template void check_places(const std::vector<PointLoad<2>>&, double, double,
                           const std::function<std::pair<double, double>(double)>&);
template void check_places(const std::vector<PointLoad<3>>&, double, double,
                           const std::function<std::pair<double, double>(double)>&);
template PointMatrix<2> constant_force_tangent(const ChainView<2>&, int, double, const Vec<double, 2>&,
                                               const Eigen::Matrix2d&);
template PointMatrix<3> constant_force_tangent(const ChainView<3>&, int, double, const Vec<double, 3>&,
                                               const Eigen::Matrix3d&);
template struct Loads<2>;
template struct Loads<3>;
template Vec<double, 2> swept(const MovingKinematics<double, 2>&, const ShapeTabulation&, bool, Formulation);
template Vec<double, 3> swept(const MovingKinematics<double, 3>&, const ShapeTabulation&, bool, Formulation);
template class ActingLoads<2>;
template class ActingLoads<3>;

}  // namespace vlbeam
