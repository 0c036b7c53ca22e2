#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// What a link takes hold of: a point or a direction of a member, or of the ground.
template <int D>
struct LinkEnd {
  enum class Of {
    beam_start,
    beam_end,
    node,    ///< of a beam whose nodes rest
    joint,   ///< of a beam, from 0
    body,    ///< a place in body axes
    ground,  ///< a place in space
  };
  static constexpr std::size_t no_member = static_cast<std::size_t>(-1);

  Of of = Of::ground;
  std::size_t member = no_member;  ///< of the assembly's, from 0
  bool direction = false;          ///< of a beam its slope there, of a body a vector in body axes
  int joint = 0;                   ///< or the node
  Vec<double, D> place = Vec<double, D>::Zero();
};

/// A link takes hold of four vectors at most: two points and two directions; or, at a clamp of bodies in space, of
/// eight. What belongs to them so needs no memory of its own.
using LinkVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 24, 1>;
using LinkMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 24, 24>;

/// A condition C = h^T A h/2 + g^T h + c = 0 on the vectors h that a link takes hold of, one behind the other. All
/// conditions of links are of this kind: a pin is linear in them, a distance quadratic, and so is what keeps two
/// directions across each other.
struct LinkCondition {
  LinkMatrix curvature;  ///< A, symmetric; empty for none
  LinkVector gradient;   ///< g
  double constant = 0;

  double value(const LinkVector& h) const {
    double sum = constant + gradient.dot(h);
    if (curvature.size() > 0) sum += 0.5 * h.dot(curvature * h);
    return sum;
  }
  LinkVector slope(const LinkVector& h) const {
    LinkVector sum = gradient;
    if (curvature.size() > 0) sum += curvature * h;
    return sum;
  }
  /// C'' without accelerations, at rates h'.
  double turning(const LinkVector& rate) const { return curvature.size() > 0 ? rate.dot(curvature * rate) : 0; }
};

/// A spring and a damper between the first two vectors of a link.
struct LinkSpring {
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
  double length = 0;     ///< at which it bears nothing [m]
  bool tension_only = false;
};

/// What ties members of an assembly to each other, or to the ground.
template <int D>
struct Link {
  std::string name;
  std::vector<LinkEnd<D>> ends;
  std::vector<LinkCondition> conditions = {};
  std::optional<LinkSpring> spring = std::nullopt;
};

/// Two points that are one.
template <int D>
Link<D> pin_link(const std::string& name, const LinkEnd<D>& a, const LinkEnd<D>& b) {
  Link<D> link{name, {a, b}};
  for (int c = 0; c < D; ++c) {
    LinkCondition condition{{}, LinkVector::Zero(2 * D)};
    condition.gradient[c] = 1;
    condition.gradient[D + c] = -1;
    link.conditions.push_back(std::move(condition));
  }
  return link;
}

/// A point on a straight line of the ground, through `from` along `direction`.
template <int D>
Link<D> rail_link(const std::string& name, const LinkEnd<D>& a, const Vec<double, D>& from,
                  const Vec<double, D>& direction) {
  Link<D> link{name, {a}};
  const Vec<double, D> along = direction.normalized();
  Eigen::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  Vec<double, D> first = Vec<double, D>::Unit(least);
  first = (first - along.dot(first) * along).normalized();
  std::vector<Vec<double, D>> across{first};
  if constexpr (D == 3) across.push_back(along.cross(first));
  for (const Vec<double, D>& normal : across) link.conditions.push_back({{}, normal, -normal.dot(from)});
  return link;
}

/// Two points that keep a distance > 0 [m].
template <int D>
Link<D> distance_link(const std::string& name, const LinkEnd<D>& a, const LinkEnd<D>& b, double distance) {
  Link<D> link{name, {a, b}};
  LinkCondition condition{LinkMatrix::Zero(2 * D, 2 * D), LinkVector::Zero(2 * D), -distance / 2};
  condition.curvature.topLeftCorner<D, D>().diagonal().setConstant(1 / distance);
  condition.curvature.bottomRightCorner<D, D>().diagonal().setConstant(1 / distance);
  condition.curvature.topRightCorner<D, D>().diagonal().setConstant(-1 / distance);
  condition.curvature.bottomLeftCorner<D, D>().diagonal().setConstant(-1 / distance);
  link.conditions.push_back(std::move(condition));
  return link;
}

/// Makes room in the conditions of a link for vectors that it has come to take hold of.
template <int D>
void widen(Link<D>& link) {
  const auto size = static_cast<Eigen::Index>(D * link.ends.size());
  for (LinkCondition& condition : link.conditions) {
    const Eigen::Index known = condition.gradient.size();
    condition.gradient.conservativeResize(size);
    condition.gradient.tail(size - known).setZero();
    if (condition.curvature.size() == 0) continue;
    const LinkMatrix curvature = condition.curvature;
    condition.curvature.setZero(size, size);
    condition.curvature.topLeftCorner(known, known) = curvature;
  }
}

/// Keeps two directions equal that the link takes hold of, as numbers of its ends: so the slopes of two beams are those
/// of one.
template <int D>
void keep_equal(Link<D>& link, std::size_t a, std::size_t b) {
  widen(link);
  const auto size = static_cast<Eigen::Index>(D * link.ends.size());
  for (int c = 0; c < D; ++c) {
    LinkCondition condition{{}, LinkVector::Zero(size)};
    condition.gradient[static_cast<Eigen::Index>(D * a) + c] = 1;
    condition.gradient[static_cast<Eigen::Index>(D * b) + c] = -1;
    link.conditions.push_back(std::move(condition));
  }
}

/// Keeps a . turn b = 0 of two directions that the link takes hold of besides its other vectors: the first of them at
/// `a`, the second at `b`, as numbers of its ends.
template <int D>
void keep_across(Link<D>& link, std::size_t a, std::size_t b, const Eigen::Matrix<double, D, D>& turn) {
  widen(link);
  const auto size = static_cast<Eigen::Index>(D * link.ends.size());
  LinkCondition condition{LinkMatrix::Zero(size, size), LinkVector::Zero(size)};
  const auto at_a = static_cast<Eigen::Index>(D * a), at_b = static_cast<Eigen::Index>(D * b);
  condition.curvature.template block<D, D>(at_a, at_b) = turn;
  condition.curvature.template block<D, D>(at_b, at_a) = turn.transpose();
  link.conditions.push_back(std::move(condition));
}

}  // namespace vlbeam
