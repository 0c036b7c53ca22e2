#pragma once

#include <vector>

#include "scene/shape_elements.hpp"

namespace vlbeam {

/// Axial force, shear, moment and torque along a beam in one of its configurations.
///
/// Curvatures of a cubic element are best at its two Gauss points, where their error is of the third order and of a
/// known pattern, which is taken out. Between them the moment is the cubic through the four points of an element and
/// its neighbour, the one that is nearer; never across a place where something acts. A force inside an element bends it
/// beyond what a cubic follows: the element has the moment of its cubic, which is that of its nodes' motion, and that
/// of a beam with both ends clamped under the force. Derived: docs/theory/section_forces.md.
template <int D>
class SectionForces {
 public:
  /// Both must outlive it. Throws std::invalid_argument as ShapeElements does.
  SectionForces(const Scene& scene, const Configuration& shape);

  const ShapeElements<D>& elements() const { return elements_; }
  /// At u of element k.
  SectionForce at(std::size_t k, double u) const;

  /// Position, velocity, slope and forces at a material coordinate, where something acts those just before it. Shear is
  /// not known of sections with frames: 0.
  struct Place {
    Vec<double, D> r, v, r_x;
    SectionForce force;
  };
  /// Empty where the beam is not.
  std::optional<Place> place(double x) const;

  struct Extremes {
    AlongBeam axial, moment, shear, torque, stress;
  };
  Extremes extremes() const;
  /// Whether the section has sizes, so that there is a stress.
  bool has_stress() const { return !moduli_.empty(); }

 private:
  using Moment = Vec<double, 3>;  ///< signed in the plane: the last one; of frames about y, z and the tangent
  using Element = typename ShapeElements<D>::Element;
  struct Recovered {
    Moment value, growth;  ///< and its derivative by the material coordinate
  };
  struct Inside {
    std::size_t element;
    double u;
    Vec<double, D> force;
  };

  void look_at(const Element& element);
  typename ShapeElements<D>::Point point(const Element& element, double u) const;
  /// At u.
  Moment moment_at(const Element& element, double u, const typename ShapeElements<D>::Point& at) const;
  /// At u of element k, by the cubic of the half in which `towards` is.
  Recovered recovered(std::size_t k, double u, double towards) const;
  /// Takes out of the moments at Gauss points what the cubics of their elements err there.
  void smooth();
  double axial(std::size_t k, double u) const;
  /// What the forces inside an element add.
  void add_clamped(std::size_t k, double u, Recovered& moment) const;
  /// But for the axial force.
  SectionForce bending(std::size_t k, double u, const Recovered& moment) const;
  void add_stress(std::size_t k, SectionForce& force, const Recovered& moment) const;
  std::size_t element_before(double x) const;
  double x_at(std::size_t k, double u) const { return shape_.x[k] + u * (shape_.x[k + 1] - shape_.x[k]); }

  const Configuration& shape_;
  ShapeElements<D> elements_;
  bool frames_;
  std::vector<std::array<Moment, 2>> points_;     ///< of elements
  std::vector<std::array<double, 2>> stretches_;  ///< there
  std::vector<std::array<double, 3>> axial_;      ///< at start, middle and end; of unsampled strain the mean [N]
  std::vector<bool> broken_, loaded_;             ///< nodes over which no cubic goes; elements in which something acts
  std::vector<Inside> inside_;
  struct Moduli {
    double area, y, z;  ///< [m^2], of the section about its axes y and z [m^3]
  };
  std::vector<Moduli> moduli_;  ///< of elements, by the section in their middle
};

extern template class SectionForces<2>;
extern template class SectionForces<3>;

}  // namespace vlbeam
