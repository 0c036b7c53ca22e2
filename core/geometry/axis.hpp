#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "core/geometry/nurbs.hpp"
#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// The initial axis of a beam by its arc length x in [0, length()]: a straight line, an arc of a circle, a helix, or a
/// chain of rational cubics.
template <int D>
class Axis {
 public:
  using Vector = Vec<double, D>;

  static Axis line(const Vector& start, const Vector& end);
  /// From the angle `from` to the angle `to` [rad], in the plane of the first two axes; in space with a pitch a helix,
  /// which rises by it along the third axis in a turn [m].
  static Axis arc(const Vector& center, double radius, double from, double to, double pitch = 0);
  /// May have kinks. Throws NurbsError.
  static Axis nurbs(const Nurbs<D>& curve);
  /// Straight from point to point, of which no two neighbours are one.
  static Axis polyline(const std::vector<Vector>& points);

  double length() const { return breaks_.back(); }
  /// 0, length() and what lies between: an element must not reach over any of these points.
  const std::vector<double>& breaks() const { return breaks_; }
  /// Those of the breaks where the tangent jumps.
  const std::vector<double>& kinks() const { return kinks_; }
  bool straight() const { return std::holds_alternative<Line>(shape_); }
  /// Angle between the tangents before and behind x [rad].
  double turn_at(double x) const;
  /// The same axis with what follows each kink turned about it, by the smallest rotation, so that the tangent does not
  /// jump: all pieces keep their curvature. A line where all are straight.
  Axis straightened() const;
  /// The same axis with some of its kinks rounded off, over at most `reach` [m] to either side and half of the pieces
  /// there: by arcs of circles between straight pieces. It gets shorter. The middle of a rounding stays a break.
  Axis rounded(const std::vector<double>& kinks, double reach) const;

  /// Whether one rational cubic can be the axis from x_a to x_b: no break between them, no helix, and no arc of pi or
  /// more.
  bool in_one_piece(double x_a, double x_b) const;

  Vector position(double x) const { return derivatives(x)[0]; }
  /// Unit tangent.
  Vector tangent(double x) const { return derivatives(x)[1]; }
  /// Before x, where the tangent jumps.
  Vector tangent_before(double x) const;
  /// Position and its first three derivatives by arc length; those of the piece behind where the axis has a break.
  std::array<Vector, 4> derivatives(double x) const;
  /// The axis from x_a to x_b, no break between them, as one rational cubic: exactly that curve, in some
  /// parametrization. Throws std::domain_error where it is not in_one_piece().
  RationalCubic<double, D> between(double x_a, double x_b) const;

 private:
  struct Line {
    Vector start, tangent;
  };
  struct Arc {
    Vector center;
    double radius, from, turn_per_length;
    double rise_per_length = 0;  ///< of a helix
  };
  struct Spans {
    std::vector<RationalCubic<double, D>> spans;
    std::vector<std::vector<double>> lengths;  ///< of each span from its start to k/n of its parameter, k = 0 .. n
    std::vector<double> bounds = {0};          ///< arc length at the start of each span, and of all
    /// Appends a span.
    void add(const RationalCubic<double, D>& span);
    double length_of(std::size_t i) const { return lengths[i].back(); }
  };
  using Chain = std::shared_ptr<const Spans>;  ///< shared by copies: a span's lengths are many numbers
  using Shape = std::variant<Line, Arc, Chain>;

  Axis(Shape shape, std::vector<double> breaks, std::vector<double> kinks = {})
      : shape_(std::move(shape)), breaks_(std::move(breaks)), kinks_(std::move(kinks)) {}
  Axis(Spans spans, std::vector<double> breaks, std::vector<double> kinks = {})
      : Axis(Shape(std::make_shared<const Spans>(std::move(spans))), std::move(breaks), std::move(kinks)) {}

  const Spans& chain() const { return *std::get<Chain>(shape_); }

  /// Index of the span that holds x, and its parameter there.
  std::pair<std::size_t, double> locate(const Spans& chain, double x) const;

  Shape shape_;
  std::vector<double> breaks_, kinks_;
};

/// A chain of rational cubics that share position and slope at their nodes: end slopes are with respect to x.
template <int D>
struct CubicChain {
  std::vector<Vec<double, D>> r, r_x;  ///< one a node
  std::vector<Weights<double>> weights;
};

/// The axis, exactly, as elements between the material coordinates `x`, which hold all its breaks. A rational cubic
/// keeps its curve when its weights become (w_0, c w_1, c^2 w_2, c^3 w_3), while its end slopes are multiplied by c and
/// 1/c: so neighbours can be given common slopes. Of the one family of such chains, that with slopes nearest to 1.
template <int D>
CubicChain<D> exact_chain(const Axis<D>& axis, const std::vector<double>& x);

/// The axis by cubics that run along it evenly: they share its positions and unit tangents at `x`, and are as long as
/// the arc length between, with the weights of even_arc_weights() or, not `rational`, unit ones. At a kink the chain
/// has the tangent before it, and the weights of the element behind are those of the tangent there.
template <int D>
CubicChain<D> even_chain(const Axis<D>& axis, const std::vector<double>& x, bool rational);

extern template class Axis<2>;
extern template class Axis<3>;
extern template CubicChain<2> exact_chain(const Axis<2>&, const std::vector<double>&);
extern template CubicChain<3> exact_chain(const Axis<3>&, const std::vector<double>&);
extern template CubicChain<2> even_chain(const Axis<2>&, const std::vector<double>&, bool);
extern template CubicChain<3> even_chain(const Axis<3>&, const std::vector<double>&, bool);

}  // namespace vlbeam
