#include "mechanics/spin/spin_chain.hpp"

#include "core/element/moving_tangent.hpp"
#include "core/element/twist_law.hpp"

namespace vlbeam {
namespace {

SpinCoordinates<double> angles_of(const SpinChain::Coordinates& q) { return {q.e.r_a[0], q.e.r_b[0], q.x_a, q.x_b}; }

Vec<double, 1> one(double value) { return Vec<double, 1>::Constant(value); }

}  // namespace

SpinChain::SpinChain(const SpinSection& section, AngleField field, Formulation formulation, int elements,
                     int quadrature_points, const std::vector<int>& driven)
    : section_(section),
      field_(field),
      table_(beam_rule(quadrature_points), unit_weights),
      elements_(static_cast<std::size_t>(elements)),
      guiding_(elements_.size()),
      work_(2 * (elements_.size() + 1)) {
  law_.section = {.rhoA = section.rhoIp, .stiffness = {section.GIp, 0}, .damping = section.damping};
  law_.formulation = formulation;
  const auto twist = ChainMass<1>::Components::Constant(field == AngleField::linear ? 0 : 1);
  free_.assign(elements_.size() + 1, {ChainMass<1>::Components::Ones(), twist});
  for (const int node : driven) free_[static_cast<std::size_t>(node)][0].setZero();
}

SpinChain::Coordinates SpinChain::local(const double* values, const Nodes& nodes, double Prescribed::*x, int k) const {
  const auto i = static_cast<std::size_t>(k);
  const double x_a = nodes[i].*x, x_b = nodes[i + 1].*x;
  if (field_ == AngleField::linear) return {{one(values[k]), one(0), one(values[k + 1]), one(0)}, x_a, x_b};
  return {element_nodes<1>(values, k), x_a, x_b};
}

void SpinChain::scatter(int k, const std::array<double, 4>& entries, double* values) const {
  if (field_ == AngleField::linear) {
    values[k] += entries[0];
    values[k + 1] += entries[2];
  } else {
    for (int i = 0; i < 4; ++i) values[2 * k + i] += entries[static_cast<std::size_t>(i)];
  }
}

SpinChain::Equations SpinChain::equations(const Coordinates& q, const Coordinates& rate) const {
  if (field_ == AngleField::hermite) {
    return moving_equations<double, 1>(q, rate, {}, table_, law_);
  }
  return spin_equations(angles_of(q), angles_of(rate), law_.formulation, section_);
}

void SpinChain::evaluate(const double* q, const double* rate, const Nodes& nodes) {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const int i = static_cast<int>(k);
    elements_[k] = equations(local(q, nodes, &Prescribed::value, i), local(rate, nodes, &Prescribed::rate, i));
  }
}

void SpinChain::add_residual(const double* a, const Nodes& nodes, double* r) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const int i = static_cast<int>(k);
    const auto part = nodal_residual(elements_[k], local(a, nodes, &Prescribed::acceleration, i));
    scatter(i, {part[0][0], part[1][0], part[2][0], part[3][0]}, r);
  }
}

double SpinChain::residual(const double* q, const double* rate, const double* a, const Nodes& nodes, double* r) {
  double lost = 0;
  for (std::size_t k = 0; k < guiding_.size(); ++k) {
    const int i = static_cast<int>(k);
    const Coordinates at = local(q, nodes, &Prescribed::value, i), rates = local(rate, nodes, &Prescribed::rate, i),
                      accelerations = local(a, nodes, &Prescribed::acceleration, i);
    std::array<Vec<double, 1>, 4> rows;
    if (field_ == AngleField::hermite) {
      const auto of =
          moving_residual<MovingEnds::both, double, 1>(at, rates, accelerations, WeightFunction{}, table_, law_, &lost);
      rows = of.nodes;
      guiding_[k] = of.ends;
    } else {
      const Equations of = equations(at, rates);
      rows = nodal_residual(of, accelerations);
      guiding_[k] = vlbeam::guiding_forces(of, accelerations);
      lost += of.dissipation;
    }
    scatter(i, {rows[0][0], rows[1][0], rows[2][0], rows[3][0]}, r);
  }
  return lost;
}

void SpinChain::add_inertia(const double* a, const Nodes& nodes, double* r) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const int i = static_cast<int>(k);
    const Coordinates at = local(a, nodes, &Prescribed::value, i);  // angles and their rates do not count
    const Equations of = field_ == AngleField::hermite
                             ? MovingElement<double, 1, MovingEnds::both>::masses(at, WeightFunction{}, table_, law_)
                             : equations(at, at);
    const auto rows = nodal_inertia(of, at.e);
    scatter(i, {rows[0][0], rows[1][0], rows[2][0], rows[3][0]}, r);
  }
}

bool SpinChain::solve(double* f) {
  mass_.reset(nodes());
  for (std::size_t k = 0; k < elements_.size(); ++k) mass_.add(static_cast<int>(k), elements_[k].mass);
  if (!mass_.factor(free_)) return false;
  solve_again(f);
  return true;
}

void SpinChain::solve_again(double* f) {
  if (field_ == AngleField::hermite) {
    mass_.solve(f);
    return;
  }
  for (int k = 0; k < nodes(); ++k) work_[2 * static_cast<std::size_t>(k)] = f[k];
  mass_.solve(work_.data());
  for (int k = 0; k < nodes(); ++k) f[k] = work_[2 * static_cast<std::size_t>(k)];
}

double SpinChain::dissipation() const {
  double power = 0;
  for (const Equations& element : elements_) power += element.dissipation;
  return power;
}

/// The angles enter linearly: the residual of unit ones is the tangent.
Eigen::Matrix4d SpinChain::tangent(const Nodes& nodes, const TangentWeights& by, int k) const {
  const auto k0 = static_cast<std::size_t>(k);
  auto unit = [&](int i, double size, double Prescribed::*x) -> Coordinates {
    auto entry = [&](int j) { return one(i == j ? size : 0); };
    return {{entry(0), entry(1), entry(2), entry(3)}, nodes[k0].*x, nodes[k0 + 1].*x};
  };
  Eigen::Matrix4d tangent;
  for (int j = 0; j < 4; ++j) {
    const auto r = nodal_residual(equations(unit(j, by.q, &Prescribed::value), unit(j, by.v, &Prescribed::rate)),
                                  unit(j, by.a, &Prescribed::acceleration));
    for (int i = 0; i < 4; ++i) tangent(i, j) = r[static_cast<std::size_t>(i)][0];
  }
  return tangent;
}

SpinChain::Point SpinChain::at(const Coordinates& q, const Coordinates& rate, double u) const {
  if (field_ == AngleField::linear) {
    const SpinMotion<double> motion(angles_of(q), angles_of(rate));
    const double per_length = 1 / (q.x_b - q.x_a);
    return {{1 - u, 0, u, 0},
            -motion.tau * (1 - u),
            -motion.tau * u,
            motion.tau,
            motion.omega_a * (1 - u) + motion.omega_b * u,
            q.e.r_a[0] * (1 - u) + q.e.r_b[0] * u,
            motion.tau_rate,
            0,
            {-per_length, 0, per_length, 0}};
  }
  const MovingKinematics<double, 1> kinematics(q, rate, WeightTransport::frozen, {});
  const PointMotion<double, 1> point = kinematics.at(u, hermite_shape(u));
  return {point.s,    point.y_a[0], point.y_b[0],  point.r_x[0], point.v[0],
          point.r[0], point.v_x[0], point.r_xx[0], point.s_x};
}

void SpinTangent::assemble(const SpinChain& chain, const SpinChain::Nodes& nodes, const TangentWeights& by) {
  twists_ = chain.per_node() == 2;
  band.reset(chain.nodes());
  work_.assign(2 * band.diagonal.size(), 0.0);
  for (int k = 0; k + 1 < chain.nodes(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Eigen::Matrix4d angles = chain.tangent(nodes, by, k);
    band.diagonal[i] += angles.topLeftCorner<2, 2>();
    band.upper[i] += angles.topRightCorner<2, 2>();
    band.lower[i + 1] += angles.bottomLeftCorner<2, 2>();
    band.diagonal[i + 1] += angles.bottomRightCorner<2, 2>();
  }
}

bool SpinTangent::factor(const SpinChain& chain, double by_a) {
  for (int node = 0; node < chain.nodes(); ++node) {
    if (!chain.driven(node)) continue;
    const auto k = static_cast<std::size_t>(node);
    for (auto* block : {&band.diagonal[k], &band.upper[k], &band.lower[k]}) block->row(0).setZero();
    band.diagonal[k](0, 0) = by_a == 0 ? 1 : by_a;
  }
  if (!twists_) {
    for (auto& block : band.diagonal) block(1, 1) = 1;  // no twist is a coordinate
  }
  return band.factor();
}

void SpinTangent::solve(double* angles) const {
  if (twists_) {
    band.solve(angles);
    return;
  }
  const std::size_t nodes = work_.size() / 2;
  for (std::size_t k = 0; k < nodes; ++k) {
    work_[2 * k] = angles[k];
    work_[2 * k + 1] = 0;
  }
  band.solve(work_.data());
  for (std::size_t k = 0; k < nodes; ++k) angles[k] = work_[2 * k];
}

}  // namespace vlbeam
