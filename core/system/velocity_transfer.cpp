// Velocities of a new mesh from the field of the old one, and the energy that the change has cost.
#include <algorithm>
#include <cmath>

#include "core/element/quadrature.hpp"
#include "core/geometry/dense.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {
namespace {

constexpr int transfer_points = 12;    // on each piece between nodes of either mesh
constexpr double largest_scaling = 1;  // of the fluctuation, more than it is

}  // namespace

template <int D>
bool BeamSystem<D>::solve_mass(const JointElements& elements, const double* q, double* p) const {
  if (!solve_mass_apart(elements, q, p)) return false;
  const auto count = static_cast<Eigen::Index>(links_.size());
  return count == 0 || press(links_, elements, q, Eigen::VectorXd::Zero(count), p);
}

template <int D>
bool BeamSystem<D>::solve_mass_apart(const JointElements& elements, const double* q, double* p) const {
  if (elements.empty()) {
    solve_without_joint(*left_, *right_, p);
    if (!rider_) return true;
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(coordinates());
    const auto solved = solve_with_rider<D>(rider_->mass, rider_law(), rider_motion(q, at_rest.data()),
                                            element_nodes<D>(p, rider_->element), Vector::Zero(), p[layout_.mark()],
                                            rider_->held, false, p);
    if (solved) p[layout_.mark()] = solved->x;
    return solved.has_value();
  }
  std::vector<JointMotion<D>> at_rest;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto kept = guides(i) || joint(i).pitch != 0 ? std::optional(0.0) : std::nullopt;
    at_rest.push_back({joint_slopes(i, q), Eigen::Matrix<double, 2 * D, 1>::Zero(), 0, Vector::Zero(), kept});
  }
  return solve_joints(elements, at_rest, p).has_value();
}

template <int D>
void BeamSystem<D>::multiply_mass(const JointElements& elements, const double* q, const double* rate,
                                  double* out) const {
  std::fill(out, out + coordinates(), 0.0);
  left_->add_inertia(rate, out);
  right_->add_inertia(rate, out);
  for (const SpanBetween<D>& span : between_) span.span().add_inertia(rate, out);
  if (rider_) {
    const auto at = rider_motion(q, rate);
    push_rider(at, rider_law().mass * at.v, out);
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const MovingPart& part = parts_[p];
    const auto& eq = elements[p];
    const auto e = view(rate, rate).coordinates(part.element).e;
    const std::array<Vector, 4> nodal{e.r_a, e.s_a, e.r_b, e.s_b};
    const Eigen::Index a = part.a < 0 ? -1 : places_[static_cast<std::size_t>(part.a)].mark,
                       b = part.b < 0 ? -1 : places_[static_cast<std::size_t>(part.b)].mark;
    const double x_a = a < 0 ? 0 : rate[a], x_b = b < 0 ? 0 : rate[b];
    const auto to = vectors_of(out, part.element);
    double on_a = eq.mass_aa * x_a + eq.mass_ab * x_b, on_b = eq.mass_ab * x_a + eq.mass_bb * x_b;
    for (std::size_t i = 0; i < 4; ++i) {
      Vector sum = eq.mass_a[i] * x_a + eq.mass_b[i] * x_b;
      for (std::size_t j = 0; j < 4; ++j) sum += eq.mass[i][j] * nodal[j];
      Eigen::Map<Vector>(to[i]) += sum;
      on_a += eq.mass_a[i].dot(nodal[i]);
      on_b += eq.mass_b[i].dot(nodal[i]);
    }
    if (a >= 0) out[a] += on_a;
    if (b >= 0) out[b] += on_b;
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    position<D>(out, places_[i].node) += joint(i).law.mass * position<D>(rate, places_[i].node);
    out[places_[i].mark] += joint(i).law.turning * rate[places_[i].mark];
  }
}

template <int D>
void BeamSystem<D>::push_rider(const RiderMotion<double, D>& at, const Vector& force, double* out) const {
  const int k = rider_->element;
  position<D>(out, k) += at.s[0] * force;
  slope<D>(out, k) += at.s[1] * force;
  position<D>(out, k + 1) += at.s[2] * force;
  slope<D>(out, k + 1) += at.s[3] * force;
  if (!rider_->held) out[layout_.mark()] += at.r_x.dot(force);
}

template <int D>
Eigen::VectorXd BeamSystem<D>::excess_momentum(const ChainState<D>& before, const ChainState<D>& after, int first,
                                               int last) const {
  Eigen::VectorXd momentum = Eigen::VectorXd::Zero(coordinates());
  const auto& rule = gauss_legendre(transfer_points);
  const double start = after.mesh.x[static_cast<std::size_t>(first)],
               end = after.mesh.x[static_cast<std::size_t>(last)];
  const std::vector<double> pieces = common_pieces(before.mesh, after.mesh, start, end);
  const ChainView<D> places = view(nullptr, nullptr);
  const auto add = [&](int to, const PointMotion<double, D>& is, const Vector& excess) {
    for (int i = 0; i < 4; ++i) {
      momentum.segment<D>(places.vector(to, i)) += is.s[static_cast<std::size_t>(i)] * excess;
    }
    if (const JointPlace* b = places.joint_at(to + 1)) momentum[b->mark] += is.y_b.dot(excess);
    if (const JointPlace* a = places.joint_at(to)) momentum[a->mark] += is.y_a.dot(excess);
  };
  for (std::size_t piece = 0; piece + 1 < pieces.size(); ++piece) {
    const double a = pieces[piece], length = pieces[piece + 1] - a;
    const int from = before.mesh.element_at(a + length / 2), to = after.mesh.element_at(a + length / 2);
    for (const auto& [u, weight] : rule) {
      const double x = a + u * length;
      const auto was = motion_at(before, from, x, model_.transport), is = motion_at(after, to, x, model_.transport);
      add(to, is, (was.v - is.v) * (weight * length * model_.section.rhoA));
    }
  }
  for (const PointMass& point : model_.masses.points) {
    if (point.x < start || point.x > end) continue;
    const int to = after.mesh.element_at(point.x);
    const auto is = motion_at(after, to, point.x, model_.transport);
    const Vector was = motion_at(before, before.mesh.element_at(point.x), point.x, model_.transport).v;
    add(to, is, point.mass * (was - is.v));
  }
  return momentum;
}

template <int D>
void BeamSystem<D>::project_velocities(const ChainState<D>& before, int first, int last, Eigen::VectorXd& y,
                                       double t) const {
  Eigen::VectorXd correction = excess_momentum(before, chain(y, t), first, last);
  if (rider_ && !before.joints.empty()) {  // a node moves as its element does not
    const auto at = rider_motion(y.data(), y.data() + coordinates());
    const Vector was = position<D>(before.rate.data(), before.joints.front().node);
    push_rider(at, rider_law().mass * (was - at.v), correction.data());
  }
  if (solve_mass(elements_at(y, t), y.data(), correction.data())) {
    y.segment(coordinates(), coordinates()) += correction;
  }
}

template <int D>
Eigen::MatrixXd BeamSystem<D>::rigid_momenta(const JointElements& elements, const Eigen::VectorXd& y) const {
  constexpr int rotations = D == 2 ? 1 : 3;
  Eigen::MatrixXd momenta(coordinates(), D + rotations);
  Eigen::VectorXd rigid(coordinates());
  for (int mode = 0; mode < D + rotations; ++mode) {
    rigid.setZero();
    const int a = (mode - D + (D == 2 ? 0 : 1)) % D, b = (a + 1) % D;  // a rotation in the plane of axes a and b
    auto rotate = [&](Eigen::Index vector) {
      rigid[vector + a] = -y[vector + b];
      rigid[vector + b] = y[vector + a];
    };
    for (Eigen::Index node = 0; node < layout_.mark(); node += node_size<D>) {
      if (mode < D) {
        rigid[node + mode] = 1;
      } else {
        rotate(node);
        rotate(node + D);
      }
    }
    for (const JointPlace& place : places_) {
      if (mode >= D && place.behind >= 0) rotate(place.behind);
    }
    multiply_mass(elements, y.data(), rigid.data(), momenta.col(mode).data());
  }
  return momenta;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::momenta(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd sum = rigid_momenta(elements_at(y, t), y).transpose() * y.segment(coordinates(), coordinates());
  if constexpr (D == 3) sum.tail<3>() += spin_momentum(y);
  return sum;
}

template <int D>
void BeamSystem<D>::restore(const Eigen::VectorXd& momenta, double total, Eigen::VectorXd& y, double t) const {
  restore_axis(momenta, total, y, t);
  if (frames_) restore_axis(momenta, total, y, t);  // spins follow marks a little
}

template <int D>
void BeamSystem<D>::restore_axis(const Eigen::VectorXd& all, double total, Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd momenta;
  momenta = all;
  if constexpr (D == 3) momenta.tail<3>() -= spin_momentum(y);
  const JointElements elements = elements_at(y, t);
  auto rate = y.segment(coordinates(), coordinates());
  // momenta of the rigid motions, and of these motions what the supports leave
  const Eigen::MatrixXd rigid = rigid_momenta(elements, y);
  Eigen::MatrixXd motion = rigid;
  for (Eigen::Index mode = 0; mode < motion.cols(); ++mode) {
    if (!solve_mass(elements, y.data(), motion.col(mode).data())) return;
  }
  // turning has another unit: pivots, and with them the rounding, must not depend on it
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(rigid.cols());
  unit.tail(rigid.cols() - D).setConstant(std::ldexp(1.0, -std::ilogb(mesh_.length())));
  const Eigen::MatrixXd metric = unit.asDiagonal() * (rigid.transpose() * motion) * unit.asDiagonal();
  const auto velocities_of = [&](const Eigen::VectorXd& of) -> Eigen::VectorXd {
    return unit.cwiseProduct(solve_pivoting(metric, unit.cwiseProduct(of)));
  };
  rate += motion * velocities_of(momenta - rigid.transpose() * rate);

  Eigen::VectorXd fluctuation = rate - motion * velocities_of(momenta);
  fluctuation.tail(layout_.turning).setZero();
  Eigen::VectorXd of_fluctuation(coordinates());
  multiply_mass(elements, y.data(), fluctuation.data(), of_fluctuation.data());
  const double twice_kinetic = fluctuation.dot(of_fluctuation);
  if (!(twice_kinetic > 0)) return;
  // T(v + s w) = T(v) + (s + s^2/2) w.M w, for w is orthogonal to what else there is
  const double missing = total - observe(y, t, model_.quadrature_points).energy.total();
  const double root = 1 + 2 * missing / twice_kinetic;
  const double scaling = root > 0 ? std::min(std::sqrt(root) - 1, largest_scaling) : -1;
  rate += scaling * fluctuation;
}

template bool BeamSystem<2>::solve_mass(const JointElements&, const double*, double*) const;
template bool BeamSystem<2>::solve_mass_apart(const JointElements&, const double*, double*) const;
template void BeamSystem<2>::multiply_mass(const JointElements&, const double*, const double*, double*) const;
template void BeamSystem<2>::push_rider(const RiderMotion<double, 2>&, const Vec<double, 2>&, double*) const;
template Eigen::VectorXd BeamSystem<2>::excess_momentum(const ChainState<2>&, const ChainState<2>&, int, int) const;
template void BeamSystem<2>::project_velocities(const ChainState<2>&, int, int, Eigen::VectorXd&, double) const;
template Eigen::MatrixXd BeamSystem<2>::rigid_momenta(const JointElements&, const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<2>::momenta(const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::restore(const Eigen::VectorXd&, double, Eigen::VectorXd&, double) const;
template bool BeamSystem<3>::solve_mass(const JointElements&, const double*, double*) const;
template bool BeamSystem<3>::solve_mass_apart(const JointElements&, const double*, double*) const;
template void BeamSystem<3>::multiply_mass(const JointElements&, const double*, const double*, double*) const;
template void BeamSystem<3>::push_rider(const RiderMotion<double, 3>&, const Vec<double, 3>&, double*) const;
template Eigen::VectorXd BeamSystem<3>::excess_momentum(const ChainState<3>&, const ChainState<3>&, int, int) const;
template void BeamSystem<3>::project_velocities(const ChainState<3>&, int, int, Eigen::VectorXd&, double) const;
template Eigen::MatrixXd BeamSystem<3>::rigid_momenta(const JointElements&, const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<3>::momenta(const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::restore_axis(const Eigen::VectorXd&, double, Eigen::VectorXd&, double) const;
template void BeamSystem<3>::restore_axis(const Eigen::VectorXd&, double, Eigen::VectorXd&, double) const;
template void BeamSystem<3>::restore(const Eigen::VectorXd&, double, Eigen::VectorXd&, double) const;

}  // namespace vlbeam
