#include "mechanics/vehicles/vehicles.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

template <int D>
ActingAxles<D>::ActingAxles(Axles<D> axles) : axles_(std::move(axles)) {
  for (const Axle& axle : axles_.all) own_.push_back(axle.sprung() ? sprung_++ : -1);
}

template <int D>
std::pair<double, double> ActingAxles<D>::road(std::size_t which, const ChainView<D>& beam, double t) const {
  const auto x = axles_.on_beam(which, beam, t);
  if (!x) return {axles_.road(which, beam, t), 0};
  const int k = beam.element_at(x->value);
  const WheelMotion<double, D> wheel(point_at<double, D>(beam.kinematics(k), x->value), axles_.up, *x);
  return {wheel.height, wheel.rate};
}

template <int D>
double ActingAxles<D>::push(std::size_t which, const Motion<D>& motion) const {
  const Axle& axle = axles_.all[which];
  const double g = -axles_.up.dot(motion.gravity);
  double push = axle.force + (axle.mass + axle.sprung_mass) * g;
  if (!axle.sprung()) return push;
  const auto [height, rate] = road(which, motion.beam, motion.t);
  const Eigen::Index at = this->height(which);
  return push - axle.stiffness * (motion.beam.q[at] - height) - axle.damping * (motion.beam.rate[at] - rate);
}

template <int D>
EnergyBalance ActingAxles<D>::add_force(const Motion<D>& motion, double* force) const {
  EnergyBalance power;
  for (std::size_t i = 0; i < axles_.all.size(); ++i) {
    const Axle& axle = axles_.all[i];
    double down = push(i, motion);
    if (axle.sprung()) {
      const double g = -axles_.up.dot(motion.gravity);
      force[height(i)] += down - axle.force - (axle.mass + axle.sprung_mass) * g;
    }
    const auto x = axles_.on_beam(i, motion.beam, motion.t);
    if (!x) continue;
    const int k = motion.beam.element_at(x->value);
    const PointMotion<double, D> at = point_at<double, D>(motion.beam.kinematics(k), x->value);
    if (motion.a != nullptr && axle.mass > 0) {  // else the beam carries it: add_carried()
      const WheelMotion<double, D> wheel(at, axles_.up, *x);
      double acceleration = wheel.convective;
      for (int n = 0; n < 4; ++n) {
        acceleration += at.s[static_cast<std::size_t>(n)] *
                        axles_.up.dot(Eigen::Map<const Vec<double, D>>(motion.a + motion.beam.vector(k, n)));
      }
      if (const JointPlace* a = motion.beam.joint_at(k)) acceleration += axles_.up.dot(at.y_a) * motion.a[a->mark];
      if (const JointPlace* b = motion.beam.joint_at(k + 1)) acceleration += axles_.up.dot(at.y_b) * motion.a[b->mark];
      down += axle.mass * acceleration;
    }
    add_point_force<D>(motion.beam, k, at, {-down * axles_.up, Vec<double, D>::Zero()}, force);
    power.loads -= down * axles_.up.dot(at.v);
  }
  return power;
}

template <int D>
void ActingAxles<D>::add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  using Real = ElementReal<D>;
  couplings_.clear();
  for (std::size_t i = 0; i < axles_.all.size(); ++i) {
    const Axle& axle = axles_.all[i];
    const double own = by.a * axle.sprung_mass + by.v * axle.damping + by.q * axle.stiffness;
    const auto x = axles_.on_beam(i, motion.beam, motion.t);
    if (!x) {
      if (axle.sprung()) couplings_.push_back({i, -1, own});
      continue;
    }
    const int k = motion.beam.element_at(x->value);
    const Vec<Real, D> up = axles_.up.template cast<Real>();
    const double g = -axles_.up.dot(motion.gravity), still = axle.force + (axle.mass + axle.sprung_mass) * g,
                 z = axle.sprung() ? motion.beam.q[height(i)] : 0,
                 z_rate = axle.sprung() ? motion.beam.rate[height(i)] : 0;
    Coupling coupling{i, k, own};
    const auto force = [&](const PointMotion<Real, D>& at, const Vec<Real, D>& acceleration) {
      const WheelMotion<Real, D> wheel(at, up, *x);
      Real down(still);
      if (axle.sprung()) {
        down += (wheel.height - Real(z)) * Real(axle.stiffness) + (wheel.rate - Real(z_rate)) * Real(axle.damping);
        const Real pull = wheel.height * Real(axle.stiffness) + wheel.rate * Real(axle.damping);
        coupling.row = -pull.derivatives();
      }
      if (axle.mass > 0) {
        const Real total = up.dot(acceleration) + wheel.convective - up.dot(at.remainder);
        down += total * Real(axle.mass);
      }
      PointForce<Real, D> f;
      f.on_r = up * Real(-down);
      return f;
    };
    tangent.add_point(motion.beam, k,
                      point_tangent<D>(motion.beam, k, x->value, motion.a != nullptr ? motion.a : motion.beam.rate,
                                       motion.a != nullptr ? by : TangentWeights{by.q, by.v, 0}, force));
    if (!axle.sprung()) continue;
    const PointMotion<double, D> at = point_at<double, D>(motion.beam.kinematics(k), x->value);
    const double share = -(by.q * axle.stiffness + by.v * axle.damping);
    for (int n = 0; n < 4; ++n) {
      coupling.column.template segment<D>(D * n) = share * at.s[static_cast<std::size_t>(n)] * axles_.up;
    }
    coupling.column[4 * D] = motion.beam.joint_at(k) != nullptr ? share * axles_.up.dot(at.y_a) : 0;
    coupling.column[4 * D + 1] = motion.beam.joint_at(k + 1) != nullptr ? share * axles_.up.dot(at.y_b) : 0;
    couplings_.push_back(std::move(coupling));
  }
}

namespace {

/// Heights of sprung masses, each of which couples to one element: they are condensed onto the beam's tangent.
template <int D>
class HeightsTangent final : public UnknownsTangent<D> {
 public:
  HeightsTangent(const CurrentBeam<D>& beam, const ActingAxles<D>& acting) : beam_(beam), acting_(acting) {}

  void constrain(const double* /*q*/, const double* /*v*/, const double* /*a*/, double /*t*/,
                 double* /*r*/) const override {}
  bool prepare(const TangentWeights& /*by*/, double /*size*/, BeamMatrix<D>& beam) override {
    couplings_ = acting_.couplings();
    heights_.clear();
    places_.clear();
    const ChainView<D> view = beam_.view(nullptr, nullptr);
    all_.setZero(beam_.coordinates());
    for (auto& coupling : couplings_) {
      if (!(coupling.own > 0)) return false;
      heights_.push_back(acting_.height(coupling.axle));
      auto& at = places_.emplace_back();
      at.fill(-1);
      if (coupling.element < 0) continue;
      for (int i = 0; i < 4 * D; ++i) at[static_cast<std::size_t>(i)] = view.vector(coupling.element, i / D) + i % D;
      for (int e = 0; e < 2; ++e) {
        if (const JointPlace* joint = view.joint_at(coupling.element + e)) {
          if (!is_guided(joint)) at[static_cast<std::size_t>(4 * D + e)] = joint->mark;
        }
      }
      if (beam_.model().constraints == Constraints::eliminated) {
        project(at, coupling.row);
        project(at, coupling.column);
      }
      beam.add_point(view, coupling.element,
                     PointMatrix<D>(-coupling.column * coupling.row.transpose() / coupling.own));
    }
    return true;
  }
  bool ties() const override { return false; }
  void complete(const double* /*q*/, const double* /*v*/, const double* /*free*/,
                const BeamMatrix<D>& /*beam*/) override {}
  void solve_before(double* r) override {
    each([&](const auto& coupling, Eigen::Index height, const auto& at) {
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (at[i] >= 0) r[at[i]] -= coupling.column[static_cast<Eigen::Index>(i)] * r[height] / coupling.own;
      }
    });
  }
  void solve_after(double* r) const override {
    each([&](const auto& coupling, Eigen::Index height, const auto& at) {
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (at[i] >= 0) r[height] -= coupling.row[static_cast<Eigen::Index>(i)] * r[at[i]];
      }
      r[height] /= coupling.own;
    });
  }
  void expand(const TangentWeights& /*by*/, Eigen::MatrixXd& dense) override {
    dense.setZero(acting_.sprung(), acting_.sprung());
    for (std::size_t i = 0; i < couplings_.size(); ++i) {
      dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) = couplings_[i].own;
    }
  }

 private:
  using Places = std::array<Eigen::Index, point_coordinates<D>>;

  template <class Function>
  void each(const Function& function) const {
    for (std::size_t i = 0; i < couplings_.size(); ++i) function(couplings_[i], heights_[i], places_[i]);
  }
  bool is_guided(const JointPlace* joint) const {
    return beam_.guides(static_cast<std::size_t>(joint - beam_.places().data()));
  }
  /// What supports hold of the coordinates is out of the beam's tangent already.
  void project(const Places& at, Eigen::Matrix<double, point_coordinates<D>, 1>& values) {
    const auto each_place = [&](const auto& function) {
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (at[i] >= 0) function(all_[at[i]], values[static_cast<Eigen::Index>(i)]);
      }
    };
    each_place([](double& entry, double value) { entry = value; });
    beam_.supports().project(all_.data());
    each_place([](double& entry, double& value) { value = std::exchange(entry, 0); });
  }

  const CurrentBeam<D>& beam_;
  const ActingAxles<D>& acting_;
  std::vector<typename ActingAxles<D>::Coupling> couplings_;
  std::vector<Eigen::Index> heights_;
  std::vector<Places> places_;  ///< of an element's coordinates, -1 for none
  Eigen::VectorXd all_;         ///< zero but in project()
};

template <int D>
class Heights final : public Unknowns<D> {
 public:
  Heights(const CurrentBeam<D>& beam, std::shared_ptr<const ActingAxles<D>> acting)
      : beam_(beam), acting_(std::move(acting)) {}

  Eigen::Index count() const override { return acting_->sprung(); }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override {
    if (count() > 0) runs.push_back({Field::mass, first, 1, 1, count()});
  }
  void adopt() override { acting_->stand_at(beam_.angles()); }
  void start(double* q, double* rate) override {
    const ChainView<D> view = beam_.view(q, rate);
    each([&](std::size_t i, Eigen::Index at) { std::tie(q[at], rate[at]) = acting_->road(i, view, 0); });
  }
  void write(const ChainState<D>& /*chain*/, const double* old_q, const double* old_rate, double* q,
             double* rate) const override {
    if (old_q == nullptr) return;
    std::copy_n(old_q, count(), q + beam_.angles());
    std::copy_n(old_rate, count(), rate + beam_.angles());
  }

  bool accelerate(const double* /*q*/, const double* /*rate*/, double /*t*/, double* a, double& /*lost*/) override {
    each([&](std::size_t i, Eigen::Index at) { a[at] /= acting_->axles().all[i].sprung_mass; });
    return true;
  }
  bool load(const double* /*q*/, const double* /*rate*/, double* /*a*/,
            std::vector<JointMotion<D>>& /*joints*/) override {
    return true;
  }
  void follow(const double* /*q*/, const double* /*rate*/, double* /*a*/) override {}
  double residual(const double* /*q*/, const double* /*v*/, const double* a, double /*t*/, double* r) override {
    inertia_onto(a, r, true);
    return 0;
  }
  void inertia(const double* a, double* r) const override { inertia_onto(a, r, false); }
  std::unique_ptr<UnknownsTangent<D>> new_tangent() override {
    return std::make_unique<HeightsTangent<D>>(beam_, *acting_);
  }
  void observe(const double* /*q*/, const double* /*rate*/, int /*points*/, Observation<D>& /*seen*/) const override {}

 private:
  template <class Function>
  void each(const Function& function) const {
    for (std::size_t i = 0; i < acting_->axles().all.size(); ++i) {
      if (acting_->axles().all[i].sprung()) function(i, acting_->height(i));
    }
  }
  void inertia_onto(const double* a, double* r, bool add) const {
    each([&](std::size_t i, Eigen::Index at) {
      const double size = acting_->axles().all[i].sprung_mass * a[at];
      r[at] = add ? r[at] + size : size;
    });
  }

  const CurrentBeam<D>& beam_;
  std::shared_ptr<const ActingAxles<D>> acting_;
};

}  // namespace

template <int D>
std::unique_ptr<Unknowns<D>> Vehicles<D>::unknowns(const CurrentBeam<D>& beam, const std::vector<double>& /*x*/) const {
  return std::make_unique<Heights<D>>(beam, acting_);
}

template <int D>
void Vehicles<D>::add_carried(const ChainView<D>& beam, double t, std::vector<BeamLink<D>>& carried) const {
  const Axles<D>& axles = acting_->axles();
  for (std::size_t i = 0; i < axles.all.size(); ++i) {
    if (axles.all[i].mass == 0) continue;
    const auto x = axles.on_beam(i, beam, t);
    if (x) carried.push_back(BeamLink<D>::carrying(axles.all[i].mass, *x, axles.up));
  }
}

template class ActingAxles<2>;
template class ActingAxles<3>;
template class Vehicles<2>;
template class Vehicles<3>;

}  // namespace vlbeam
