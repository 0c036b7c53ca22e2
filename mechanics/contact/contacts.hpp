#pragma once

#include <vector>

#include "mechanics/contact/node_contact.hpp"
#include "mechanics/motion/system/beam_links.hpp"

namespace vlbeam {

/// Joints, and the supports at the ends, that strike each other, or rest against each other: those are links then.
template <int D>
class Contacts {
 public:
  using Vector = Vec<double, D>;
  using Contact = NodeContact<D>;
  /// Of a contact: how far its nodes are apart, the rate of that, and the direction from the one to the other.
  struct Gap {
    double distance, rate;
    Vector direction;
  };

  /// Both must outlive this object.
  Contacts(CurrentBeam<D>& beam, BeamLinks<D>& links) : beam_(beam), links_(links) {}

  /// After each change of the beam: tells the links what rests.
  void adopt();

  /// All that may touch, whether it does or not.
  std::vector<Contact> all() const;
  const std::vector<Contact>& resting() const { return resting_; }
  Gap gap(const Contact& contact, const Eigen::VectorXd& y) const;
  /// From now on its nodes rest against each other, or no longer.
  void close(const Contact& contact, const Eigen::VectorXd& y);
  void open(const Contact& contact, const Eigen::VectorXd& y);

 private:
  CurrentBeam<D>& beam_;
  BeamLinks<D>& links_;
  std::vector<Contact> resting_;
};

extern template class Contacts<2>;
extern template class Contacts<3>;

}  // namespace vlbeam
