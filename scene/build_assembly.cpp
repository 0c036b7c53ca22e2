#include "scene/build_assembly.hpp"

#include <algorithm>

#include "scene/across.hpp"
#include "scene/build.hpp"
#include "scene/on_elements.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

/// The node of a beam that a link takes hold of at t = 0.
int node_of(const Scene& scene, const LinkEndSpec& end) {
  switch (end.of) {
    case LinkEndSpec::Of::beam_start:
      return 0;
    case LinkEndSpec::Of::node:
      return end.joint;
    case LinkEndSpec::Of::joint:
      return place_nodes(scene, build_axis<3>(scene).breaks()).joints[static_cast<std::size_t>(end.joint)];
    default:
      return scene.beam.elements;
  }
}

/// Position and slope there.
template <int D>
std::array<Point, 2> node_in(const Scene& scene, const LinkEndSpec& end) {
  const ChainState<D> chain = build_shape<D>(scene);
  const int node = node_of(scene, end);
  std::array<Point, 2> there{};
  const auto r = position<D>(chain.q.data(), node), s = slope<D>(chain.q.data(), node);
  std::copy_n(r.data(), D, there[0].begin());
  std::copy_n(s.data(), D, there[1].begin());
  return there;
}

/// Of a beam of the whole, whose nodes are numbered in proportion where a companion has fewer of them.
LinkEndSpec now(const Scene& whole, LinkEndSpec end) {
  if (end.of != LinkEndSpec::Of::node) return end;
  const int drawn = whole.assembly->beams[end.which].scene.beam.elements;
  end.joint = renumbered(end.joint, drawn, elements_of(whole, end.which), "/links/between");
  return end;
}

std::array<Point, 2> node_of_whole(const Scene& whole, const LinkEndSpec& end) {
  const Scene scene = beam_scene(whole, end.which);
  const LinkEndSpec here = now(whole, end);
  return scene.dimension == 2 ? node_in<2>(scene, here) : node_in<3>(scene, here);
}

template <int D>
LinkEnd<D> build_end(const Scene& whole, const LinkEndSpec& spec) {
  using Of = typename LinkEnd<D>::Of;
  LinkEnd<D> end;
  end.place = vector_of<D>(spec.place);
  switch (spec.of) {
    case LinkEndSpec::Of::beam_start:
      end.of = Of::beam_start;
      break;
    case LinkEndSpec::Of::beam_end:
      end.of = Of::beam_end;
      break;
    case LinkEndSpec::Of::node:
      end.of = Of::node;
      break;
    case LinkEndSpec::Of::joint:
      end.of = Of::joint;
      break;
    case LinkEndSpec::Of::body:
      end.of = Of::body;
      break;
    case LinkEndSpec::Of::ground:
      return end;
  }
  end.joint = now(whole, spec).joint;
  end.member = spec.which + (spec.of == LinkEndSpec::Of::body ? whole.assembly->beams.size() : 0);
  return end;
}

/// A direction in space as a body has it in its own axes; the ground has it as it is.
template <int D>
LinkEnd<D> direction_of(const Scene& whole, const LinkEndSpec& spec, const Vec<double, D>& in_space) {
  LinkEnd<D> end = build_end<D>(whole, spec);
  end.direction = true;
  end.place = in_space;
  if (spec.of != LinkEndSpec::Of::body) return end;
  const auto axes = axes_of(whole.assembly->bodies[spec.which].rotation);
  for (int i = 0; i < D; ++i) end.place[i] = vector_of<D>(axes[static_cast<std::size_t>(i)]).dot(in_space);
  return end;
}

/// Whether two beams of one section are one beam at a clamp: they share the slope then, stretch and all, as one does at
/// a node. Elsewhere the stretch jumps with the axial force.
template <int D>
bool goes_on_straight(const Scene& whole, const LinkEndSpec& a, const LinkEndSpec& b) {
  if (!b.is_of_beam()) return false;
  const Scene one = beam_scene(whole, a.which), other = beam_scene(whole, b.which);
  const BeamSection first = build_section(one), second = build_section(other);
  const bool even = one.beam.sections.empty() && other.beam.sections.empty();
  const bool same = even && first.rhoA == second.rhoA && first.stiffness.EA == second.stiffness.EA &&
                    first.stiffness.EI == second.stiffness.EI && one.beam.strain_law == other.beam.strain_law;
  constexpr double rounding = 1e-9;
  const Vec<double, D> slope = vector_of<D>(node_of_whole(whole, a)[1]),
                       next = vector_of<D>(node_of_whole(whole, b)[1]);
  return same && (slope - next).norm() < rounding;
}

/// Adds what keeps directions of two ends as they are at t = 0.
template <int D>
void keep_directions(const Scene& whole, const LinkSpec& spec, Link<D>& link) {
  using Matrix = Eigen::Matrix<double, D, D>;
  const bool swapped = !spec.between[0].is_of_beam();  // a beam comes first
  const LinkEndSpec &a = spec.between[swapped ? 1 : 0], &b = spec.between[swapped ? 0 : 1];
  const auto keep = [&](const LinkEnd<D>& one, const LinkEnd<D>& other, const Matrix& turn) {
    link.ends.push_back(one);
    link.ends.push_back(other);
    keep_across<D>(link, link.ends.size() - 2, link.ends.size() - 1, turn);
  };
  if (a.is_of_beam()) {
    const Point tangent = node_of_whole(whole, a)[1];
    const Vec<double, D> along = vector_of<D>(tangent).normalized();
    LinkEnd<D> own = build_end<D>(whole, a);
    own.direction = true;
    if (goes_on_straight<D>(whole, a, b)) {
      LinkEnd<D> its = build_end<D>(whole, b);
      its.direction = true;
      link.ends.push_back(own);
      link.ends.push_back(its);
      keep_equal<D>(link, link.ends.size() - 2, link.ends.size() - 1);
      return;
    }
    if (b.is_of_beam()) {  // in the plane: the other slope, turned by the angle between both and a quarter
      const Vec<double, D> other = vector_of<D>(node_of_whole(whole, b)[1]).normalized();
      LinkEnd<D> its = build_end<D>(whole, b);
      its.direction = true;
      if constexpr (D == 2) {
        const double c = along.dot(other), s = other[0] * along[1] - other[1] * along[0];
        Matrix turn;  // a quarter beyond what turns `other` into `along`
        turn << -s, -c, c, -s;
        keep(own, its, turn);
      }
      return;
    }
    for (const Vec<double, D>& normal : across<D>(along)) {
      keep(own, direction_of<D>(whole, b, normal), Matrix::Identity());
    }
    return;
  }
  // two bodies, or one and the ground: all axes
  const auto pairs =
      D == 2 ? std::vector<std::pair<int, int>>{{0, 1}} : std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 2}};
  for (const auto& [first, second] : pairs) {
    keep(direction_of<D>(whole, a, Vec<double, D>::Unit(first)),
         direction_of<D>(whole, b, Vec<double, D>::Unit(second)), Matrix::Identity());
  }
}

}  // namespace

Point place_of(const Scene& whole, const LinkEndSpec& end) {
  if (end.of == LinkEndSpec::Of::ground) return end.place;
  if (end.of == LinkEndSpec::Of::body) return place_on_body(whole.assembly->bodies[end.which], end.place);
  return node_of_whole(whole, end)[0];
}

bool are_one_beam(const Scene& whole, const LinkEndSpec& a, const LinkEndSpec& b) {
  return whole.dimension == 2 ? goes_on_straight<2>(whole, a, b) : goes_on_straight<3>(whole, a, b);
}

template <int D>
BodyModel<D> build_body(const Scene& whole, const BodySpec& body) {
  BodyModel<D> model;
  model.mass = body.mass;
  if (body.inertia.size() == 1) model.inertia[2] = body.inertia[0];
  if (body.inertia.size() == 3) model.inertia = {body.inertia[0], body.inertia[1], body.inertia[2]};
  model.center = vector_of<D>(body.position);
  const auto axes = axes_of(body.rotation);
  for (int i = 0; i < D; ++i) model.axes.col(i) = vector_of<D>(axes[static_cast<std::size_t>(i)]);
  model.velocity = vector_of<D>(body.velocity);
  model.spin = vector_of<3>(body.angular_velocity);
  model.gravity = vector_of<D>(whole.gravity);
  model.gravity_ramp = whole.gravity_ramp;
  model.time_is_load_factor = whole.analysis == Analysis::statics;
  for (const BodyLoadSpec& spec : body.loads) {
    BodyLoad<D> load;
    const Vec<double, 3> direction = D == 2 && spec.type == BodyLoadSpec::Type::torque
                                         ? Vec<double, 3>::UnitZ()
                                         : vector_of<3>(spec.direction).normalized();
    load.value = [size = acting(spec.magnitude, whole.analysis), direction](double t) -> Vec<double, 3> {
      return size(t).value * direction;
    };
    if (spec.type == BodyLoadSpec::Type::force) {
      const auto at = std::ranges::find(body.points, spec.point, &BodyPointSpec::name);
      load.place = at == body.points.end() ? Vec<double, D>::Zero() : Vec<double, D>(vector_of<D>(at->at));
    }
    model.loads.push_back(std::move(load));
  }
  return model;
}

template <int D>
Link<D> build_link(const Scene& whole, const LinkSpec& spec) {
  const LinkEnd<D> a = build_end<D>(whole, spec.between[0]), b = build_end<D>(whole, spec.between[1]);
  const Vec<double, D> from = vector_of<D>(place_of(whole, spec.between[0])),
                       to = vector_of<D>(place_of(whole, spec.between[1]));
  switch (spec.type) {
    case LinkType::rail:
      return rail_link<D>(spec.name, a, to, vector_of<D>(spec.direction));
    case LinkType::distance:
      return distance_link<D>(spec.name, a, b, (to - from).norm());
    case LinkType::spring:
      return {spec.name,
              {a, b},
              {},
              LinkSpring{spec.stiffness, spec.damping, spec.length.value_or((to - from).norm()), spec.tension_only}};
    default:
      break;
  }
  Link<D> link = pin_link<D>(spec.name, a, b);
  if (spec.type == LinkType::clamp) keep_directions<D>(whole, spec, link);
  return link;
}

template BodyModel<2> build_body(const Scene&, const BodySpec&);
template BodyModel<3> build_body(const Scene&, const BodySpec&);
template Link<2> build_link(const Scene&, const LinkSpec&);
template Link<3> build_link(const Scene&, const LinkSpec&);

}  // namespace vlbeam
