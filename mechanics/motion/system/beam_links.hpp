#pragma once

#include <algorithm>
#include <vector>

#include "mechanics/motion/system/beam_link.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// The links of a beam: joints of blocks that keep their distances, links of rooms, and what rests against each other.
template <int D>
class BeamLinks {
 public:
  using Vector = Vec<double, D>;
  using Link = BeamLink<D>;

  /// `beam` must outlive this object.
  explicit BeamLinks(CurrentBeam<D>& beam) : beam_(beam) {}

  /// The distances that joints of a block have in q, an array of coordinates, are those that they keep.
  void tie_blocks(const double* q);
  /// After each change of the beam. What rests has then to be told anew.
  void adopt();
  /// What the beam carries at points that travel along it, at time t; q and rate are arrays of coordinates.
  void carry(const double* q, const double* rate, double t) const;
  const std::vector<Link>& carried() const { return carried_; }
  /// What rests against each other from now on.
  void set_resting(const std::vector<Link>& resting);

  /// Those that push and pull, then what rests.
  const std::vector<Link>& all() const { return all_; }
  /// The first of these.
  std::vector<Link> tied() const { return {all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(tied_)}; }
  /// Whether any holds a material point where it is.
  bool holds_points() const {
    return std::any_of(all_.begin(), all_.end(), [](const Link& link) { return link.place.has_value(); });
  }
  /// Whether joint `index` of the model is one of a block.
  bool in_block(int index) const;

  /// What links ask of the accelerations along them, by C'' = 0 [m/s^2].
  Eigen::VectorXd bending_in(const double* q, const double* rate, const std::vector<Link>& links) const;
  const CurrentBeam<D>& beam() const { return beam_; }

 private:
  /// Two of the model's joints that are tied to each other, and the way from the one to the other [m].
  struct Tie {
    int behind, ahead;
    Vector apart;
  };

  CurrentBeam<D>& beam_;
  std::vector<Tie> ties_;
  std::vector<Link> all_;
  mutable std::vector<Link> carried_;
  std::size_t tied_ = 0;  ///< how many of all are those of blocks
};

extern template class BeamLinks<2>;
extern template class BeamLinks<3>;

}  // namespace vlbeam
