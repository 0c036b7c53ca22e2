#include "mechanics/assembly/body.hpp"

#include <Eigen/LU>
#include <stdexcept>

namespace vlbeam {
namespace {

template <int D>
Vec<double, 3> in_space(const Vec<double, D>& r) {
  Vec<double, 3> point = Vec<double, 3>::Zero();
  point.template head<D>() = r;
  return point;
}

/// spin x r.
template <int D>
Vec<double, D> turned(const Vec<double, 3>& spin, const Vec<double, D>& r) {
  return spin.cross(in_space<D>(r)).template head<D>();
}

template <int D>
class BodyEquations final : public SecondOrderSystem {
 public:
  explicit BodyEquations(BodySystem<D>& body)
      : body_(body),
        own_(body.coordinates()),
        masses_(body.masses()),
        unit_(masses_.tail(own_ - D).sum() / std::max<double>(static_cast<double>(own_ - D), 1)) {}

  Eigen::Index coordinates() const override { return own_ + body_.multipliers(); }
  Eigen::Index multipliers() const override { return body_.multipliers(); }
  std::vector<FieldRun> fields() const override {
    std::vector<FieldRun> runs = body_.fields();
    if (multipliers() > 0) runs.push_back({Field::slope_multiplier, own_, 1, 1, multipliers()});
    return runs;
  }
  void expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const override {
    q.setZero(coordinates());
    v.setZero(coordinates());
    q.head(own_) = y.head(own_);
    v.head(own_) = y.segment(own_, own_);
  }
  void contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const override {
    y.head(own_) = q.head(own_);
    y.segment(own_, own_) = v.head(own_);
  }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override {
    a.setZero(coordinates());
    body_.add_forces(q.data(), nullptr, t, a.data());
    const Eigen::Index m = multipliers();
    if (m == 0) {
      a.array() /= masses_.array();
      return;
    }
    // M a + G^T unit l = f, G a = -(G v)'
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(own_ + m, own_ + m);
    const Eigen::MatrixXd rows = body_.gradients(q.data());
    whole.topLeftCorner(own_, own_).diagonal() = masses_;
    whole.topRightCorner(own_, m) = unit_ * rows.transpose();
    whole.bottomLeftCorner(m, own_) = unit_ * rows;
    for (int i = 0; i < m; ++i) {
      const auto [first, second] = BodySystem<D>::pair(i);
      a[own_ + i] = -unit_ * (first == second ? 1 : 2) * axis(v, first).dot(axis(v, second));
    }
    a = whole.partialPivLu().solve(a).eval();
  }
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& /*v*/, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override {
    r.setZero(coordinates());
    body_.add_forces(q.data(), nullptr, t, r.data());
    r.head(own_) = (masses_.array() * a.head(own_).array()).matrix() - r.head(own_);
    if (multipliers() == 0) return 0;
    r.head(own_) += body_.gradients(q.data()).transpose() * (unit_ * a.tail(multipliers()));
    body_.conditions(q.data(), r.data() + own_);
    return 0;
  }
  bool inertia(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& a, double /*t*/, Eigen::VectorXd& r) override {
    r.setZero(coordinates());
    r.head(own_) = (masses_.array() * a.head(own_).array()).matrix();
    return true;
  }
  ConstraintResidual constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                         double /*t*/) const override {
    ConstraintResidual largest;
    if (multipliers() == 0) return largest;
    Eigen::VectorXd values(multipliers());
    body_.conditions(q.data(), values.data());
    largest.position = values.cwiseAbs().maxCoeff();
    largest.velocity = (body_.gradients(q.data()) * v.head(own_)).cwiseAbs().maxCoeff();
    return largest;
  }
  double turning(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const override {
    return body_.model().turns() ? body_.spin(q.data(), v.data()).norm() : 0;
  }
  BalanceEntries balance() const override { return body_.balance(); }
  EnergyBalance supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& /*a*/,
                               double t) override {
    EnergyBalance power;
    Eigen::VectorXd none = Eigen::VectorXd::Zero(own_);
    power.loads = body_.add_forces(q.data(), v.data(), t, none.data());
    return power;
  }
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& /*v*/, const Eigen::VectorXd& a, double t,
                 const TangentWeights& by) override {
    const Eigen::Index m = multipliers();
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(own_ + m, own_ + m);
    whole.diagonal().head(own_) = by.a * masses_;
    scale_ = by.a * unit_;
    if (m > 0) {
      for (int i = 0; i < m; ++i) {
        const auto [first, second] = BodySystem<D>::pair(i);
        const Eigen::Index at = D * (1 + first), other = D * (1 + second);
        whole.template block<D, D>(at, other).diagonal().array() += by.q * unit_ * a[own_ + i];
        if (first != second) whole.template block<D, D>(other, at).diagonal().array() += by.q * unit_ * a[own_ + i];
      }
      const Eigen::MatrixXd rows = scale_ * body_.gradients(q.data());
      whole.topRightCorner(own_, m) = rows.transpose();
      whole.bottomLeftCorner(m, own_) = rows;
    }
    for (const BodyLoad<D>& load : body_.model().loads) {  // a torque turns the axes as they are
      if (load.place) continue;
      const Vec<double, 3> torque = load.value(t);
      for (int i = 0; i < D; ++i) {
        for (int c = 0; c < D; ++c) {
          whole.template block<D, 1>(D * (1 + i), D * (1 + i) + c) -=
              by.q / 2 * turned<D>(torque, Vec<double, D>::Unit(c));
        }
      }
    }
    factors_.compute(whole);
    return true;
  }
  void solve(Eigen::VectorXd& r) const override {
    r.tail(multipliers()) *= scale_;
    r = factors_.solve(r).eval();
  }

 private:
  static Eigen::Map<const Vec<double, D>> axis(const Eigen::VectorXd& q, int i) {
    return Eigen::Map<const Vec<double, D>>(q.data() + D * (1 + i));
  }

  BodySystem<D>& body_;
  Eigen::Index own_;
  Eigen::VectorXd masses_;
  double unit_;  ///< makes an acceleration of a multiplier [kg m^2]
  double scale_ = 1;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace

template <int D>
BodySystem<D>::BodySystem(BodyModel<D> model) : model_(std::move(model)), ramp_(model_.gravity, model_.gravity_ramp) {}

template <int D>
Eigen::VectorXd BodySystem<D>::initial_state() const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const Eigen::Index n = coordinates();
  y.head<D>() = model_.center;
  y.segment<D>(n) = model_.velocity;
  if (!model_.turns()) return y;
  for (int i = 0; i < D; ++i) {
    y.segment<D>(D * (1 + i)) = model_.axes.col(i);
    y.segment<D>(n + D * (1 + i)) = turned<D>(model_.spin, model_.axes.col(i));
  }
  return y;
}

template <int D>
Handle<D> BodySystem<D>::direction(const Vec<double, D>& place) const {
  Handle<D> handle;
  for (int i = 0; i < D; ++i) {
    if (place[i] != 0) handle.shares.push_back({D * (1 + i), place[i]});
  }
  return handle;
}

template <int D>
Handle<D> BodySystem<D>::point(const Vec<double, D>& place) const {
  Handle<D> handle = direction(place);
  handle.shares.insert(handle.shares.begin(), {0, 1.0});
  return handle;
}

template <int D>
std::vector<FieldRun> BodySystem<D>::fields() const {
  std::vector<FieldRun> runs{{Field::position, 0, D, D, 1}};
  if (model_.turns()) runs.push_back({Field::slope, D, D, D, D});
  return runs;
}

template <int D>
void BodySystem<D>::rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  BodyEquations<D> equations(*this);
  Eigen::VectorXd q, v, a;
  equations.expand(y, q, v);
  equations.acceleration(q, v, t, a);
  const Eigen::Index n = coordinates();
  dydt.setZero(y.size());
  dydt.head(n) = v.head(n);
  dydt.segment(n, n) = a.head(n);
  balance().add(equations.supplied_power(q, v, a, t), dydt);
}

template <int D>
void BodySystem<D>::jacobian(const Eigen::VectorXd& /*y*/, double /*t*/, Eigen::MatrixXd& /*dfdy*/,
                             Eigen::VectorXd& /*dfdt*/) {
  throw std::logic_error("a body has no Jacobian of its right-hand side");
}

template <int D>
std::unique_ptr<SecondOrderSystem> BodySystem<D>::new_second_order() {
  return std::make_unique<BodyEquations<D>>(*this);
}

template <int D>
bool BodySystem<D>::proceed(const Eigen::VectorXd& y, double t) {
  if (ramp_.due(t)) {
    const Vec<double, D> at = y.head<D>(), velocity = y.segment<D>(coordinates());
    ramp_.advance(t, {model_.mass * at, model_.mass * velocity});
  }
  return true;
}

template <int D>
Observation<D> BodySystem<D>::observe(const Eigen::VectorXd& y, double t) const {
  Observation<D> seen;
  const double *const q = y.data(), *const rate = q + coordinates();
  const Vec<double, D> at = y.head<D>(), velocity = y.segment<D>(coordinates());
  seen.add_mass(model_.mass, at, velocity, model_.gravity_at(t));
  seen.mass = model_.mass;
  if (model_.turns()) {
    const Vec<double, D> moments = model_.second_moments();
    for (int i = 0; i < D; ++i) {
      const Vec<double, D> axis = Eigen::Map<const Vec<double, D>>(q + D * (1 + i)),
                           turning = Eigen::Map<const Vec<double, D>>(rate + D * (1 + i));
      seen.energy.kinetic += 0.5 * moments[i] * turning.squaredNorm();
      seen.angular_momentum += moments[i] * moment_about_origin(axis, turning);
    }
  }
  seen.energy.supplied = ramp_.until(t, {seen.mass_moment, seen.momentum});
  seen.load_work = balance().of(y).loads;
  return seen;
}

template <int D>
Eigen::Matrix<double, D, D> BodySystem<D>::axes(const double* q) const {
  if (!model_.turns()) return Eigen::Matrix<double, D, D>::Identity();
  return Eigen::Map<const Eigen::Matrix<double, D, D>>(q + D);
}

template <int D>
Vec<double, 3> BodySystem<D>::spin(const double* q, const double* rate) const {
  Vec<double, 3> sum = Vec<double, 3>::Zero();  // sum d_i x d_i' = 2 w in space, w in the plane's normal twice too
  if (!model_.turns()) return sum;
  for (int i = 0; i < D; ++i) {
    sum += in_space<D>(Eigen::Map<const Vec<double, D>>(q + D * (1 + i)))
               .cross(in_space<D>(Eigen::Map<const Vec<double, D>>(rate + D * (1 + i))));
  }
  return sum / 2;
}

template <int D>
double BodySystem<D>::add_forces(const double* q, const double* rate, double t, double* force) const {
  Eigen::Map<Vec<double, D>>(force) += model_.mass * model_.gravity_at(t);
  forces_.add_to(force);
  double power = 0;
  for (const BodyLoad<D>& load : model_.loads) {
    const Vec<double, 3> value = load.value(t);
    if (load.place) {
      const Vec<double, D> along = value.head<D>();
      const Handle<D> at = point(*load.place);
      at.add_force(along, force);
      if (rate != nullptr) power += along.dot(at.rate(rate));
      continue;
    }
    for (int i = 0; i < D; ++i) {  // half of torque x d_i on each axis: all of them together have that torque
      const Vec<double, D> half = turned<D>(value, Eigen::Map<const Vec<double, D>>(q + D * (1 + i))) / 2;
      Eigen::Map<Vec<double, D>>(force + D * (1 + i)) += half;
      if (rate != nullptr) power += half.dot(Eigen::Map<const Vec<double, D>>(rate + D * (1 + i)));
    }
  }
  return power;
}

template <int D>
bool BodySystem<D>::square_up(Eigen::VectorXd& y) const {
  if (!model_.turns()) return false;
  const Eigen::Index n = coordinates();
  const Eigen::VectorXd by_mass = masses().cwiseInverse();
  const auto remove = [&](auto&& part, const Eigen::VectorXd& off) {
    const Eigen::MatrixXd rows = gradients(y.data()), pull = by_mass.asDiagonal() * rows.transpose();
    part -= pull * (rows * pull).partialPivLu().solve(off);
  };
  Eigen::VectorXd off(multipliers());
  conditions(y.data(), off.data());
  remove(y.head(n), off);
  remove(y.segment(n, n), gradients(y.data()) * y.segment(n, n));
  return true;
}

template <int D>
Eigen::VectorXd BodySystem<D>::masses() const {
  Eigen::VectorXd masses = Eigen::VectorXd::Constant(coordinates(), model_.mass);
  const Vec<double, D> moments = model_.second_moments();
  for (int i = 0; i < D && model_.turns(); ++i) masses.segment<D>(D * (1 + i)).setConstant(moments[i]);
  return masses;
}

template <int D>
std::pair<int, int> BodySystem<D>::pair(int condition) {
  if (condition < D) return {condition, condition};
  const int other = condition - D;  // 01, 12, 02
  return other == 2 ? std::pair{0, 2} : std::pair{other, other + 1};
}

template <int D>
void BodySystem<D>::conditions(const double* q, double* values) const {
  for (int i = 0; i < pairs; ++i) {
    const auto [first, second] = pair(i);
    const Eigen::Map<const Vec<double, D>> a(q + D * (1 + first)), b(q + D * (1 + second));
    values[i] = first == second ? (a.squaredNorm() - 1) / 2 : a.dot(b);
  }
}

template <int D>
Eigen::MatrixXd BodySystem<D>::gradients(const double* q) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(pairs, coordinates());
  for (int i = 0; i < pairs; ++i) {
    const auto [first, second] = pair(i);
    const Eigen::Map<const Vec<double, D>> a(q + D * (1 + first)), b(q + D * (1 + second));
    rows.template block<1, D>(i, D * (1 + first)) += b.transpose();
    if (first != second) rows.template block<1, D>(i, D * (1 + second)) += a.transpose();
  }
  return rows;
}

template class BodySystem<2>;
template class BodySystem<3>;

}  // namespace vlbeam
