#pragma once

#include <algorithm>
#include <vector>

#include "core/element/rest_strain.hpp"
#include "core/element/shape_functions.hpp"

namespace vlbeam {

/// The stress-free shape of a beam: rational cubics over intervals of the material coordinate. Strains are measured
/// from it at the same material point, whatever the mesh has become; they may jump between its pieces.
template <int D>
class RestCurve {
 public:
  struct Piece {
    double x_a, x_b;
    NodalCubic<double, D> e;
    Weights<double> w;
  };

  RestCurve(std::vector<Piece> pieces, StrainLaw law, double curvature_regularization)
      : pieces_(std::move(pieces)), law_(law), regularization_(curvature_regularization) {}

  double curvature_regularization() const { return regularization_; }

  /// Index of the piece that holds x; that on the right where pieces meet.
  template <class Real>
  int piece_at(const Real& x) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), x,
                                        [](const Real& value, const Piece& piece) { return value < Real(piece.x_a); });
    return std::max(0, static_cast<int>(after - pieces_.begin()) - 1);
  }
  /// Material coordinate where piece i ends.
  double end_of(int i) const { return pieces_[static_cast<std::size_t>(i)].x_b; }
  int pieces() const { return static_cast<int>(pieces_.size()); }

  /// Rest strains at x on piece i.
  template <class Real>
  RestStrain<Real> at(const Real& x, int i) const {
    using std::sqrt;
    const Piece& piece = pieces_[static_cast<std::size_t>(i)];
    const double l = piece.x_b - piece.x_a;
    const Weights<Real> w{Real(piece.w[0]), Real(piece.w[1]), Real(piece.w[2]), Real(piece.w[3])};
    const ShapeTable<Real> f = rational_shape(w, Real((x - Real(piece.x_a)) * Real(1 / l)));
    auto derivative = [&](std::size_t n, double scale) -> Vec<Real, D> {
      Vec<Real, D> sum;
      for (int c = 0; c < D; ++c) {
        sum[c] = (Real(piece.e.r_a[c]) * f[0][n] + Real(piece.e.r_b[c]) * f[2][n] +
                  (Real(piece.e.s_a[c]) * f[1][n] + Real(piece.e.s_b[c]) * f[3][n]) * Real(l)) *
                 Real(scale);
      }
      return sum;
    };
    const Vec<Real, D> r_x = derivative(1, 1 / l), r_xx = derivative(2, 1 / (l * l)),
                       r_xxx = derivative(3, 1 / (l * l * l));
    const Real g = r_x.dot(r_x), half_rate = r_x.dot(r_xx);
    RestStrain<Real> rest;
    if (law_ == StrainLaw::green) {
      rest.axial = Real(0.5) * (g - Real(1));
      rest.axial_x = half_rate;
    } else {
      rest.axial = sqrt(g) - Real(1);
      rest.axial_x = half_rate / sqrt(g);
    }
    const Curvature<Real, D> kappa(r_x, r_xx, law_, regularization_);
    rest.curvature = kappa.value;
    rest.curvature_x = kappa.by_slope.dot(r_xx) + kappa.by_second.dot(r_xxx);
    return rest;
  }

 private:
  std::vector<Piece> pieces_;
  StrainLaw law_;
  double regularization_;
};

}  // namespace vlbeam
