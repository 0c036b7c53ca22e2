#include "mechanics/spin/spin_unknowns.hpp"

#include <algorithm>
#include <utility>

namespace vlbeam {
namespace {

/// A nut moves by what the angles do, dx = g . dq + off, and what acts on it turns them by g: with all else solved for,
/// they have a tangent of their own and two dyads.
template <int D>
class SpinView final : public UnknownsTangent<D> {
 public:
  explicit SpinView(SpinUnknowns<D>& of) : of_(of) {}

  void constrain(const double* q, const double* v, const double* a, double t, double* r) const override {
    const Eigen::Index at = of_.at();
    if (const auto nut = of_.nut_place()) {
      const Eigen::Index mark = places()[*nut].mark;
      Eigen::Map<Eigen::VectorXd>(r + at, of_.count()) -= of_.nut_torque(*nut, q, v, r[mark]);
      r[mark] = of_.nut().off(of_.spin(), q + at, v + at, q[mark]);
    }
    of_.spin().drive(a + at, t, r + at);
  }

  bool prepare(const TangentWeights& by, double size, BeamMatrix<D>& beam) override {
    if (const auto nut = of_.nut_place()) take_nut(*nut, size, beam);
    of_.spin().assemble(by, tangent_);
    return of_.spin().factor(by.a, tangent_);
  }

  bool ties() const override { return of_.nut_place().has_value(); }

  void complete(const double* q, const double* v, const double* free, const BeamMatrix<D>& beam) override {
    const Spin& spin = of_.spin();
    const Eigen::Index at = of_.at(), mark = places()[*of_.nut_place()].mark;
    const double push = free[mark];
    beam.solve(column_.data());
    thread_ = of_.nut().thread(spin, q + at, v + at, q[mark]);
    const auto where_free = [&](Eigen::VectorXd torque) {
      for (const DrivenAngle& drive : spin.model().drives) torque[spin.angle(drive.node)] = 0;
      return torque;
    };
    torque_ = where_free(thread_.by_angles);
    by_x_ = where_free((own_ - row_.dot(column_)) * thread_.by_angles + push * thread_.slope);
    answer_.resize(spin.coordinates(), 2);
    answer_.col(0) = by_x_;
    answer_.col(1) = where_free(push * thread_.share);
    for (int i = 0; i < 2; ++i) tangent_.solve(answer_.col(i).data());
    Eigen::Matrix2d small = Eigen::Matrix2d::Identity();
    small.row(0) += thread_.by_angles.transpose() * answer_;
    small.row(1) += thread_.twist.transpose() * answer_;
    inverse_ = small.inverse();
  }

  void solve_before(double* r) override {
    if (const auto nut = of_.nut_place()) off_ = std::exchange(r[places()[*nut].mark], 0);
  }

  void solve_after(double* r) const override {
    const Eigen::Index at = of_.at();
    const auto nut = of_.nut_place();
    Eigen::Map<Eigen::VectorXd> all(r, at), turn(r + at, of_.count());
    if (nut) turn -= row_.dot(all) * torque_ + off_ * by_x_;
    tangent_.solve(turn.data());
    if (!nut) return;
    const Eigen::Vector2d seen(thread_.by_angles.dot(turn), thread_.twist.dot(turn));
    turn -= answer_ * (inverse_ * seen);
    const double moves = off_ + thread_.by_angles.dot(turn);
    all -= moves * column_;
    r[places()[*nut].mark] = moves;
  }

  void expand(const TangentWeights& by, Eigen::MatrixXd& dense) override {
    of_.spin().assemble(by, tangent_);
    const Eigen::Index size = 2 * Eigen::Index{of_.beam().dofs().nodes};  // an angle and a twist a node
    dense.setZero(size, size);
    tangent_.band.expand(dense);
  }

 private:
  const std::vector<JointPlace>& places() const { return of_.beam().places(); }

  /// Takes the nut's x out of the beam's tangent.
  void take_nut(std::size_t which, double size, BeamMatrix<D>& beam) {
    constexpr int B = node_size<D>;
    const Eigen::Index behind = of_.beam().dofs().mark();
    const int nodes = of_.beam().dofs().nodes;
    const auto& border = beam.border[which];
    row_.setZero(of_.at());
    column_.setZero(of_.at());
    for (int i = 0; i < BorderedBlockTridiagonal<B>::reach && border.first + i < nodes; ++i) {
      row_.template segment<B>(Eigen::Index{B} * (border.first + i)) = border.row[static_cast<std::size_t>(i)];
      column_.template segment<B>(Eigen::Index{B} * (border.first + i)) = border.column[static_cast<std::size_t>(i)];
    }
    const auto x = static_cast<Eigen::Index>(which), others = Eigen::Index{beam.borders()};
    row_.segment(behind, others) = beam.corner.row(x).head(others);
    column_.segment(behind, others) = beam.corner.col(x).head(others);
    own_ = beam.corner(x, x);
    row_[behind + x] = column_[behind + x] = 0;
    beam.fix(static_cast<int>(which), size);
  }

  SpinUnknowns<D>& of_;
  SpinTangent tangent_;
  double own_ = 0;                ///< of the force on x, by x
  Eigen::VectorXd row_, column_;  ///< of it by all else but the angles; what of that moves against x
  Nut::Thread thread_;
  Eigen::VectorXd torque_, by_x_;  ///< on the angles that are free: g, and what dx makes of it
  Eigen::Matrix<double, Eigen::Dynamic, 2> answer_;
  Eigen::Matrix2d inverse_;
  double off_ = 0;  ///< [m], of the right-hand side
};

const SpinModel& checked(const SpinModel& model, int last_node) {
  check_drives(model.drives, last_node);
  return model;
}

std::vector<Prescribed> resting(const std::vector<double>& x) {
  std::vector<Prescribed> marks;
  for (const double at : x) marks.push_back({at, 0, 0});
  return marks;
}

}  // namespace

template <int D>
SpinUnknowns<D>::SpinUnknowns(const CurrentBeam<D>& beam, const std::vector<double>& x)
    : beam_(beam),
      spin_(checked(*spin_model(beam.model()), static_cast<int>(x.size()) - 1),
            beam.marks() != nullptr ? *beam.marks() : resting(x), beam.model().formulation,
            beam.model().points_of_polynomials()) {}

template <int D>
void SpinUnknowns<D>::add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const {
  for (const FieldRun& run : spin_.fields(first)) runs.push_back(run);
}

template <int D>
void SpinUnknowns<D>::start(double* q, double* rate) {
  spin_.start(q + at(), rate + at());
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    const double pitch = spin_.model().pitch_of(beam_.joint_index(i)), x = q[beam_.places()[i].mark];
    if (pitch != 0) nut_.emplace(pitch, x, spin_.section(q + at(), rate + at(), x).at.angle);
  }
}

/// Events leave them alone.
template <int D>
void SpinUnknowns<D>::write(const ChainState<D>& /*chain*/, const double* old_q, const double* old_rate, double* q,
                            double* rate) const {
  if (old_q == nullptr) return;
  std::copy_n(old_q, count(), q + at());
  std::copy_n(old_rate, count(), rate + at());
}

template <int D>
std::optional<std::size_t> SpinUnknowns<D>::nut_place() const {
  for (std::size_t i = 0; nut_ && i < beam_.places().size(); ++i) {
    if (ties(i)) return i;
  }
  return std::nullopt;
}

template <int D>
typename Unknowns<D>::Tied SpinUnknowns<D>::tied(std::size_t joint, const double* q, const double* rate) const {
  const Nut::Place place = nut_->place(spin_, q + at(), rate + at(), q[beam_.places()[joint].mark]);
  return {place.x, place.rate};
}

template <int D>
bool SpinUnknowns<D>::accelerate(const double* q, const double* rate, double t, double* a, double& dissipated) {
  return spin_.accelerate(q + at(), rate + at(), t, a + at(), dissipated);
}

template <int D>
bool SpinUnknowns<D>::load(const double* q, const double* rate, double* a, std::vector<JointMotion<D>>& joints) {
  const auto which = nut_place();
  if (!which) return true;
  const Eigen::Index mark = beam_.places()[*which].mark;
  if (!nut_->couple(spin_, q + at(), rate + at(), a + at(), q[mark], rate[mark])) return false;
  joints[*which].x_inertia += nut_->load().inertia;
  a[mark] += nut_->load().force;
  return true;
}

template <int D>
void SpinUnknowns<D>::follow(const double* /*q*/, const double* /*rate*/, double* a) {
  by_nut_ = nullptr;
  if (const auto which = nut_place()) {
    by_nut_ = &nut_->torque(nut_->turn(a[beam_.places()[*which].mark], a + at()));
  }
}

template <int D>
EnergyBalance SpinUnknowns<D>::power(const double* q, const double* rate, const double* a, double t,
                                     const double* free) {
  Eigen::VectorXd by_nut;
  const auto which = nut_place();
  if (free != nullptr && which) by_nut = nut_torque(*which, q, rate, free[beam_.places()[*which].mark]);
  return spin_.power(q + at(), rate + at(), a + at(), t,
                     free == nullptr     ? by_nut_
                     : by_nut.size() > 0 ? &by_nut
                                         : nullptr);
}

template <int D>
double SpinUnknowns<D>::residual(const double* q, const double* v, const double* a, double t, double* r) {
  return spin_.residual(q + at(), v + at(), a + at(), t, r + at());
}

template <int D>
std::unique_ptr<UnknownsTangent<D>> SpinUnknowns<D>::new_tangent() {
  return std::make_unique<SpinView<D>>(*this);
}

template <int D>
void SpinUnknowns<D>::observe(const double* q, const double* rate, int points, Observation<D>& seen) const {
  const Spin::Seen turning = spin_.observe(q + at(), rate + at(), points);
  seen.energy.kinetic += turning.kinetic;
  seen.energy.torsion += turning.torsion;
  seen.momentum_about_axis += turning.momentum;
}

template <int D>
void SpinUnknowns<D>::observe_forces(const double* q, const double* v, const double* free,
                                     OuterForces<D>& forces) const {
  Eigen::VectorXd torques = Eigen::Map<const Eigen::VectorXd>(free + at(), count());
  if (const auto nut = nut_place()) {
    const double push = free[beam_.places()[*nut].mark];
    torques -= nut_torque(*nut, q, v, push);
    forces.guiding[static_cast<std::size_t>(beam_.joint_index(*nut))] = push;
  }
  forces.drives = spin_.drive_torques(torques.data());
}

template <int D>
void SpinRoom<D>::count(BalanceEntries& balance) const {
  balance.dissipated = balance.dissipated || section.damping != 0;
  balance.loads = balance.loads || torques.present();
  balance.ends = balance.ends || !drives.empty();
}

template <int D>
std::unique_ptr<Unknowns<D>> SpinRoom<D>::unknowns(const CurrentBeam<D>& beam, const std::vector<double>& x) const {
  return std::make_unique<SpinUnknowns<D>>(beam, x);
}

template class SpinUnknowns<2>;
template class SpinUnknowns<3>;
template class SpinRoom<2>;
template class SpinRoom<3>;

}  // namespace vlbeam
