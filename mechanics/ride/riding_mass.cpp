#include "mechanics/ride/riding_mass.hpp"

namespace vlbeam {

template <int D>
RidingMass<D>::RidingMass(const CurrentBeam<D>& beam, const typename ChainState<D>::Loose& rider)
    : beam_(beam),
      element_(rider.element),
      held_(rider.held),
      end_(rider.element > 0 ? beam.mesh().x.back() : beam.mesh().x.front()),
      mass_(beam.left(), beam.right(), beam.mesh().last() + 1, rider.element) {
  const auto k = static_cast<std::size_t>(element_);
  const Mesh& mesh = beam.mesh();
  curve_ = {mesh.x[k], mesh.x[k + 1] - mesh.x[k], mesh.weights[k].w};
}

template <int D>
RiderMotion<double, D> RidingMass<D>::motion(const double* q, const double* rate) const {
  return rider_motion<double, D>(curve_, nodes(q), nodes(rate), held_ ? end_ : q[x()], held_ ? 0 : rate[x()]);
}

template <int D>
Vec<double, D> RidingMass<D>::acceleration(const double* q, const double* rate, const double* a) const {
  const auto at = motion(q, rate);
  return combine_nodes<double, D>(at.s, nodes(a)) + at.r_x * a[x()] + at.remainder;
}

template <int D>
double RidingMass<D>::add_residual(const Motion<D>& now, double* r) const {
  const auto part =
      rider_residual<double, D>(motion(now.beam.q, now.beam.rate), nodes(now.a), now.a[x()], law(), now.gravity, held_);
  position<D>(r, element_) += part.nodes[0];
  slope<D>(r, element_) += part.nodes[1];
  position<D>(r, element_ + 1) += part.nodes[2];
  slope<D>(r, element_ + 1) += part.nodes[3];
  r[x()] = part.x;
  return part.dissipation;
}

template <int D>
void RidingMass<D>::add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  tangent.add_border(element_);
  tangent.add_element(
      now.beam, element_,
      rider_tangent<D>(motion(now.beam.q, now.beam.rate), nodes(now.a), now.a[x()], law(), now.gravity, held_, by),
      {0, -1});
}

template <int D>
auto RidingMass<D>::accelerate(const double* q, const double* rate, const Vector& gravity, double* a) const
    -> std::optional<Answer> {
  const auto at = motion(q, rate);
  const auto solved = solve_with_rider<D>(mass_, law(), at, nodes(a), at.remainder - gravity, 0, held_, true, a);
  if (!solved) return std::nullopt;
  a[x()] = solved->x;
  return Answer{solved->force, at.s, element_, solved->dissipation, solved->contact};
}

template <int D>
bool RidingMass<D>::solve(const double* q, double* p) const {
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(beam_.coordinates());
  const auto solved =
      solve_with_rider<D>(mass_, law(), motion(q, at_rest.data()), nodes(p), Vector::Zero(), p[x()], held_, false, p);
  if (solved) p[x()] = solved->x;
  return solved.has_value();
}

template <int D>
void RidingMass<D>::add_momentum(const double* q, const double* rate, const Vector& v, double* out) const {
  const auto at = motion(q, rate);
  const Vector momentum = law().mass * v;
  position<D>(out, element_) += at.s[0] * momentum;
  slope<D>(out, element_) += at.s[1] * momentum;
  position<D>(out, element_ + 1) += at.s[2] * momentum;
  slope<D>(out, element_ + 1) += at.s[3] * momentum;
  if (!held_) out[x()] += at.r_x.dot(momentum);
}

template class RidingMass<2>;
template class RidingMass<3>;

}  // namespace vlbeam
