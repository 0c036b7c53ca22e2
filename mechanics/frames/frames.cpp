#include "mechanics/frames/frames.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/frames/frame_element.hpp"

namespace vlbeam {
namespace {

constexpr double far_away = 0.5;  // cosine of the angle at which references follow

Eigen::Matrix3d cross_matrix(const Vec<double, 3>& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

/// s'.(dA/ds) s': what the spin's rate has of velocities.
template <class Real>
Real quadratic(const TriadReference& from, const Vec<Real, 3>& s, const Vec<Real, 3>& v) {
  using std::sqrt;
  const Vec<Real, 3> t = from.t.cast<Real>();
  const Real size = sqrt(s.dot(s)), along = t.dot(s), below = size * (size + along);
  return t.cross(s).dot(v) * (s.dot(v) * (Real(2) + along / size) + t.dot(v) * size) / (below * below);
}

/// With its gradient by s.
Active<3> active_quadratic(const TriadReference& from, const Vec<double, 3>& s, const Vec<double, 3>& rate) {
  Vec<Active<3>, 3> at;
  for (int c = 0; c < 3; ++c) at[c] = Active<3>(s[c], c);
  return quadratic<Active<3>>(from, at, rate.cast<Active<3>>());
}

}  // namespace

Frames::Frames(const FrameModel& model, const Mesh& mesh, const double* rest,
               const std::vector<SectionState>& rest_sections, const double* q,
               const std::vector<SectionState>& sections)
    : model_(model), x_(mesh.x) {
  const auto count = static_cast<std::size_t>(mesh.elements());
  const auto stands = [](const double* at, const std::vector<SectionState>& directions, int k) -> TriadReference {
    const Vec<double, 3> t = slope<3>(at, k).normalized();
    const Vec<double, 3>& d = directions[static_cast<std::size_t>(k)].direction;
    return {t, (d - t * t.dot(d)).normalized()};
  };
  for (std::size_t k = 0; k < count; ++k) {
    weights_.push_back(mesh.weights[k].w);
    tables_.emplace_back(x_[k + 1] - x_[k], mesh.weights[k].w);
  }
  for (std::size_t k = 0; k < count && rest != nullptr; ++k) {
    const int i = static_cast<int>(k);
    const TriadReference a = stands(rest, rest_sections, i), b = stands(rest, rest_sections, i + 1);
    const FrameElement<double> element(tables_[k], model_.section,
                                       frame_ends({a, position<3>(rest, i), slope<3>(rest, i), 0},
                                                  {b, position<3>(rest, i + 1), slope<3>(rest, i + 1), 0}, 0));
    for (std::size_t g = 0; g < 2; ++g) tables_[k].points[g].rest = element.strain(g, 0);
  }
  for (int k = 0; k <= mesh.last(); ++k) {
    TriadReference& from = references_.emplace_back(stands(q, sections, k));
    if (const double angle = sections[static_cast<std::size_t>(k)].angle; angle != 0) {
      const auto [sine, cosine] = sine_cosine(angle);
      from.d = from.d * cosine - from.t.cross(from.d) * sine;
    }
  }
  for (std::size_t k = 0; k < count; ++k) packs_.add(static_cast<int>(k), tables_[k]);
  for (std::size_t k = 0; k < count; ++k) {
    between_.push_back(sections[k].ahead - (sections[k + 1].angle - sections[k].angle));
  }
  for (std::size_t k = 0; k <= count && rest != nullptr; ++k) {
    const int i = static_cast<int>(k);
    const Vec<double, 3> none = Vec<double, 3>::Zero();
    rest_ends_.push_back(
        {x_[k], false, {position<3>(rest, i), slope<3>(rest, i), none, none}, stands(rest, rest_sections, i).d});
  }
  held_.assign(count + 1, false);
  nodes_.reserve(count + 1);
  turned_.resize(count);
  for (auto* work : {&spins_, &momenta_, &spin_rates_, &momentum_rates_, &diagonal_, &beside_}) work->resize(count + 1);
}

FrameNode Frames::node(const double* q, int k) const {
  return {references_[static_cast<std::size_t>(k)], position<3>(q, k), slope<3>(q, k), q[angle(k)]};
}

Frames::~Frames() = default;

bool Frames::seen(const double* q) const {
  const std::size_t moving = std::size_t{node_size<3>} * static_cast<std::size_t>(nodes());
  return looked_at_.size() > moving && std::equal(q, q + moving, looked_at_.begin()) &&
         std::equal(q + angle(0), q + angle(nodes()), looked_at_.begin() + static_cast<std::ptrdiff_t>(moving));
}

void Frames::look(const double* q) const {
  for (std::size_t j = 0; j < joints_.size(); ++j) x_[static_cast<std::size_t>(joint_nodes_[j])] = q[joints_[j].mark];
  if (seen(q)) return;
  looked_at_.assign(q, q + Eigen::Index{node_size<3>} * nodes());
  looked_at_.insert(looked_at_.end(), q + angle(0), q + angle(nodes()));
  nodes_.clear();
  for (int k = 0; k < nodes(); ++k) nodes_.push_back(node(q, k));
  for (int k = 0; k < elements(); ++k) turned_[static_cast<std::size_t>(k)] = turned(q, k);
}

template <class Visit>
void Frames::at_torques(double t, const Visit& visit) const {
  const auto at = [&](int k, double u, double torque) { visit(k, (1 - u) * torque, u * torque); };
  for (const Torques::Point& load : model_.torques.points) {
    const double x = load.x ? load.x(t) : x_[static_cast<std::size_t>(load.node)];
    const auto k = static_cast<std::size_t>(element_of(x));
    at(static_cast<int>(k), (x - x_[k]) / (x_[k + 1] - x_[k]), load.torque(t));
  }
  if (!model_.torques.line) return;
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    at(k, 0.5, model_.torques.line(t) * (x_[i + 1] - x_[i]));
  }
}

EnergyBalance Frames::add_force(const Motion<3>& motion, double* force) const {
  const double *q = motion.beam.q, *rate = motion.beam.rate;
  look(q);
  EnergyBalance power;
  if (damped()) {
    look_at_spins(rate);
    power.dissipated =
        packs_.add_damped_forces(model_.section, nodes_, turned_, rate, spins_, force, force + angle(0)) +
        add_sliding_damping(q, rate, force);
  } else {
    packs_.add_forces(model_.section, nodes_, turned_, force, force + angle(0));
  }
  add_sliding_force(q, force);
  power.loads = add_loads(motion, force);
  return power;
}

double Frames::load_power(const Motion<3>& motion, double* scratch) const {
  if (!model_.loaded()) return 0;
  look(motion.beam.q);
  return add_loads(motion, scratch);
}

double Frames::add_loads(const Motion<3>& motion, double* force) const {
  const double *q = motion.beam.q, *rate = motion.beam.rate;
  double power = add_moments(q, rate, motion.t, force);
  if (!model_.torques.present()) return power;
  const auto turn = [&](int k, double torque) {
    force[angle(k)] += torque;
    slope<3>(force, k) += torque * nodes_[static_cast<std::size_t>(k)].spin_by_slope;
    power += torque * spin_of(rate, k);
  };
  at_torques(motion.t, [&](int k, double on_a, double on_b) {
    turn(k, on_a);
    turn(k + 1, on_b);
    if (slides(k)) power += add_torque_on_marks(k, q, rate, on_a, on_b, force);
  });
  return power;
}

double Frames::add_moments(const double* q, const double* rate, double t, double* force) const {
  double power = 0;
  at_moments([&](int k, const SectionMoment& moment) {
    const auto by = moment_force<double>(moment, moment.size(t), references_[static_cast<std::size_t>(k)],
                                         slope<3>(q, k), q[angle(k)]);
    slope<3>(force, k) += by.on_slope;
    force[angle(k)] += by.on_angle;
    power += by.on_slope.dot(slope<3>(rate, k)) + by.on_angle * rate[angle(k)];
  });
  return power;
}

double Frames::spin_of(const double* rate, int k) const {
  return rate[angle(k)] + nodes_[static_cast<std::size_t>(k)].spin_by_slope.dot(slope<3>(rate, k));
}

double Frames::bent_spin_rate(const double* q, const double* rate, const double* a, int k) const {
  const auto i = static_cast<std::size_t>(k);
  const Vec<double, 3> v = slope<3>(rate, k);
  return nodes_[i].spin_by_slope.dot(slope<3>(a, k)) + quadratic<double>(references_[i], slope<3>(q, k), v);
}

void Frames::times_inertia(const std::vector<double>& x, std::vector<double>& result) const {
  std::ranges::fill(result, 0);
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    if (slides(static_cast<int>(k))) continue;
    const double share = model_.section.rhoIp * tables_[k].length / 6;
    result[k] += share * (2 * x[k] + x[k + 1]);
    result[k + 1] += share * (x[k] + 2 * x[k + 1]);
  }
}

void Frames::look_at_spins(const double* rate) const {
  for (int k = 0; k < nodes(); ++k) spins_[static_cast<std::size_t>(k)] = spin_of(rate, k);
  times_inertia(spins_, momenta_);
}

void Frames::add_inertia(const double* q, const double* rate, const double* a, double* r) const {
  if (model_.section.rhoIp == 0) return;
  look(q);
  look_at_spins(rate);
  for (int k = 0; k < nodes(); ++k) {
    spin_rates_[static_cast<std::size_t>(k)] = a[angle(k)] + bent_spin_rate(q, rate, a, k);
  }
  times_inertia(spin_rates_, momentum_rates_);
  for (int k = 0; k < nodes(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec<double, 3> s = slope<3>(q, k), v = slope<3>(rate, k);
    r[angle(k)] += momentum_rates_[i];
    slope<3>(r, k) += momentum_rates_[i] * nodes_[i].spin_by_slope + momenta_[i] * v.cross(spin_curl(s));
  }
  add_sliding_inertia(q, rate, a, r);
}

void Frames::add_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const {
  const double *q = motion.beam.q, *rate = motion.beam.rate, *a = motion.a;
  look(q);
  if (by.q != 0) packs_.add_tangents(model_.section, nodes_, turned_, by.q, tangent);
  add_sliding_tangent(motion, by, tangent);
  if (damped()) add_damping_tangent(motion, by, tangent);
  if (by.q != 0) {
    at_moments([&](int k, const SectionMoment& moment) {
      BeamMatrix<3>::WideBlock block = BeamMatrix<3>::WideBlock::Zero();
      block.bottomRightCorner<4, 4>() =
          -by.q * moment_tangent(moment, moment.size(motion.t), references_[static_cast<std::size_t>(k)],
                                 slope<3>(q, k), q[angle(k)]);
      tangent.add_turning(k, k, block);
    });
  }
  if (model_.torques.present() && by.q != 0) {
    const auto turn = [&](int k, double torque) {
      tangent.add_slope_stiffness(
          k, -by.q * torque * references_[static_cast<std::size_t>(k)].spin_by_slope_gradient<double>(slope<3>(q, k)));
    };
    at_torques(motion.t, [&](int k, double on_a, double on_b) {
      if (slides(k)) return;
      turn(k, on_a);
      turn(k + 1, on_b);
    });
  }
  if (model_.section.rhoIp == 0) return;
  // of each node: what its spin, the spin's rate and the force on its slope change by with s and phi
  struct Changes {
    Vec<double, 3> A, spin, spin_rate, gyroscopic;
    Eigen::Matrix3d own;
  };
  std::vector<Changes> changes;
  look_at_spins(rate);
  for (int k = 0; k < nodes(); ++k) {
    const TriadReference& from = references_[static_cast<std::size_t>(k)];
    const Vec<double, 3> s = slope<3>(q, k), v = slope<3>(rate, k), c = slope<3>(a, k);
    const Vec<double, 3> A = from.spin_by_slope<double>(s);
    const Eigen::Matrix3d G = from.spin_by_slope_gradient<double>(s);
    const Active<3> D = active_quadratic(from, s, v);
    const double size2 = s.squaredNorm(), size3 = size2 * std::sqrt(size2);
    const Eigen::Matrix3d curl_by = (Eigen::Matrix3d::Identity() - 3 * s * s.transpose() / size2) / size3;
    const double p = momenta_[static_cast<std::size_t>(k)];
    spin_rates_[static_cast<std::size_t>(k)] = a[angle(k)] + A.dot(c) + D.value();
    changes.push_back({A, by.q * G.transpose() * v + by.v * A,
                       by.q * (G.transpose() * c + D.derivatives()) + by.v * (G + G.transpose()) * v + by.a * A,
                       v.cross(spin_curl(s)),
                       p * (by.q * cross_matrix(v) * curl_by - by.v * cross_matrix(spin_curl(s)))});
  }
  times_inertia(spin_rates_, momentum_rates_);
  using Block = Eigen::Matrix<double, 7, 7>;
  const auto couple = [&](int row, int column, double inertia) {
    const Changes &on = changes[static_cast<std::size_t>(row)], &from = changes[static_cast<std::size_t>(column)];
    Block block = Block::Zero();
    block.block<3, 3>(3, 3) = inertia * (on.A * from.spin_rate.transpose() + on.gyroscopic * from.spin.transpose());
    block.block<3, 1>(3, 6) = inertia * (by.a * on.A + by.v * on.gyroscopic);
    block.block<1, 3>(6, 3) = inertia * from.spin_rate.transpose();
    block(6, 6) = inertia * by.a;
    tangent.add_turning(row, column, block);
  };
  for (int k = 0; k < elements(); ++k) {
    if (slides(k)) continue;
    const double share = model_.section.rhoIp * tables_[static_cast<std::size_t>(k)].length / 6;
    couple(k, k, 2 * share);
    couple(k, k + 1, share);
    couple(k + 1, k, share);
    couple(k + 1, k + 1, 2 * share);
  }
  for (int k = 0; k < nodes(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    tangent.add_slope_stiffness(
        k, changes[i].own + by.q * momentum_rates_[i] * references_[i].spin_by_slope_gradient<double>(slope<3>(q, k)));
  }
}

void Frames::start_spin_matrix() const {
  std::ranges::fill(diagonal_, 0);
  std::ranges::fill(beside_, 0);
}

void Frames::add_to_spin_matrix(std::size_t element, double share) const {
  diagonal_[element] += 2 * share;
  diagonal_[element + 1] += 2 * share;
  beside_[element] = held_[element] || held_[element + 1] ? 0 : share;
}

void Frames::factor_spin_matrix() const {
  for (std::size_t k = 1; k < diagonal_.size(); ++k) {
    diagonal_[k] -= beside_[k - 1] / diagonal_[k - 1] * beside_[k - 1];
  }
}

void Frames::solve_spins(const double* q, const double* rate, double* force) const {
  look(q);
  look_at_spins(rate);
  const std::size_t n = spins_.size();
  start_spin_matrix();
  for (std::size_t k = 0; k + 1 < n; ++k) {
    if (!slides(static_cast<int>(k))) add_to_spin_matrix(k, model_.section.rhoIp * tables_[k].length / 6);
  }
  for (std::size_t k = 0; k < n; ++k) spin_rates_[k] = force[angle(static_cast<int>(k))];
  start_sliding_spins(q, rate);
  factor_spin_matrix();
  solve_for_spins(spin_rates_);
  times_inertia(spin_rates_, momentum_rates_);
  finish_sliding_spins(force);
  for (std::size_t k = 0; k < n; ++k) {
    const int i = static_cast<int>(k);
    const Vec<double, 3> s = slope<3>(q, i), v = slope<3>(rate, i);
    slope<3>(force, i) -= momentum_rates_[k] * nodes_[k].spin_by_slope + momenta_[k] * v.cross(spin_curl(s));
    force[angle(i)] = spin_rates_[k];
  }
}

void Frames::complete(const double* q, const double* rate, double* a) const {
  for (const AtJoint& joint : joints_) {
    for (int k = 0; k < nodes(); ++k) a[angle(k)] += joint.response[static_cast<std::size_t>(k)] * a[joint.mark];
  }
  for (int k = 0; k < nodes(); ++k) a[angle(k)] -= bent_spin_rate(q, rate, a, k);
}

double Frames::turned_away(const double* q) const {
  double least = 1;
  for (int k = 0; k < nodes(); ++k) {
    const Vec<double, 3> s = slope<3>(q, k);
    least = std::min(least, references_[static_cast<std::size_t>(k)].t.dot(s) / s.norm());
  }
  return far_away - least;
}

void Frames::follow(const double* q, double* rate) {
  look(q);
  for (int k = 0; k < elements(); ++k) {
    between_[static_cast<std::size_t>(k)] = twist(q, k) - (q[angle(k + 1)] - q[angle(k)]);
  }
  for (int k = 0; k < nodes(); ++k) {
    if (rate != nullptr) rate[angle(k)] = spin_of(rate, k);
    TriadReference& from = references_[static_cast<std::size_t>(k)];
    from = from.at(slope<3>(q, k));
  }
  looked_at_.clear();
}

void Frames::exchange(Archive& memory) {
  for (TriadReference& from : references_) {
    for (double& number : from.t) memory(number);
    for (double& number : from.d) memory(number);
  }
  for (double& number : between_) memory(number);
  looked_at_.clear();
}

std::vector<SectionState> Frames::sections(const double* q, const double* rate) const {
  look(q);
  std::vector<SectionState> result;
  for (int k = 0; k < nodes(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    result.push_back(
        {nodes_[i].direction, spin_of(rate, k), k < elements() ? twist(q, k) : 0, held_[i] ? q[angle(k)] : 0});
  }
  return result;
}

Frames::Seen Frames::observe(const double* q, const double* rate) const {
  Seen seen;
  look(q);
  look_at_spins(rate);
  for (int k = 0; k < nodes(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    seen.kinetic += 0.5 * momenta_[i] * spins_[i];
    seen.momentum += momenta_[i] * slope<3>(q, k).normalized();
  }
  observe_sliding(q, rate, seen);
  for (int k = 0; k < elements(); ++k) {
    if (slides(k)) continue;
    const auto i = static_cast<std::size_t>(k);
    const FrameElement<double> element(tables_[i], model_.section, frame_ends(nodes_[i], nodes_[i + 1], turned(q, k)));
    const double inner = element.inner();
    const auto energy = element.energy(inner);
    seen.bending += energy[0];
    seen.torsion += energy[1];
    for (std::size_t g = 0; g < 2; ++g) seen.add(element.from_rest(g, inner));
  }
  return seen;
}

std::vector<std::array<FrameStrain<double>, 2>> Frames::moments(const double* q) const {
  look(q);
  std::vector<std::array<FrameStrain<double>, 2>> all(static_cast<std::size_t>(elements()));
  for (int k = 0; k < elements(); ++k) {
    if (slides(k)) continue;
    const auto i = static_cast<std::size_t>(k);
    const FrameElement<double> element(tables_[i], model_.section, frame_ends(nodes_[i], nodes_[i + 1], turned(q, k)));
    const double inner = element.inner();
    all[i] = {element.from_rest(0, inner), element.from_rest(1, inner)};
  }
  for (const Sliding& sliding : sliding_) {
    all[static_cast<std::size_t>(sliding.element)] = element_at(sliding, q).from_rest();
  }
  const FrameSection& section = model_.section;
  for (auto& element : all) {
    for (auto& [y, z, torsion] : element) {
      y *= section.EI_y;
      z *= section.EI_z;
      torsion *= section.GIp;
    }
  }
  return all;
}

}  // namespace vlbeam
