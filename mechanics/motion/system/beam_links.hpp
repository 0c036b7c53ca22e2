#pragma once

#include <vector>

#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/motion/system/node_link.hpp"

namespace vlbeam {

/// Nodes of a beam that keep a distance: joints of blocks, links of rooms, and what rests against each other.
template <int D>
class BeamLinks {
 public:
  using Vector = Vec<double, D>;
  using Link = NodeLink<D>;

  /// `beam` must outlive this object.
  explicit BeamLinks(CurrentBeam<D>& beam) : beam_(beam) {}

  /// The distances that joints of a block have in q, an array of coordinates, are those that they keep.
  void tie_blocks(const double* q);
  /// After each change of the beam. What rests has then to be told anew.
  void adopt();
  /// What rests against each other from now on.
  void set_resting(const std::vector<Link>& resting);

  /// Those that push and pull, then what rests.
  const std::vector<Link>& all() const { return all_; }
  /// The first of these.
  std::vector<Link> tied() const { return {all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(tied_)}; }
  /// Whether joint `index` of the model is one of a block.
  bool in_block(int index) const;

  /// What links ask of the accelerations along them, by C'' = 0 [m/s^2].
  Eigen::VectorXd bending_in(const double* rate) const;

 private:
  /// Two of the model's joints that are tied to each other, and the way from the one to the other [m].
  struct Tie {
    int behind, ahead;
    Vector apart;
  };

  CurrentBeam<D>& beam_;
  std::vector<Tie> ties_;
  std::vector<Link> all_;
  std::size_t tied_ = 0;  ///< how many of all are those of blocks
};

extern template class BeamLinks<2>;
extern template class BeamLinks<3>;

}  // namespace vlbeam
