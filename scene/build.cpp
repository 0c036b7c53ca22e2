#include "scene/build.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/length_control/rest_arc.hpp"
#include "core/length_control/segmentation.hpp"
#include "mechanics/contact/contact_room.hpp"
#include "mechanics/frames/frame_room.hpp"
#include "mechanics/frames/frame_sections.hpp"
#include "mechanics/remesh/giving_way.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/ropes/ground.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/bearings.hpp"
#include "scene/build_drag.hpp"
#include "scene/build_flow.hpp"
#include "scene/build_frames.hpp"
#include "scene/build_loads.hpp"
#include "scene/build_winch.hpp"
#include "scene/corners.hpp"
#include "scene/options.hpp"
#include "scene/sections.hpp"
#include "scene/time_function.hpp"
#include "scene/validate_feed.hpp"
#include "scene/vehicles.hpp"

namespace vlbeam {
namespace {

MergeShape build_merge(const Scene& scene) {
  switch (merge_policy(scene)) {
    case MergePolicy::unit:
      return MergeShape::unit;
    case MergePolicy::rest_arc:
      return MergeShape::rest_arc;
    case MergePolicy::least_change:
      return MergeShape::least_change;
    case MergePolicy::own:
      return MergeShape::own;
    case MergePolicy::relaxed:
      return has_rest_shape(scene) ? MergeShape::rest_arc : MergeShape::point_fit;
    case MergePolicy::point_fit:
      break;
  }
  return MergeShape::point_fit;
}

LengthControl build_length_control(const Scene& scene) {
  const auto& control = scene.length_control;
  return {control.enabled,
          standard_length(scene),
          control.upper,
          control.hysteresis,
          build_merge(scene),
          control.merge_rule,
          merges_rationally(scene),
          scene.analysis == Analysis::statics ? VelocityTransfer::nodal : control.velocities,
          end_merge(scene),
          merge_below(scene)};
}

/// The axis, exactly, with one joint at most. The two elements at it are one curve cut in two, so that it is smooth
/// there, and with transported weights stays what it is while the joint slides.
template <int D>
CubicChain<D> exact_shape(const Axis<D>& axis, const InitialNodes& nodes) {
  const auto& x = nodes.x;
  const int joint = nodes.joints.empty() ? 0 : nodes.joints.front();
  const auto j = static_cast<std::size_t>(std::max(joint, 1));
  if (joint == 0 || !axis.in_one_piece(x[j - 1], x[j + 1])) return exact_chain(axis, x);
  std::vector<double> others = x;
  others.erase(others.begin() + joint);
  auto chain = exact_chain(axis, others);
  const double l = x[j + 1] - x[j - 1], u = (x[j] - x[j - 1]) / l;
  const auto whole = RationalCubic<double, D>::from_nodal({chain.r[j - 1], chain.r_x[j - 1], chain.r[j], chain.r_x[j]},
                                                          l, chain.weights[j - 1]);
  const auto at = whole.evaluate(u);
  chain.r.insert(chain.r.begin() + joint, at[0]);
  chain.r_x.insert(chain.r_x.begin() + joint, at[1] / l);
  chain.weights[j - 1] = restrict_cubic(whole.weights, 0.0, u);
  chain.weights.insert(chain.weights.begin() + joint, restrict_cubic(whole.weights, u, 1.0));
  return chain;
}

/// n + 1 nodes from 0 to the last of `breaks`, which are all nodes; the elements between two breaks are equal.
std::vector<double> uniform_nodes(const std::vector<double>& breaks, int n) {
  const std::size_t spans = breaks.size() - 1;
  std::vector<int> share(spans, 1);
  for (int given = static_cast<int>(spans); given < n; ++given) {  // the next one where elements are longest
    std::size_t longest = 0;
    for (std::size_t i = 1; i < spans; ++i) {
      if ((breaks[i + 1] - breaks[i]) * share[longest] > (breaks[longest + 1] - breaks[longest]) * share[i])
        longest = i;
    }
    ++share[longest];
  }
  std::vector<double> x;
  for (std::size_t i = 0; i < spans; ++i) {
    for (int k = 0; k < share[i]; ++k) x.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / share[i]);
  }
  x.push_back(breaks.back());
  return x;
}

/// The breaks of an axis with the places where the section changes, which are nodes, too.
std::vector<double> with_changes(const Scene& scene, std::vector<double> breaks) {
  const double rounding = corner_rounding * breaks.back();
  for (const double at : section_changes(scene.beam)) {
    const double x = position_on_axis(scene.beam.curve, breaks, at);
    const auto next = std::ranges::lower_bound(breaks, x - rounding);
    if (next == breaks.end() || *next > x + rounding) breaks.insert(next, x);
  }
  return breaks;
}

/// Nodes of the point masses: those given, or the nearest that nothing else needs, which moves to the place given.
void place_masses(const Scene& scene, const std::vector<double>& breaks, InitialNodes& nodes) {
  const int n = scene.beam.elements;
  const double rounding = corner_rounding * breaks.back();
  std::vector<int> taken = nodes.joints;
  for (const PointMassSpec& mass : scene.point_masses) {
    if (!mass.position) taken.push_back(mass.node);
  }
  const auto is_taken = [&](int k) {
    return std::ranges::find(taken, k) != taken.end() ||
           std::binary_search(breaks.begin(), breaks.end(), nodes.x[static_cast<std::size_t>(k)]);
  };
  for (std::size_t i = 0; i < scene.point_masses.size(); ++i) {
    const PointMassSpec& mass = scene.point_masses[i];
    if (!mass.position) {
      nodes.masses.push_back(mass.node);
      continue;
    }
    const std::string key = "/point_masses/" + std::to_string(i) + "/position";
    if (!(*mass.position <= drawn_axis<3>(scene.beam.curve).length() + rounding)) {
      throw InvalidInput(
          key, number_text(*mass.position),
          "it must be on the beam, at most " + number_text(drawn_axis<3>(scene.beam.curve).length()) + " [m]");
    }
    const double x = std::min(position_on_axis(scene.beam.curve, breaks, *mass.position), breaks.back());
    const auto there = std::ranges::find_if(nodes.x, [&](double at) { return std::abs(at - x) <= rounding; });
    int node = static_cast<int>(there - nodes.x.begin());
    if (there == nodes.x.end()) {
      node = 0;
      for (int k = 1; k < n; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (is_taken(k) || !(nodes.x[at - 1] < x && x < nodes.x[at + 1])) continue;
        if (node == 0 || std::abs(nodes.x[at] - x) < std::abs(nodes.x[static_cast<std::size_t>(node)] - x)) node = k;
      }
      if (node == 0) {
        throw InvalidInput(key, number_text(*mass.position),
                           "the mass needs a node of its own there: take more elements than " + std::to_string(n));
      }
      nodes.x[static_cast<std::size_t>(node)] = x;
    }
    taken.push_back(node);
    nodes.masses.push_back(node);
  }
}

/// A bearing gets a node where one is to be had that nothing else needs: elements between bearings err least.
void place_bearings(const Scene& scene, const std::vector<double>& breaks, InitialNodes& nodes) {
  std::vector<int> taken = nodes.joints;
  taken.insert(taken.end(), nodes.masses.begin(), nodes.masses.end());
  for (const LoadSpec& load : scene.loads) {
    if (load.at == LoadPlace::node) taken.push_back(load.node);
  }
  for (const BearingSpec& bearing : scene.bearings) {
    int node = 0;
    for (int k = 1; k < scene.beam.elements; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const bool fits = nodes.x[i - 1] < bearing.x && bearing.x < nodes.x[i + 1];
      if (!fits || std::ranges::find(taken, k) != taken.end()) continue;
      if (std::binary_search(breaks.begin(), breaks.end(), nodes.x[i]) && nodes.x[i] != bearing.x) continue;
      const auto off = [&](int which) { return std::abs(nodes.x[static_cast<std::size_t>(which)] - bearing.x); };
      if (node == 0 || off(k) < off(node)) node = k;
    }
    if (node == 0 || std::ranges::find(nodes.x, bearing.x) != nodes.x.end()) continue;
    nodes.x[static_cast<std::size_t>(node)] = bearing.x;
    taken.push_back(node);
  }
}

}  // namespace

template <int D>
Support<D> build_support(const SupportSpec& spec, const Vec<double, D>& tangent) {
  switch (spec.type) {
    case SupportType::clamp:
      return spec.clamp == ClampType::full ? Support<D>::clamp() : Support<D>::direction_clamp(tangent);
    case SupportType::pin:
      return Support<D>::pin();
    case SupportType::slide:
      return Support<D>::slide(tangent);
    case SupportType::free:
      break;
  }
  return Support<D>::free_end();
}

template <int D>
Axis<D> build_axis(const Scene& scene) {
  const Axis<D> drawn = drawn_axis<D>(scene.beam.curve);
  if (drawn.kinks().empty()) return drawn;
  const auto round = rounded_corners(scene, drawn_axis<3>(scene.beam.curve));
  return drawn.rounded(round, drawn.length() / scene.beam.elements);
}

InitialNodes place_nodes(const Scene& scene, const std::vector<double>& of_axis) {
  const int n = scene.beam.elements;
  const std::vector<double> breaks = with_changes(scene, of_axis);
  InitialNodes nodes{uniform_nodes(breaks, n)};
  const auto joints = sliding_joints(scene);
  for (std::size_t which = 0; which < joints.size(); ++which) {
    const double x = position_on_axis(scene.beam.curve, breaks, joints[which].position);
    if (!(x > 0 && x < breaks.back())) {
      throw InvalidInput(
          joint_key(scene, which) + "/position", number_text(x),
          "it must be inside the beam: more than 0 and less than " + number_text(breaks.back()) + " [m]");
    }
    if (which > 0 && joints[which].position <= joints[which - 1].position) {
      throw InvalidInput(joint_key(scene, which) + "/position", number_text(x),
                         "joints stand in order along the beam: it must be more than " +
                             number_text(joints[which - 1].position) + " [m], by that of " +
                             joint_key(scene, which - 1));
    }
    const int first = nodes.joints.empty() ? 1 : nodes.joints.back() + 1;
    if (std::binary_search(breaks.begin(), breaks.end(), x)) {
      const int there = static_cast<int>(std::ranges::lower_bound(nodes.x, x) - nodes.x.begin());
      if (first <= there && there < n) {
        nodes.joints.push_back(there);
        continue;
      }
    }
    // the nearest interior node moves to the joint, unless the curve or another joint needs it where it is
    auto may_move = [&](int k) {
      const auto i = static_cast<std::size_t>(k);
      return !std::binary_search(breaks.begin(), breaks.end(), nodes.x[i]) && nodes.x[i - 1] < x && x < nodes.x[i + 1];
    };
    int node = 0;
    for (int k = first; k < n; ++k) {
      if (!may_move(k)) continue;
      const auto distance = [&](int i) { return std::abs(nodes.x[static_cast<std::size_t>(i)] - x); };
      if (node == 0 || distance(k) <= distance(node)) node = k;
    }
    if (node == 0) {
      const bool one = joints.size() == 1;
      throw InvalidInput(joint_key(scene, which) + "/position", number_text(x),
                         std::string(one ? "the sliding mass needs a node of its own between two knots of the curve"
                                         : "each joint needs a node of its own, between two knots of a curve") +
                             ": take more elements than " + std::to_string(n));
    }
    nodes.joints.push_back(node);
    nodes.x[static_cast<std::size_t>(node)] = x;
  }
  place_masses(scene, breaks, nodes);
  place_bearings(scene, breaks, nodes);
  return nodes;
}

std::vector<PointMass> build_point_masses(const Scene& scene, const std::vector<double>& breaks) {
  std::vector<PointMass> masses;
  if (scene.point_masses.empty()) return masses;
  const InitialNodes nodes = place_nodes(scene, breaks);
  for (std::size_t i = 0; i < scene.point_masses.size(); ++i) {
    masses.push_back({nodes.x[static_cast<std::size_t>(nodes.masses[i])], scene.point_masses[i].mass});
  }
  return masses;
}

/// Adds the velocities of the scene's rigid motion to those of a chain's nodes, without what supports hold.
template <int D>
void add_rigid_motion(const Scene& scene, const Axis<D>& axis, ChainState<D>& chain) {
  if (!scene.initial_velocity) return;
  const int last = chain.mesh.last();
  const auto turning = [&scene](const Vec<double, D>& s) -> Vec<double, D> {
    return initial_velocity<D>(scene, s) - initial_velocity<D>(scene, Vec<double, D>::Zero());
  };
  for (int k = 0; k <= last; ++k) {
    position<D>(chain.rate.data(), k) += initial_velocity<D>(scene, position<D>(chain.q.data(), k));
    slope<D>(chain.rate.data(), k) += turning(slope<D>(chain.q.data(), k));
    if constexpr (D == 3) {
      if (chain.kept == nullptr) continue;
      const Vec<double, 3> spin =
          scene.initial_velocity->rotation * vector_of<3>(scene.initial_velocity->axis).normalized();
      own_sections(chain).now[static_cast<std::size_t>(k)].spin += spin.dot(slope<3>(chain.q.data(), k).normalized());
    }
  }
  for (auto& joint : chain.joints) {
    if (joint.kink) joint.kink->rate += turning(joint.kink->slope);
  }
  for (const int k : {0, last}) {
    const Support<D> support =
        build_support<D>(k == 0 ? scene.start : scene.end, axis.tangent(k == 0 ? 0 : axis.length()));
    const auto keep = [&](auto part, const typename Support<D>::Components& free) {
      part = support.out_of_frame((support.into_frame(part).array() * free).matrix());
    };
    keep(position<D>(chain.rate.data(), k), support.free_position);
    keep(slope<D>(chain.rate.data(), k), support.free_slope);
    if constexpr (D == 3) {
      if (chain.kept && !support.free_angle) own_sections(chain).now[static_cast<std::size_t>(k)].spin = 0;
    }
  }
}

template <int D>
Vec<double, D> initial_velocity(const Scene& scene, const Vec<double, D>& r) {
  const InitialVelocitySpec& motion = *scene.initial_velocity;
  const Vec<double, D> arm = r - vector_of<D>(motion.about);
  Vec<double, D> turned;
  if constexpr (D == 2) {
    turned << -arm[1], arm[0];
  } else {
    turned = vector_of<D>(motion.axis).normalized().cross(arm);
  }
  return vector_of<D>(motion.translation) + motion.rotation * turned;
}

/// The floor of a scene under the beam of a model.
template <int D>
std::shared_ptr<const Part<D>> build_ground(const Scene& scene, const BeamModel<D>& model) {
  const GroundSpec& ground = *scene.ground;
  const double weight = mean_mass(scene.beam, beam_length(scene)) * model.gravity.norm();
  return std::make_shared<Ground<D>>(FloorLaw<D>{.up = -model.gravity.normalized(),
                                                 .level = ground.height,
                                                 .stiffness = ground.stiffness,
                                                 .depth = ground.depth.value_or(weight / ground.stiffness),
                                                 .damping = ground.damping,
                                                 .friction = ground.friction},
                                     model.quadrature_points, model.masses, model.section.rhoA);
}

namespace {

template <int D>
void add_drag(const Scene& scene, BeamModel<D>& model) {
  const auto drag = build_drag<D>(scene, scene.drag.value_or(DragSpec{}), model.section.rhoA, model.quadrature_points);
  if (drag.present()) model.parts.push_back(std::make_shared<ActingDrag<D>>(drag));
}

/// Where joints, or a joint and a support, do not end the run when they meet.
template <int D>
void add_contacts(const Scene& scene, BeamModel<D>& model) {
  const ContactSpec contact = scene.contact.value_or(ContactSpec{});
  const auto joints = sliding_joints(scene);
  const auto strikes = [](const SlidingJointSpec& joint) { return joint.at_support != AtSupport::stop; };
  if (contact.joints == AtSupport::stop && std::ranges::none_of(joints, strikes)) return;
  auto& room = bring<ContactRoom<D>>(model);
  for (const SlidingJointSpec& joint : joints) room.at_support.push_back({joint.at_support, joint.restitution});
  room.at_meeting = {contact.joints, contact.restitution};
  room.joints_rest = joints_may_rest(scene);
}

template <int D>
void add_giving_way(const Scene& scene, BeamModel<D>& model) {
  const bool cuts = cut_policy(scene) == CutPolicy::relaxed, merges = merge_policy(scene) == MergePolicy::relaxed;
  if (!cuts && !merges) return;
  auto& room = bring<RemeshRoom<D>>(model);
  room.cuts = cuts;
  room.merges = merges;
}

template <int D>
void add_spin(const Scene& scene, Torques torques, BeamModel<D>& model) {
  SpinModel& spin = spin_in(model);
  spin.section = build_spin(scene.beam);
  spin.field = scene.spin->angles;
  spin.rate = initial_spin(scene);
  for (const auto& drive : scene.spin->drives) spin.drives.push_back({drive.node, time_function(drive.angle)});
  spin.torques = std::move(torques);
  for (const SlidingJointSpec& joint : sliding_joints(scene)) spin.pitch.push_back(joint.pitch.value_or(0));
}

}  // namespace

template <int D>
BeamModel<D> build_model(const Scene& scene) {
  BeamModel<D> model;
  model.section = build_section(scene);
  model.pieces = build_pieces(scene);
  model.formulation = scene.formulation;
  model.transport = weight_transport(scene);
  model.quadrature_points = quadrature_points(scene);
  model.polynomial_points = points_of_polynomials(scene);
  model.axial_strain = axial_strain(scene);
  model.gravity = vector_of<D>(scene.gravity);
  if (scene.analysis == Analysis::dynamics) model.gravity_ramp = scene.gravity_ramp;
  const Axis<D> axis = build_axis<D>(scene);
  model.start = build_support<D>(scene.start, axis.tangent(0));
  model.end = build_support<D>(scene.end, axis.tangent(axis.length()));
  const auto motion_of = [&scene](const std::optional<SupportMotionSpec>& spec) -> SupportMotion<D> {
    if (!spec) return {};
    const auto& [direction, displacement, angle, x, y, z] = *spec;
    SupportMotion<D> motion;
    const std::array<const std::optional<TimeSpec>*, 3> axes{&x, &y, &z};
    for (std::size_t c = 0; c < D; ++c) {
      if (*axes[c]) motion.along[c] = acting(smooth_by_default(**axes[c]), scene.analysis);
    }
    if (angle) motion.angle = acting(smooth_by_default(*angle), scene.analysis);
    if (direction == Point{}) return motion;
    motion.direction = vector_of<D>(direction).normalized();
    motion.displacement = acting(smooth_by_default(displacement), scene.analysis);
    return motion;
  };
  model.start_motion = motion_of(scene.start.motion);
  model.end_motion = motion_of(scene.end.motion);
  model.start_releases = scene.start.type == SupportType::free;
  model.end_releases = scene.end.type == SupportType::free;
  const InitialNodes placed = place_nodes(scene, axis.breaks());
  for (const SlidingJointSpec& spec : sliding_joints(scene)) {
    const double x = placed.x[static_cast<std::size_t>(placed.joints[model.joints.size()])];
    ModelJoint<D>& joint = model.joints.emplace_back();
    joint.law = SlidingJoint{spec.mass, joint_slopes(scene, spec), spec.friction};
    if (spec.pulley) joint.law.turning.inertia = spec.pulley->inertia / (spec.pulley->radius * spec.pulley->radius);
    if (spec.support == SupportType::pin) joint.support = Support<D>::pin();
    if (spec.support == SupportType::clamp) {
      joint.support = Support<D>::direction_clamp(axis.tangent(x));
      joint.support->free_angle = true;
    }
    joint.motion = motion_of(spec.motion);
    joint.separation_distance = separation_distance(scene, spec);
    if (spec.x) joint.x = travelling(x, acting(*spec.x, scene.analysis));
  }
  for (const BlockSpec& block : scene.blocks) {
    model.blocks.push_back(block.joints);  // the block only shifts: any of its joints may have its mass
    for (const int tied : block.joints) {
      model.joints[static_cast<std::size_t>(tied)].law.mass += block.mass / static_cast<double>(block.joints.size());
    }
  }
  model.contact_distance = contact_distance(scene);
  if constexpr (has_room("contact")) add_contacts(scene, model);
  model.masses.points = build_point_masses(scene, axis.breaks());
  if constexpr (has_room("ropes")) {
    if (scene.beam.sections.empty()) add_drag(scene, model);
    if (scene.ground) model.parts.push_back(build_ground<D>(scene, model));
  }
  add_bearings(scene, axis, model);
  add_vehicles(scene, axis, model);
  model.time_is_load_factor = scene.analysis == Analysis::statics;
  model.constraints = scene.constraints;
  model.length_control = build_length_control(scene);
  if constexpr (has_room("remesh")) add_giving_way(scene, model);
  for (const auto& piece : model.pieces.pieces()) model.length_control.kept.push_back(piece.end);
  if (has_rest_shape(scene)) model.rest = std::make_shared<const Axis<D>>(axis.straightened());
  auto [loads, torques, moments] = build_loads<D>(scene);
  const std::vector<double>& nodes = placed.x;
  const auto stay = [&](auto& points) {  // at what the node marks now, wherever it moves to
    if (flows(scene)) return;
    for (auto& load : points) {
      if (load.node >= 0) load.x = [x = nodes[static_cast<std::size_t>(load.node)]](double) { return x; };
    }
  };
  stay(loads.points);
  stay(torques.points);
  if constexpr (D == 3 && has_room("frames")) {
    if (has_frames(scene)) {
      model.rooms.push_back(
          std::make_shared<FrameRoom>(FrameModel{build_frames(scene.beam), torques, std::move(moments)}));
    }
  }
  if constexpr (has_room("spin")) {
    if (scene.spin && !has_frames(scene)) add_spin(scene, std::move(torques), model);
  }
  model.loads = std::move(loads);
  add_laws_along(scene, model);
  for (const bool at_start : {true, false}) {
    if ((at_start ? scene.start : scene.end).pays_out()) add_winch(scene, at_start, axis.length(), model);
  }
  for (const Knot& knot : knots(scene)) {
    ModelJoint<D>& joint = model.joints.emplace_back();
    joint.law.slopes = knot.slopes;
    joint.x = [x = placed.x[static_cast<std::size_t>(knot.node)]](double) -> Prescribed { return {x, 0, 0}; };
  }
  if (flows(scene)) add_flow<D>(scene, axis.tangent(0).normalized(), model);
  return model;
}

template <int D>
ChainState<D> build_shape(const Scene& scene) {
  const Axis<D> axis = build_axis<D>(scene);
  const InitialNodes nodes = place_nodes(scene, axis.breaks());
  const auto& x = nodes.x;
  CubicChain<D> shape;
  if (axis.straight() || axis_form(scene) == AxisForm::even) {
    shape = even_chain(axis, x, !is_polynomial(scene.beam.element));
    if (axis.straight()) shape.weights.assign(x.size() - 1, scene.beam.weights);
  } else {
    shape = exact_shape(axis, nodes);
  }
  ChainState<D> chain;
  chain.mesh.x = x;
  chain.q.resize(static_cast<std::size_t>(node_size<D>) * x.size());
  chain.rate.assign(chain.q.size(), 0);
  for (int k = 0; k <= scene.beam.elements; ++k) {
    const auto i = static_cast<std::size_t>(k);
    position<D>(chain.q.data(), k) = shape.r[i];
    slope<D>(chain.q.data(), k) = shape.r_x[i];
    if (k < scene.beam.elements) chain.mesh.weights.push_back({shape.weights[i], x[i], x[i + 1]});
  }
  if (has_rest_shape(scene)) {
    chain.rest = chain.q;
    const Axis<D> rest = axis.straightened();
    for (int k = 0; !axis.kinks().empty() && k <= scene.beam.elements; ++k) {
      const auto at = rest.derivatives(x[static_cast<std::size_t>(k)]);
      position<D>(chain.rest.data(), k) = at[0];
      slope<D>(chain.rest.data(), k) = at[1];
    }
  }
  if constexpr (D == 3) {
    if (has_frames(scene)) {
      add_frames(scene, chain);
    }
  }
  const auto joints = sliding_joints(scene);
  const auto add_joint = [&](int node, std::size_t index, JointSlopes slopes) {
    auto& joint = chain.joints.emplace_back();
    joint = {.node = node, .index = static_cast<int>(index)};
    if (slopes == JointSlopes::continuous) return;
    const double at = x[static_cast<std::size_t>(node)];
    const bool kinked = std::ranges::find(axis.kinks(), at) != axis.kinks().end();
    joint.kink = {kinked ? axis.tangent(at) : Vec<double, D>(slope<D>(chain.q.data(), node)), Vec<double, D>::Zero()};
  };
  for (std::size_t i = 0; i < joints.size(); ++i) add_joint(nodes.joints[i], i, joint_slopes(scene, joints[i]));
  std::size_t index = joints.size() + (scene.start.pays_out() ? 1 : 0) + (scene.end.pays_out() ? 1 : 0);
  for (const Knot& knot : knots(scene)) add_joint(knot.node, index++, knot.slopes);
  std::ranges::sort(chain.joints, {}, [](const auto& joint) { return joint.node; });
  const LengthControl control = build_length_control(scene);
  const bool even = has_rest_shape(scene) && axis_form(scene) == AxisForm::even;
  if (even && control.enabled && control.takes_rest_arc() && weight_transport(scene) == WeightTransport::transported) {
    for (int k = 0; k < chain.mesh.elements(); ++k) {
      if (!chain.moves(k)) continue;
      chain.mesh.weights[static_cast<std::size_t>(k)] = rest_arc(axis, chain, k, control.trigger_length());
    }
  }
  return chain;
}

/// Makes joints of the ends through which the beam is fed.
template <int D>
void add_feeds(const Scene& scene, ChainState<D>& chain) {
  int index = static_cast<int>(sliding_joints(scene).size());
  if (scene.start.pays_out()) {
    chain.joints.insert(chain.joints.begin(), {.node = 0, .rate = -feed_rate(scene.start), .index = index++});
  }
  if (scene.end.pays_out()) {
    chain.joints.push_back({.node = chain.mesh.last(), .rate = feed_rate(scene.end), .index = index});
  }
}

/// What the slope of a node changes by as it goes along element k, past x: as the element bends there, but for what the
/// rest curve, which the node follows, bends otherwise than the element does at rest.
template <int D>
Vec<double, D> bend_along(const Scene& scene, const ChainState<D>& chain, int k, double x) {
  const WeightTransport transport = weight_transport(scene);
  const Vec<double, D> bend = motion_at(chain, k, x, transport).r_xx;
  if (!has_rest_shape(scene)) return bend;
  ChainState<D> at_rest = chain;
  at_rest.q = chain.rest;
  const Vec<double, D> lacks =
      build_axis<D>(scene).straightened().derivatives(x)[2] - motion_at(at_rest, k, x, transport).r_xx;
  return bend + rotation_from_rest(chain, k) * lacks;
}

template <int D>
void set_in_motion(const Scene& scene, ChainState<D>& chain) {
  const Axis<D> axis = build_axis<D>(scene);
  const bool built = !starts_in_equilibrium(scene), straight = built && axis.straight();
  add_rigid_motion(scene, axis, chain);
  // the beam is at rest or moves as a rigid body, so each moving node travels along it
  const auto joints = sliding_joints(scene);
  for (auto& joint : chain.joints) {
    const auto i = static_cast<std::size_t>(joint.index);
    if (i >= joints.size()) continue;  // a knot, which rests in the beam
    const int j = joint.node;
    const double x = chain.mesh.x[static_cast<std::size_t>(j)];
    const auto r_x = slope<D>(chain.q.data(), j);
    const bool held = joints[i].support != SupportType::free;
    // what is held stands still, and what goes through it is the beam
    const double own = joints[i].x       ? time_function(*joints[i].x)(0).rate
                       : joints[i].pitch ? -initial_spin(scene) * *joints[i].pitch / (2 * std::numbers::pi)
                                         : joints[i].velocity;
    const double rate = held ? -position<D>(chain.rate.data(), j).dot(r_x) / r_x.squaredNorm() : own;
    joint.rate = rate;
    position<D>(chain.rate.data(), j) += rate * r_x;
    Vec<double, D> before = Vec<double, D>::Zero(), behind = before;
    if (built && has_rest_shape(scene)) {
      before = behind = rate * axis.derivatives(x)[2];
    } else if (!straight) {
      before = rate * bend_along(scene, chain, j - 1, x);
      behind = rate * bend_along(scene, chain, j, x);
    }
    const Vec<double, D> turning = slope<D>(chain.rate.data(), j);
    before += turning;
    behind += joint.kink ? joint.kink->rate : turning;
    if (joint.kink) joint.kink->rate = behind;
    slope<D>(chain.rate.data(), j) = joint.kink ? before : Vec<double, D>((before + behind) / 2);
    if (held) position<D>(chain.rate.data(), j).setZero();
    if constexpr (D == 3) {  // triads of the node are those of the material points that pass it
      if (has_frames(scene))
        own_sections(chain).now[static_cast<std::size_t>(j)].spin +=
            rate * turning_along(chain, axis.straightened(), j);
    }
    if (joints[i].support != SupportType::clamp) continue;
    const auto sleeve = Support<D>::direction_clamp(axis.tangent(x));
    slope<D>(chain.rate.data(), j) =
        sleeve.out_of_frame((sleeve.into_frame(slope<D>(chain.rate.data(), j)).array() * sleeve.free_slope).matrix());
  }
  add_feeds(scene, chain);
}

template <int D>
ChainState<D> build_chain(const Scene& scene) {
  if (flows(scene)) {
    ChainState<D> chain = flowing_chain(scene, build_model<D>(scene));
    add_rigid_motion(scene, build_axis<D>(scene), chain);
    return chain;
  }
  ChainState<D> chain = build_shape<D>(scene);
  set_in_motion(scene, chain);
  return chain;
}

template Support<2> build_support(const SupportSpec&, const Vec<double, 2>&);
template Support<3> build_support(const SupportSpec&, const Vec<double, 3>&);
template Vec<double, 2> initial_velocity(const Scene&, const Vec<double, 2>&);
template Vec<double, 3> initial_velocity(const Scene&, const Vec<double, 3>&);
template Axis<2> build_axis(const Scene&);
template Axis<3> build_axis(const Scene&);
template BeamModel<2> build_model(const Scene&);
template BeamModel<3> build_model(const Scene&);
template ChainState<2> build_shape(const Scene&);
template ChainState<3> build_shape(const Scene&);
template void set_in_motion(const Scene&, ChainState<2>&);
template void set_in_motion(const Scene&, ChainState<3>&);
template ChainState<2> build_chain(const Scene&);
template ChainState<3> build_chain(const Scene&);

}  // namespace vlbeam
