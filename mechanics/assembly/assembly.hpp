#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/assembly/member.hpp"

namespace vlbeam {

template <int D>
class AssemblyEquations;

/// Several beams and bodies with links between them, as equations with events: derived in
/// docs/theory/assemblies.md. Its state is that of all members: coordinates, rates, then the sum of what they count.
///
/// Each member keeps its own equations and its own factored matrix; a link acts on it by forces alone. Conditions of
/// links are eliminated by a small dense system of the multipliers, so cost is that of the members and what links add.
/// Events of one member leave the others as they are; where links hold what an event has moved, velocities follow.
/// Methods that take equations of second order (generalized-alpha) hold conditions at positions; explicit ones come
/// back to them after each step.
template <int D>
class AssemblySystem final : public EventedOde {
 public:
  using Members = std::vector<std::unique_ptr<Member<D>>>;

  AssemblySystem(Members members, std::vector<Link<D>> links);
  ~AssemblySystem() override;

  const std::vector<Link<D>>& links() const { return links_; }
  /// How far each link is from what it ties, at the start: positions [m] and directions [-], and rates of both.
  struct Gap {
    double position = 0, rate = 0;
  };
  std::vector<Gap> gaps() const;
  /// Conditions count from how the members are placed at the start, and velocities come to agree with links. Returns
  /// the links that are redundant: others hold what they hold.
  std::vector<std::string> settle();
  Eigen::VectorXd initial_state() const { return initial_; }

  Eigen::Index size() const override { return 2 * coordinates() + balance().count(); }
  std::vector<FieldRun> fields() const override;
  /// With the accelerations that links allow: explicit methods drift from what links hold, and are brought back after
  /// each step where `corrects` says so.
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override;
  /// Refused: throws std::logic_error.
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;
  std::unique_ptr<SecondOrderSystem> new_second_order() override;
  Guards guards(const Eigen::VectorXd& y, double t) const override;
  void handle_event(int index, Eigen::VectorXd& y, double t) override;
  /// Members are sampled with the forces of links that belong to the state.
  void sample(const Eigen::VectorXd& y, double t) override;
  void correct(Eigen::VectorXd& y, double t) override;
  bool proceed(const Eigen::VectorXd& y, double t) override;
  std::string fastest(const Eigen::VectorXd& y) const override;
  void exchange(Archive& memory) override;

  std::function<void(const Eigen::VectorXd& y, double t)> on_sample;  ///< after all members'
  std::function<void(const Eigen::VectorXd& y, double t)> on_state;   ///< after each step
  std::function<bool(double t)> on_step;
  /// What of the energy an event of the members has changed, links included [J].
  std::function<void(double jump)> on_event;

  std::size_t members() const { return members_.size(); }
  Member<D>& member(std::size_t which) const { return *members_[which]; }
  /// The state of one member, without what it counts, in memory that the next call for this member overwrites.
  const Eigen::VectorXd& state_of(const Eigen::VectorXd& y, std::size_t which) const;
  Eigen::Index coordinates() const { return coordinates_; }
  BalanceEntries balance() const;
  /// Energies and momenta of all members and springs, with what the state counts.
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points) const;
  /// Force of a link on its first end, as members were sampled last [N]; on its other vectors behind it.
  std::vector<Vec<double, D>> forces_of(std::size_t link) const;
  /// Makes the forces of links those that belong to a state; returns the power that dampers of links take [W].
  double find_forces(const Eigen::VectorXd& y, double t);
  /// From the first point of a link to the second; nothing where the link has one [m].
  Vec<double, D> apart(const Eigen::VectorXd& y, std::size_t link) const;
  /// Energy that springs hold [J].
  double spring_energy(const Eigen::VectorXd& y) const;

  /// What links take hold of, one behind the other: that of link k begins at first_end(k).
  const std::vector<Handle<D>>& handles() const { return handles_; }
  std::size_t first_end(std::size_t link) const { return first_end_[link]; }
  const LinkEnd<D>& end(std::size_t handle) const { return *ends_[handle]; }
  /// Counts the changes of members.
  std::size_t revision() const { return revision_; }
  /// Where the coordinates of a member stand.
  Eigen::Index first(std::size_t member) const { return first_[member]; }
  bool corrects = false;                    ///< see rhs()
  std::vector<std::string> redundant = {};  ///< links, as find_forces() found last

 private:
  void adopt(double t);
  /// Velocities become those that agree with links, by impulses along them.
  void project(Eigen::VectorXd& y, double t);
  LinkVector values(const Eigen::VectorXd& y, std::size_t link, bool rates) const;

  Members members_;
  std::vector<Link<D>> links_;
  std::vector<const LinkEnd<D>*> ends_;
  std::vector<std::size_t> first_end_;
  std::vector<Handle<D>> handles_;
  std::vector<Eigen::Index> first_;
  Eigen::Index coordinates_ = 0;
  bool is_whole_ = false;                        ///< links hold what they tie
  mutable std::vector<Eigen::VectorXd> states_;  ///< of state_of()
  std::size_t revision_ = 0;
  Eigen::VectorXd initial_;
  std::unique_ptr<AssemblyEquations<D>> view_;  ///< of find_forces() and project()
};

extern template class AssemblySystem<2>;
extern template class AssemblySystem<3>;

}  // namespace vlbeam
