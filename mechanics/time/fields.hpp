#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/pieces.hpp"
#include "mechanics/time/step_kernels.hpp"

namespace vlbeam {

/// What a coordinate is. Each kind has a norm of its own, so that no metre is compared with a radian.
enum class Field {
  position,          ///< [m]
  slope,             ///< [-]
  mark,              ///< material coordinate of a joint [m]
  mass,              ///< position of a mass that has left the beam [m]
  angle,             ///< [rad]
  twist,             ///< [rad/m]
  multiplier,        ///< of constraints on positions
  slope_multiplier,  ///< of constraints on slopes
};
inline constexpr std::size_t field_count = 8;

/// Coordinates of one kind: `count` groups of `width`, the first at `first`, each `stride` behind the last.
struct FieldRun {
  Field field;
  Eigen::Index first, width = 1, stride = 1, count = 1;

  /// Some of the groups.
  FieldRun part(Eigen::Index from, Eigen::Index number) const {
    return {field, first + from * stride, width, stride, number};
  }
};

/// A number for each kind.
using FieldNorms = std::array<double, field_count>;

/// Calls f(run, index) for each coordinate of the runs.
template <class Runs, class Function>
void for_each_coordinate(const Runs& runs, const Function& f) {
  for (const FieldRun& run : runs) {
    for (Eigen::Index k = 0, at = run.first; k < run.count; ++k, at += run.stride) {
      for (Eigen::Index i = at; i < at + run.width; ++i) f(run.field, i);
    }
  }
}

/// Largest magnitude of `count` groups of `width`, of finite entries. Four groups at a time: each waits for the one
/// before it otherwise.
template <int width>
double largest_magnitude(const double* at, Eigen::Index stride, Eigen::Index count) {
  constexpr Eigen::Index at_a_time = 4;
  std::array<std::array<double, width>, at_a_time> largest{};
  const auto take = [&](std::size_t which) {
    for (std::size_t i = 0; i < width; ++i) {
      const double size = std::abs(at[i]);
      largest[which][i] = size > largest[which][i] ? size : largest[which][i];
    }
    at += stride;
  };
  for (; count >= at_a_time; count -= at_a_time) {
    for (std::size_t which = 0; which < at_a_time; ++which) take(which);
  }
  for (; count > 0; --count) take(0);
  double all = 0;
  for (const auto& group : largest) all = std::max(all, *std::max_element(group.begin(), group.end()));
  return all;
}

/// The same of a run in x.
inline double largest_magnitude(const FieldRun& run, const Eigen::VectorXd& x) {
  const double* const at = x.data() + run.first;
  if (run.width == 2) return largest_magnitude<2>(at, run.stride, run.count);
  if (run.width == 3) return largest_magnitude<3>(at, run.stride, run.count);
  double largest = 0;
  for (Eigen::Index i = 0; i < run.width; ++i) {
    largest = std::max(largest, largest_magnitude<1>(at + i, run.stride, run.count));
  }
  return largest;
}

/// Whether two runs are positions and slopes of the same nodes in the plane, and all there is of these.
inline bool are_planar_nodes(const FieldRun& a, const FieldRun& b) {
  return a.width == 2 && b.width == 2 && a.stride == 4 && b.stride == 4 && b.first == a.first + 2 && a.count == b.count;
}

/// Largest magnitude of each kind in some vectors, of finite entries.
template <std::size_t N>
std::array<FieldNorms, N> field_norms(const std::vector<FieldRun>& runs,
                                      const std::array<const Eigen::VectorXd*, N>& vectors) {
  std::array<FieldNorms, N> norms{};
  std::size_t done = 0;
  if (runs.size() > 1 && are_planar_nodes(runs[0], runs[1])) {  // most of all there is, in one pass
    std::array<std::atomic<double>, N> position{}, slope{};
    in_pieces(runs[0].count, runs[0].stride, [&](Eigen::Index first, Eigen::Index count) {
      for (std::size_t i = 0; i < N; ++i) {
        std::array<double, 4> largest;
        step_kernels().largest(count, vectors[i]->data() + runs[0].first + 4 * first, largest);
        raise(position[i], std::max(largest[0], largest[1]));
        raise(slope[i], std::max(largest[2], largest[3]));
      }
    });
    for (std::size_t i = 0; i < N; ++i) {
      norms[i][static_cast<std::size_t>(runs[0].field)] = position[i];
      norms[i][static_cast<std::size_t>(runs[1].field)] = slope[i];
    }
    done = 2;
  }
  for (; done < runs.size(); ++done) {
    const FieldRun& run = runs[done];
    for (std::size_t i = 0; i < N; ++i) {
      double& norm = norms[i][static_cast<std::size_t>(run.field)];
      std::atomic<double> largest = norm;
      in_pieces(run.count, run.stride, [&](Eigen::Index first, Eigen::Index count) {
        raise(largest, largest_magnitude(run.part(first, count), *vectors[i]));
      });
      norm = largest;
    }
  }
  return norms;
}
inline FieldNorms field_norms(const std::vector<FieldRun>& runs, const Eigen::VectorXd& x) {
  return field_norms<1>(runs, {&x}).front();
}

inline bool all_finite(const Eigen::VectorXd& x) {
  std::atomic<bool> finite = true;
  in_pieces(x.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
    if (!((0 * x.segment(first, count)).sum() == 0)) finite = false;  // without a branch an entry
  });
  return finite;
}

/// Position and slope of `nodes` nodes of a beam in `dimension` dimensions, node by node.
inline std::vector<FieldRun> nodal_fields(Eigen::Index dimension, Eigen::Index nodes) {
  return {{Field::position, 0, dimension, 2 * dimension, nodes},
          {Field::slope, dimension, dimension, 2 * dimension, nodes}};
}

}  // namespace vlbeam
