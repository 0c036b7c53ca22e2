#pragma once

#include <vector>

#include "mechanics/contact/contacts.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// New velocities where joints, or the supports at the ends, strike each other.
template <int D>
class Impacts {
 public:
  using Contact = NodeContact<D>;

  /// All must outlive this object.
  Impacts(const BeamInside<D>& inside, Contacts<D>& contacts)
      : beam_(inside.beam),
        links_(inside.links),
        mass_(inside.mass),
        accelerations_(inside.accelerations),
        contacts_(contacts) {}

  /// All that touch and come nearer strike each other at once, and what rests bears it: new velocities, and what rests
  /// then. Throws ComputationFailed where it cannot.
  void strike(Eigen::VectorXd& y, double t);

 private:
  using Gap = typename Contacts<D>::Gap;

  /// Velocities after an impact of these.
  void collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t);
  /// Throws ComputationFailed.
  [[noreturn]] void comes_to_rest(const Contact& contact, double t) const;

  CurrentBeam<D>& beam_;
  BeamLinks<D>& links_;
  BeamMass<D>& mass_;
  Accelerations<D>& accelerations_;
  Contacts<D>& contacts_;
};

extern template class Impacts<2>;
extern template class Impacts<3>;

}  // namespace vlbeam
