#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// A vector of D components that is linear in the coordinates of one member of an assembly: a point of it, or a
/// direction. What belongs to the ground has no shares.
template <int D>
struct Handle {
  struct Share {
    Eigen::Index at;  ///< of the D coordinates that begin there
    double factor;
  };
  std::vector<Share> shares = {};
  Vec<double, D> constant = Vec<double, D>::Zero();

  /// Its value, by coordinates `q` of the member.
  Vec<double, D> value(const double* q) const { return constant + rate(q); }
  /// The same of rates or accelerations.
  Vec<double, D> rate(const double* v) const {
    Vec<double, D> sum = Vec<double, D>::Zero();
    for (const Share& share : shares) sum += share.factor * Eigen::Map<const Vec<double, D>>(v + share.at);
    return sum;
  }
  /// Adds a force on it to an array like q.
  void add_force(const Vec<double, D>& force, double* q) const {
    for (const Share& share : shares) Eigen::Map<Vec<double, D>>(q + share.at) += share.factor * force;
  }
};

/// Forces of links on one member: the member's equations of motion have them like those of any load. Links do no work
/// in all, so they count as none on one member.
template <int D>
struct LinkForces {
  struct On {
    const Handle<D>* handle;  ///< of the assembly, which gives other ones after each event
    Vec<double, D> force;
  };
  std::vector<On> all = {};

  void add_to(double* q) const {
    for (const On& on : all) on.handle->add_force(on.force, q);
  }
};

}  // namespace vlbeam
