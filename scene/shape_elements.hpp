#pragma once

#include <optional>

#include "core/element/moving_kinematics.hpp"
#include "core/element/section_pieces.hpp"
#include "core/element/strain_extremes.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The elements of a beam in one of its configurations.
template <int D>
class ShapeElements {
 public:
  using Point = PointMotion<double, D>;
  struct Element {
    std::size_t index;
    MovingKinematics<double, D> kinematics;
    std::optional<NodalCubic<double, D>> rest;  ///< none where it is straight and unstrained
    std::array<StrainExtremes, 3> sampled;      ///< at start, middle and end, where the axial strain is sampled there

    /// At u as far as strains need it that are not damped: shape functions, slope and its derivative. At rest.
    Point bent(double u) const;
    Point at(double u) const { return kinematics.at(u, rational_shape(kinematics.weights(), u)); }
    double x(double u) const {
      const auto& q = kinematics.coordinates();
      return q.x_a + u * (q.x_b - q.x_a);
    }
  };
  struct Axial {
    double strain, tension;  ///< [-], [N]
  };

  /// Throws std::invalid_argument unless the configuration has one entry a node or element. Both must outlive it.
  ShapeElements(const Scene& scene, const Configuration& shape);

  std::size_t count() const { return shape_.x.size() - 1; }
  /// The model's: of all of the beam, or that of which its sections are shares.
  const BeamSection& section() const { return section_; }
  BeamSection section_at(double x) const { return pieces_.empty() ? section_ : pieces_.at(x).of(section_); }
  /// Whether the axial strain is summed at start, middle and end of an element.
  bool samples_axially() const { return sampled_; }
  Element element(std::size_t k) const;
  /// At u, as the strain law measures them, from the rest shape.
  StrainExtremes strains(const Element& element, double u, const Point& at) const;
  /// At u, where strains() is known: by the parabola through the points at which the axial strain is sampled.
  Axial axial(const Element& element, double u, const StrainExtremes& there) const;

 private:
  const Configuration& shape_;
  BeamSection section_;
  SectionPieces pieces_;
  WeightTransport transport_;
  bool curved_, sampled_;
  Configuration::Rest rest_;
};

extern template class ShapeElements<2>;
extern template class ShapeElements<3>;

}  // namespace vlbeam
