#include "scene/simulate_assembly.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "mechanics/assembly/assembly_statics.hpp"
#include "scene/beam_record.hpp"
#include "scene/build.hpp"
#include "scene/build_assembly.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/extremes.hpp"
#include "scene/plausibility.hpp"
#include "scene/section_sample.hpp"
#include "scene/static_sample.hpp"

namespace vlbeam {
namespace {

constexpr double agrees_within = 1e-6;  // of the speeds there are: velocities of what a link holds at t = 0
constexpr double degree = std::numbers::pi / 180;

template <int D>
class AssemblyRun {
 public:
  AssemblyRun(const Scene& whole, const ProgressCallback& progress, const RunOutput& output)
      : whole_(whole), parts_(*whole.assembly), progress_(progress), output_(output), stops_(whole) {
    typename AssemblySystem<D>::Members members;
    for (std::size_t i = 0; i < parts_.beams.size(); ++i) {
      beams_.emplace_back(beam_scene(whole, i), output_);
      members.push_back(std::make_unique<BeamMember<D>>(beams_.back().system, beams_.back().forces));
      follow(i);
    }
    for (const BodySpec& body : parts_.bodies) {
      bodies_.push_back(std::make_unique<BodySystem<D>>(build_body<D>(whole, body)));
      members.push_back(std::make_unique<BodyMember<D>>(*bodies_.back()));
    }
    std::vector<Link<D>> links;
    for (const LinkSpec& link : parts_.links) links.push_back(build_link<D>(whole, link));
    system_ = std::make_unique<AssemblySystem<D>>(std::move(members), std::move(links));
    system_->corrects = whole.integrator.type != IntegratorType::generalized_alpha;
    check_velocities();
    settle();
    warn_of_twist();
    system_->on_sample = [this](const Eigen::VectorXd& y, double t) { sample(y, t); };
    system_->on_step = [this](double t) { return !progress_ || progress_(t); };
    system_->on_event = [this](double jump) { event_of_whole(jump); };
    if (whole.output.extremes) {
      extremes_.emplace(whole);
      system_->on_state = [this](const Eigen::VectorXd& y, double t) {
        system_->find_forces(y, t);
        for (std::size_t i = 0; i < beams_.size(); ++i) beams_[i].state = system_->state_of(y, i);
        extremes_->add(seen(y, t));
      };
    }
  }

  /// Follows the equilibria.
  RunResult rest() {
    AssemblyStaticsOptions options{.steps = whole_.statics.steps,
                                   .arc_length = whole_.statics.control == LoadControl::arc_length,
                                   .tolerance = whole_.statics.tolerance,
                                   .length = beam_length(whole_)};
    const BeamSection section = build_section(whole_);
    options.wave_rate = std::sqrt(section.stiffness.EA / section.rhoA) / options.length;
    std::optional<AssemblyEquilibrium> last;
    const auto started = std::chrono::steady_clock::now();
    try {
      trace_equilibria<D>(
          *system_, options,
          [&](const AssemblyEquilibrium& at) {
            add_equilibrium(at);
            last = at;
            const bool goes_on = !progress_ || progress_(at.factor);
            if (!goes_on) result_.status = RunStatus::interrupted;
            return goes_on;
          },
          result_.solver);
      if (last && whole_.statics.frequencies > 0) {
        result_.frequencies = natural_frequencies<D>(*system_, options, *last, whole_.statics.frequencies);
      }
    } catch (const ComputationFailed& failure) {
      result_.status = RunStatus::failed;
      result_.failure = failure.what();
      result_.failure_time = failure.t;
    }
    result_.timing.motion = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    add_implausible();
    return std::move(result_);
  }

  RunResult operator()() {
    IntegrationOptions options = options_of_shortest_wave();
    run_to_end(
        whole_, *system_, [this] { return system_->initial_state(); }, stops_, options, nullptr, result_);
    for (const Beam& beam : beams_) result_.solver.rhs_evaluations += beam.system.rhs_evaluations();
    add_implausible();
    return std::move(result_);
  }

 private:
  /// A beam, as it moves and as it is recorded.
  struct Beam {
    Scene scene;
    std::shared_ptr<LinkForces<D>> forces = std::make_shared<LinkForces<D>>();
    BeamSystem<D> system;
    BeamRecord<D> record;
    Eigen::VectorXd state = {};  ///< that is sampled

    Beam(Scene of, const RunOutput& output)
        : scene(std::move(of)), system(model(), build_chain<D>(scene)), record(scene, system, output) {}

    BeamModel<D> model() const {
      BeamModel<D> model = build_model<D>(scene);
      model.parts.push_back(std::make_shared<ActingLinks<D>>(forces));
      return model;
    }
  };

  void follow(std::size_t i) {
    Beam& beam = beams_[i];
    beam.system.on_sample = [&beam](const Eigen::VectorXd& y, double /*t*/) { beam.state = y; };
    beam.system.on_event = [this, &beam, i](const EventRecord<D>& record) {
      Event event = beam.record.event(record);
      event.beam = parts_.beams[i].name;
      booked_ += event.discrete_jump;
      result_.timing.length_control += record.seconds;
      result_.events.push_back(std::move(event));
    };
  }

  /// What velocities lose where links hold an event's beam belongs to the event.
  void event_of_whole(double jump) {
    jumps_ += jump;
    if (!result_.events.empty()) {
      result_.events.back().discrete_jump += jump - booked_;
      result_.events.back().energy_jump.kinetic += jump - booked_;
    }
    booked_ = 0;
  }

  /// Throws InvalidInput where the velocities at t = 0 tear a link.
  void check_velocities() const {
    const Eigen::VectorXd y = system_->initial_state();
    const double speed = y.segment(system_->coordinates(), system_->coordinates()).cwiseAbs().maxCoeff();
    const auto gaps = system_->gaps();
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      if (!(gaps[k].rate > agrees_within * speed)) continue;
      refuse(
          "/links/" + std::to_string(k) + "/between",
          "ends that part with " + six_digits(gaps[k].rate) + " m/s at t = 0",
          "what a link ties starts with one velocity: see velocity of bodies, initial_velocity of beams, velocity of "
          "joints");
    }
  }

  void settle() {
    const std::vector<std::string> redundant = system_->settle();
    if (redundant.empty()) return;
    std::string names;
    for (const std::string& name : redundant) names += (names.empty() ? "\"" : ", \"") + name + "\"";
    result_.warnings.push_back({WarningKind::redundant_links,
                                "other links hold already what " + names + (redundant.size() > 1 ? " hold" : " holds") +
                                    ": the motion is right, and how they share the force is not known",
                                "leave out what is held twice, or take a \"pin\" in place of a \"clamp\""});
  }

  /// A clamp in space holds the tangent of a beam. Its sections turn about it as they like where they have no frames.
  void warn_of_twist() {
    if (D == 2) return;
    std::vector<std::string> free;
    for (const LinkSpec& link : parts_.links) {
      if (link.type != LinkType::clamp) continue;
      for (const LinkEndSpec& end : link.between) {
        const std::string& name = parts_.beams[end.is_of_beam() ? end.which : 0].name;
        const bool one_beam = link.between[0].is_of_beam() && link.between[1].is_of_beam();
        if (end.is_of_beam() && !one_beam && std::ranges::find(free, name) == free.end()) free.push_back(name);
      }
    }
    if (free.empty()) return;
    std::string names;
    for (const std::string& name : free) names += (names.empty() ? "\"" : ", \"") + name + "\"";
    result_.warnings.push_back({WarningKind::free_twist,
                                "what is clamped to " + names + " turns freely about the axis there: without frames " +
                                    "beams have no torsion, and GIp is not used",
                                "hold its turning otherwise, by a second beam or a link"});
  }

  IntegrationOptions options_of_shortest_wave() const {
    IntegrationOptions shortest;
    double least = std::numeric_limits<double>::infinity();
    for (const Beam& beam : beams_) {
      const auto options = integration_options(whole_, beam.system.model().section, beam.system.mesh().shortest());
      if (!(options.first_step < least)) continue;
      least = options.first_step;
      shortest = options;
    }
    return shortest;
  }

  void sample(const Eigen::VectorXd& y, double t) {
    if (stops_.keeps_shape_at(t)) {
      for (std::size_t i = 0; i < beams_.size(); ++i) {
        Configuration shape = beams_[i].record.shape(beams_[i].state, t);
        shape.beam = parts_.beams[i].name;
        output_.add(std::move(shape), result_);
      }
    }
    if (!stops_.samples_at(t)) return;
    Sample now = seen(y, t);
    if (extremes_) {
      extremes_->add(now);
      now.extremes = std::make_shared<const std::vector<Extreme>>(extremes_->all());
    }
    if (result_.samples.empty()) first_total_ = now.discrete_total;
    result_.max_kinetic = std::max(result_.max_kinetic, now.energy.kinetic);
    const FlowSample::Ledger& ledger = now.flow->ledger;
    const double gain = now.discrete_total - now.energy.supplied - ledger.ends - ledger.loads - first_total_ - jumps_;
    result_.max_energy_drift = std::max(result_.max_energy_drift, std::abs(gain));
    result_.samples.push_back(std::move(now));
    most_energy_ = std::max(most_energy_, energy_there_is(result_.samples.front(), result_.samples.back()));
    if (result_.solver.steps >= steps_unjudged) check_source_of_energy(whole_, most_energy_, gain, t);
  }

  /// The state of each beam, and forces of links, are those of y.
  Sample seen(const Eigen::VectorXd& y, double t) const {
    const Observation<D> all = system_->observe(y, t, ledger_points), own = system_->observe(y, t, own_points);
    Sample sample;
    sample.t = t;
    sample.energy = all.energy;
    sample.discrete_total = own.energy.total();
    sample.momentum = point_of<D>(all.momentum);
    sample.angular_momentum = point_of<3>(all.angular_momentum);
    sample.beam_length = all.beam_length;
    FlowSample given;
    given.ledger = {0, all.end_work, all.load_work, 0};
    sample.flow = std::make_shared<const FlowSample>(std::move(given));
    AssemblySample parts;
    for (const Beam& beam : beams_) parts.beams.push_back(beam.record.seen(beam.state, t).sample);
    for (std::size_t i = 0; i < bodies_.size(); ++i) parts.bodies.push_back(body_sample(y, i));
    for (std::size_t k = 0; k < parts_.links.size(); ++k) parts.links.push_back(link_sample(y, k));
    sample.assembly = std::make_shared<const AssemblySample>(std::move(parts));
    return sample;
  }

  void add_equilibrium(const AssemblyEquilibrium& at) {
    const auto number = static_cast<double>(result_.samples.size());
    const Observation<D> all = system_->observe(at.y, at.factor, ledger_points),
                         own = system_->observe(at.y, at.factor, own_points);
    Sample sample;
    sample.t = number;
    StaticSample equilibrium{at.factor, at.falls, 0, at.falls_known ? 0 : 1};
    sample.equilibrium = equilibrium;
    sample.energy = all.energy;
    sample.discrete_total = own.energy.total();
    FlowSample none;
    none.ledger = {0, 0, 0, 0};
    sample.flow = std::make_shared<const FlowSample>(std::move(none));
    AssemblySample parts;
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      Beam& beam = beams_[i];
      beam.state = system_->state_of(at.y, i);
      const OuterForces<D> forces = beam.system.forces_at_rest(beam.state, at.factor);
      Configuration shape = shape_of(beam.scene, beam.system, beam.state, at.factor, forces);
      shape.t = number;
      shape.beam = parts_.beams[i].name;
      parts.beams.push_back(static_sample<D>(beam.system, {beam.state, at.factor, equilibrium}, number, beam.scene,
                                             resolved_places(beam.scene), forces, shape));
      output_.add(std::move(shape), result_);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) parts.bodies.push_back(body_sample(at.y, i));
    for (std::size_t k = 0; k < parts_.links.size(); ++k) parts.links.push_back(link_sample(at.y, k));
    sample.assembly = std::make_shared<const AssemblySample>(std::move(parts));
    result_.samples.push_back(std::move(sample));
  }

  BodySample body_sample(const Eigen::VectorXd& y, std::size_t i) const {
    const BodySystem<D>& body = *bodies_[i];
    const Eigen::VectorXd state = system_->state_of(y, beams_.size() + i);
    const double *q = state.data(), *rate = q + body.coordinates();
    BodySample sample;
    sample.position = point_of<D>(Vec<double, D>(state.head<D>()));
    sample.velocity = point_of<D>(Vec<double, D>(state.segment<D>(body.coordinates())));
    sample.angular_velocity = point_of<3>(body.spin(q, rate));
    const Eigen::Matrix<double, D, D> axes = body.axes(q);
    if constexpr (D == 2) {
      sample.rotation[2] = portable::atan2(axes(1, 0), axes(0, 0)) / degree;
    } else {
      const Eigen::Quaterniond turn{Eigen::Matrix3d(axes)};
      const double sine = turn.vec().norm(), sign = turn.w() < 0 ? -1 : 1;
      const double angle = 2 * portable::atan2(sine, std::abs(turn.w())) / degree;
      if (sine > 0) sample.rotation = point_of<3>(Vec<double, 3>(sign * angle / sine * turn.vec()));
    }
    return sample;
  }

  LinkSample link_sample(const Eigen::VectorXd& y, std::size_t k) const {
    const auto forces = system_->forces_of(k);
    const bool from_ground = parts_.links[k].between[0].of == LinkEndSpec::Of::ground;
    const Vec<double, D> force = from_ground && forces.size() > 1 ? forces[1] : forces[0];
    LinkSample sample;
    sample.force = point_of<D>(force);
    const Vec<double, D> apart = system_->apart(y, k);
    sample.length = apart.norm();
    if (sample.length > 0) sample.tension = (from_ground ? -1 : 1) * force.dot(apart) / sample.length;
    return sample;
  }

  void add_implausible() {
    for (std::size_t i = 0; i < beams_.size(); ++i) {
      RunResult own;
      for (const Sample& sample : result_.samples) own.samples.push_back(sample.assembly->beams[i]);
      for (Warning warning : implausible(beams_[i].scene, own)) {
        warning.message = parts_.beams[i].name + ": " + warning.message;
        result_.warnings.push_back(std::move(warning));
      }
    }
  }

  static constexpr std::size_t steps_unjudged =
      10;  // of a motion from rest: all energy there is may be the method's error

  const Scene& whole_;
  const AssemblySpec& parts_;
  ProgressCallback progress_;
  const RunOutput& output_;
  Stops stops_;
  std::deque<Beam> beams_;  // they know each other by reference
  std::vector<std::unique_ptr<BodySystem<D>>> bodies_;
  std::unique_ptr<AssemblySystem<D>> system_;
  std::optional<Extremes> extremes_;
  RunResult result_;
  double first_total_ = 0, jumps_ = 0, booked_ = 0, most_energy_ = 0;
};

}  // namespace

namespace {

template <int D>
RunResult simulate_assembly_in(const Scene& whole, const ProgressCallback& progress, const RunOutput& output) {
  AssemblyRun<D> run(whole, progress, output);
  return whole.analysis == Analysis::statics ? run.rest() : run();
}

}  // namespace

RunResult simulate_assembly(const Scene& whole, const ProgressCallback& progress, const RunOutput& output) {
  return whole.dimension == 2 ? simulate_assembly_in<2>(whole, progress, output)
                              : simulate_assembly_in<3>(whole, progress, output);
}

}  // namespace vlbeam
