#include "mechanics/time/newton_stop.hpp"

#include <cstdint>
#include <limits>

namespace vlbeam {
namespace {

constexpr double rounding_share = 8;       // of a residual's own rounding over that of one perturbation
constexpr double negligible_share = 1e-9;  // of the coordinates
constexpr double far_below = 1e-3;         // of the increment: slow contraction there may be rounding
constexpr double stagnant = 0.5;           // contraction that may be rounding anywhere

/// Of multipliers infinite: they are no sizes of anything.
FieldNorms sizes_of(const std::vector<FieldRun>& fields, const Eigen::VectorXd& q) {
  FieldNorms sizes = field_norms(fields, q);
  const auto at = [&](Field field) -> double& { return sizes[static_cast<std::size_t>(field)]; };
  const double length = at(Field::position);
  for (const Field field : {Field::mark, Field::mass}) at(field) = std::max(at(field), length);
  for (const Field field : {Field::slope, Field::angle}) at(field) = std::max(at(field), 1.0);
  at(Field::twist) = std::max(at(Field::twist), 1 / length);
  for (const Field field : {Field::multiplier, Field::slope_multiplier}) {
    at(field) = std::numeric_limits<double>::infinity();
  }
  return sizes;
}

}  // namespace

double relative_to_coordinates(const std::vector<FieldRun>& fields, const Eigen::VectorXd& x,
                               const Eigen::VectorXd& q) {
  const FieldNorms of_x = field_norms(fields, x), sizes = sizes_of(fields, q);
  double largest = 0;
  for (std::size_t f = 0; f < field_count; ++f) {
    if (of_x[f] > 0) largest = std::max(largest, of_x[f] / sizes[f]);
  }
  return largest;
}

double NewtonStop::relative_error(double times) const {
  double largest = 0;
  for (std::size_t f = 0; f < field_count; ++f) {
    if (correction_[f] <= (noise_known_ ? times * noise_[f] : 0)) continue;
    largest = std::max(largest, correction_[f] / increment_[f]);
  }
  return largest;
}

NewtonStop::Verdict NewtonStop::judge(const Eigen::VectorXd& r, const Eigen::VectorXd& d, double tolerance,
                                      double slow) {
  const double previous = error_;
  before_ = correction_;
  if (++corrections_ <= 3) {
    const auto [correction, increment] = field_norms<2>(fields_, {&r, &d});
    correction_ = correction;
    increment_ = increment;
    // A mark that is wrong moves points of the beam by as much, and no more matters: one that hardly moves itself has
    // corrections that are rounding from the first one on.
    double& mark = increment_[static_cast<std::size_t>(Field::mark)];
    mark = std::max(mark, increment_[static_cast<std::size_t>(Field::position)]);
  } else {  // the increment changes by next to nothing
    correction_ = field_norms(fields_, r);
  }
  error_ = relative_error(1);
  contraction_ = previous > 0 ? error_ / previous : 0;
  if (std::isnan(contraction_)) contraction_ = 1;  // corrections of a field that does not move at all
  slowest_ = std::max(slowest_, contraction_);
  if (error_ == 0) return Verdict::done;
  if (!first_of_tangent_) of_tangent_ = contraction_ < 1 ? std::max(of_tangent_, contraction_) : 0;
  first_of_tangent_ = false;
  const double theta = std::max(of_tangent_, contraction_);
  const bool known = previous > 0 || theta > 0;
  if (known && theta < 1 && theta / (1 - theta) * error_ <= tolerance) return Verdict::done;
  if (previous == 0) return Verdict::go_on;
  if (contraction_ <= slow) return Verdict::go_on;
  return !noise_known_ && (error_ < far_below || contraction_ > stagnant) ? Verdict::stagnates : Verdict::slow;
}

FieldNorms NewtonStop::largest_rounding(const Eigen::VectorXd& q) const {
  FieldNorms sizes = sizes_of(fields_, q);
  for (double& size : sizes) size *= negligible_share;
  return sizes;
}

bool NewtonStop::negligible(const Eigen::VectorXd& q) const {
  const FieldNorms largest = largest_rounding(q);
  for (std::size_t f = 0; f < field_count; ++f) {
    if (!(correction_[f] <= largest[f])) return false;
  }
  return true;
}

bool NewtonStop::falls() const {
  if (corrections_ < 2) return true;  // what was before belongs to another step
  for (std::size_t f = 0; f < field_count; ++f) {
    if (correction_[f] > newton_rounding * increment_[f] && correction_[f] <= stagnant * before_[f]) return true;
  }
  return false;
}

bool NewtonStop::grows(double limit, const Eigen::VectorXd& q) const {
  const FieldNorms largest = largest_rounding(q);
  for (std::size_t f = 0; f < field_count; ++f) {
    if (correction_[f] > largest[f] && correction_[f] > limit * before_[f]) return true;
  }
  return false;
}

void NewtonStop::perturb(Eigen::VectorXd& x) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  in_pieces(x.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i) {
      const bool up = (static_cast<std::uint32_t>(i) * 2654435761U >> 31U) != 0;  // without a pattern
      x[i] *= up ? 1 + eps : 1 - eps;
    }
  });
}

void NewtonStop::set_noise(const Eigen::VectorXd& change, const Eigen::VectorXd& q) {
  const FieldNorms largest = largest_rounding(q);
  noise_ = field_norms(fields_, change);
  for (std::size_t f = 0; f < field_count; ++f) noise_[f] = std::min(rounding_share * noise_[f], largest[f]);
  noise_known_ = true;
  noise_age_ = 0;
}

}  // namespace vlbeam
