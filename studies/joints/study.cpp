// What slides on a beam against what is known without elements: rings, sleeves, several masses, and masses that are
// driven.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/scene_json.hpp"

namespace vlbeam {
namespace joints {
namespace {

constexpr double degree = std::numbers::pi / 180;

double distance(const Point& a, const Point& b) { return portable::hypot(a[0] - b[0], a[1] - b[1]); }

LoadSpec pull(int node, double force, const Point& direction, double ramp = 0) {
  return {.node = node, .x = {}, .magnitude = {.value = force, .ramp = ramp}, .direction = direction, .turn = {}};
}

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        root_(context.folder.parent_path().parent_path()),
        statics_(parse_json(read_text(root_ / "reference" / "joints.json"))),
        bridge_(parse_json(read_text(root_ / "reference" / "bridge.json"))),
        hoisted_(parse_json(read_text(root_ / "reference" / "winch.json")).at("path")) {}

  StudyReport operator()() {
    sleeves();
    ring();
    heavy_masses();
    mirrored_masses();
    light_masses();
    trolleys();
    driven_mass();
    guided_bead();
    rod_let_down();
    hoisted_weight();
    fed_under_a_bead();
    lead_screws();
    lifted_load();
    report_.tables.push_back(std::move(errors_));
    const GnuplotVariables variables{{"folder", context_.folder.string()}};
    report_.figures = {{"sleeve", "A rod that leaves a sleeve and bears a weight, in balance", "sleeve.gp", variables},
                       {"errors", "Error of the equilibria against the number of elements", "errors.gp", variables},
                       {"trolleys", "Two trolleys on a rope", "trolleys.gp", variables},
                       {"bridge", "A mass that is driven over a bridge, and its modes", "bridge.gp", variables},
                       {"winch", "A weight that a winch hoists while it swings", "winch.gp", variables},
                       {"screw", "A load on a lead screw, by the torque that turns it", "screw.gp", variables}};
    return std::move(report_);
  }

 private:
  /// A scene of the library, by an integrator whose error is far below what it is compared with.
  Scene library(const std::string& name) const {
    Json scene = read_json(root_ / "scenes" / (name + ".json"));
    Json& beam = scene["beam"];
    beam["strain_law"] = "green";  // the references'
    if (beam["section"].value("EI", Json()) == 0) {
      beam["axial_strain"] = "full";
      beam["compression"] = "full";
    }
    const Json& integrators = context_.config.at("integrators");
    if (integrators.contains(name)) scene["integrator"] = integrators.at(name);
    return scene_from_json(scene);
  }

  void add(const std::string& name, const char* level, const std::vector<double>& levels,
           const std::vector<double>& errors, double floor) {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      errors_.rows.push_back({name, levels[i], errors[i]});
      report_.cases.push_back({.options = {{"case", name}, {level, levels[i]}}, .results = {{"error", errors[i]}}});
    }
    report_.measured[name + "_error"] = errors.back();
    report_.fits.push_back(
        fit_order(name, levels, errors, {.floor = floor, .rule = level_rule_of(context_.config, name)}));
  }
  std::vector<double> levels(const char* key) const { return context_.config.at(key).get<std::vector<double>>(); }

  /// `beyond` is the length of the rod over that outside of the sleeve in balance, `off` how far from there it starts.
  RunResult rod_in_sleeve(const std::string& degrees, int elements, double beyond, double off) const {
    const Json& known = statics_.at("sleeve");
    const double beta = std::stod(degrees) * degree, outside = known.at("degrees").at(degrees).at("length");
    const double length = beyond * outside;
    Scene scene = library("rod_through_sleeve");
    scene.beam.elements = elements;
    scene.beam.curve.end = {length * portable::cos(beta), length * portable::sin(beta), 0};
    scene.beam.section.EA = known.at("EA");
    scene.sliding_joints.front().position = length - outside + off;
    scene.loads = {pull(elements, known.at("load"), {0, -1, 0})};
    return StudyContext::simulate_to_the_end(scene);
  }

  /// With a sleeve on a node that all meshes have, and, on the finest, started elsewhere.
  void sleeves() {
    Table shapes{.name = "sleeve_shapes",
                 .caption = "Axis of the rod outside of the sleeve, by the inclination of the sleeve",
                 .columns = {"degrees", "x", "y"},
                 .curve = true};
    Table tips{.name = "sleeve_tips",
               .caption = "The rod in an inclined sleeve: length outside of it by shooting and on the finest mesh",
               .columns = {"degrees", "length", "computed", "tip_x", "tip_y"}};
    const auto meshes = levels("elements");
    int unstable = 0;
    double elsewhere = 0, at_tips = 0, worst = 0, least = std::numeric_limits<double>::infinity();
    for (const auto& [degrees, rod] : statics_.at("sleeve").at("degrees").items()) {
      const double length = rod.at("length"), angle = std::stod(degrees);
      std::vector<double> errors;
      for (const double n : meshes) {
        const RunResult result = rod_in_sleeve(degrees, static_cast<int>(n), 10.0 / 7, 0);
        const Sample& balanced = result.samples.back();
        const double outside = 10.0 / 7 * length - *balanced.joint_position;
        errors.push_back(std::abs(outside - length) / length);
        if (n < meshes.back()) continue;
        unstable += balanced.equilibrium->negative_pivots > 0 ? 1 : 0;
        const Point sleeve = *balanced.mass_position;
        const Point tip{balanced.end[0] - sleeve[0], balanced.end[1] - sleeve[1], 0};
        tips.rows.push_back({angle, length, outside, tip[0], tip[1]});
        at_tips = std::max(at_tips, distance(tip, {rod.at("x"), rod.at("y"), 0}));
        for (const Point& r : result.configurations.back().r) {
          if (r[0] > sleeve[0] - 1e-9) shapes.rows.push_back({angle, r[0] - sleeve[0], r[1] - sleeve[1]});
        }
        const RunResult other = rod_in_sleeve(degrees, static_cast<int>(n), 1.4, 0.05);
        elsewhere =
            std::max(elsewhere, std::abs(1.4 * length - *other.samples.back().joint_position - length) / length);
      }
      add("sleeve_" + degrees, "elements", meshes, errors, 1e-11);
      worst = std::max(worst, errors.back());
      for (std::size_t i = 1; i < errors.size(); ++i) {
        least = std::min(least, portable::log(errors[i - 1] / errors[i]) / portable::log(meshes[i] / meshes[i - 1]));
      }
    }
    report_.measured["sleeve_worst_error"] = worst;
    report_.measured["sleeve_least_order"] = least;
    report_.measured["sleeves_unstable"] = unstable;
    report_.measured["sleeve_tip_error"] = at_tips;
    report_.measured["sleeve_elsewhere_error"] = elsewhere;
    report_.tables.push_back(std::move(shapes));
    report_.tables.push_back(std::move(tips));
  }

  /// A slack cable through a ring: where it comes to rest, and with which forces at its ends.
  void ring() {
    const Json& known = statics_.at("ring").at("green");
    const auto size = [](const Json& force) { return portable::hypot(force[0].get<double>(), force[1].get<double>()); };
    std::vector<double> places, forces;
    for (const double n : levels("cable_elements")) {
      Scene scene = library("cable_through_ring");
      scene.beam.elements = static_cast<int>(n);
      const Sample balanced = StudyContext::simulate_to_the_end(scene).samples.back();
      places.push_back(std::abs(*balanced.joint_position - known.at("x").get<double>()));
      const auto off = [&](std::size_t end, const char* name) {
        const Point& force = balanced.reactions[end].position;
        return std::abs(portable::hypot(force[0], force[1]) / size(known.at(name)) - 1);
      };
      forces.push_back(std::max(off(0, "start_force"), off(1, "end_force")));
    }
    add("ring_place", "elements", levels("cable_elements"), places, 1e-11);
    add("ring_forces", "elements", levels("cable_elements"), forces, 1e-11);
  }

  /// A cantilever that runs through a ring, or bears a mass instead of it.
  void heavy_masses() {
    Scene scene;
    scene.gravity = {};
    scene.beam.strain_law = StrainLaw::green;
    scene.beam.element = ElementKind::ale_ancf;
    scene.beam.elements = 8;
    scene.beam.section.radius = 0.02;
    scene.start.type = SupportType::clamp;
    SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
    joint.support = SupportType::pin;
    joint.position = 0.55;
    scene.loads = {pull(8, 200, {-0.6, 1, 0}, 0.05)};
    explicitly(scene, 1e-12);
    scene.duration = 0.1;
    const auto where = [](const Scene& of) { return StudyContext::simulate_to_the_end(of).samples.back().end; };
    const Point held = where(scene);
    joint.support = SupportType::free;
    std::vector<double> errors;
    for (const double mass : levels("masses")) {
      joint.mass = mass;
      errors.push_back(distance(where(scene), held));
    }
    add("heavy_mass", "mass", levels("masses"), errors, 1e-12);
  }

  static void explicitly(Scene& scene, double tolerance) {
    scene.integrator = {};
    scene.integrator.type = IntegratorType::fehlberg78;
    scene.integrator.rtol = scene.integrator.atol = tolerance;
  }

  /// A soft beam of 2 m between two pins, with masses on it.
  static Scene rope(const std::vector<std::array<double, 3>>& masses) {
    Scene scene;
    scene.beam.strain_law = StrainLaw::green;
    scene.beam.element = ElementKind::ale_ancf;
    scene.beam.elements = 16;
    scene.beam.curve.end = {2, 0, 0};
    scene.beam.section.radius = 0.015;
    scene.beam.material = {.density = 1200, .youngs_modulus = 5e7};
    scene.start.type = scene.end.type = SupportType::pin;
    for (const auto& [position, mass, velocity] : masses) {
      SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
      joint.mass = mass;
      joint.position = position;
      joint.velocity = velocity;
    }
    explicitly(scene, 1e-11);
    return scene;
  }

  void mirrored_masses() {
    Scene scene = rope({{0.4, 0.5, 1.5}, {1.6, 0.5, -1.5}});
    scene.duration = 0.3;
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    double off = 0;
    for (const Sample& sample : result.samples) {
      off = std::max(off, std::abs(*sample.joints[0].position + *sample.joints[1].position - 2));
      off = std::max(off, std::abs((*sample.joints[0].mass_position)[1] - (*sample.joints[1].mass_position)[1]));
    }
    report_.measured["mirror_off"] = off;
    report_.measured["mirror_events"] = static_cast<int>(result.events.size());
  }

  /// What a second mass changes of the first one's motion, halved twice.
  void light_masses() {
    const auto place = [](double light) {
      Scene scene = rope({{0.5, 0.5, 1}, {1.45, light, 0}});
      scene.length_control.lower = 0.4985;
      scene.length_control.end_merge = 0;
      scene.duration = 0.12;
      return *StudyContext::simulate_to_the_end(scene).samples.back().joints[0].position;
    };
    const double with_4 = place(4e-4), with_2 = place(2e-4), with_1 = place(1e-4);
    report_.measured["light_mass_ratio"] = (with_4 - with_2) / (with_2 - with_1);
  }

  void trolleys() {
    Scene scene = library("two_trolleys");
    explicitly(scene, 1e-12);
    scene.output.interval = 0.005;
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    Table path{.name = "trolleys",
               .caption = "Two trolleys on a rope: material coordinates and places",
               .columns = {"t", "x_0", "x_1", "X_0", "Y_0", "X_1", "Y_1"},
               .curve = true};
    double largest = 0;
    for (const Sample& sample : result.samples) {
      const auto &first = sample.joints[0], &second = sample.joints[1];
      path.rows.push_back({sample.t, *first.position, *second.position, (*first.mass_position)[0],
                           (*first.mass_position)[1], (*second.mass_position)[0], (*second.mass_position)[1]});
      const Energy& energy = sample.energy;
      largest = std::max({largest, energy.kinetic, energy.axial + energy.bending, std::abs(energy.gravity)});
    }
    report_.measured["trolleys_ledger"] = result.max_energy_drift / largest;
    report_.measured["trolleys_events"] = static_cast<int>(result.events.size());
    report_.tables.push_back(std::move(path));
  }

  void driven_mass() {
    const double unit = bridge_.at("static_deflection");
    Table path{
        .name = "bridge",
        .caption = "Deflection under a mass that is driven over a bridge, over the static one under it in the middle",
        .columns = {"t", "deflection"},
        .curve = true};
    for (const auto& [name, element] :
         {std::pair{"ancf", ElementKind::ale_ancf}, std::pair{"rancf", ElementKind::ale_rancf}}) {
      std::vector<double> errors;
      for (const double step : levels("steps")) {
        Scene scene = library("bridge");
        scene.beam.element = element;
        scene.beam.elements = context_.config.at("bridge_elements");
        scene.integrator.step = step;
        scene.output.interval = 4e-3;
        const RunResult result = StudyContext::simulate_to_the_end(scene);
        double worst = 0;
        for (const auto& at : bridge_.at("under_the_mass")) {
          const auto sample = std::ranges::min_element(
              result.samples, {}, [t = at.at("t").get<double>()](const Sample& s) { return std::abs(s.t - t); });
          worst = std::max(worst, std::abs((*sample->mass_position)[1] - at.at("y").get<double>()) / unit);
        }
        errors.push_back(worst);
        if (step > levels("steps").back() || element != ElementKind::ale_ancf) continue;
        for (const Sample& sample : result.samples) path.rows.push_back({sample.t, (*sample.mass_position)[1] / unit});
      }
      add(std::string("bridge_") + name, "step", levels("steps"), errors,
          bridge_.at("uncertainty").get<double>() / unit);
    }
    report_.tables.push_back(std::move(path));
    Table modes{
        .name = "bridge_modes", .caption = "The same by modes of the linear beam", .columns = {"t", "deflection"}};
    for (const auto& at : bridge_.at("under_the_mass")) {
      modes.rows.push_back({at.at("t"), at.at("y").get<double>() / unit});
    }
    report_.tables.push_back(std::move(modes));
  }

  /// Guided as it would slide by itself a bead needs no force.
  void guided_bead() {
    Scene scene = library("incline");
    const double weight = scene.sliding_mass->mass * 9.81;
    SlidingJointSpec& bead = scene.sliding_joints.emplace_back();
    static_cast<SlidingMassSpec&>(bead) = *scene.sliding_mass;
    scene.sliding_mass.reset();
    scene.output.interval = scene.integrator.step;
    const auto mean = [&](double acceleration) {
      bead.x = TimeSpec{.acceleration = acceleration};
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      double force = 0;
      for (const Sample& sample : result.samples) force += sample.joint->guiding;
      return std::abs(force) / static_cast<double>(result.samples.size()) / weight;
    };
    report_.measured["freely_guided_force"] = mean(9.81 / 2);
    report_.measured["evenly_guided_force"] = mean(0);
  }

  /// At constant speed, after a start from rest: an inextensible rod hangs at the length that is out, by its weight.
  /// The reaction gives what comes out its momentum.
  void rod_let_down() {
    constexpr double rhoA = 0.1, gravity = 9.81, speed = 1, length = 1;
    std::vector<double> places, forces;
    for (const double EA : levels("stiffnesses")) {
      Scene scene;
      scene.gravity = {0, -gravity, 0};
      scene.beam.strain_law = StrainLaw::green;
      scene.beam.element = ElementKind::ale_ancf;
      scene.beam.elements = 8;
      scene.beam.curve.end = {0, -length, 0};
      scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0.01, .rhoA = rhoA};
      scene.start.type = SupportType::pin;
      scene.start.feed = TimeSpec{.rate = speed, .ramp = 0.5};
      scene.initial_shape = InitialShape::equilibrium;
      scene.integrator = {};
      scene.integrator.type = IntegratorType::generalized_alpha;
      scene.integrator.step = 2e-4;
      scene.duration = 2;
      scene.output.interval = 0.01;
      double place = 0, force = 0;
      for (const Sample& sample : StudyContext::simulate_to_the_end(scene).samples) {
        if (sample.t < 1) continue;
        const double out = length + speed * sample.t, expected = rhoA * (gravity * out - speed * speed);
        place = std::max(place, std::abs(sample.end[1] + out) / out);
        force = std::max(force, std::abs(sample.reactions[0].position[1] / expected - 1));
      }
      places.push_back(place);
      forces.push_back(force);
    }
    add("winch_place", "EA", levels("stiffnesses"), places, 1e-12);
    report_.measured["winch_force_error"] = forces.back();
  }

  void hoisted_weight() {
    Scene scene = library("winch");
    scene.output.interval = 0.025;
    Table path{.name = "winch",
               .caption = "Path of a weight that a winch hoists while it swings [m]",
               .columns = {"t", "X", "Y"},
               .curve = true};
    Table pendulum{.name = "winch_pendulum",
                   .caption = "The same of a point on an inextensible cable without mass [m]",
                   .columns = {"t", "X", "Y"}};
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    for (const Sample& sample : result.samples) path.rows.push_back({sample.t, sample.end[0], sample.end[1]});
    double worst = 0;
    for (const auto& at : hoisted_) {
      const double t = at.at("t"), x = at.at("x"), y = at.at("y");
      const auto sample =
          std::ranges::min_element(result.samples, {}, [t](const Sample& s) { return std::abs(s.t - t); });
      worst = std::max(worst, distance(sample->end, {x, y, 0}));
      pendulum.rows.push_back({t, x, y});
    }
    report_.measured["hoisted_error"] = worst;
    report_.measured["hoisted_events"] = static_cast<int>(result.events.size());
    report_.tables.push_back(std::move(path));
    report_.tables.push_back(std::move(pendulum));
  }

  /// A bead slides down a cable that is paid out askew, by a pin that moves.
  void fed_under_a_bead() {
    double worst = 0;
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      Scene scene = rope({{0.3, 0.05, 0.5}});
      scene.beam.element = element;
      scene.end = {};
      scene.start.feed = TimeSpec{.rate = 1, .ramp = 0.1};
      scene.start.motion = {.direction = {0, 1, 0}, .displacement = {.rate = 0.5, .ramp = 0.2}};
      explicitly(scene, 1e-12);
      scene.duration = 0.4;
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      worst = std::max(worst, result.max_energy_drift / result.max_kinetic);
    }
    report_.measured["fed_ledger"] = worst;
  }

  /// The scene of the library as a rigid screw: its nut's material coordinate under a torque that grows as gravity
  /// does.
  static double on_a_rigid_screw(const Scene& scene, double t) {
    const SlidingJointSpec& nut = scene.sliding_joints.front();
    const double lead = *nut.pitch / (2 * std::numbers::pi), ramp = scene.gravity_ramp,
                 inertia = scene.beam.section.rhoIp + nut.mass * lead * lead,
                 torque = scene.loads.front().magnitude.value + nut.mass * scene.gravity[1] * lead;
    const double turned = ramp * ramp * 5 / 36 + ramp / 2 * (t - ramp) + (t - ramp) * (t - ramp) / 2;
    return nut.position - lead * torque / inertia * turned;
  }

  /// Against the rigid screw, the stiffer the nearer; and what the ledger leaves where it is soft.
  void lead_screws() {
    std::vector<double> places;
    for (const double EA : levels("screw_stiffnesses")) {
      Scene scene = library("lead_screw");
      scene.beam.section.EA = EA;
      scene.beam.section.GIp = 1e-4 * EA;
      scene.integrator.rtol = scene.integrator.atol = 1e-9;
      double place = 0;
      for (const Sample& sample : StudyContext::simulate_to_the_end(scene).samples) {
        if (sample.t < scene.gravity_ramp) continue;
        place = std::max(place, std::abs(*sample.joint_position - on_a_rigid_screw(scene, sample.t)));
      }
      places.push_back(place);
    }
    add("screw_place", "EA", levels("screw_stiffnesses"), places, 1e-8);
    double worst = 0;
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      Scene scene = library("lead_screw");
      scene.beam.element = element;
      scene.beam.section.EA = 1e5;
      scene.beam.section.GIp = 10;
      scene.duration = 1;
      scene.gravity_ramp = 0;  // the work of gravity that grows is summed up to order 4 only
      explicitly(scene, 1e-11);
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      worst = std::max(worst, result.max_energy_drift / result.max_kinetic);
      report_.measured["screw_events"] = static_cast<int>(result.events.size());
    }
    report_.measured["screw_ledger"] = worst;
  }

  void lifted_load() {
    const Scene given = library("lead_screw");
    const double weight = given.sliding_joints.front().mass * -given.gravity[1],
                 balance = weight * *given.sliding_joints.front().pitch / (2 * std::numbers::pi);
    Table heights{
        .name = "screw",
        .caption = "Height of a load on a lead screw over time, by the torque on the screw over that of balance",
        .columns = {"t", "torque", "height"},
        .curve = true};
    Table rigid{
        .name = "screw_rigid", .caption = "The same on a rigid screw [m]", .columns = {"t", "torque", "height"}};
    double worst = 0;
    for (const double share : {0.96, 1.0, 1.06, 1.2}) {
      Scene scene = given;
      scene.loads.front().magnitude.value = share * balance;
      scene.duration = 1;
      for (const Sample& sample : StudyContext::simulate_to_the_end(scene).samples) {
        heights.rows.push_back({sample.t, share, 1 - *sample.joint_position});
        if (sample.t < scene.gravity_ramp) continue;
        const double known = on_a_rigid_screw(scene, sample.t);
        worst = std::max(worst, std::abs(*sample.joint_position - known));
        if (std::lround(sample.t / scene.output.interval) % 5 == 0) rigid.rows.push_back({sample.t, share, 1 - known});
      }
    }
    report_.measured["screw_lift_error"] = worst;
    report_.tables.push_back(std::move(heights));
    report_.tables.push_back(std::move(rigid));
  }

  const StudyContext& context_;
  std::filesystem::path root_;
  Json statics_, bridge_, hoisted_;
  StudyReport report_;
  Table errors_{
      .name = "errors",
      .caption =
          "Errors of length outside a sleeve over itself, of a cable's place in a ring [m] and its end forces over "
          "themselves, of a heavy mass against a ring [m], of the deflection of a bridge over the static one",
      .columns = {"case", "level", "error"}};
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace joints

Study joints_study();

Study joints_study() {
  return {.name = "joints", .title = "What slides on a beam, and what holds or drives it", .run = joints::run};
}

}  // namespace vlbeam
