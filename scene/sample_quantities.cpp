#include "scene/sample_quantities.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "scene/assembly_quantities.hpp"
#include "scene/bearings.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"

namespace vlbeam {
namespace {

using Columns = std::vector<std::string>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Collects the quantities of one scene.
class Quantities {
 public:
  explicit Quantities(int dimension) : d_(static_cast<std::size_t>(dimension)) {}

  std::vector<SampleQuantity> take() { return std::move(list_); }

  void part(const std::string& path) { list_.push_back({path, {}, "", "", SampleShape::number, 1, {}}); }

  /// `of(sample)` is a number or an optional one.
  template <class Of>
  void number(const std::string& path, const std::string& column, const std::string& unit,
              const std::string& description, const Of& of) {
    list_.push_back({path, {column}, unit, description, SampleShape::number, 1, [of](const Sample& s, double* out) {
                       return store(of(s), out);
                     }});
  }

  /// `of(sample)` is a point, an optional one, or a pointer to one; its first components count.
  template <class Of>
  void vector(const std::string& path, const std::string& stem, const std::string& unit, const std::string& description,
              const Of& of) {
    static constexpr std::array axes{"_x", "_y", "_z"};
    Columns columns;
    for (std::size_t i = 0; i < d_; ++i) columns.push_back(stem + axes[i]);
    list_.push_back(
        {path, columns, unit, description, SampleShape::vector, d_, [of, d = d_](const Sample& s, double* out) {
           const auto point = of(s);
           if constexpr (!std::is_same_v<decltype(point), const Point>) {
             if (!point) return false;
             std::copy_n(point->begin(), d, out);
           } else {
             std::copy_n(point.begin(), d, out);
           }
           return true;
         }});
  }

  /// `of(sample, out)` writes numbers, which form one vector or several of the scene's dimension.
  template <class Of>
  void list(const std::string& path, const Columns& columns, const std::string& unit, const std::string& description,
            SampleShape shape, const Of& of) {
    const std::size_t dimension = shape == SampleShape::vector ? columns.size() : d_;
    list_.push_back({path, columns, unit, description, shape, dimension, [of](const Sample& s, double* out) {
                       of(s, out);
                       return true;
                     }});
  }

  void reaction(const std::string& at, const std::string& of_what,
                const std::function<const Reaction&(const Sample&)>& of) {
    vector("reactions/" + at + "/position", "reaction_" + at, "N", "force of " + of_what + " on the beam",
           [of](const Sample& s) -> Point { return of(s).position; });
    vector("reactions/" + at + "/slope", "reaction_" + at + "_slope", "N m",
           "generalized force of " + of_what + " on the beam's slope: of a moment M across it, M x r_x/|r_x|^2",
           [of](const Sample& s) -> Point { return of(s).slope; });
  }

  std::size_t dimension() const { return d_; }

 private:
  static bool store(double value, double* out) {
    *out = value;
    return true;
  }
  static bool store(const std::optional<double>& value, double* out) {
    if (value) *out = *value;
    return value.has_value();
  }

  std::size_t d_;
  std::vector<SampleQuantity> list_;
};

void add_energy(Quantities& q, const Scene& scene) {
  const auto energy = [&q](const char* name, const std::string& description, double (*of)(const Sample&)) {
    q.number(std::string("energy/") + name, std::string("energy_") + name, "J", description, of);
  };
  energy("kinetic", "kinetic energy", [](const Sample& s) { return s.energy.kinetic; });
  energy("axial", "strain energy of stretching", [](const Sample& s) { return s.energy.axial; });
  energy("bending", "strain energy of bending", [](const Sample& s) { return s.energy.bending; });
  energy("torsion", "strain energy of torsion", [](const Sample& s) { return s.energy.torsion; });
  energy("gravity", "potential energy of gravity as it is then", [](const Sample& s) { return s.energy.gravity; });
  energy("dissipated", "taken by damping and friction since t = 0",
         [](const Sample& s) { return s.energy.dissipated; });
  if (scene.start.motion || scene.end.motion || guided(scene) || fed(scene) || scene.gravity_ramp > 0) {
    energy(
        "supplied",
        "work since t = 0 of supports that move, of guides and of gravity while it grows, and what is fed in with it",
        [](const Sample& s) { return s.energy.supplied; });
  }
  energy("total", "sum of these but `supplied`; total - supplied is what is conserved",
         [](const Sample& s) { return s.energy.total(); });
  energy("discrete_total", "the total by the model's own quadrature points; the others are by a 25-point rule",
         [](const Sample& s) { return s.discrete_total; });
}

void add_joint(Quantities& q, bool guided) {
  using Joint = const std::optional<JointSample>&;
  const auto number = [&q](const char* path, const char* column, const char* unit, const char* description,
                           double JointSample::*member) {
    q.number(path, column, unit, description, [member](const Sample& s) -> std::optional<double> {
      return s.joint ? std::optional((*s.joint).*member) : std::nullopt;
    });
  };
  number("joint_velocity", "joint_velocity", "m/s", "rate of joint_position, x_i'", &JointSample::velocity);
  q.vector("contact/force", "contact", "N", "force of the beam on the sliding mass, while it is on it",
           [](const Sample& s) -> std::optional<Point> {
             Joint joint = s.joint;
             return joint ? std::optional(joint->force) : std::nullopt;
           });
  number(
      "contact/tangential", "contact_tangential", "N",
      "part of that force along the beam, towards its end (at a kink between both tangents); without friction what the "
      "mesh leaves",
      &JointSample::tangential);
  number("contact/normal", "contact_normal", "N", "magnitude of its part across the beam", &JointSample::normal);
  if (guided)
    number("contact/guiding", "contact_guiding", "N",
           "force of what guides the mass along the beam: its power over joint_velocity", &JointSample::guiding);
}

/// Lists in the order of the scene, with no number for what is not there.
void add_joints(Quantities& q, std::size_t count, bool guided) {
  const auto columns = [count](const std::string& stem, const std::vector<std::string>& axes) {
    Columns names;
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::string& axis : axes) names.push_back("joint" + std::to_string(i) + "_" + stem + axis);
    }
    return names;
  };
  const auto numbers = [&](const char* name, const char* unit, const char* description, const auto& of) {
    q.list(std::string("sliding_joints/") + name, columns(name, {""}), unit, description, SampleShape::vector,
           [of](const Sample& s, double* out) {
             for (const SlidingSample& joint : s.joints) *out++ = of(joint);
           });
  };
  const auto vectors = [&](const char* name, const char* unit, const char* description, const auto& of) {
    std::vector<std::string> axes{"_x", "_y", "_z"};
    axes.resize(q.dimension());
    q.list(std::string("sliding_joints/") + name, columns(name, axes), unit, description, SampleShape::vectors,
           [of, d = q.dimension()](const Sample& s, double* out) {
             for (const SlidingSample& joint : s.joints) {
               const std::optional<Point> point = of(joint);
               if (point) {
                 std::copy_n(point->begin(), d, out);
               } else {
                 std::fill_n(out, d, nan);
               }
               out += d;
             }
           });
  };
  const auto of_contact = [](double JointSample::*member) {
    return [member](const SlidingSample& joint) { return joint.on_beam ? (*joint.on_beam).*member : nan; };
  };
  q.part("sliding_joints");
  numbers("position", "m", "material coordinates of all joints; null of one that has left the beam",
          [](const SlidingSample& joint) { return joint.position.value_or(nan); });
  numbers("velocity", "m/s", "rates of their material coordinates", of_contact(&JointSample::velocity));
  vectors("mass_position", "m", "positions of their masses, rings and sleeves",
          [](const SlidingSample& joint) { return joint.mass_position; });
  vectors("force", "N", "forces of the beam on them, while they are on it", [](const SlidingSample& joint) {
    return joint.on_beam ? std::optional(joint.on_beam->force) : std::nullopt;
  });
  numbers("tangential", "N", "parts of these forces along the beam, towards its end",
          of_contact(&JointSample::tangential));
  numbers("normal", "N", "magnitudes of their parts across the beam", of_contact(&JointSample::normal));
  if (guided)
    numbers("guiding", "N", "forces of what guides them along the beam: their power over velocity",
            of_contact(&JointSample::guiding));
}

void add_strains(Quantities& q) {
  const auto number = [&q](const char* path, const char* column, const char* unit, const char* description,
                           double (*of)(const StrainSample&)) {
    q.number(path, column, unit, description, [of](const Sample& s) { return of(s.strains); });
  };
  number("axial_strain/min", "axial_strain_min", "-", "least axial strain of the beam, as its strain law measures it",
         [](const StrainSample& s) { return s.axial_strain[0]; });
  number("axial_strain/max", "axial_strain_max", "-", "largest axial strain",
         [](const StrainSample& s) { return s.axial_strain[1]; });
  const auto force = [&q](const char* path, const char* column, const char* description, std::size_t i,
                          double AlongBeam::*member) {
    q.number(path, column, "N", description, [i, member](const Sample& s) {
      return s.sections && s.sections->axial ? (*s.sections->axial).*member : s.strains.axial_force[i];
    });
  };
  force("axial_force/min", "axial_force_min", "least axial force, damping included; tension is positive", 0,
        &AlongBeam::least);
  force("axial_force/max", "axial_force_max", "largest axial force", 1, &AlongBeam::largest);
  number("curvature/max", "curvature_max", "1/m", "largest magnitude of curvature, from the rest shape",
         [](const StrainSample& s) { return s.curvature; });
}

/// What sections bear, least and largest along the beam, and where.
void add_section_forces(Quantities& q, const Scene& scene) {
  using Of = std::optional<AlongBeam> SectionSample::*;
  const auto number = [&q](const std::string& name, const char* key, const char* unit, const std::string& description,
                           Of of, double AlongBeam::*member) {
    q.number(name + "/" + key, name + "_" + key, unit, description, [of, member](const Sample& s) {
      return s.sections && (*s.sections.*of) ? std::optional((*s.sections.*of).value().*member) : std::nullopt;
    });
  };
  const auto both = [&number](const std::string& name, const char* unit, const std::string& what, Of of) {
    number(name, "min", unit, "least " + what, of, &AlongBeam::least);
    number(name, "max", unit, "largest " + what, of, &AlongBeam::largest);
    number(name, "x_min", "m", "material coordinate of the least", of, &AlongBeam::at_least);
    number(name, "x_max", "m", "material coordinate of the largest", of, &AlongBeam::at_largest);
  };
  if (build_section(scene).bends() || has_frames(scene)) {
    both("bending_moment", "N m",
         scene.dimension == 2 ? "bending moment along the beam; a beam drawn from left to right sags where it is > 0"
                              : "magnitude of the bending moment along the beam",
         &SectionSample::moment);
    if (!has_frames(scene)) {
      both("shear_force", "N",
           scene.dimension == 2 ? "shear force along the beam: growth of the bending moment with arc length"
                                : "magnitude of the shear force along the beam",
           &SectionSample::shear);
    }
  }
  if (has_frames(scene)) {
    both("torque", "N m", "torque along the beam, about its axis, right-handed", &SectionSample::torque);
  }
  if (!knows_stress(scene.beam)) return;
  number("stress", "max", "Pa", "largest stress along the beam, its magnitude: of axial force and bending",
         &SectionSample::stress, &AlongBeam::largest);
  number("stress", "x_max", "m", "material coordinate of the largest", &SectionSample::stress, &AlongBeam::at_largest);
}

void add_ends(Quantities& q, const Scene& scene) {
  const std::string angle = scene.dimension == 2
                                ? "direction of the beam, from the first axis towards the second, -180 to 180"
                                : "direction of the beam above the horizontal, -90 to 90";
  for (const std::size_t end : {0U, 1U}) {
    const std::string name = end == 0 ? "start" : "end";
    q.number("angles/" + name, "angles_" + name, "degrees", angle,
             [end](const Sample& s) { return s.sections ? std::optional(s.sections->angles[end]) : std::nullopt; });
  }
  for (const std::size_t end : {0U, 1U}) {
    const SupportSpec& support = end == 0 ? scene.start : scene.end;
    const bool held = support.type == SupportType::clamp || support.type == SupportType::pin;
    if (!held && !support.pays_out()) continue;
    const std::string name = end == 0 ? "start" : "end";
    q.number("tension/" + name, "tension_" + name, "N",
             "with which the beam pulls at what holds it there, along its direction; a mass at that node counts",
             [end](const Sample& s) { return s.sections ? s.sections->tension[end] : std::nullopt; });
  }
}

void add_places(Quantities& q, const Scene& scene) {
  if (scene.places.empty()) return;
  q.part("places");
  const bool bends = build_section(scene).bends() || has_frames(scene);
  for (std::size_t i = 0; i < scene.places.size(); ++i) {
    const std::string path = "places/" + scene.places[i].name + "/", stem = "place_" + scene.places[i].name + "_";
    const auto of = [i](const Sample& s) -> const std::optional<PlaceSample>& { return s.sections->places[i]; };
    const auto point = [&](const std::string& name, const char* unit, const char* description,
                           Point PlaceSample::*member) {
      q.vector(path + name, stem + name, unit, description, [of, member](const Sample& s) {
        const std::optional<PlaceSample>& place = of(s);
        return place ? std::optional((*place).*member) : std::nullopt;
      });
    };
    const auto force = [&](const std::string& name, const char* unit, const char* description,
                           double SectionForce::*member) {
      q.number(path + name, stem + name, unit, description, [of, member](const Sample& s) {
        const std::optional<PlaceSample>& place = of(s);
        return place ? std::optional(place->force.*member) : std::nullopt;
      });
    };
    point("position", "m", "where it is", &PlaceSample::position);
    point("velocity", "m/s", "velocity of the material point, or of the joint", &PlaceSample::velocity);
    q.number(path + "angle", stem + "angle", "degrees", "direction of the beam, as of angles", [of](const Sample& s) {
      const std::optional<PlaceSample>& place = of(s);
      return place ? std::optional(place->angle) : std::nullopt;
    });
    force("axial_force", "N", "along the axis, tension positive", &SectionForce::axial);
    if (bends && !has_frames(scene)) force("shear_force", "N", "as along the beam", &SectionForce::shear);
    if (bends) force("bending_moment", "N m", "as along the beam", &SectionForce::moment);
    if (has_frames(scene)) force("torque", "N m", "about the axis, right-handed", &SectionForce::torque);
    if (knows_stress(scene.beam)) {
      force("stress", "Pa", "largest magnitude in the section, of axial force and bending", &SectionForce::stress);
    }
  }
}

void add_reactions(Quantities& q, const Scene& scene) {
  q.part("reactions");
  const auto end = [&](std::size_t i, const char* name, const SupportSpec& support) {
    if (support.type == SupportType::free) return;
    q.reaction(name, std::string("the support at the ") + name,
               [i](const Sample& s) -> const Reaction& { return s.reactions[i]; });
  };
  end(0, "start", scene.start);
  if (scene.flow) {
    std::size_t i = 0;
    for (const FlowSpec::Guide& guide : scene.flow->nodes) {
      if (guide.support == SupportType::free) continue;
      q.reaction("node_" + std::to_string(guide.node), "the support of this inner node",
                 [k = i++](const Sample& s) -> const Reaction& { return s.flow->supports[k]; });
    }
  }
  end(1, "end", scene.end);
}

void add_supports_between(Quantities& q, const Scene& scene) {
  if (scene.bearings.empty()) return;
  q.part("supports");
  for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
    const std::string name = bearing_name(scene, i);
    const auto point = [&](const std::string& key, const char* unit, const char* what, Point BearingSample::*member) {
      q.vector("supports/" + name + "/" + key, "support_" + name + "_" + key, unit, what,
               [i, member](const Sample& s) -> std::optional<Point> {
                 return s.sections ? std::optional(s.sections->bearings[i].*member) : std::nullopt;
               });
    };
    point("position", "m", "of the point of the beam that it holds", &BearingSample::position);
    point("force", "N", "of the support on the beam", &BearingSample::force);
  }
}

void add_vehicles(Quantities& q, const Scene& scene) {
  if (scene.vehicles.empty()) return;
  q.part("vehicles");
  std::size_t which = 0;
  for (const VehicleSpec& vehicle : scene.vehicles) {
    for (std::size_t k = 0; k < vehicle.axles.size(); ++k, ++which) {
      const std::string axle = "axle_" + std::to_string(k), path = "vehicles/" + vehicle.name + "/" + axle + "/",
                        stem = "vehicle_" + vehicle.name + "_" + axle + "_";
      const auto of = [which](const Sample& s) -> const AxleSample& { return s.sections->axles[which]; };
      q.number(path + "x", stem + "x", "m", "material coordinate of the wheel, on the beam or off it",
               [of](const Sample& s) { return of(s).x; });
      q.number(path + "force", stem + "force", "N", "with which the wheel pushes the beam; null while it is off it",
               [of](const Sample& s) { return of(s).force; });
      q.number(path + "height", stem + "height", "m",
               "of the mass that the wheel carries, as if the spring had its length at rest; without one, of the wheel",
               [of](const Sample& s) { return of(s).height; });
    }
  }
}

void add_flow(Quantities& q, const Scene& scene) {
  q.number("flow/mass", "mass", "kg", "of the beam between its end nodes",
           [](const Sample& s) { return s.flow->mass; });
  if (scene.spin) {
    q.list("flow/end_angles", {"angle_start", "angle_end"}, "rad",
           "angle of the section at the first and the last node", SampleShape::vector,
           [](const Sample& s, double* out) { std::ranges::copy(*s.flow->end_angles, out); });
    q.number("flow/spin_momentum", "spin_momentum", "kg m^2/s", "angular momentum of the spin about the axis",
             [](const Sample& s) { return s.flow->spin_momentum; });
    Columns drives;
    for (const auto& drive : scene.spin->drives) drives.push_back("torque_node_" + std::to_string(drive.node));
    if (!drives.empty()) {
      q.list("flow/drive_torques", drives, "N m", "torque about the axis of each drive of the angle, on the beam",
             SampleShape::vector, [](const Sample& s, double* out) { std::ranges::copy(s.flow->torques, out); });
    }
  }
  static constexpr std::array axes{"_x", "_y", "_z"};
  Columns loads;
  const auto concentrated =
      std::ranges::count_if(scene.loads, [](const LoadSpec& load) { return load.at != LoadPlace::beam; });
  for (std::ptrdiff_t k = 0; k < concentrated; ++k) {
    for (std::size_t i = 0; i < q.dimension(); ++i) loads.push_back("load" + std::to_string(k) + axes[i]);
  }
  if (concentrated > 0) {
    q.list("flow/loads", loads, "m", "where the concentrated loads are; null while one is not on the beam",
           SampleShape::vectors, [d = q.dimension()](const Sample& s, double* out) {
             for (const Point& load : s.flow->loads) out = std::copy_n(load.begin(), d, out);
           });
  }
  using Ledger = FlowSample::Ledger;
  const auto entry = [&q](const char* name, const char* unit, const char* description, double Ledger::*member) {
    q.number(std::string("flow/ledger/") + name, std::string("ledger_") + name, unit, description,
             [member](const Sample& s) { return s.flow->ledger.*member; });
  };
  entry("mass", "kg", "in through the ends since t = 0", &Ledger::mass);
  entry("ends", "J", "in through the ends with the matter, and from supports and drives, since t = 0", &Ledger::ends);
  entry("loads", "J", "work of the loads since t = 0", &Ledger::loads);
  entry("mesh", "J", "work of moving inner nodes along the beam since t = 0: discretisation error only", &Ledger::mesh);
}

}  // namespace

std::vector<SampleQuantity> sample_quantities(const Scene& scene) {
  if (scene.assembly) return assembly_quantities(scene);
  Quantities q(scene.dimension);
  q.number("t", "t", "s", "time; in statics the number of the equilibrium, from 0",
           [](const Sample& s) { return s.t; });
  if (scene.analysis == Analysis::statics) {
    q.number("load_factor", "load_factor", "-", "what loads, gravity and displacements of supports are scaled by",
             [](const Sample& s) { return s.equilibrium->load_factor; });
    q.number("negative_pivots", "negative_pivots", "-",
             "directions in which the potential energy falls; 0 is a stable equilibrium",
             [](const Sample& s) { return static_cast<double>(s.equilibrium->negative_pivots); });
    if (sliding_joint(scene) != nullptr) {
      q.number("holding_force", "holding_force", "N",
               "along the beam, of what holds a joint at its material coordinate; 0 once it is released",
               [](const Sample& s) { return s.equilibrium->holding_force; });
    }
  }
  q.number("joint_position", "joint_position", "m",
           "material coordinate x_i of the sliding mass; null once it has left the beam, or without one",
           [](const Sample& s) { return s.joint_position; });
  q.vector("mass_position", "mass", "m", "position of the sliding mass; null without one",
           [](const Sample& s) { return s.mass_position; });
  q.vector("end", "end", "m", "position of the beam's last node", [](const Sample& s) -> Point { return s.end; });
  q.number("beam_length", "beam_length", "m", "arc length of the deformed beam",
           [](const Sample& s) { return s.beam_length; });
  q.number("beam_length_rate", "beam_length_rate", "m/s", "rate of that length",
           [](const Sample& s) { return s.beam_length_rate; });
  add_energy(q, scene);
  for (const std::size_t end : {0U, 1U}) {
    if (!(end == 0 ? scene.start : scene.end).pays_out()) continue;
    const std::string name = end == 0 ? "start" : "end";
    q.number("winches/" + name + "_length", "winch_" + name + "_length", "m",
             "length of beam that the winch there has paid out since t = 0",
             [end](const Sample& s) { return s.winches[end]->length; });
    q.number("winches/" + name + "_rate", "winch_" + name + "_rate", "m/s", "rate of that length",
             [end](const Sample& s) { return s.winches[end]->rate; });
    q.number("winches/" + name + "_tension", "winch_" + name + "_tension", "N",
             "tension of the beam at the winch's outlet", [end](const Sample& s) { return s.winches[end]->tension; });
    q.number("winches/" + name + "_power", "winch_" + name + "_power", "W",
             "power of the winch's push on the beam, without the energy that the beam brings along",
             [end](const Sample& s) { return s.winches[end]->power; });
  }
  q.vector("momentum", "momentum", "kg m/s", "linear momentum of beam and mass",
           [](const Sample& s) -> Point { return s.momentum; });
  const std::string angular =
      "angular momentum of beam and mass about the origin, without spin about the axis; in the plane its one "
      "component";
  if (scene.dimension == 2) {
    q.list("angular_momentum", {"angular_momentum"}, "kg m^2/s", angular, SampleShape::vector,
           [](const Sample& s, double* out) { *out = s.angular_momentum[2]; });
  } else {
    q.vector("angular_momentum", "angular_momentum", "kg m^2/s", angular,
             [](const Sample& s) -> Point { return s.angular_momentum; });
  }
  if (sliding_joint(scene)) add_joint(q, guided(scene));
  if (scene.sliding_joints.size() > 1) add_joints(q, scene.sliding_joints.size(), guided(scene));
  add_strains(q);
  add_section_forces(q, scene);
  add_ends(q, scene);
  add_reactions(q, scene);
  add_places(q, scene);
  add_supports_between(q, scene);
  add_vehicles(q, scene);
  if (has_flow_sample(scene)) add_flow(q, scene);
  return q.take();
}

}  // namespace vlbeam
