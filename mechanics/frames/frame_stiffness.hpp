#pragma once

#include <array>

#include "mechanics/frames/frame_element.hpp"

namespace vlbeam {

/// The second derivative of an element's energy by c = r_B - r_A, s_A, s_B and the angles of its ends, where the inner
/// angle is that of the least energy. No branch on values: `Real` may be a Pack.
///
/// The triad in the middle turns by w = e_3 x mu as its tangent changes by mu, mu_i = N_i/|N|, N = r_x there. What is
/// seen from it, r_x and r_xx at a point, changes by -w x r + w x (w x r)/2. With the derivatives b_S of the strains S,
/// all but those, the tangent is the sum of k_S b_S b_S^T, of the stresses times the second derivatives of strains by
/// r_x and r_xx, and of what acts on mu, and on the angles of the ends in the middle, times theirs.
template <class Real>
class FrameStiffness {
 public:
  using Vector = Vec<Real, 3>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;
  using Columns = std::array<Vector, 3>;  ///< by c, s_A, s_B
  using Ends = std::array<Real, 2>;

  std::array<std::array<Matrix, 3>, 3> axis;  ///< rows and columns of c, s_A, s_B; those with row <= column
  std::array<Columns, 2> angles;              ///< columns of the angles
  Real aa, ab, bb;                            ///< among the angles
  Ends torques;                               ///< on the angles [N m]

  /// `turn_a`, `turn_b` are what an angle, held, turns an end by as its slope changes: A of TriadReference. What acts
  /// on the angles times dA/ds is for who knows it.
  FrameStiffness(const FrameElement<Real>& element, const Real& inner, const Vector& turn_a, const Vector& turn_b)
      : of_(element) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) axis[i][j] = Matrix::Zero();
      by_a_[i] = by_b_[i] = by_inner_[i] = rest_[i][0] = rest_[i][1] = Vector::Zero();
    }
    aa = ab = bb = inner_a_ = inner_b_ = inner_inner_ = torques[0] = torques[1] = Real(0);
    on_middle_[0] = on_middle_[1] = middle_[0] = middle_[1] = middle_[2] = Real(0);
    const auto turn = sine_cosine(Real(inner * of_.table_.points[0].bump()));
    for (std::size_t g = 0; g < 2; ++g) add_point(g, inner, turn);
    add_end(of_.a_, 1, torques[0]);
    add_end(of_.b_, 2, torques[1]);
    add_middle();
    take_inner();
    const Columns a = angle_of_end(of_.a_, 1, of_.inside(turn_a)), b = angle_of_end(of_.b_, 2, of_.inside(turn_b));
    for (std::size_t i = 0; i < 3; ++i) {
      angles[0][i] = by_a_[i] + a[i] * aa + b[i] * ab;
      angles[1][i] = by_b_[i] + a[i] * ab + b[i] * bb;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) {
        add_outer(axis[i][j], a[i], angles[0][j]);
        add_outer(axis[i][j], b[i], angles[1][j]);
        add_outer(axis[i][j], by_a_[i], a[j]);
        add_outer(axis[i][j], by_b_[i], b[j]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) axis[i][j] = outside(axis[i][j]);
      angles[0][i] = of_.outside(angles[0][i]);
      angles[1][i] = of_.outside(angles[1][i]);
    }
  }

  /// Of the element in lane `lane`, where this is a pack: by r_A, s_A, phi_A, r_B, s_B, phi_B.
  FrameMatrix in_order(int lane = 0) const {
    const auto of = [&](const Real& x) -> double {
      if constexpr (std::is_same_v<Real, Pack>) {
        return x[lane];
      } else {
        return x;
      }
    };
    FrameMatrix k;
    constexpr std::array<int, 3> at{7, 3, 10};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) {
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) k(at[i] + c, at[j] + d) = k(at[j] + d, at[i] + c) = of(axis[i][j](c, d));
        }
      }
      for (int c = 0; c < 3; ++c) {
        k(at[i] + c, 6) = k(6, at[i] + c) = of(angles[0][i][c]);
        k(at[i] + c, 13) = k(13, at[i] + c) = of(angles[1][i][c]);
      }
    }
    k(6, 6) = of(aa);
    k(6, 13) = k(13, 6) = of(ab);
    k(13, 13) = of(bb);
    k.topRows<3>() = -k.middleRows<3>(7);
    k.leftCols<3>() = -k.middleCols<3>(7);
    return k;
  }

 private:
  using Element = FrameElement<Real>;
  using Pair = std::array<Real, 2>;

  static void add_outer(Matrix& sum, const Vector& a, const Vector& b) {
    for (int c = 0; c < 3; ++c) {
      for (int d = 0; d < 3; ++d) sum(c, d) += a[c] * b[d];
    }
  }
  static void add_both(Matrix& sum, const Vector& a, const Vector& b) {
    for (int c = 0; c < 3; ++c) {
      for (int d = 0; d < 3; ++d) sum(c, d) += a[c] * b[d] + b[c] * a[d];
    }
  }
  /// By mu, of what changes with r_x and r_xx as given.
  static Pair by_middle(const typename Element::Seen& at, const Vector& by_x, const Vector& by_xx) {
    Pair result;
    for (int i = 0; i < 2; ++i) {
      result[static_cast<std::size_t>(i)] =
          at.r_x[i] * by_x[2] - at.r_x[2] * by_x[i] + at.r_xx[i] * by_xx[2] - at.r_xx[2] * by_xx[i];
    }
    return result;
  }

  void add_point(std::size_t g, const Real& inner, const SineCosine<Real>& turn) {
    const auto& point = of_.table_.points[g];
    const auto& at = of_.points_[g];
    const auto pull = of_.pull(g, inner, turn);
    const Real w(point.weight), u(point.u), bump(point.bump());
    const Real per_square = at.per_stretch * at.per_stretch, n(curvature_power(of_.section_.law));
    const auto [y, z, torsion] = pull.strain;
    const auto [M_y, M_z, torque] = pull.moment;

    // the strains' derivatives, by r_x and r_xx, and with the middle by the columns
    const auto strain_of = [&](const Vector& direction, const Real& shrinks) {
      auto by = Element::gradient(at, direction);
      by[0] = by[0] * at.over - at.r_x * Real(shrinks * per_square);
      by[1] *= at.over;
      return by;
    };
    const Real by_length = of_.green() ? Real(torsion - at.own) : Real(0);
    const auto to_columns = [&](const std::array<Vector, 2>& by) {
      const Pair turned = by_middle(at, by[0], by[1]);
      Columns columns;
      for (std::size_t i = 0; i < 3; ++i) {
        const Real m = Real(of_.table_.middle[i]) * of_.per_stretch_m_;
        columns[i] = by[0] * Real(point.s_x[i]) + by[1] * Real(point.s_xx[i]);
        columns[i][0] += turned[0] * m;
        columns[i][1] += turned[1] * m;
      }
      return columns;
    };
    const Vector along_y(pull.turn.cosine, pull.turn.sine, Real(0));
    const Vector along_z(-pull.turn.sine, pull.turn.cosine, Real(0));
    const Vector along_t(Real(0), Real(0), Real(-1));
    const Columns b_y = to_columns(strain_of(along_y, n * y)), b_z = to_columns(strain_of(along_z, n * z));
    const Columns b_t = to_columns(strain_of(along_t, n * at.own + by_length));
    const Real k_y = w * Real(of_.section_.EI_y), k_z = w * Real(of_.section_.EI_z), k_t = w * Real(of_.section_.GIp);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector c_y = b_y[i] * k_y, c_z = b_z[i] * k_z, c_t = b_t[i] * k_t;
      for (std::size_t j = i; j < 3; ++j) {
        add_outer(axis[i][j], c_y, b_y[j]);
        add_outer(axis[i][j], c_z, b_z[j]);
        add_outer(axis[i][j], c_t, b_t[j]);
      }
      // the frame's angle makes z of y, and -y of z
      const Vector turns = c_y * z - c_z * y + b_z[i] * M_y - b_y[i] * M_z;
      Vector twists = c_t * at.per_length;
      if (of_.green()) {
        const Real shrinks = torque * at.per_length * per_square * Real(point.s_x[i]);
        twists -= at.r_x * shrinks;
      }
      by_a_[i] += turns * Real(Real(1) - u) - twists;
      by_b_[i] += turns * u + twists;
      by_inner_[i] += turns * bump + twists * Real(4 * (1 - 2 * point.u));
    }
    const Real turning = k_y * z * z + k_z * y * y - M_y * y - M_z * z, twisting = k_t * at.per_length * at.per_length;
    const Real v = Real(1) - u, slope(4 * (1 - 2 * point.u));
    aa += turning * v * v + twisting;
    ab += turning * v * u - twisting;
    bb += turning * u * u + twisting;
    inner_a_ += turning * v * bump - twisting * slope;
    inner_b_ += turning * u * bump + twisting * slope;
    inner_inner_ += turning * bump * bump + twisting * slope * slope;
    torques[0] += pull.spin * v - torque * at.per_length;
    torques[1] += pull.spin * u + torque * at.per_length;

    // second derivatives by r_x, and by r_x and r_xx
    const Vector& p = at.r_x;
    const Real B = pull.n.dot(p), q = at.near, c_3 = at.c[2];
    const Real E = pull.n.dot(at.c) - c_3 * q * B;
    const auto by = Element::gradient(at, pull.n);
    const Real curls = c_3 * B * q * q * at.per_stretch;  // what turns with the unit tangent
    Vector r = p * at.per_stretch;
    r[2] += Real(1);
    const Vector f = -Element::around(at.r_xx);  // r_xx x e_3
    Matrix xx = Matrix::Zero(), xX = Matrix::Zero();
    const Real sinks = torque * by_length;
    const Real along = n * (n + Real(2)) * E * at.over + Real(3) * sinks;
    add_both(xx, p,
             by[0] * Real(-n * at.over * per_square) +
                 p * Real(Real(0.5) * (along * per_square - curls * at.over) * per_square));
    add_both(xx, pull.n, (r * Real(q * c_3) - f) * Real(q * at.over));
    add_both(xx, r, (f - r * Real(c_3 * q)) * Real(q * q * B * at.over));
    xx.diagonal().array() += curls * at.over - (n * E * at.over + sinks) * per_square;
    const Vector across = Element::around(p);
    add_outer(xX, (r * Real(B * q) - pull.n) * Real(q * at.over), across);
    add_outer(xX, p * Real(-n * at.over * per_square), by[1]);
    const Vector m = pull.n * at.over;
    const Real m_3 = m[2] - q * B * at.over;
    xX(0, 1) += m_3, xX(1, 0) -= m_3;
    xX(0, 2) -= m[1], xX(2, 0) += m[1];
    xX(1, 2) += m[0], xX(2, 1) -= m[0];

    // with the middle
    std::array<Vector, 2> x_mu, X_mu;
    for (int i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      x_mu[k] = xx.col(2) * p[i] - xx.col(i) * p[2] + xX.col(2) * at.r_xx[i] - xX.col(i) * at.r_xx[2];
      X_mu[k] = xX.row(2).transpose() * p[i] - xX.row(i).transpose() * p[2];
    }
    const Real radial = pull.on_x.dot(p) + pull.on_xx.dot(at.r_xx);
    const auto moment = [&](int i, int j) -> Real { return pull.on_x[i] * p[j] + pull.on_xx[i] * at.r_xx[j]; };
    middle_[0] += by_middle(at, x_mu[0], X_mu[0])[0] + moment(1, 1) - radial;
    middle_[1] += by_middle(at, x_mu[1], X_mu[1])[1] + moment(0, 0) - radial;
    middle_[2] += by_middle(at, x_mu[1], X_mu[1])[0] - Real(0.5) * (moment(0, 1) + moment(1, 0));
    for (int i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      x_mu[k][i] += pull.on_x[2], x_mu[k][2] -= pull.on_x[i];
      X_mu[k][i] += pull.on_xx[2], X_mu[k][2] -= pull.on_xx[i];
      for (std::size_t j = 0; j < 3; ++j) {
        rest_[j][k] += x_mu[k] * Real(point.s_x[j]) + X_mu[k] * Real(point.s_xx[j]);
      }
    }
    const Pair turned = by_middle(at, pull.on_x, pull.on_xx);
    on_middle_[0] += turned[0];
    on_middle_[1] += turned[1];

    for (std::size_t i = 0; i < 3; ++i) {
      const Real x_i(point.s_x[i]), X_i(point.s_xx[i]);
      for (std::size_t j = i; j < 3; ++j) {
        const Real x_j(point.s_x[j]), X_j(point.s_xx[j]);
        const Real both = x_i * x_j, one = x_i * X_j, other = X_i * x_j;
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) axis[i][j](c, d) += xx(c, d) * both + xX(c, d) * one + xX(d, c) * other;
        }
      }
    }
  }

  /// The torque on an end's angle, times the second derivative of that in the middle.
  void add_end(const typename Element::End& end, std::size_t column, const Real& torque) {
    const Vector& s = end.s;
    const Vector turned = -Element::around(s);  // s x e_3
    const Real q = end.near, per = Real(1) / end.stretch, share = torque * q * per;
    Vector by = s * Real((Real(2) + s[2] * per) * q * per);
    by[2] += q;
    add_both(axis[column][column], turned, by * Real(Real(0.5) * share));
    for (int i = 0; i < 2; ++i) {
      Vector& sum = rest_[column][static_cast<std::size_t>(i)];
      sum += turned * Real(share * q * s[i]);
      // less s x e_i
      if (i == 0) sum[1] -= share * s[2], sum[2] += share * s[1];
      if (i == 1) sum[0] += share * s[2], sum[2] -= share * s[0];
    }
    const Real square = torque * q * q;
    middle_[0] += square * s[0] * s[1];
    middle_[1] -= square * s[0] * s[1];
    middle_[2] += Real(0.5) * square * (s[1] * s[1] - s[0] * s[0]);
    const Vector by_middle = end.by_middle();
    on_middle_[0] += torque * by_middle[0];
    on_middle_[1] += torque * by_middle[1];
  }

  void add_middle() {
    const Real per = of_.per_stretch_m_, square = per * per;
    Matrix own;
    own << middle_[0] * square, middle_[2] * square, -on_middle_[0] * square,  //
        middle_[2] * square, middle_[1] * square, -on_middle_[1] * square,     //
        -on_middle_[0] * square, -on_middle_[1] * square, Real(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const Real m_i(of_.table_.middle[i]);
      for (std::size_t j = i; j < 3; ++j) {
        const Real m_j(of_.table_.middle[j]), both = m_i * m_j, by_i = m_i * per, by_j = m_j * per;
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) {
            Real& sum = axis[i][j](c, d);
            sum += own(c, d) * both;
            if (d < 2) sum += rest_[i][static_cast<std::size_t>(d)][c] * by_j;
            if (c < 2) sum += rest_[j][static_cast<std::size_t>(c)][d] * by_i;
          }
        }
      }
    }
  }

  /// The inner angle follows, and is gone.
  void take_inner() {
    const Real soft = Real(1) / inner_inner_;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector follows = by_inner_[i] * soft;
      for (std::size_t j = i; j < 3; ++j) add_outer(axis[i][j], -follows, by_inner_[j]);
      by_a_[i] -= follows * inner_a_;
      by_b_[i] -= follows * inner_b_;
    }
    aa -= inner_a_ * inner_a_ * soft;
    ab -= inner_a_ * inner_b_ * soft;
    bb -= inner_b_ * inner_b_ * soft;
  }

  /// The derivative of an end's angle in the middle.
  Columns angle_of_end(const typename Element::End& end, std::size_t column, const Vector& turn) const {
    Columns result;
    const Vector by_middle = end.by_middle() * of_.per_stretch_m_;
    for (std::size_t i = 0; i < 3; ++i) result[i] = by_middle * Real(of_.table_.middle[i]);
    result[column] += end.by_slope() + turn;
    return result;
  }

  Matrix outside(const Matrix& inside) const {
    Matrix half;
    for (int d = 0; d < 3; ++d) half.col(d) = of_.outside(inside.col(d));
    Matrix result;
    for (int c = 0; c < 3; ++c) result.row(c) = of_.outside(half.row(c).transpose()).transpose();
    return result;
  }

  const FrameElement<Real>& of_;
  Columns by_a_, by_b_, by_inner_;             // columns of the angles in the middle, and of the inner one
  Real inner_a_, inner_b_, inner_inner_;       // what these do to each other
  std::array<std::array<Vector, 2>, 3> rest_;  // by mu, rows of c, s_A, s_B
  Pair on_middle_;                             // on mu
  std::array<Real, 3> middle_;                 // 11, 22 and 12 of mu
};

}  // namespace vlbeam
