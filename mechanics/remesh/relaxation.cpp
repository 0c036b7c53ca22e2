#include "mechanics/remesh/relaxation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

#include "core/element/fixed_rest.hpp"
#include "core/length_control/chain_motion.hpp"

namespace vlbeam {
namespace {

constexpr int most_relaxations = 40;
constexpr double relaxed = 1e-12;       // predicted decrease of the energy, over what there is
constexpr int share_bits = 48;          // of a share of a step
constexpr double shortest_step = 1e-3;  // of Newton's

/// The strain energy of some elements of a chain as a function of what gives way at their nodes.
template <int D>
class Patch {
 public:
  using Vector = Vec<double, D>;

  Patch(ChainState<D>& chain, const std::vector<GivingNode>& giving, const BeamRules& rules, const MovingLaw<D>& law)
      : chain_(chain), section_(law.section) {
    const auto number = [&](double* vector) {
      unknowns_.push_back(vector);
      return static_cast<int>(unknowns_.size()) - 1;
    };
    std::vector<std::array<int, 2>> at(static_cast<std::size_t>(chain.mesh.last()) + 1, {-1, -1});
    for (const auto& [node, position, slope] : giving) {
      auto& place = at[static_cast<std::size_t>(node)];
      if (position && place[0] < 0) place[0] = number(vlbeam::position<D>(chain.q.data(), node).data());
      if (slope && place[1] < 0) place[1] = number(vlbeam::slope<D>(chain.q.data(), node).data());
    }
    for (int k = 0; k < chain.mesh.elements(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      Element element{k, {at[i][0], at[i][1], at[i + 1][0], at[i + 1][1]}, {}, {}};
      const auto* const joint = chain.joint_at(k);
      if (joint != nullptr && joint->kink) element.unknown[1] = -1;  // the slope behind a kink is not the node's
      if (std::ranges::all_of(element.unknown, [](int u) { return u < 0; })) continue;
      element.basis =
          fixed_basis(chain.mesh.x[i], chain.mesh.x[i + 1], current_weights(chain, k, law.transport),
                      rules.of(chain.mesh.weights[i].w), law.pieces != nullptr ? *law.pieces : SectionPieces());
      if (chain.curved_at_rest()) {
        const auto rest = chain.rest_nodes(k);
        element.basis.visit(section_, [&](const auto& point, const BeamSection& felt, std::size_t /*index*/) {
          element.rest.push_back(rest_strain<D>(along(point.s_x, rest), along(point.s_xx, rest), felt));
        });
      }
      elements_.push_back(std::move(element));
    }
  }

  Eigen::Index size() const { return D * static_cast<Eigen::Index>(unknowns_.size()); }
  Eigen::VectorXd places() const {
    Eigen::VectorXd all(size());
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      all.segment<D>(D * static_cast<Eigen::Index>(i)) = Eigen::Map<const Vector>(unknowns_[i]);
    }
    return all;
  }
  void move_to(const Eigen::VectorXd& places) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      Eigen::Map<Vector> vector(unknowns_[i]);
      vector = places.segment<D>(D * static_cast<Eigen::Index>(i));
    }
  }

  double energy() const {
    double sum = 0;
    for (const Element& element : elements_) {
      const auto e = chain_.coordinates(element.index).e;
      element.basis.visit(section_, [&](const auto& point, const BeamSection& felt, std::size_t g) {
        const Vector r_x = along(point.s_x, e), r_xx = along(point.s_xx, e);
        if (element.rest.empty()) {
          const ElasticStress<double, D> stress(r_x, r_xx, felt.stiffness);
          sum += point.weight * (stress.axial + stress.bending);
        } else {
          const RestStress<double, D> stress(r_x, r_xx, element.rest[g], felt);
          sum += point.weight * (stress.axial + stress.bending);
        }
      });
    }
    return sum;
  }

  void differentiate(Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) const {
    gradient.setZero(size());
    hessian.setZero(size(), size());
    // r_A enters through minus the chord r_B - r_A, r_B through the chord
    constexpr std::array<std::size_t, 4> of_chord{0, 1, 0, 2};
    constexpr std::array<double, 4> sign{-1, 1, 1, 1};
    for (const Element& element : elements_) {
      const auto e = chain_.coordinates(element.index).e;
      const NodalCubic<double, D> at_rest{Vector::Zero(), Vector::Zero(), Vector::Zero(), Vector::Zero()};
      BeamSection undamped = section_;
      undamped.damping = 0;
      auto f = fixed_force<double, D>(element.basis, e, at_rest, undamped);
      auto k = elastic_tangent<double, D>(element.basis, e, undamped);
      if (!element.rest.empty()) {
        const auto more = rest_force<double, D>(element.basis, element.rest, e, undamped);
        f.r_b += more.r_b, f.s_a += more.s_a, f.s_b += more.s_b;
        const auto stiffer = rest_tangent<double, D>(element.basis, element.rest, e, undamped);
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) k[i][j] += stiffer[i][j];
        }
      }
      const std::array<Vector, 3> force{f.r_b, f.s_a, f.s_b};
      for (std::size_t i = 0; i < 4; ++i) {
        if (element.unknown[i] < 0) continue;
        gradient.segment<D>(D * element.unknown[i]) -= sign[i] * force[of_chord[i]];
        for (std::size_t j = 0; j < 4; ++j) {
          if (element.unknown[j] < 0) continue;
          hessian.block<D, D>(D * element.unknown[i], D * element.unknown[j]) +=
              sign[i] * sign[j] * k[of_chord[i]][of_chord[j]];
        }
      }
    }
  }

 private:
  struct Element {
    int index;
    std::array<int, 4> unknown;  ///< of r_A, s_A, r_B, s_B; -1 for what stays
    FixedBasis<double> basis;
    std::vector<RestStrain<double>> rest;
  };

  static Vector along(const std::array<double, 3>& s, const NodalCubic<double, D>& e) {
    return (e.r_b - e.r_a) * s[0] + e.s_a * s[1] + e.s_b * s[2];
  }

  ChainState<D>& chain_;
  BeamSection section_;
  std::vector<double*> unknowns_;
  std::vector<Element> elements_;
};

/// relax(), of a patch.
template <int D>
int relax_patch(Patch<D>& patch, double excess) {
  if (patch.size() == 0) return 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  double energy = patch.energy();
  const double enough = energy - excess;
  for (int iteration = 1; iteration <= most_relaxations; ++iteration) {
    patch.differentiate(gradient, hessian);
    Eigen::LLT<Eigen::MatrixXd> factors(hessian);
    // slack elements have directions without stiffness, or with a negative one
    for (double shift = 1e-9; factors.info() != Eigen::Success && shift < 1; shift *= 10) {
      Eigen::MatrixXd stiffer = hessian;
      stiffer.diagonal().array() += shift * hessian.diagonal().cwiseAbs().maxCoeff();
      factors.compute(stiffer);
    }
    if (factors.info() != Eigen::Success) return iteration;
    const Eigen::VectorXd from = patch.places(), step = -factors.solve(gradient);
    const auto take = [&](double share) { patch.move_to(from + share * step); };
    const auto energy_after = [&](double share) {
      take(share);
      return patch.energy();
    };
    const double decrease = -gradient.dot(step);
    if (!(decrease > relaxed * energy)) {  // the energy no longer tells: the last step is Newton's own
      if (decrease > 0 && decrease < excess) take(1);
      return iteration;
    }
    double share = 1, now = energy_after(share);
    for (; !(now < energy); now = energy_after(share)) {
      if (share < shortest_step) {
        patch.move_to(from);
        return iteration;
      }
      share /= 2;
    }
    if (now < enough) {  // up to where just that is gone
      std::uintmax_t evaluations = 50;
      const auto within = boost::math::tools::toms748_solve(
          [&](double of) { return energy_after(of) - enough; }, 0.0, share, energy - enough, now - enough,
          boost::math::tools::eps_tolerance<double>(share_bits), evaluations);
      take(within.first);
      return iteration;
    }
    energy = now;
  }
  return most_relaxations;
}

}  // namespace

template <int D>
int relax(ChainState<D>& chain, std::vector<GivingNode> giving, const BeamRules& rules, const MovingLaw<D>& law,
          double excess) {
  if (!(excess > 0)) return 0;
  Patch<D> patch(chain, giving, rules, law);
  return relax_patch(patch, excess);
}

template int relax(ChainState<2>&, std::vector<GivingNode>, const BeamRules&, const MovingLaw<2>&, double);
template int relax(ChainState<3>&, std::vector<GivingNode>, const BeamRules&, const MovingLaw<3>&, double);

}  // namespace vlbeam
