#pragma once

#include <optional>
#include <vector>

#include "mechanics/contact/node_contact.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// Nodes of a beam that keep a distance: joints of blocks; joints, and the supports at the ends, that rest against each
/// other. And those that may come to rest.
template <int D>
class BeamLinks {
 public:
  using Vector = Vec<double, D>;
  using Contact = NodeContact<D>;
  using Link = NodeLink<D>;
  /// Of a contact: how far its nodes are apart, the rate of that, and the direction from the one to the other.
  struct Gap {
    double distance, rate;
    Vector direction;
  };

  /// `beam` must outlive this object.
  explicit BeamLinks(CurrentBeam<D>& beam) : beam_(beam) {}

  /// The distances that joints of a block have in q, an array of coordinates, are those that they keep.
  void tie_blocks(const double* q);
  /// After each change of the beam.
  void adopt();

  /// Blocks, then what rests.
  const std::vector<Link>& all() const { return all_; }
  const std::vector<Contact>& resting() const { return resting_; }
  /// Those of blocks: they pull, too.
  std::vector<Link> of_blocks() const {
    return {all_.begin(), all_.end() - static_cast<std::ptrdiff_t>(resting_.size())};
  }
  /// Whether joint `index` of the model is one of a block.
  bool in_block(int index) const;

  /// All that may touch, whether it does or not.
  std::vector<Contact> contacts() const;
  Gap gap(const Contact& contact, const Eigen::VectorXd& y) const;
  /// From now on its nodes rest against each other, or no longer.
  void close(const Contact& contact, const Eigen::VectorXd& y);
  void open(const Contact& contact, const Eigen::VectorXd& y);

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
  std::vector<Contact> resting_;
  std::vector<Link> all_;
};

extern template class BeamLinks<2>;
extern template class BeamLinks<3>;

}  // namespace vlbeam
