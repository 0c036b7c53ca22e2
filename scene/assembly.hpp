#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace vlbeam {

/// A place on a body.
struct BodyPointSpec {
  std::string name;
  Point at{};  ///< in body axes [m]
};

/// A load on a body: a force at a named point, or a torque.
struct BodyLoadSpec {
  enum class Type { force, torque } type = Type::force;
  std::string point = {};    ///< of a force; empty: the center of mass
  TimeSpec magnitude = {};   ///< [N] or [N m]
  Point direction{0, 1, 0};  ///< of a force, or axis of a torque in space
};

/// A rigid body beside the beams, or a point mass.
struct BodySpec {
  std::string name;
  double mass = 0;                   ///< [kg]
  std::vector<double> inertia = {};  ///< about the center of mass [kg m^2]: one number in the plane, in space three
                                     ///< about the body axes; none: a point mass
  Point position{};                  ///< of the center of mass at t = 0 [m]
  Point rotation{};                  ///< of the body axes at t = 0, a rotation vector [degrees]; in the plane the
                                     ///< last component
  Point velocity{};                  ///< of the center of mass at t = 0 [m/s]
  Point angular_velocity{};          ///< at t = 0, in space [rad/s]; in the plane the last component
  std::vector<BodyPointSpec> points = {};
  std::vector<BodyLoadSpec> loads = {};
};

/// What a link takes hold of.
struct LinkEndSpec {
  enum class Of { beam_start, beam_end, node, joint, body, ground } of = Of::ground;
  std::size_t which = 0;  ///< beam or body, in the order of the scene
  int joint = 0;          ///< of the beam, or its node
  Point place{};          ///< in body axes, or of the ground [m]

  bool is_of_beam() const { return of != Of::body && of != Of::ground; }
};

/// What ties beams, bodies and the ground to each other.
enum class LinkType {
  pin,       ///< two points are one
  clamp,     ///< and directions keep their angle
  slide,     ///< a joint of a beam carries a point
  distance,  ///< two points keep their distance
  spring,    ///< a spring and a damper between two points
  rail,      ///< a point stays on a line of the ground
};
struct LinkSpec {
  std::string name;
  LinkType type = LinkType::pin;
  std::array<LinkEndSpec, 2> between = {};
  double stiffness = 0;               ///< spring [N/m]
  double damping = 0;                 ///< spring [N s/m]
  std::optional<double> length = {};  ///< spring: at which it bears nothing; if not given, that at t = 0 [m]
  bool tension_only = false;          ///< spring
  Point direction{1, 0, 0};           ///< rail
};

/// A scene of several beams and bodies. Each beam is a scene of its own in all that concerns it; gravity, duration,
/// integrator and output are those of the whole.
struct AssemblySpec {
  struct Beam {
    std::string name;
    Scene scene;
  };
  std::vector<Beam> beams;
  std::vector<BodySpec> bodies = {};
  std::vector<LinkSpec> links = {};
  std::size_t longest = 0;  ///< which of the beams: lengths and accuracy of the whole go by it
  int elements = 1;         ///< of that beam, as read: the elements of all grow in proportion with those of the whole
};

/// How many elements a beam of an assembly has now.
int elements_of(const Scene& whole, std::size_t which);

/// The scene of one beam of an assembly, with what it shares with the whole as that is now.
Scene beam_scene(const Scene& whole, std::size_t which);

/// The scene that a shape, an event or a sample of a run belongs to: that of its beam, or the whole.
Scene scene_of_beam(const Scene& whole, const std::string& beam);

/// The whole, of parts that are complete: what follows from the longest beam.
Scene whole_scene(AssemblySpec parts);

/// Throws InvalidInput where beams, bodies and links have no names of their own.
void check_names(const AssemblySpec& parts);

/// Where a key of a beam's scene stands in the whole.
std::string key_in_assembly(std::size_t which, const std::string& key);

/// A place in a message.
std::string place_text(const Point& place, int dimension);

/// A body in its pose at t = 0: a place of it in space [m], and its axes there.
Point place_on_body(const BodySpec& body, const Point& at);
std::array<Point, 3> axes_of(const Point& rotation_degrees);

}  // namespace vlbeam
