#include "scene/assembly_quantities.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "scene/assembly.hpp"
#include "scene/derived.hpp"

namespace vlbeam {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

class AssemblyQuantities {
 public:
  explicit AssemblyQuantities(const Scene& whole) : d_(static_cast<std::size_t>(whole.dimension)) {}

  std::vector<SampleQuantity> take() { return std::move(list_); }
  void add(SampleQuantity quantity) { list_.push_back(std::move(quantity)); }
  void part(const std::string& path) { list_.push_back({path, {}, "", "", SampleShape::number, 1, {}}); }

  /// `of(sample)` is a number.
  template <class Of>
  void number(const std::string& path, const std::string& unit, const std::string& description, const Of& of) {
    std::string column = path;
    std::ranges::replace(column, '/', '_');
    add({path, {column}, unit, description, SampleShape::number, 1, [of](const Sample& s, double* out) {
           *out = of(s);
           return true;
         }});
  }
  /// `of(sample)` is a point.
  template <class Of>
  void vector(const std::string& path, const std::string& unit, const std::string& description, const Of& of) {
    vector_of(path, unit, description, d_, of);
  }
  template <class Of>
  void vector_of(const std::string& path, const std::string& unit, const std::string& description, std::size_t size,
                 const Of& of) {
    static constexpr std::array axes{"_x", "_y", "_z"};
    std::vector<std::string> columns;
    std::string stem = path;
    std::ranges::replace(stem, '/', '_');
    for (std::size_t i = 0; i < size; ++i) columns.push_back(stem + axes[i]);
    add({path, columns, unit, description, SampleShape::vector, size, [of, size](const Sample& s, double* out) {
           const Point point = of(s);
           std::copy_n(point.begin(), size, out);
           return true;
         }});
  }

 private:
  std::size_t d_;
  std::vector<SampleQuantity> list_;
};

/// Whether a quantity of a beam is one of the whole only.
bool is_of_the_whole(const std::string& path) {
  constexpr std::array whole{"t", "energy/dissipated", "energy/supplied", "energy/total", "energy/discrete_total"};
  return std::ranges::find(whole, path) != whole.end();
}

void add_beam(AssemblyQuantities& q, const Scene& whole, std::size_t which) {
  const std::string& name = whole.assembly->beams[which].name;
  const Scene scene = beam_scene(whole, which);
  q.part(name);
  for (SampleQuantity quantity : sample_quantities(scene)) {
    if (is_of_the_whole(quantity.path)) continue;
    quantity.path = name + "/" + quantity.path;
    for (std::string& column : quantity.columns) column = name + "_" + column;
    if (quantity.values) {
      quantity.values = [which, values = quantity.values](const Sample& s, double* out) {
        return values(s.assembly->beams[which], out);
      };
    }
    q.add(std::move(quantity));
  }
  const std::size_t joints = sliding_joints(scene).size();
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string path = name + "/joint " + std::to_string(i);
    const auto joint = [which, i, joints](const Sample& s) {
      const Sample& beam = s.assembly->beams[which];
      return joints > 1 ? beam.joints[i] : SlidingSample{beam.joint_position, beam.mass_position, beam.joint};
    };
    q.part(path);
    q.number(path + "/position", "m", "its material coordinate",
             [joint](const Sample& s) { return joint(s).position.value_or(not_there); });
    q.number(path + "/velocity", "m/s", "rate of its material coordinate",
             [joint](const Sample& s) { return joint(s).on_beam ? joint(s).on_beam->velocity : not_there; });
    q.vector(path + "/place", "m", "its place in space", [joint](const Sample& s) {
      return joint(s).mass_position.value_or(Point{not_there, not_there, not_there});
    });
  }
}

void add_body(AssemblyQuantities& q, const Scene& whole, std::size_t which) {
  const std::string& name = whole.assembly->bodies[which].name;
  const auto of = [which](Point BodySample::*member) {
    return [which, member](const Sample& s) { return s.assembly->bodies[which].*member; };
  };
  q.part(name);
  q.vector(name + "/position", "m", "place of the center of mass", of(&BodySample::position));
  q.vector(name + "/velocity", "m/s", "velocity of the center of mass", of(&BodySample::velocity));
  if (whole.assembly->bodies[which].inertia.empty()) return;
  if (whole.dimension == 2) {
    q.number(name + "/angle", "degrees", "turn of the body axes from those of the scene, -180 to 180",
             [which](const Sample& s) { return s.assembly->bodies[which].rotation[2]; });
    q.number(name + "/angular_velocity", "rad/s", "angular velocity",
             [which](const Sample& s) { return s.assembly->bodies[which].angular_velocity[2]; });
    return;
  }
  q.vector(name + "/rotation", "degrees", "turn of the body axes from those of the scene, a rotation vector",
           of(&BodySample::rotation));
  q.vector(name + "/angular_velocity", "rad/s", "angular velocity in space", of(&BodySample::angular_velocity));
}

void add_link(AssemblyQuantities& q, const Scene& whole, std::size_t which) {
  const LinkSpec& link = whole.assembly->links[which];
  const auto of = [which](double LinkSample::*member) {
    return [which, member](const Sample& s) { return s.assembly->links[which].*member; };
  };
  q.part(link.name);
  q.vector(link.name + "/force", "N", "with which the link acts on its first end; from the ground on the other",
           [which](const Sample& s) { return s.assembly->links[which].force; });
  if (link.type != LinkType::spring && link.type != LinkType::distance) return;
  q.number(link.name + "/length", "m", "distance of its ends", of(&LinkSample::length));
  q.number(link.name + "/tension", "N", "with which it pulls its ends together", of(&LinkSample::tension));
}

}  // namespace

std::vector<SampleQuantity> assembly_quantities(const Scene& whole) {
  AssemblyQuantities q(whole);
  q.number("t", "s", "time; in statics the number of the equilibrium, from 0", [](const Sample& s) { return s.t; });
  if (whole.analysis == Analysis::statics) {
    q.number("load_factor", "-", "what loads, gravity and displacements of supports are scaled by",
             [](const Sample& s) { return s.equilibrium->load_factor; });
    q.number("negative_pivots", "-",
             "directions in which the potential energy falls, as far as they are looked for; 0 is stable",
             [](const Sample& s) { return static_cast<double>(s.equilibrium->negative_pivots); });
  }
  const auto energy = [&q](const char* name, const std::string& description, double (*of)(const Sample&)) {
    q.number(std::string("energy/") + name, "J", description, of);
  };
  q.part("energy");
  energy("kinetic", "kinetic energy of all", [](const Sample& s) { return s.energy.kinetic; });
  energy("axial", "strain energy of stretching, and of springs", [](const Sample& s) { return s.energy.axial; });
  energy("bending", "strain energy of bending", [](const Sample& s) { return s.energy.bending; });
  energy("torsion", "strain energy of torsion", [](const Sample& s) { return s.energy.torsion; });
  energy("gravity", "potential energy of gravity as it is then", [](const Sample& s) { return s.energy.gravity; });
  energy("dissipated", "taken by damping and friction since t = 0",
         [](const Sample& s) { return s.energy.dissipated; });
  energy("supplied", "work since t = 0 of supports that move, of guides, of loads and of gravity while it grows",
         [](const Sample& s) { return s.energy.supplied + s.flow->ledger.loads + s.flow->ledger.ends; });
  energy("total", "sum of these but `supplied`; total - supplied is what is conserved",
         [](const Sample& s) { return s.energy.total(); });
  q.vector("momentum", "kg m/s", "linear momentum of all", [](const Sample& s) { return s.momentum; });
  if (whole.dimension == 2) {
    q.number("angular_momentum", "kg m^2/s", "angular momentum of all about the origin",
             [](const Sample& s) { return s.angular_momentum[2]; });
  } else {
    q.vector("angular_momentum", "kg m^2/s", "angular momentum of all about the origin",
             [](const Sample& s) { return s.angular_momentum; });
  }
  for (std::size_t i = 0; i < whole.assembly->beams.size(); ++i) add_beam(q, whole, i);
  for (std::size_t i = 0; i < whole.assembly->bodies.size(); ++i) add_body(q, whole, i);
  for (std::size_t i = 0; i < whole.assembly->links.size(); ++i) add_link(q, whole, i);
  return q.take();
}

}  // namespace vlbeam
