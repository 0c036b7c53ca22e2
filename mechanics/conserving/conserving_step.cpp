#include "mechanics/conserving/conserving_step.hpp"

#include "mechanics/conserving/discrete_gradient.hpp"
#include "mechanics/ride/rider_step.hpp"
#include "mechanics/ride/riding_mass.hpp"

namespace vlbeam {
namespace {

template <int D>
NodalCubic<double, D> mean(const NodalCubic<double, D>& a, const NodalCubic<double, D>& b) {
  return {(a.r_a + b.r_a) / 2, (a.s_a + b.s_a) / 2, (a.r_b + b.r_b) / 2, (a.s_b + b.s_b) / 2};
}

}  // namespace

template <int D>
void ConservingStep<D>::refresh() {
  if (revision_ == beam_.revision()) return;
  revision_ = beam_.revision();
  const auto& mesh = beam_.mesh();
  const int joint = beam_.has_joint() ? beam_.places().front().node : -2;
  fixed_.clear();
  for (int k = 0; k < mesh.elements(); ++k) {
    if (k == joint || k + 1 == joint) continue;
    const auto i = static_cast<std::size_t>(k);
    const double l = mesh.x[i + 1] - mesh.x[i];
    const Weights<double>& w = mesh.weights[i].w;
    const BeamRule& rule = beam_.rules().of(w);
    fixed_.push_back({k, fixed_basis(l, w, rule), fixed_inertia(l, w, rule)});
  }
}

template <int D>
double ConservingStep<D>::residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                                   const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) {
  refresh();
  const auto& model = beam_.model();
  const auto& mesh = beam_.mesh();
  const MovingLaw<D> law = beam_.moving_law(t + h / 2);
  const double rhoA = model.section.rhoA;
  double dissipation = 0;
  r.setZero();
  double* out = r.data();

  for (const auto& element : fixed_) {
    const int k = element.index;
    const auto e_rate0 = element_nodes<D>(v0.data(), k), e_rate1 = element_nodes<D>(v1.data(), k);
    const auto force =
        mean_fixed_force<D>(element.basis, {element_nodes<D>(q0.data(), k), element_nodes<D>(q1.data(), k)},
                            mean(e_rate0, e_rate1), model.section);
    dissipation += force.dissipation;
    const Vec<double, D> a_r = (e_rate1.r_a - e_rate0.r_a) / h, a_s = (e_rate1.s_a - e_rate0.s_a) / h,
                         b_r = (e_rate1.r_b - e_rate0.r_b) / h, b_s = (e_rate1.s_b - e_rate0.s_b) / h;
    auto inertia = [&](std::size_t i) -> Vec<double, D> {
      const auto& m = element.inertia.mass[i];
      return (a_r * m[0] + a_s * m[1] + b_r * m[2] + b_s * m[3] - law.gravity * element.inertia.load[i]) * rhoA;
    };
    position<D>(out, k) += inertia(0) + force.r_b;
    slope<D>(out, k) += inertia(1) - force.s_a;
    position<D>(out, k + 1) += inertia(2) - force.r_b;
    slope<D>(out, k + 1) += inertia(3) - force.s_b;
  }

  const Eigen::Index extra = node_size<D> * Eigen::Index{mesh.last() + 1};
  if (beam_.has_joint()) {
    const int j = beam_.places().front().node;
    auto coordinates = [&](const Eigen::VectorXd& c, int k, double left, double right) {
      return MovingCoordinates<double, D>{element_nodes<D>(c.data(), k), left, right};
    };
    auto add = [&](int k, const MovingForce<D>& part) {
      position<D>(out, k) += part.nodes[0];
      slope<D>(out, k) += part.nodes[1];
      position<D>(out, k + 1) += part.nodes[2];
      slope<D>(out, k + 1) += part.nodes[3];
      r[extra] += part.end;
      dissipation += part.dissipation;
    };
    const auto ju = static_cast<std::size_t>(j);
    const double start = mesh.x[ju - 1], end = mesh.x[ju + 1];
    add(j - 1, conserving_residual<MovingEnds::b, D>(
                   {coordinates(q0, j - 1, start, q0[extra]), coordinates(q1, j - 1, start, q1[extra])},
                   {coordinates(v0, j - 1, 0, v0[extra]), coordinates(v1, j - 1, 0, v1[extra])}, h,
                   mesh.weights[ju - 1], beam_.moving_parts()[0].table, law));
    add(j,
        conserving_residual<MovingEnds::a, D>({coordinates(q0, j, q0[extra], end), coordinates(q1, j, q1[extra], end)},
                                              {coordinates(v0, j, v0[extra], 0), coordinates(v1, j, v1[extra], 0)}, h,
                                              mesh.weights[ju], beam_.moving_parts()[1].table, law));
    position<D>(out, j) +=
        beam_.joint(0).law.mass * ((position<D>(v1.data(), j) - position<D>(v0.data(), j)) / h - law.gravity);
  } else if (const auto* rider = rider_of(beam_)) {
    const int k = rider->element();
    const auto part =
        conserving_rider<D>(rider->curve(), {element_nodes<D>(q0.data(), k), element_nodes<D>(q1.data(), k)},
                            {element_nodes<D>(v0.data(), k), element_nodes<D>(v1.data(), k)}, {q0[extra], q1[extra]},
                            {v0[extra], v1[extra]}, h, model.joints.front().law.mass, law.gravity, rider->held());
    position<D>(out, k) += part.nodes[0];
    slope<D>(out, k) += part.nodes[1];
    position<D>(out, k + 1) += part.nodes[2];
    slope<D>(out, k + 1) += part.nodes[3];
    r[extra] = part.x;
  } else if (!beam_.free_masses().empty()) {
    r.segment<D>(extra) =
        model.joints.front().law.mass * ((v1.segment<D>(extra) - v0.segment<D>(extra)) / h - law.gravity);
  }
  beam_.supports().project(out);
  return dissipation;
}

template class ConservingStep<2>;
template class ConservingStep<3>;

}  // namespace vlbeam
