#pragma once

#include <array>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "mechanics/motion/system/beam_system.hpp"

namespace vlbeam {

/// Axial forces as unknowns of their own, while a static iteration looks for an equilibrium. A beam that hardly
/// stretches has a potential energy with a steep, narrow and curved valley: a step along it that turns the axis by
/// dtheta strains it by dtheta^2/2, and what follows from that strain, EA dtheta^2/2, has nothing to do with the force
/// in the beam. With the forces N linearised beside the coordinates, N + dN = N(eps) + EA deps, the tangent has N for
/// N(eps), and nothing else changes once dN is eliminated: Newton's iteration for min max of the mixed energy, whose
/// steps are limited by the turn alone, however stiff the axis (Garcea, Trunfio & Casciaro, Comput. Methods Appl. Mech.
/// Engrg. 165, 1998). Where it converges N is N(eps), and the tangent the exact one.
template <int D>
class FreeTension {
 public:
  explicit FreeTension(const BeamSystem<D>& system);

  /// Forces as strains say at q, but none below `least` [N].
  void start(const Eigen::VectorXd& q, double least);
  /// Adds to the tangent at q what these forces do beyond those of the strains.
  void add_to(const Eigen::VectorXd& q, BeamMatrix<D>& tangent) const;
  /// Takes q to q - share change, and the forces along; none falls below `least`.
  void advance(Eigen::VectorXd& q, const Eigen::VectorXd& change, double share, double least);
  /// Whether strains at q pull, in the mean of each element, by more than `least` [N].
  bool pulls(const Eigen::VectorXd& q, double least) const;

 private:
  /// Where the axial strain is summed.
  struct Point {
    int element;
    std::array<double, 4> s_x;
    double weight;  ///< [m]
    Vec<double, D> r_x;
    double strain;  ///< from the rest shape
    double EA;      ///< there [N]
  };

  /// The axial force there, and its derivative by the strain [N].
  std::array<double, 2> pull_at(const Point& point) const;
  /// Calls visit(point) at q.
  template <class Visit>
  void at_points(const Eigen::VectorXd& q, const Visit& visit) const;

  const BeamSystem<D>& system_;
  const Stiffness stiffness_;
  std::vector<double> forces_;  ///< conjugate to the strain [N]
};

extern template class FreeTension<2>;
extern template class FreeTension<3>;

}  // namespace vlbeam
