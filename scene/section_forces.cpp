#include "scene/section_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"

namespace vlbeam {
namespace {

const std::array<double, 2> gauss{0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3};
// of Gauss' rule of three points
const std::array<double, 3> mean_points{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
constexpr std::array<double, 3> mean_shares{5.0 / 18, 8.0 / 18, 5.0 / 18};
constexpr double at_node = 1e-9;     // of an element's length
constexpr int looks_an_element = 8;  // for extremes
constexpr double straight = 1e-300;  // below it a curvature has no direction

template <int D>
Vec<double, 3> in_space(const Vec<double, D>& v) {
  Vec<double, 3> result = Vec<double, 3>::Zero();
  result.template head<D>() = v;
  return result;
}

/// Moment and shear at `x` of a beam of length l that is clamped at both ends, under a unit force at `a` against the
/// side to which a positive moment bends it.
std::array<double, 2> clamped_beam(double l, double a, double x) {
  const double b = l - a, reaction = b * b * (3 * a + b) / (l * l * l), moment = a * b * b / (l * l);
  const double beyond = x > a ? 1 : 0;
  return {reaction * x - moment - beyond * (x - a), reaction - beyond};
}

}  // namespace

template <int D>
SectionForces<D>::SectionForces(const Scene& scene, const Configuration& shape)
    : shape_(shape),
      elements_(scene, shape),
      frames_(!shape.moments.empty()),
      points_(elements_.count()),
      stretches_(elements_.count()),
      axial_(elements_.count()),
      broken_(shape.x.size(), false),
      loaded_(elements_.count(), false) {
  if (knows_stress(scene.beam)) {
    for (std::size_t k = 0; k < elements_.count(); ++k) {
      const SectionSizes sizes = *sizes_of(section_at(scene.beam, (shape.x[k] + shape.x[k + 1]) / 2));
      moduli_.push_back({sizes.area, sizes.area * sizes.i2_y / sizes.half_z, sizes.area * sizes.i2_z / sizes.half_y});
    }
  }
  for (const double at : section_changes(scene.beam)) {  // the curvature jumps there
    const auto node = std::ranges::min_element(shape.x, {}, [at](double x) { return std::abs(x - at); });
    broken_[static_cast<std::size_t>(node - shape.x.begin())] = true;
  }
  broken_.front() = broken_.back() = true;
  for (const Configuration::Action& action : shape.actions) {
    if (action.x < shape.x.front() || action.x > shape.x.back()) continue;
    const std::size_t k = element_before(action.x);
    const double l = shape.x[k + 1] - shape.x[k], u = (action.x - shape.x[k]) / l;
    if (u < at_node) {
      broken_[k] = true;
    } else if (u > 1 - at_node) {
      broken_[k + 1] = true;
    } else {
      broken_[k] = broken_[k + 1] = loaded_[k] = true;
      inside_.push_back({k, u, vector_of<D>(action.force)});
    }
  }
  for (std::size_t k = 0; k < elements_.count(); ++k) look_at(elements_.element(k));
  for (std::size_t k = 0; frames_ && k < elements_.count(); ++k) {
    for (std::size_t g = 0; g < 2; ++g) points_[k][g] = vector_of<3>(shape.moments[k][g]);
  }
  smooth();
}

template <int D>
typename ShapeElements<D>::Point SectionForces<D>::point(const Element& element, double u) const {
  return elements_.section().damping > 0 ? element.at(u) : element.bent(u);
}

template <int D>
void SectionForces<D>::look_at(const Element& element) {
  const std::size_t k = element.index;
  for (std::size_t g = 0; g < 2; ++g) {
    const auto at = point(element, gauss[g]);
    stretches_[k][g] = std::sqrt(at.r_x.dot(at.r_x));
    points_[k][g] = elements_.section().bends() && !frames_ ? moment_at(element, gauss[g], at) : Moment(Moment::Zero());
  }
  if (elements_.samples_axially()) {
    for (std::size_t n = 0; n < 3; ++n) axial_[k][n] = element.sampled[n].force.largest;
    return;
  }
  double mean = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    mean += mean_shares[n] * elements_.strains(element, mean_points[n], point(element, mean_points[n])).force.largest;
  }
  axial_[k].fill(mean);
}

template <int D>
typename SectionForces<D>::Moment SectionForces<D>::moment_at(const Element& element, double u,
                                                              const typename ShapeElements<D>::Point& at) const {
  const BeamSection section = elements_.section_at(element.x(u));
  const auto curvature_of = [&section](const Vec<double, D>& r_x, const Vec<double, D>& r_xx) -> Vec<double, 3> {
    const double squared = r_x.dot(r_x), scale = section.stiffness.green() ? squared * std::sqrt(squared) : squared;
    return in_space<D>(r_x).cross(in_space<D>(r_xx)) / scale;
  };
  Vec<double, 3> curvature = curvature_of(at.r_x, at.r_xx);
  if (element.rest) {
    const auto rest = curvature_of(combine_nodes(at.s_x, *element.rest), combine_nodes(at.s_xx, *element.rest));
    const double size = curvature.norm();
    if constexpr (D == 2) {
      curvature -= rest;
    } else if (size > straight) {  // the law knows magnitudes
      curvature *= 1 - rest.norm() / size;
    }
  }
  if constexpr (D == 2) {
    if (section.damping > 0) {
      const Curvature<double, 2> strain(at.r_x, at.r_xx, section.stiffness.law, 0);
      curvature[2] += section.damping * (strain.by_slope.dot(at.v_x) + strain.by_second.dot(at.v_xx));
    }
  }
  // what is conjugate to Green's curvature acts on the angle of the section by way of the stretch
  const double share = section.stiffness.green() ? 1 / std::sqrt(at.r_x.dot(at.r_x)) : 1;
  return section.stiffness.EI * share * curvature;
}

/// What is left is smooth along the beam but for an error of one sign at the first point of each element and of the
/// other at the second, smooth in size over the cube of the length: the differences of six points that no quartic has,
/// or of four that its own cubic explains, are of that.
template <int D>
void SectionForces<D>::smooth() {
  const std::vector<std::array<Moment, 2>> raw = points_;
  constexpr std::size_t most = 3;  // elements
  for (std::size_t k = 0; k < raw.size(); ++k) {
    std::size_t first = k, last = k;
    if (!broken_[k]) --first;
    if (!broken_[k + 1]) ++last;
    if (last - first == 1 && last == k && k >= 2 && !broken_[first]) --first;
    if (last - first == 1 && first == k && last + 1 < raw.size() && !broken_[last + 1]) ++last;
    const std::size_t count = 2 * (last - first + 1);
    if (count < 4) continue;
    std::array<double, 2 * most> x{}, off{};
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t of = first + i / 2;
      const double l = shape_.x[of + 1] - shape_.x[of], s = gauss[i % 2] - 0.5;
      x[i] = shape_.x[of] + gauss[i % 2] * l;
      off[i] = s * l * l * l;
    }
    Moment difference = Moment::Zero();
    double own = 0;
    for (std::size_t i = 0; i < count; ++i) {
      double share = 1;
      for (std::size_t j = 0; j < count; ++j) share /= j == i ? 1 : x[i] - x[j];
      difference += share * raw[first + i / 2][i % 2];
      own += share * off[i];
    }
    // four points have the third derivative of the moment itself in their difference, over 6: it errs by a 90th of it
    if (count == 4) own += 90.0 / 6;
    const Moment size = difference / own;
    const double l = shape_.x[k + 1] - shape_.x[k];
    for (std::size_t g = 0; g < 2; ++g) points_[k][g] -= (gauss[g] - 0.5) * l * l * l * size;
  }
}

template <int D>
typename SectionForces<D>::Recovered SectionForces<D>::recovered(std::size_t k, double u, double towards) const {
  std::array<double, 4> x{};
  std::array<Moment, 4> values;
  std::size_t count = 0;
  const auto take = [&](std::size_t of) {
    for (std::size_t g = 0; g < 2; ++g) {
      x[count] = shape_.x[of] + gauss[g] * (shape_.x[of + 1] - shape_.x[of]);
      values[count++] = points_[of][g];
    }
  };
  const bool before = !broken_[k], behind = !broken_[k + 1];
  take(k);
  if (before && (towards < 0.5 || !behind)) {
    take(k - 1);
  } else if (behind) {
    take(k + 1);
  }
  // Lagrange's polynomial and its derivative
  const double at = x_at(k, u);
  Recovered sum{Moment::Zero(), Moment::Zero()};
  for (std::size_t i = 0; i < count; ++i) {
    double share = 1, growth = 0;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i) continue;
      const double inverse = 1 / (x[i] - x[j]);
      growth = growth * (at - x[j]) * inverse + share * inverse;
      share *= (at - x[j]) * inverse;
    }
    sum.value += share * values[i];
    sum.growth += growth * values[i];
  }
  if (loaded_[k] && !frames_) add_clamped(k, u, sum);
  return sum;
}

template <int D>
double SectionForces<D>::axial(std::size_t k, double u) const {
  const auto& n = axial_[k];
  if (elements_.samples_axially()) {
    return (1 - u) * (1 - 2 * u) * n[0] + 4 * u * (1 - u) * n[1] + u * (2 * u - 1) * n[2];
  }
  // the parabola that has the means of three elements, or the line of two
  const double l = shape_.x[k + 1] - shape_.x[k], mean = n[0];
  const bool before = !broken_[k], behind = !broken_[k + 1];
  const auto growth_to = [&](std::size_t other) {  // over l, between the middles
    const double l_other = shape_.x[other + 1] - shape_.x[other];
    return (axial_[other][0] - mean) * 2 * l / (l + l_other);
  };
  if (before && behind) {
    const double back = -growth_to(k - 1), forth = growth_to(k + 1);
    const double a = (shape_.x[k] - shape_.x[k - 1]) / l, b = (shape_.x[k + 2] - shape_.x[k + 1]) / l, s = u - 0.5;
    const double bend = 1.5 * (forth - back) / (1 + a + b);
    return mean + (back + bend * (1 + 2 * a) / 3) * s + bend * (s * s - 1.0 / 12);
  }
  if (before) return mean - growth_to(k - 1) * (u - 0.5);
  if (behind) return mean + growth_to(k + 1) * (u - 0.5);
  return mean;
}

template <int D>
void SectionForces<D>::add_clamped(std::size_t k, double u, Recovered& moment) const {
  for (const Inside& inside : inside_) {
    if (inside.element != k) continue;
    const Element element = elements_.element(k);
    const Vec<double, D> r_x = element.bent(inside.u).r_x;
    const double stretch = std::sqrt(r_x.dot(r_x)), l = element.kinematics.length() * stretch;
    const auto [value, growth] = clamped_beam(l, inside.u * l, u * l);
    const Moment about = in_space<D>(inside.force).cross(in_space<D>(r_x)) / stretch;
    moment.value += value * about;
    moment.growth += growth * stretch * about;
  }
}

template <int D>
SectionForce SectionForces<D>::bending(std::size_t k, double u, const Recovered& moment) const {
  SectionForce force;
  const double share = (u - gauss[0]) / (gauss[1] - gauss[0]);
  const double stretch = stretches_[k][0] + share * (stretches_[k][1] - stretches_[k][0]);
  if (frames_) {
    force.moment = std::sqrt(moment.value[0] * moment.value[0] + moment.value[1] * moment.value[1]);
    force.torque = moment.value[2];
  } else {
    force.moment = D == 2 ? moment.value[2] : moment.value.norm();
    force.shear = (D == 2 ? moment.growth[2] : moment.growth.norm()) / stretch;
  }
  return force;
}

template <int D>
void SectionForces<D>::add_stress(std::size_t k, SectionForce& force, const Recovered& moment) const {
  if (!has_stress()) return;
  const Moduli& of = moduli_[k];
  const double bent =
      frames_ ? std::abs(moment.value[0]) / of.y + std::abs(moment.value[1]) / of.z : std::abs(force.moment) / of.y;
  force.stress = std::abs(force.axial) / of.area + bent;
}

template <int D>
SectionForce SectionForces<D>::at(std::size_t k, double u) const {
  const Recovered moment = recovered(k, u, u);
  SectionForce force = bending(k, u, moment);
  force.axial = axial(k, u);
  add_stress(k, force, moment);
  return force;
}

template <int D>
std::size_t SectionForces<D>::element_before(double x) const {
  const auto inner_end = shape_.x.end() - 1;
  return static_cast<std::size_t>(std::lower_bound(shape_.x.begin() + 1, inner_end, x) - shape_.x.begin()) - 1;
}

template <int D>
std::optional<typename SectionForces<D>::Place> SectionForces<D>::place(double x) const {
  const double beyond = at_node * (shape_.x.back() - shape_.x.front());
  if (!(x >= shape_.x.front() - beyond && x <= shape_.x.back() + beyond)) return {};
  const std::size_t k = element_before(x);
  const Element element = elements_.element(k);
  const double u = std::clamp((x - element.x(0)) / element.kinematics.length(), 0.0, 1.0);
  const auto point = element.at(u);
  return Place{point.r, point.v, point.r_x, at(k, u)};
}

template <int D>
typename SectionForces<D>::Extremes SectionForces<D>::extremes() const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr AlongBeam none{infinite, -infinite, 0, 0};
  Extremes extremes{none, none, none, none, none};
  const auto add = [](AlongBeam& to, double value, double x) {
    if (value < to.least) {
      to.least = value;
      to.at_least = x;
    }
    if (value > to.largest) {
      to.largest = value;
      to.at_largest = x;
    }
  };
  // Looks at u of element k, by what is nearer to `towards`; returns how the moment grows there, in a half.
  const auto look = [&](std::size_t k, double u, double towards) {
    const Recovered moment = recovered(k, u, towards);
    SectionForce force = bending(k, u, moment);
    const double x = x_at(k, u);
    force.axial = axial(k, u);
    add_stress(k, force, moment);
    add(extremes.axial, force.axial, x);
    add(extremes.stress, force.stress, x);
    add(extremes.moment, force.moment, x);
    add(extremes.shear, force.shear, x);
    add(extremes.torque, force.torque, x);
    if (D == 2) return moment.growth[2];
    const Moment bent = frames_ ? Moment(moment.value[0], moment.value[1], 0) : moment.value;
    return bent.dot(moment.growth);
  };
  for (std::size_t k = 0; k < elements_.count(); ++k) {
    if (loaded_[k]) {
      for (int i = 0; i <= looks_an_element; ++i) look(k, static_cast<double>(i) / looks_an_element, 0);
      for (const Inside& inside : inside_) {
        if (inside.element == k) look(k, inside.u, 0);
      }
      continue;
    }
    for (const double from : {0.0, 0.5}) {  // each half has a cubic of its own
      const double at_from = look(k, from, from + 0.25), at_to = look(k, from + 0.5, from + 0.25);
      if (at_from * at_to < 0) look(k, from + 0.5 * at_from / (at_from - at_to), from + 0.25);
    }
  }
  return extremes;
}

template class SectionForces<2>;
template class SectionForces<3>;

}  // namespace vlbeam
