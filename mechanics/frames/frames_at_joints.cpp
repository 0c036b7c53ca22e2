// What elements of a beam with frames do whose ends move along the beam.
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/element/active.hpp"
#include "core/element/quadrature.hpp"
#include "mechanics/frames/frames.hpp"

namespace vlbeam {

void Frames::let_slide(std::span<const JointPlace> joints, Eigen::Index angles, const Axis<3>* rest,
                       std::shared_ptr<const RestTriads> along) {
  first_angle_ = angles;
  rest_curve_ = rest;
  along_ = std::move(along);
  joints_.clear();
  joint_nodes_.clear();
  sliding_.clear();
  slides_.assign(static_cast<std::size_t>(elements()), false);
  for (const JointPlace& joint : joints) {
    joints_.push_back({joint.mark, {}});
    joint_nodes_.push_back(joint.node);
  }
  mark_inertia_.assign(joints_.size() * joints_.size(), 0);
  const auto joint_at = [&](int node) {
    const auto at = std::ranges::find(joint_nodes_, node);
    return at == joint_nodes_.end() ? -1 : static_cast<int>(at - joint_nodes_.begin());
  };
  packs_.clear();
  for (int k = 0; k < elements(); ++k) {
    const int a = joint_at(k), b = joint_at(k + 1);
    const auto i = static_cast<std::size_t>(k);
    if (a < 0 && b < 0) {
      packs_.add(k, tables_[i]);
      continue;
    }
    slides_[i] = true;
    sliding_.push_back({k, {a, b}, FrameTable(1, weights_[i])});
  }
}

std::array<FrameRestEnd, 2> Frames::rest_ends(int k) const {
  std::array<FrameRestEnd, 2> ends;
  for (int e = 0; e < 2; ++e) {
    const auto i = static_cast<std::size_t>(k + e);
    FrameRestEnd& end = ends[static_cast<std::size_t>(e)];
    end = rest_ends_[i];
    if (std::ranges::find(joint_nodes_, k + e) == joint_nodes_.end()) continue;
    end.x = x_[i];
    end.moves = true;
    end.curve = rest_curve_->derivatives(x_[i]);
    end.direction = along_->direction<double>(x_[i], end.curve[1]);
  }
  return ends;
}

MovingFrame Frames::element_at(const Sliding& sliding, const double* q) const {
  const auto i = static_cast<std::size_t>(sliding.element);
  MovingFrameRest rest;
  if (rest_curve_ != nullptr) {
    const auto ends = rest_ends(sliding.element);
    rest = moving_frame_rest(sliding.unit, model_.section, ends[0], ends[1], *along_);
  }
  return {sliding.unit,
          model_.section,
          nodes_[i],
          nodes_[i + 1],
          x_[i],
          x_[i + 1],
          turned(q, sliding.element),
          rest_curve_ != nullptr ? &rest : nullptr};
}

MovingFrameVector Frames::gathered(const Sliding& sliding, const double* q, bool still) const {
  const int k = sliding.element;
  MovingFrameVector result;
  result << position<3>(q, k), slope<3>(q, k), q[angle(k)], position<3>(q, k + 1), slope<3>(q, k + 1), q[angle(k + 1)],
      0, 0;
  for (int e = 0; e < 2; ++e) {
    const int joint = sliding.joints[static_cast<std::size_t>(e)];
    result[14 + e] = joint >= 0 ? q[joints_[static_cast<std::size_t>(joint)].mark]
                     : still    ? 0
                                : x_[static_cast<std::size_t>(k + e)];
  }
  return result;
}

void Frames::scatter(const Sliding& sliding, const MovingFrameVector& values, double* to) const {
  for (int e = 0; e < 2; ++e) {
    const int k = sliding.element + e, joint = sliding.joints[static_cast<std::size_t>(e)];
    position<3>(to, k) += values.segment<3>(7 * e);
    slope<3>(to, k) += values.segment<3>(7 * e + 3);
    to[angle(k)] += values[7 * e + 6];
    if (joint >= 0) to[joints_[static_cast<std::size_t>(joint)].mark] += values[14 + e];
  }
}

MovingFrameInertia Frames::inertia_of(const Sliding& sliding, const double* q) const {
  const auto i = static_cast<std::size_t>(sliding.element);
  return {references_[i], references_[i + 1], sliding.unit.middle, turned(q, sliding.element), model_.section.rhoIp};
}

MovingFrameSpin<double> Frames::spin_of(const Sliding& sliding, const double* q, const double* rate) const {
  const auto i = static_cast<std::size_t>(sliding.element);
  const TwistRate<double> twist(sliding.unit.middle, frame_ends(nodes_[i], nodes_[i + 1], turned(q, sliding.element)),
                                x_[i + 1] - x_[i]);
  const auto rates = [&](int e) -> FrameEndRates<double> {
    const int k = sliding.element + e, joint = sliding.joints[static_cast<std::size_t>(e)];
    return {position<3>(rate, k), slope<3>(rate, k), spin_of(rate, k),
            joint >= 0 ? rate[joints_[static_cast<std::size_t>(joint)].mark] : 0};
  };
  return {twist, rates(0), rates(1), model_.section.rhoIp};
}

void Frames::add_sliding_force(const double* q, double* force) const {
  for (const Sliding& sliding : sliding_) scatter(sliding, -element_at(sliding, q).gradient(), force);
}

void Frames::add_sliding_inertia(const double* q, const double* rate, const double* a, double* r) const {
  for (const Sliding& sliding : sliding_) {
    scatter(
        sliding,
        inertia_of(sliding, q)
            .residual<double>(gathered(sliding, q, false), gathered(sliding, rate, true), gathered(sliding, a, true)),
        r);
  }
}

void Frames::add_sliding_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const {
  const double *q = motion.beam.q, *rate = motion.beam.rate, *a = motion.a;
  for (const Sliding& sliding : sliding_) {
    MovingFrameMatrix matrix = MovingFrameMatrix::Zero();
    if (by.q != 0) matrix = by.q * element_at(sliding, q).tangent();
    const MovingFrameInertia inertia = inertia_of(sliding, q);
    const auto at = varied(gathered(sliding, q, false), by.q);
    if (model_.section.rhoIp != 0 && a != nullptr) {
      const auto r = inertia.residual<Active<16>>(at, varied(gathered(sliding, rate, true), by.v),
                                                  varied(gathered(sliding, a, true), by.a));
      for (int i = 0; i < 16; ++i) matrix.row(i) += r[i].derivatives().transpose();
    }
    if (model_.torques.present() && by.q != 0) {
      const auto push = [&](const Active<16>& u, const Active<16>& torque) {
        const auto f = inertia.torque<Active<16>>(at, u, torque);
        for (int i = 0; i < 16; ++i) matrix.row(i) -= f[i].derivatives().transpose();
      };
      for (const Torques::Point& load : model_.torques.points) {
        const double x = load.x ? load.x(motion.t) : x_[static_cast<std::size_t>(load.node)];
        if (element_of(x) != sliding.element) continue;
        push((x - at[14]) / (at[15] - at[14]), load.torque(motion.t));
      }
      if (model_.torques.line) {
        push(Active<16>(0.5), (at[15] - at[14]) * model_.torques.line(motion.t));
      }
    }
    tangent.add_turning_at_joints(sliding.element, matrix, sliding.joints);
  }
}

void Frames::start_sliding_spins(const double* q, const double* rate) const {
  seen_spins_.clear();
  for (AtJoint& joint : joints_) joint.response.assign(x_.size(), 0);
  std::ranges::fill(mark_inertia_, 0);
  for (const Sliding& sliding : sliding_) {
    const MovingFrameSpin<double>& spin = seen_spins_.emplace_back(spin_of(sliding, q, rate));
    const auto k = static_cast<std::size_t>(sliding.element);
    const double share = spin.share, flux = spin.flux / (x_[k + 1] - x_[k]);
    add_to_spin_matrix(k, share);
    const auto known = spin.momentum_rates(0, 0, 0, 0);
    spin_rates_[k] -= known[0] - flux;
    spin_rates_[k + 1] -= known[1] + flux;
    // spins by x'', and x'' by itself and by that of the other end
    for (std::size_t e = 0; e < 2; ++e) {
      if (sliding.joints[e] < 0) continue;
      const auto j = static_cast<std::size_t>(sliding.joints[e]);
      joints_[j].response[k + e] += 2 * share * spin.tau;
      joints_[j].response[k + 1 - e] += share * spin.tau;
      for (std::size_t f = 0; f < 2; ++f) {
        if (sliding.joints[f] < 0) continue;
        mark_inertia_[j * joints_.size() + static_cast<std::size_t>(sliding.joints[f])] +=
            (e == f ? 2 : 1) * share * spin.tau * spin.tau;
      }
    }
  }
}

void Frames::finish_sliding_spins(double* force) const {
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    const Sliding& sliding = sliding_[i];
    const MovingFrameSpin<double>& spin = seen_spins_[i];
    const int k = sliding.element;
    const auto at = static_cast<std::size_t>(k);
    const double flux = spin.flux / (x_[at + 1] - x_[at]);
    position<3>(force, k) += spin.on_r_b;
    position<3>(force, k + 1) -= spin.on_r_b;
    slope<3>(force, k) -= spin.on_s_a;
    slope<3>(force, k + 1) -= spin.on_s_b;
    const auto p_rates = spin.momentum_rates(spin_rates_[at], spin_rates_[at + 1], 0, 0);
    momenta_[at] += spin.p_a;
    momenta_[at + 1] += spin.p_b;
    momentum_rates_[at] += p_rates[0] - flux;
    momentum_rates_[at + 1] += p_rates[1] + flux;
    for (std::size_t e = 0; e < 2; ++e) {
      if (sliding.joints[e] < 0) continue;
      force[joints_[static_cast<std::size_t>(sliding.joints[e])].mark] +=
          spin.tau * p_rates[e] - (e == 0 ? spin.on_x_a : spin.on_x_b);
    }
  }
  // with spins that follow x'', less is left of its inertia
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    by_x_ = joints_[j].response;
    for (std::size_t k = 0; k < by_x_.size(); ++k) by_x_[k] = held_[k] ? 0 : by_x_[k];
    solve_for_spins(joints_[j].response);
    for (std::size_t i = j; i < joints_.size(); ++i) {
      double sum = 0;
      const std::vector<double>& of_other = i == j ? by_x_ : joints_[i].response;  // not solved for yet
      for (std::size_t k = 0; k < by_x_.size(); ++k) sum += held_[k] ? 0 : of_other[k] * joints_[j].response[k];
      mark_inertia_[i * joints_.size() + j] -= sum;
      if (i != j) mark_inertia_[j * joints_.size() + i] -= sum;
    }
  }
}

double Frames::spin_within(const double* q, const double* rate, double x) const {
  const int k = element_of(x);
  const auto i = static_cast<std::size_t>(k);
  const double u = (x - x_[i]) / (x_[i + 1] - x_[i]);
  const auto sliding = std::ranges::find(sliding_, k, &Sliding::element);
  if (sliding == sliding_.end()) return (1 - u) * spin_of(rate, k) + u * spin_of(rate, k + 1);
  const MovingFrameSpin<double> spin = spin_of(*sliding, q, rate);
  return (1 - u) * spin.omega_a + u * spin.omega_b;
}

void Frames::project_spins(const Frames& before, const double* was, const double* was_rate, const double* q,
                           double* rate) const {
  before.look(was);
  look(q);
  std::vector<double> excess(x_.size(), 0), pieces;
  std::ranges::set_union(before.x_, x_, std::back_inserter(pieces));
  start_spin_matrix();
  for (std::size_t k = 0; k + 1 < x_.size(); ++k) {
    add_to_spin_matrix(k, model_.section.rhoIp * (x_[k + 1] - x_[k]) / 6);
  }
  factor_spin_matrix();
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    const double length = pieces[i + 1] - pieces[i];
    for (const auto& [u, weight] : gauss_legendre(2)) {
      const double x = pieces[i] + u * length;
      const double more = before.spin_within(was, was_rate, x) - spin_within(q, rate, x);
      const auto k = static_cast<std::size_t>(element_of(x));
      const double share = (x - x_[k]) / (x_[k + 1] - x_[k]), size = model_.section.rhoIp * weight * length * more;
      excess[k] += (1 - share) * size;
      excess[k + 1] += share * size;
    }
  }
  solve_for_spins(excess);
  for (int k = 0; k < nodes(); ++k) rate[angle(k)] += excess[static_cast<std::size_t>(k)];
}

void Frames::solve_for_spins(std::vector<double>& x) const {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) x[k] = held_[k] ? 0 : x[k];
  for (std::size_t k = 1; k < n; ++k) x[k] -= beside_[k - 1] / diagonal_[k - 1] * x[k - 1];
  for (std::size_t k = n; k-- > 0;) x[k] = (x[k] - (k + 1 < n ? beside_[k] * x[k + 1] : 0)) / diagonal_[k];
}

std::array<double, 2> Frames::angles_in(const double* q, int k) const {
  const auto i = static_cast<std::size_t>(k);
  if (!slides(k)) {
    const FrameElement<double> element(tables_[i], model_.section, frame_ends(nodes_[i], nodes_[i + 1], turned(q, k)));
    return {element.twist(), element.inner()};
  }
  const auto sliding = std::ranges::find(sliding_, k, &Sliding::element);
  return element_at(*sliding, q).angles();
}

double Frames::twist(const double* q, int k) const { return angles_in(q, k)[0]; }

std::vector<double> Frames::twists_to(const double* q, const std::vector<double>& x) const {
  look(q);
  std::vector<double> sums{0}, twists;  // to the nodes, to the points
  for (int k = 0; k < elements(); ++k) sums.push_back(sums.back() + twist(q, k));
  for (const double at : x) {
    const int k = element_of(at);
    const auto i = static_cast<std::size_t>(k);
    const double u = (at - x_[i]) / (x_[i + 1] - x_[i]);
    const auto angles = angles_in(q, k);
    twists.push_back(sums[i] + u * angles[0] + 4 * u * (1 - u) * angles[1]);
  }
  return twists;
}

TriadReference Frames::section_at(const double* q, double x) const {
  look(q);
  const int k = element_of(x);
  const auto i = static_cast<std::size_t>(k);
  const double l = x_[i + 1] - x_[i], u = (x - x_[i]) / l;
  const auto angles = angles_in(q, k);
  TriadReference at =
      frame_at(u, l, weights_[i], frame_ends(nodes_[i], nodes_[i + 1], turned(q, k)), angles[0], angles[1]);
  if (rest_curve_ == nullptr) return at;
  const auto rest = rest_ends(k);
  const FrameTable table(l, weights_[i]);
  const FrameEnds<double> ends{
      rest[1].curve[0] - rest[0].curve[0], rest[0].curve[1], rest[1].curve[1], rest[0].direction, rest[1].direction, 0};
  const TriadReference own =
      frame_at(u, l, weights_[i], ends, FrameElement<double>(table, model_.section, ends).twist(), 0);
  const Vec<double, 3> s = rest_curve_->derivatives(x)[1];
  const Vec<double, 3> follows = carried<double>(s.normalized(), own.t, along_->direction<double>(x, s));
  const double off = angle_of(own.t.dot(own.d.cross(follows)), own.d.dot(follows));
  const auto [sine, cosine] = sine_cosine(off);
  at.d = at.d * cosine + at.t.cross(at.d) * sine;
  return at;
}

double Frames::spin_at(const double* q, const double* rate, double x, double x_rate) const {
  look(q);
  const int k = element_of(x);
  const auto i = static_cast<std::size_t>(k);
  return spin_within(q, rate, x) + x_rate * twist(q, k) / (x_[i + 1] - x_[i]);
}

void Frames::observe_sliding(const double* q, const double* rate, Seen& seen) const {
  for (const Sliding& sliding : sliding_) {
    const MovingFrame element = element_at(sliding, q);
    const auto energy = element.energy();
    seen.bending += energy[0];
    seen.torsion += energy[1];
    for (const FrameStrain<double>& bent : element.from_rest()) seen.add(bent);
    const MovingFrameSpin<double> spin = spin_of(sliding, q, rate);
    seen.kinetic += spin.kinetic;
    seen.momentum +=
        spin.p_a * slope<3>(q, sliding.element).normalized() + spin.p_b * slope<3>(q, sliding.element + 1).normalized();
  }
}

double Frames::add_torque_on_marks(int k, const double* q, const double* rate, double on_a, double on_b,
                                   double* force) const {
  const auto sliding = std::ranges::find(sliding_, k, &Sliding::element);
  const double tau = spin_of(*sliding, q, rate).tau;
  double power = 0;
  for (int e = 0; e < 2; ++e) {
    const int joint = sliding->joints[static_cast<std::size_t>(e)];
    if (joint < 0) continue;
    const Eigen::Index mark = joints_[static_cast<std::size_t>(joint)].mark;
    const double on_mark = -tau * (e == 0 ? on_a : on_b);
    force[mark] += on_mark;
    power += on_mark * rate[mark];
  }
  return power;
}

}  // namespace vlbeam
