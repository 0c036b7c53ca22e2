#include "mechanics/motion/joint/sliding_joint.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "mechanics/motion/joint/joint_side.hpp"

namespace vlbeam {
namespace {

/// Mass matrix of a joint's own unknowns, factored, and the conditions on their accelerations.
template <int D, int Unknowns>
class JointEquations {
 public:
  using Matrix = Eigen::Matrix<double, Unknowns, Unknowns>;
  using Column = Eigen::Matrix<double, Unknowns, 1>;

  /// Conditions C'' = 0 on the slopes, which stand behind r; none with one slope.
  JointEquations(const Matrix& mass, const SlidingJoint& joint, const JointMotion<D>& motion) : factor_(mass) {
    if constexpr (Unknowns == 3 * D + 1) {
      const SlopeConditions<D> conditions(joint.slopes, longest_axis<D>(motion.slopes.template head<D>()));
      gradients_.setZero();
      drift_.setZero();
      for (int i = 0; i < conditions.count(); ++i) {
        gradients_.col(i).template segment<2 * D>(D) = conditions.gradient(i, motion.slopes);
        drift_[i] = conditions.rate(i, motion.slope_rates, motion.slope_rates);
      }
      response_ = factor_.solve(gradients_);
      Square schur = gradients_.transpose() * response_;
      for (int i = conditions.count(); i < most; ++i) schur(i, i) = 1;  // conditions there are none of
      schur_inverse_ = schur.inverse();
    }
  }

  bool positive_definite() const { return factor_.info() == Eigen::Success; }

  /// Accelerations under the forces `f` of slopes that move, or of slopes at rest.
  Column solve(const Column& f, bool moving) const {
    Column a = factor_.solve(f);
    if constexpr (Unknowns == 3 * D + 1) {
      Few excess = gradients_.transpose() * a;
      if (moving) excess += drift_;
      a -= response_ * (schur_inverse_ * excess);
    }
    return a;
  }

 private:
  static constexpr int most = SlopeConditions<D>::most;
  using Few = Eigen::Matrix<double, most, 1>;
  using Square = Eigen::Matrix<double, most, most>;
  using Columns = Eigen::Matrix<double, Unknowns, most>;

  Eigen::LLT<Matrix, Eigen::Upper> factor_;
  Columns gradients_, response_;
  Few drift_;
  Square schur_inverse_;
};

/// Takes what `held` holds of the joint's place and slope out of its equations: there, a = 0.
template <int D, int Unknowns>
void hold(const Support<D>& held, Eigen::Matrix<double, Unknowns, Unknowns>& mass,
          Eigen::Matrix<double, Unknowns, 1>& rhs) {
  using Matrix = Eigen::Matrix<double, Unknowns, Unknowns>;
  Matrix keep = Matrix::Identity();
  const auto share = [&](const typename Support<D>::Components& free) -> Eigen::Matrix<double, D, D> {
    return held.frame * free.matrix().asDiagonal() * held.frame.transpose();
  };
  keep.template block<D, D>(0, 0) = share(held.free_position);
  keep.template block<D, D>(D, D) = share(held.free_slope);
  const Matrix whole = mass.template selfadjointView<Eigen::Upper>();
  // what is held has a mass of the size of what is free: the unit of mass must not matter
  Eigen::Matrix<double, Unknowns, 1> size = Eigen::Matrix<double, Unknowns, 1>::Zero();
  size.template segment<D>(0).setConstant(whole.template block<D, D>(0, 0).trace());
  size.template segment<D>(D).setConstant(whole.template block<D, D>(D, D).trace());
  mass = keep * whole * keep + size.asDiagonal() * (Matrix::Identity() - keep);
  rhs = keep * rhs;
}

template <int D, bool Kinked>
std::optional<double> solve(const Span<D>& left, const Span<D>& right, const MovingEquations<double, D>& left_element,
                            const MovingEquations<double, D>& right_element, const SlidingJoint& joint,
                            const JointMotion<D>& motion, const Support<D>* held, double* force, double* joint_force,
                            const BeamPart& part) {
  constexpr int unknowns = (Kinked ? 3 : 2) * D + 1, behind = (Kinked ? 2 : 1) * D, x = unknowns - 1;
  using Equations = JointEquations<D, unknowns>;
  using Column = typename Equations::Column;
  const int node = left.open() + 1;
  left.reduce(force, part.before);
  right.reduce(force, part.behind);
  typename Equations::Matrix mass = Equations::Matrix::Zero();
  Column rhs;
  rhs.template segment<D>(0) = position<D>(force, node);
  rhs.template segment<D>(D) = slope<D>(force, node);
  if constexpr (Kinked) rhs.template segment<D>(behind) = Eigen::Map<const Vec<double, D>>(joint_force + 1);
  rhs[x] = *joint_force;
  mass.diagonal().template head<D>().array() += joint.mass;
  mass(x, x) += motion.x_inertia;
  JointSide<D, unknowns, D> left_side(left, left_element, 2);
  JointSide<D, unknowns, behind> right_side(right, right_element, 0);
  left_side.eliminate(force, mass, rhs);
  right_side.eliminate(force, mass, rhs);
  const Eigen::Matrix<double, D, unknowns> row = mass.template topRows<D>();
  const Vec<double, D> on_node = rhs.template head<D>();
  if (held != nullptr) hold<D, unknowns>(*held, mass, rhs);
  const Equations equations(mass, joint, motion);
  if (!equations.positive_definite()) return std::nullopt;
  Column a = equations.solve(rhs, true);
  double dissipation = 0;
  if (joint.friction) {
    // the beam pulls at the joint by what accelerates its mass, and by what its node lacks where that is held
    const auto pull = [&](const Column& by, const Vec<double, D>& acting, const Vec<double, D>& gravity) {
      Vec<double, D> sum = joint.mass * (by.template head<D>() - gravity);
      if (held != nullptr) sum += acting - row * by;
      return sum;
    };
    const Vec<double, D> none = Vec<double, D>::Zero();
    const auto contact = motion.contact(joint);
    const double share = contact.share(*joint.friction, motion.x_rate);
    const Column by_friction = equations.solve(contact.stretch() * Column::Unit(x), false);
    const auto pressing = pressing_force<D>(contact.pressing(pull(a, on_node, motion.gravity)),
                                            contact.pressing(pull(by_friction, none, none)), share);
    if (!pressing) return std::nullopt;
    a -= share * *pressing * by_friction;
    dissipation = share * *pressing * contact.stretch() * motion.x_rate;
  }
  left_side.substitute(a, force);
  right_side.substitute(a, force);
  position<D>(force, node) = a.template segment<D>(0);
  slope<D>(force, node) = a.template segment<D>(D);
  if constexpr (Kinked) Eigen::Map<Vec<double, D>>(joint_force + 1) = a.template segment<D>(behind);
  *joint_force = a[x];
  left.substitute(force, part.before);
  right.substitute(force, part.behind);
  return dissipation;
}

}  // namespace

template <int D>
std::optional<double> solve_with_joint(const Span<D>& left, const Span<D>& right,
                                       const MovingEquations<double, D>& left_element,
                                       const MovingEquations<double, D>& right_element, const SlidingJoint& joint,
                                       const JointMotion<D>& motion, const Support<D>* held, double* force,
                                       double* joint_force, const BeamPart& part) {
  const auto solution = joint.kinked() ? solve<D, true> : solve<D, false>;
  return solution(left, right, left_element, right_element, joint, motion, held, force, joint_force, part);
}

template <int D>
void solve_without_joint(const Span<D>& left, const Span<D>& right, double* force) {
  constexpr int unknowns = 2 * D;
  left.reduce(force);
  right.reduce(force);
  Eigen::Matrix<double, unknowns, unknowns> mass = Eigen::Matrix<double, unknowns, unknowns>::Zero();
  for (const Span<D>* span : {&left, &right}) {
    const auto& frame = span->support().frame;
    const auto& block = span->open_mass();
    mass.template block<D, D>(0, 0) += frame * block.rr.matrix().asDiagonal() * frame.transpose();
    mass.template block<D, D>(0, D) += frame * block.rs.matrix().asDiagonal() * frame.transpose();
    mass.template block<D, D>(D, D) += frame * block.ss.matrix().asDiagonal() * frame.transpose();
  }
  Eigen::Map<Eigen::Matrix<double, unknowns, 1>> at_node(force + node_size<D> * left.open());
  at_node = mass.template selfadjointView<Eigen::Upper>().llt().solve(at_node.eval());
  left.substitute(force);
  right.substitute(force);
}

template std::optional<double> solve_with_joint(const Span<2>&, const Span<2>&, const MovingEquations<double, 2>&,
                                                const MovingEquations<double, 2>&, const SlidingJoint&,
                                                const JointMotion<2>&, const Support<2>*, double*, double*,
                                                const BeamPart&);
template void solve_without_joint(const Span<2>&, const Span<2>&, double*);
template std::optional<double> solve_with_joint(const Span<3>&, const Span<3>&, const MovingEquations<double, 3>&,
                                                const MovingEquations<double, 3>&, const SlidingJoint&,
                                                const JointMotion<3>&, const Support<3>*, double*, double*,
                                                const BeamPart&);
template void solve_without_joint(const Span<3>&, const Span<3>&, double*);

}  // namespace vlbeam
