#include "mechanics/motion/system/equations.hpp"

#include "core/element/moving_tangent.hpp"
#include "core/pieces.hpp"
#include "mechanics/motion/system/joint_friction.hpp"

namespace vlbeam {

template <int D>
double Equations<D>::residual(const ConstVector& q, const ConstVector& v, const ConstVector& a, double t,
                              Eigen::VectorXd& r, Extent extent) const {
  const Motion<D> now = beam_.motion(q.data(), v.data(), a.data(), t);
  const int most = extent == Extent::ends ? 1 : Span<D>::all;
  const Vec<double, D> on_beam = beam_.beam_gravity(t);
  in_pieces(r.size(), 1, [&r](Eigen::Index first, Eigen::Index n) { r.segment(first, n).setZero(); });
  double lost = 0;
  if (!beam_.acting().empty()) {
    for (const auto& part : beam_.acting()) lost += part->add_force(now, r.data()).dissipated;
    in_pieces(r.size(), 1, [&r](Eigen::Index first, Eigen::Index n) { r.segment(first, n) = -r.segment(first, n); });
  }
  at_spans(
      [&](const Span<D>& span) { lost += span.add_residual(q.data(), v.data(), a.data(), on_beam, r.data(), most); });
  const PointMasses<D>& masses = beam_.model().masses;
  if (masses.present()) masses.add_residual(now.beam, a.data(), now.gravity, r.data());
  if (auto* unknowns = beam_.unknowns()) lost += unknowns->residual(q.data(), v.data(), a.data(), t, r.data());
  if (of_mesh_) {
    lost += of_mesh_->add_residual(q.data(), v.data(), a.data(), t, r.data());
  } else if (beam_.has_joint()) {
    add_joints(now, r, lost);
  } else if (beam_.loose() != nullptr) {
    lost += beam_.loose()->add_residual(now, r.data());
  }
  for (std::size_t i = 0; i < beam_.free_masses().size(); ++i) {
    const Eigen::Index at = beam_.dofs().free_mass(static_cast<int>(i));
    const double mass = beam_.model().joints[static_cast<std::size_t>(beam_.free_masses()[i])].law.mass;
    r.segment<D>(at) = mass * (a.segment<D>(at) - now.gravity);
  }
  return lost;
}

template <int D>
template <class Function>
void Equations<D>::at_moving_parts(const Motion<D>& now, const Function& function) const {
  MovingLaw<D> law = beam_.moving_law(now.t);
  for (const MovingPart& part : beam_.moving_parts()) {
    const auto rest = beam_.rest_of(part, now.beam.q);
    law.rest = rest ? &*rest : nullptr;
    switch (part.ends) {
      case MovingEnds::a:
        function.template operator()<MovingEnds::a>(part, law);
        break;
      case MovingEnds::b:
        function.template operator()<MovingEnds::b>(part, law);
        break;
      case MovingEnds::both:
        function.template operator()<MovingEnds::both>(part, law);
        break;
    }
  }
}

/// Elements at joints, joint by joint what slides there, and its friction.
template <int D>
void Equations<D>::add_joints(const Motion<D>& now, Eigen::VectorXd& r, double& lost) const {
  const ChainView<D>&beam = now.beam, accelerations = beam_.view(beam.q, now.a);
  const auto& places = beam_.places();
  at_moving_parts(now, [&]<MovingEnds Ends>(const MovingPart& part, const MovingLaw<D>& law) {
    const int k = part.element;
    const auto of = moving_residual<Ends, double, D>(beam.coordinates(k), beam.rates(k), accelerations.rates(k),
                                                     beam.weights(k), part.table, law, &lost);
    for (int i = 0; i < 4; ++i) {
      Eigen::Map<Vec<double, D>>(r.data() + beam.vector(k, i)) += of.nodes[static_cast<std::size_t>(i)];
    }
    for (int e = 0; e < moving_ends<Ends>; ++e) {
      const int joint = is_end_a<Ends>(e) ? part.a : part.b;
      r[places[static_cast<std::size_t>(joint)].mark] += of.ends[static_cast<std::size_t>(e)];
    }
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SlidingJoint& joint = beam_.joint(i).law;
    auto lacking = position<D>(r.data(), places[i].node);
    const Vec<double, D> inertia = joint.mass * (position<D>(now.a, places[i].node) - now.gravity);
    const Vec<double, D> pull = beam_.held(i) == nullptr ? inertia : Vec<double, D>(-lacking);
    lacking += inertia;
    r[places[i].mark] +=
        beam_.turning_inertia(i, beam.q) * now.a[places[i].mark] + beam_.turning_lag(i, beam.q, beam.rate);
    if (!joint.friction) continue;
    const auto friction = friction_at<D>(joint, places[i], pull, beam.q, beam.rate);
    r[places[i].mark] -= friction.force;
    lost += friction.dissipation;
  }
}

template <int D>
void Equations<D>::assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                            const TangentWeights& by, BeamMatrix<D>& tangent) {
  const Motion<D> now = beam_.motion(q.data(), v.data(), a.data(), t);
  tangent.start(beam_.dofs().nodes, beam_.places());
  if constexpr (D == 3) {
    if (beam_.unknowns() != nullptr && beam_.unknowns()->of_nodes()) tangent.add_angles();
  }
  if (of_mesh_) {
    of_mesh_->add_tangent(now, by, tangent);
  } else {
    add_elements(now, by, tangent);
  }
  for (const auto& part : beam_.acting()) part->add_tangent(now, by, tangent);
  if (!beam_.model().rubs()) return;
  const auto& places = beam_.places();
  bool held = false;
  for (std::size_t i = 0; i < places.size(); ++i) held = held || beam_.held(i) != nullptr;
  if (held) {
    lacking_.resize(q.size());
    residual(q, v, a, t, lacking_);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SlidingJoint& joint = beam_.joint(i).law;
    if (!joint.friction) continue;
    Vec<double, D> pull = joint.mass * (position<D>(a.data(), places[i].node) - now.gravity);
    const bool holds = beam_.held(i) != nullptr;
    if (holds) pull -= position<D>(lacking_.data(), places[i].node);
    add_friction_tangent<D>(joint, places[i], pull, holds, q.data(), v.data(), by, tangent);
  }
}

/// Elements, those at joints among them, and what slides there.
template <int D>
void Equations<D>::add_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  const auto& joints = beam_.model().joints;
  const ChainView<D>&beam = now.beam, accelerations = beam_.view(beam.q, now.a);
  auto *diagonal = tangent.diagonal.data(), *upper = tangent.upper.data(), *lower = tangent.lower.data();
  at_spans([&](const Span<D>& span) { span.add_tangent(beam.q, beam.rate, by, diagonal, upper, lower); });
  at_moving_parts(now, [&]<MovingEnds Ends>(const MovingPart& part, const MovingLaw<D>& law) {
    const std::array<int, 2> marks = Ends == MovingEnds::a   ? std::array{part.a, -1}
                                     : Ends == MovingEnds::b ? std::array{part.b, -1}
                                                             : std::array{part.a, part.b};
    const int k = part.element;
    tangent.add_element(beam, k,
                        moving_tangent<Ends, D>(beam.coordinates(k), beam.rates(k), accelerations.rates(k), by,
                                                beam.weights(k), part.table, law),
                        marks);
  });
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    const SlidingJoint& joint = beam_.joint(i).law;
    tangent.add_mass(beam_.places()[i].node, by.a * joint.mass);
    if (joint.turning.present()) add_turning(i, now, by, tangent);
  }
  if (beam_.loose() != nullptr) beam_.loose()->add_tangent(now, by, tangent);
  for (const int index : beam_.free_masses()) {
    for (int c = 0; c < D; ++c) {
      tangent.add_border(0);
      const int last = tangent.borders() - 1;
      tangent.corner(last, last) = by.a * joints[static_cast<std::size_t>(index)].law.mass;
    }
  }
}

/// What the beam turns at a joint.
template <int D>
void Equations<D>::add_turning(std::size_t which, const Motion<D>& now, const TangentWeights& by,
                               BeamMatrix<D>& tangent) const {
  const Turning& turning = beam_.joint(which).law.turning;
  const JointPlace& place = beam_.places()[which];
  const double x = now.beam.q[place.mark], rate = now.beam.rate[place.mark], a = now.a[place.mark], m = turning.at(x);
  const Vec<double, D> s = slope<D>(now.beam.q, place.node), s_rate = slope<D>(now.beam.rate, place.node);
  double& own = tangent.entry(place.mark, place.mark);
  own += by.a * turning.against<D>(x, s);
  if (!turning.stretched) {
    own += by.q * turning.by_length * a;
    return;
  }
  own += by.v * m * s.dot(s_rate) + by.q * turning.by_length * (s.squaredNorm() * a + s.dot(s_rate) * rate);
  for (int c = 0; c < D; ++c) {
    tangent.entry(place.mark, Eigen::Index{node_size<D>} * place.node + D + c) +=
        m * (by.q * (2 * s[c] * a + s_rate[c] * rate) + by.v * s[c] * rate);
  }
}

template class Equations<2>;
template class Equations<3>;

}  // namespace vlbeam
