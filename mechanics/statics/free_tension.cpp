#include "mechanics/statics/free_tension.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {

template <int D>
FreeTension<D>::FreeTension(const BeamSystem<D>& system)
    : system_(system), stiffness_(system.model().axis_section().stiffness) {}

template <int D>
std::array<double, 2> FreeTension<D>::pull_at(const Point& point) const {
  if (!stiffness_.slackens()) return {point.EA * point.strain, point.EA};
  const SlackLaw<double> rope(point.strain, stiffness_.slack_over);
  return {point.EA * rope.pull, point.EA * rope.stiffness};
}

template <int D>
template <class Visit>
void FreeTension<D>::at_points(const Eigen::VectorXd& q, const Visit& visit) const {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(q.size());
  const ChainView<D> beam = system_.view(q.data(), none.data());
  const ChainState<D> chain = [&] {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.size());
    y.head(system_.coordinates()) = q.head(system_.coordinates());
    return system_.chain(y, 0);
  }();
  const auto strain_of = [&](const Vec<double, D>& r_x) {
    return stiffness_.green() ? (r_x.squaredNorm() - 1) / 2 : r_x.norm() - 1;
  };
  const SectionPieces& pieces = system_.model().pieces;
  for (int k = 0; k < system_.mesh().elements(); ++k) {
    const MovingKinematics<double, D> element = beam.kinematics(k);
    const double x_a = element.coordinates().x_a;
    for (const BeamPoint& of : system_.rules().of(system_.mesh().weights[static_cast<std::size_t>(k)].w)) {
      if (of.feels == Feels::all_but_stretch) continue;
      const PointMotion<double, D> at = element.at(of.u, rational_shape(element.weights(), of.u));
      const double share = pieces.empty() ? 1 : pieces.at(x_a + of.u * element.length()).axial;
      Point point{k, at.s_x, of.weight * element.length(), at.r_x, strain_of(at.r_x), stiffness_.EA * share};
      if (chain.curved_at_rest()) point.strain -= strain_of(combine_nodes(at.s_x, chain.rest_nodes(k)));
      visit(point);
    }
  }
}

template <int D>
void FreeTension<D>::start(const Eigen::VectorXd& q, double least) {
  forces_.clear();
  at_points(q, [&](const Point& point) { forces_.push_back(std::max(pull_at(point)[0], least)); });
}

template <int D>
void FreeTension<D>::add_to(const Eigen::VectorXd& q, BeamMatrix<D>& tangent) const {
  const ChainView<D> beam = system_.view(q.data(), q.data());
  std::size_t which = 0;
  at_points(q, [&](const Point& point) {
    const double more = forces_[which++] - pull_at(point)[0];
    Eigen::Matrix<double, D, D> by_slope = Eigen::Matrix<double, D, D>::Identity();  // second derivative of the strain
    if (!stiffness_.green()) {
      const double stretch = point.r_x.norm();
      by_slope -= point.r_x * point.r_x.transpose() / (stretch * stretch);
      by_slope /= stretch;
    }
    Eigen::Matrix<double, 4 * D, 4 * D> matrix;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const double s = point.s_x[static_cast<std::size_t>(i)] * point.s_x[static_cast<std::size_t>(j)];
        matrix.template block<D, D>(D * i, D * j) = point.weight * more * s * by_slope;
      }
    }
    tangent.add_element(beam, point.element, matrix);
  });
}

template <int D>
void FreeTension<D>::advance(Eigen::VectorXd& q, const Eigen::VectorXd& change, double share, double least) {
  const ChainView<D> beam = system_.view(q.data(), q.data());
  std::size_t which = 0;
  at_points(q, [&](const Point& point) {
    Vec<double, D> slope = Vec<double, D>::Zero();
    for (int i = 0; i < 4; ++i) {
      slope -= point.s_x[static_cast<std::size_t>(i)] *
               Eigen::Map<const Vec<double, D>>(change.data() + beam.vector(point.element, i));
    }
    const double along = point.r_x.dot(slope) / (stiffness_.green() ? 1 : point.r_x.norm());
    double& force = forces_[which++];
    const auto [pull, stiffness] = pull_at(point);
    force += share * (pull + stiffness * along - force);
    force = std::max(force, least);
  });
  q -= share * change;
}

template <int D>
bool FreeTension<D>::pulls(const Eigen::VectorXd& q, double least) const {
  std::vector<double> means(static_cast<std::size_t>(system_.mesh().elements()), 0);
  std::vector<double> lengths = means;
  at_points(q, [&](const Point& point) {
    const auto k = static_cast<std::size_t>(point.element);
    means[k] += point.weight * pull_at(point)[0];
    lengths[k] += point.weight;
  });
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (!(means[k] > least * lengths[k])) return false;
  }
  return true;
}

template class FreeTension<2>;
template class FreeTension<3>;

}  // namespace vlbeam
