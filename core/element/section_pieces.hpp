#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/element/section.hpp"

namespace vlbeam {

/// Parts of the mass per length, of EA and of EI, over those of a beam's own section.
struct SectionShare {
  double mass = 1, axial = 1, bending = 1;

  /// That section. What regularizes its curvature goes with the curvature at which it is as stiff as the beam's own: so
  /// tables of elements that scale curvatures have it, too.
  BeamSection of(BeamSection section) const {
    section.rhoA *= mass;
    section.stiffness.EA *= axial;
    section.stiffness.EI *= bending;
    if (bending > 0) section.curvature_regularization *= std::sqrt(axial / bending);
    return section;
  }
};

/// The sections of a beam that has more than one, piece by piece along it.
class SectionPieces {
 public:
  struct Piece {
    double end;  ///< material coordinate [m]; the last piece goes on to the end of the beam, and beyond
    SectionShare share;
  };
  /// A part of an interval, in one piece: from `low` to `high` over it, 0 to 1.
  struct Stretch {
    double low, high;  ///< material coordinates [m]
    const SectionShare* share;
    bool at_start, at_end;  ///< it begins where the interval does; it ends there
  };

  SectionPieces() = default;
  /// In the order of the beam.
  explicit SectionPieces(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  /// Whether the beam has one section all along, its own.
  bool empty() const { return pieces_.empty(); }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const SectionShare& at(double x) const { return pieces_[index(x)].share; }
  /// Whether the section changes between two material coordinates, by more than rounding from either.
  bool change_between(double a, double b) const {
    const double rounding = small * (b - a);
    return !empty() && index(a + rounding) != index(b - rounding);
  }
  /// Where it does.
  std::vector<double> changes_between(double a, double b) const {
    std::vector<double> found;
    const double rounding = small * (b - a);
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
      if (pieces_[i].end > a + rounding && pieces_[i].end < b - rounding) found.push_back(pieces_[i].end);
    }
    return found;
  }
  /// Calls visit(stretch) for the parts of [a, b], in order.
  template <class Visit>
  void visit(double a, double b, const Visit& visit) const {
    const double rounding = small * (b - a);
    const std::size_t first = index(a + rounding), last = index(b - rounding);
    for (std::size_t i = first; i <= last; ++i) {
      visit(Stretch{i == first ? a : pieces_[i - 1].end, i == last ? b : pieces_[i].end, &pieces_[i].share, i == first,
                    i == last});
    }
  }

 private:
  static constexpr double small = 1e-12;

  std::size_t index(double x) const {
    const auto at = std::ranges::upper_bound(pieces_.begin(), pieces_.end() - 1, x, {}, &Piece::end);
    return static_cast<std::size_t>(at - pieces_.begin());
  }

  std::vector<Piece> pieces_;
};

/// All sections of a beam: its own, and those over it.
struct BeamSections {
  BeamSection own;
  SectionPieces pieces = {};

  BeamSections(const BeamSection& all_along) : own(all_along) {}  // NOLINT(google-explicit-constructor): one piece
  BeamSections(const BeamSection& own_, const SectionPieces& pieces_) : own(own_), pieces(pieces_) {}
};

}  // namespace vlbeam
