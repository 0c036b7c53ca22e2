#include "core/scene/build.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vlbeam {
namespace {

// Points beyond which the error of the mesh hides that of the rule (studies/falling_beam, convergence in points).
constexpr int polynomial_points = 5;
constexpr int rational_points = 10;
constexpr double separation_share = 1e-3;  // of the beam's length

bool is_polynomial(ElementKind kind) { return kind == ElementKind::ale_ancf || kind == ElementKind::ancf; }

template <int D>
Vec<double, D> vector_of(const Point& point) {
  return Eigen::Map<const Vec<double, D>>(point.data());
}

BeamSection build_section(const BeamSpec& beam) {
  BeamSection section;
  if (beam.section.type == Section::Type::circle) {
    const double r2 = beam.section.radius * beam.section.radius;
    const double area = std::numbers::pi * r2;
    section.rhoA = beam.material.density * area;
    section.stiffness = {beam.material.youngs_modulus * area, beam.material.youngs_modulus * area * r2 / 4};
  } else {
    section.rhoA = beam.section.rhoA;
    section.stiffness = {beam.section.EA, beam.section.EI};
  }
  section.damping = beam.material.damping;
  section.curvature_regularization = beam.material.curvature_regularization;
  return section;
}

template <int D>
Support<D> build_support(const SupportSpec& spec, const Vec<double, D>& tangent) {
  switch (spec.type) {
    case SupportType::clamp:
      return spec.clamp == ClampType::full ? Support<D>::clamp() : Support<D>::direction_clamp(tangent);
    case SupportType::pin:
      return Support<D>::pin();
    case SupportType::free:
      break;
  }
  return Support<D>::free_end();
}

template <int D>
Vec<double, D> tangent_of(const Scene& scene) {
  return (vector_of<D>(scene.beam.curve.end) - vector_of<D>(scene.beam.curve.start)) / beam_length(scene);
}

}  // namespace

int quadrature_points(const Scene& scene) {
  if (scene.beam.quadrature_points > 0) return scene.beam.quadrature_points;
  return is_polynomial(scene.beam.element) ? polynomial_points : rational_points;
}

double beam_length(const Scene& scene) {
  return (vector_of<3>(scene.beam.curve.end) - vector_of<3>(scene.beam.curve.start)).norm();
}

double standard_length(const Scene& scene) { return beam_length(scene) / scene.beam.elements; }

double separation_distance(const Scene& scene) {
  return scene.sliding_mass->separation_distance.value_or(separation_share * beam_length(scene));
}

template <int D>
BeamModel<D> build_model(const Scene& scene) {
  BeamModel<D> model;
  model.section = build_section(scene.beam);
  model.strain_law = scene.beam.strain_law;
  model.formulation = scene.formulation;
  model.transport = scene.weights;
  model.quadrature_points = quadrature_points(scene);
  model.gravity = vector_of<D>(scene.gravity);
  model.gravity_ramp = scene.gravity_ramp;
  const Vec<double, D> tangent = tangent_of<D>(scene);
  model.start = build_support<D>(scene.start, tangent);
  model.end = build_support<D>(scene.end, tangent);
  model.start_releases = scene.start.type == SupportType::free;
  model.end_releases = scene.end.type == SupportType::free;
  if (scene.sliding_mass) {
    model.joint = SlidingJoint{scene.sliding_mass->mass, scene.sliding_mass->slopes, scene.sliding_mass->friction};
    model.separation_distance = separation_distance(scene);
  }
  model.constraints = scene.constraints;
  const auto& control = scene.length_control;
  model.length_control = {control.enabled,
                          standard_length(scene),
                          control.upper,
                          control.hysteresis,
                          is_polynomial(scene.beam.element) ? MergePolicy::unit : control.merge,
                          control.velocities};
  return model;
}

template <int D>
ChainState<D> build_chain(const Scene& scene) {
  const int n = scene.beam.elements;
  const double length = beam_length(scene);
  const Vec<double, D> start = vector_of<D>(scene.beam.curve.start), tangent = tangent_of<D>(scene);
  ChainState<D> chain;
  for (int k = 0; k <= n; ++k) chain.mesh.x.push_back(length * k / n);
  if (scene.sliding_mass) {  // the nearest interior node of the uniform mesh moves to the joint
    const double x = scene.sliding_mass->position;
    chain.joint = std::clamp(static_cast<int>(std::lround(x / length * n)), 1, n - 1);
    chain.mesh.x[static_cast<std::size_t>(chain.joint)] = x;
    chain.joint_rate = scene.sliding_mass->velocity;
    if (scene.sliding_mass->slopes != JointSlopes::continuous) chain.kink = {tangent, Vec<double, D>::Zero()};
  }
  for (int k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    chain.mesh.weights.push_back({scene.beam.weights, chain.mesh.x[i], chain.mesh.x[i + 1]});
  }
  chain.q.resize(static_cast<std::size_t>(node_size<D>) * (static_cast<std::size_t>(n) + 1));
  chain.rate.assign(chain.q.size(), 0);
  for (int k = 0; k <= n; ++k) {
    position<D>(chain.q.data(), k) = start + chain.mesh.x[static_cast<std::size_t>(k)] * tangent;
    slope<D>(chain.q.data(), k) = tangent;
  }
  // the beam is at rest, so the moving node travels along it
  if (scene.sliding_mass) position<D>(chain.rate.data(), chain.joint) = chain.joint_rate * tangent;
  return chain;
}

template BeamModel<2> build_model(const Scene&);
template BeamModel<3> build_model(const Scene&);
template ChainState<2> build_chain(const Scene&);
template ChainState<3> build_chain(const Scene&);

}  // namespace vlbeam
