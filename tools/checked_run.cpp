#include "tools/checked_run.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <thread>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/messages.hpp"
#include "io/shapes.hpp"
#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/options.hpp"
#include "scene/validate.hpp"
#include "tools/converge_setting.hpp"
#include "tools/run_track.hpp"
#include "tools/sudden_gravity.hpp"

namespace vlbeam {
namespace {

constexpr double step_ratio = 2;                          // of a companion's steps
constexpr double implicit_order = 3, explicit_order = 5;  // of a step's error
// Errors in time fall at least in proportion to the steps; those of a mesh may hardly fall while it locks. In
// equilibria neither events nor friction lower the order of a mesh: they are trusted with one less than that of cubic
// elements.
constexpr OrderRange time_orders{1, 2}, explicit_orders{1, 4}, mesh_orders{0.5, 2}, equilibrium_orders{0.5, 3};
constexpr int fewest_elements = 3;
constexpr double most_work = 2;             // of a companion, in steps times elements of the run
constexpr double mesh_share = 0.01;         // of the motion
constexpr double whole_motion_share = 0.1;  // of the length: motion from which the accuracy is one of the length
constexpr double least_motion = 1e-6;
constexpr double nothing = 1e-10;  // of the length: what rounding lets a beam at rest move by
constexpr int most_repeats = 2;
constexpr double aimed_share = 0.8;   // of what is allowed, when a run is done again
constexpr double most_growth = 3;     // of the steps of a repetition, over what its ratio would make of them
constexpr double finest_ratio = 4;    // of steps from one repetition to the next
constexpr double hopeless_ratio = 8;  // that the order seen asks for: a second repetition would be far from it
constexpr double least_order_seen =
    0.5;                         // below, runs differ as much with shorter steps: no repetition brings them together
constexpr double much_more = 3;  // of what is wrong along the beam, over that of its end, joints and masses
constexpr const char* too_long = "it takes more work than the run itself";

/// One run and what it is compared by.
struct Seen {
  Scene scene;
  double ratio = 1;  ///< of its steps or elements to those of the run before it in its chain
  RunResult result = {};
  Track track = {};
  std::vector<double> times = {};
  std::vector<std::vector<double>> shapes = {};
  std::string why = {};  ///< it tells nothing
  bool event_shapes = false;
  ShapeSpool spool = {};

  bool tells() const { return why.empty(); }
  double work() const { return static_cast<double>(result.solver.steps) * scene.beam.elements; }
};

bool ended_well(const RunResult& result) {
  return result.status == RunStatus::completed || result.status == RunStatus::separated;
}

/// Whether a run keeps the shapes that its scene asks for.
enum class ShapesOf { the_scene, no_one };

/// Runs it, keeping shapes at `times` to be compared by.
void run(Seen& seen, const std::vector<double>& times, const ProgressCallback& progress, ShapesOf kept) {
  const bool in_time = seen.scene.analysis == Analysis::dynamics;
  const std::vector<double>& asked = seen.scene.output.configurations;
  Scene scene = seen.scene;
  if (in_time) {
    scene.output.configurations.insert(scene.output.configurations.end(), times.begin(), times.end());
    std::ranges::sort(scene.output.configurations);
    std::vector<double>& all = scene.output.configurations;
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  const auto shape = [&](const Configuration& configuration) {
    if (!scene.assembly && (!in_time || std::ranges::binary_search(times, configuration.t))) {
      seen.times.push_back(configuration.t);
      seen.shapes.push_back(probes(seen.scene, configuration));
    }
    const bool wanted = !in_time || std::ranges::find(asked, configuration.t) != asked.end();
    if (kept == ShapesOf::the_scene && wanted) seen.spool.add(configuration);
  };
  seen.result = simulate(scene, progress, nullptr, {.shape = shape, .event_shapes = seen.event_shapes});
  seen.track = track_of(seen.scene, seen.result, seen.times, seen.shapes);
}

bool possible(const Scene& scene) {
  try {
    validate(scene);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// The scene without what is kept of it for its user. An automatic integrator stays one: by it steps follow turns and
/// ramps, in companions, too.
Scene unseen(const Scene& scene) {
  Scene same = scene;
  same.output.configurations.clear();
  same.output.extremes = false;
  return same;
}

bool refines_tolerance(const Scene& scene) {
  return !has_fixed_step(scene.integrator.type) || scene.integrator.adaptive;
}

/// Steps longer by the ratio, or shorter where it is less than 1.
Scene longer_steps(const Scene& scene, double ratio) {
  if (!refines_tolerance(scene)) {
    Scene longer = scene;
    longer.integrator.step = std::min(longer.integrator.step * ratio, scene.duration);
    return longer;
  }
  const bool implicit = has_fixed_step(scene.integrator.type);
  return with_tolerance(scene, portable::pow(ratio, implicit ? implicit_order : explicit_order));
}

/// A chain of companions, each coarser than the one before.
using Companions = std::vector<std::unique_ptr<Seen>>;

Companions in_time(const Scene& scene) {
  Companions list;
  if (scene.analysis == Analysis::statics) return list;
  const Scene same = unseen(scene);
  for (const double ratio : {step_ratio, step_ratio * step_ratio}) {
    const Scene coarser = longer_steps(same, ratio);
    if (!possible(coarser)) break;
    list.push_back(std::make_unique<Seen>(Seen{coarser, step_ratio}));
  }
  return list;
}

Companions of_mesh(const Scene& scene) {
  Companions list;
  // along a path by arc length no two meshes have equilibria of equal load
  if (scene.analysis == Analysis::statics && scene.statics.control == LoadControl::arc_length) return list;
  const Scene same = unseen(scene);
  const int n = scene.beam.elements, points = quadrature_points(scene);
  int before = n;
  const auto add = [&](int elements) {
    if (elements >= before || elements < fewest_elements || list.size() == 2) return;
    try {
      const Scene coarser = on_mesh(same, elements, points);
      validate(coarser);
      list.push_back(std::make_unique<Seen>(Seen{coarser, static_cast<double>(before) / elements}));
      before = elements;
    } catch (const InvalidInput&) {  // it does not stand for the scene
    }
  };
  add((n + 1) / 2);
  if (list.empty()) add((2 * n + 2) / 3);
  add((before + 1) / 2);
  add((2 * before + 2) / 3);
  return list;
}

/// Running maxima of what a run is off from the ones before it in a chain, over the places or of one row.
struct Distances {
  std::vector<double> t, first, second;
};

/// Row by row: the largest distances of neighbours in the chain run, first, second companion.
Distances distances(const Track::Row& row, const Seen* first, const Seen* second) {
  const auto same = [&row](const Seen* seen) -> const Track::Row* {
    if (seen == nullptr || !seen->tells()) return nullptr;
    const auto found = std::ranges::find(seen->track.rows, row.quantity, &Track::Row::quantity);
    return found == seen->track.rows.end() ? nullptr : &*found;
  };
  const Track::Row *a = same(first), *b = same(second);
  Distances found;
  if (a == nullptr) return found;
  found.t = row.t;
  found.first = largest_distance(row, *a);
  if (b != nullptr) found.second = largest_distance(*a, *b);
  found.t.resize(found.first.size());
  return found;
}

/// What one row may be off, at each of its times.
struct Told {
  std::vector<double> t, error;
  double order = 1;      ///< at the end
  bool falls = true;     ///< with the steps or elements, as far as three runs tell at the end
  bool of_axis = false;  ///< of places along the beam
  double last() const { return error.empty() ? 0 : error.back(); }
};

Told told(const Track::Row& row, const Seen* first, const Seen* second, OrderRange orders) {
  const Distances found = distances(row, first, second);
  Told told;
  told.t = found.t;
  told.of_axis = row.quantity == "shape";
  if (found.first.empty()) return told;
  if (row.kind == TrackKind::force) orders = {std::min(orders.lowest, 0.5), 1};
  // only where a place is in error at a time is asked
  const std::size_t asked_from = row.kind == TrackKind::place ? 0 : found.first.size() - 1;
  told.t.erase(told.t.begin(), told.t.begin() + static_cast<std::ptrdiff_t>(asked_from));
  const ErrorOrders runs(first->ratio, second != nullptr ? second->ratio : 1, orders);
  for (std::size_t i = asked_from; i < found.first.size(); ++i) {
    const ToldError at = runs.told(found.first[i], i < found.second.size() ? found.second[i] : -1);
    told.error.push_back(told.error.empty() ? at.error : std::max(at.error, told.error.back()));
    told.order = at.order;
    told.falls = at.falls;
  }
  return told;
}

template <class... Parts>
std::string in_words(const Parts&... parts) {
  std::ostringstream text;
  text.precision(2);
  (text << ... << parts);
  return text.str();
}
std::string two_digits(double value) { return in_words(value); }

/// What all the places of a run may be off.
struct Places {
  std::vector<Told> rows;
  double largest = 0, order = 1;
  bool falls = true;          ///< the largest one does
  double beside_axis = 0;     ///< largest of the end, the joints, the masses and the winches
  bool known_beside = false;  ///< there is one

  /// In words, where places along the beam err much more than what a user looks at first.
  std::string but_for_axis() const {
    if (!known_beside || largest < much_more * beside_axis) return {};
    return " along the beam (" + two_digits(beside_axis) + " m at its end, joints and masses)";
  }
  double at(double t) const {
    double error = 0;
    for (const Told& row : rows) {
      const auto behind = std::ranges::upper_bound(row.t, t);
      if (behind != row.t.begin())
        error = std::max(error, row.error[static_cast<std::size_t>(behind - row.t.begin()) - 1]);
    }
    return error;
  }
};

Places places_of(const Track& track, const Seen* first, const Seen* second, OrderRange orders) {
  Places places;
  for (const Track::Row& row : track.rows) {
    if (row.kind != TrackKind::place) continue;
    Told found = told(row, first, second, orders);
    if (found.last() >= places.largest) {
      places.largest = found.last();
      places.order = found.order;
      places.falls = found.falls;
    }
    if (!found.of_axis) {
      places.beside_axis = std::max(places.beside_axis, found.last());
      places.known_beside = true;
    }
    places.rows.push_back(std::move(found));
  }
  return places;
}

double motion_of(const Track& track) {
  double motion = 0;
  for (const Track::Row& row : track.rows) {
    if (row.kind != TrackKind::place) continue;
    const auto ways = largest_way(row);
    if (!ways.empty()) motion = std::max(motion, ways.back());
  }
  return motion;
}

const Seen* at(const Companions& companions, std::size_t i) {
  return i < companions.size() ? companions[i].get() : nullptr;
}

class Checked {
 public:
  Checked(const Scene& scene, const ProgressCallback& progress, const RunOutput& output, int jobs)
      : progress_(progress), output_(output), jobs_(jobs), main_{scene}, time_(in_time(scene)), mesh_(of_mesh(scene)) {
    if (scene.analysis == Analysis::dynamics) times_ = probe_times(scene);
    main_.event_shapes = output.event_shapes;
  }

  RunResult operator()() {
    run_all();
    Seen* last = &main_;
    if (ended_well(main_.result)) {
      judge_mesh();
      last = &judge_time();
      conclude(*last);
    }
    last->spool.shapes()([&](const Configuration& shape) { output_.add(Configuration(shape), last->result); });
    work_ += main_.work();
    for (const Companions* list : {&mesh_, &time_, &again_}) {
      for (const auto& seen : *list) work_ += seen->work();
    }
    work_ /= main_.work();
    return std::move(last->result);
  }

  /// Of all runs, over that of the first one alone.
  double work() const { return work_; }

 private:
  /// The run and its companions, `jobs` at a time; the run goes on in this thread, for its caller's sake.
  void run_all() {
    std::vector<Seen*> companions;
    for (const Companions* list : {&mesh_, &time_}) {
      for (const auto& seen : *list) companions.push_back(seen.get());
    }
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next++; i < companions.size(); i = next++) follow(*companions[i]);
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < std::min(jobs_, static_cast<int>(companions.size()) + 1); ++i) others.emplace_back(work);
    try {
      run(main_, times_, progress_, ShapesOf::the_scene);
    } catch (...) {
      stop_ = true;
      throw;
    }
    if (!ended_well(main_.result)) stop_ = true;
    allowed_work_ = most_work * main_.work();
    work();
    others.clear();
    for (Seen* seen : companions) {
      if (seen->tells() && seen->work() > most_work * main_.work()) seen->why = too_long;
    }
  }

  /// Runs a companion as long as it is worth it. How far one comes that does not tell anything is of no account.
  void follow(Seen& seen) {
    double steps = 0;
    const auto at_step = [&](double) { return !stop_ && ++steps * seen.scene.beam.elements <= allowed_work_; };
    try {
      run(seen, times_, at_step, ShapesOf::no_one);
      if (ended_well(seen.result)) return;
      seen.why = seen.result.status == RunStatus::failed ? "it fails: " + seen.result.failure : too_long;
    } catch (const std::exception& error) {
      seen.why = explained(error);
    }
  }

  void judge_mesh() {
    error_.motion = motion_of(main_.track);
    const Seen *first = at(mesh_, 0), *second = at(mesh_, 1);
    if (first == nullptr) {
      error_.no_mesh = "no coarser mesh stands for the scene";
    } else if (!first->tells()) {
      error_.no_mesh = "the run on " + std::to_string(first->scene.beam.elements) + " elements: " + first->why;
    }
    if (!error_.no_mesh.empty()) return;
    const OrderRange orders = main_.scene.analysis == Analysis::statics ? equilibrium_orders : mesh_orders;
    mesh_places_ = places_of(main_.track, first, second, orders);
    for (const Track::Row& row : main_.track.rows) {
      error_.quantities.push_back({row.quantity, row.unit, {}, told(row, first, second, orders).last()});
    }
    error_.mesh = mesh_places_.largest;
    const double most = most_of_mesh();
    if (*error_.mesh > most && most > 0) {
      const double finer = portable::pow(*error_.mesh / most, 1 / mesh_places_.order);
      error_.elements_wanted = static_cast<int>(std::min(std::ceil(main_.scene.beam.elements * finer), 1e9));
    }
  }

  /// What the mesh may make wrong unwarned: a share of the motion; where nothing moves, of what would be a large one
  /// [m].
  double most_of_mesh() const {
    const double length = longest(main_);
    return mesh_share * (error_.motion > nothing * length ? error_.motion : whole_motion_share * length);
  }

  /// The beam's length, the largest that there was where it is fed [m].
  static double longest(const Seen& run) {
    double length = beam_length(run.scene);
    if (!run.scene.start.pays_out() && !run.scene.end.pays_out()) return length;
    for (const Sample& sample : run.result.samples) length = std::max(length, sample.beam_length);
    return length;
  }

  /// Estimates the error in time, and does the run again where it is too large. Returns the last run.
  Seen& judge_time() {
    const Scene& scene = main_.scene;
    if (scene.analysis == Analysis::statics) {
      error_.no_time = "an equilibrium has none";
      return main_;
    }
    double share = 1;  // of the motion that an automatic run's tolerances are made for
    if (scene.integrator.automatic) {
      const double length = longest(main_);
      share = std::clamp(error_.motion / (whole_motion_share * length), least_motion / whole_motion_share, 1.0);
      error_.allowed = scene.integrator.accuracy * length * share;
    }
    if (at(time_, 0) == nullptr) {
      error_.no_time = "no longer steps stand for the scene";
    } else if (!time_.front()->tells()) {
      error_.no_time = "the run of longer steps: " + time_.front()->why;
    }
    const bool high_order = refines_tolerance(scene) && !has_fixed_step(scene.integrator.type);
    const OrderRange orders = high_order ? explicit_orders : time_orders;
    std::vector<Seen*> chain{&main_};  // from the finest on
    if (error_.no_time.empty()) {
      for (const auto& seen : time_) chain.push_back(seen.get());
    } else if (scene.integrator.automatic && repeat(chain, step_ratio)) {
      error_.no_time.clear();  // shorter steps tell where longer ones do not
    } else {
      return main_;
    }
    const auto estimate = [&] {
      time_places_ = places_of(chain[0]->track, chain[1], chain.size() > 2 ? chain[2] : nullptr, orders);
      error_.time = time_places_.largest;
    };
    estimate();
    while (scene.integrator.automatic && *error_.time > error_.allowed && error_.repeats < most_repeats &&
           (!sensitive(*chain[0]) || (share < 1 && error_.repeats == 0))) {
      const double order = error_.repeats == 0 ? orders.best : time_places_.order;
      const double wanted = portable::pow(*error_.time / (aimed_share * error_.allowed), 1 / order);
      if (error_.repeats > 0 && wanted > hopeless_ratio) break;
      const double ratio = std::min(wanted, finest_ratio);
      if (!repeat(chain, ratio)) break;  // what is known is said
      estimate();
    }
    for (std::size_t i = 0; i < chain[0]->track.rows.size(); ++i) {
      const Track::Row& row = chain[0]->track.rows[i];
      if (i == error_.quantities.size()) error_.quantities.push_back({row.quantity, row.unit, {}, {}});
      error_.quantities[i].time = told(row, chain[1], chain.size() > 2 ? chain[2] : nullptr, orders).last();
    }
    return *chain[0];
  }

  /// Whether the last equilibrium of statics is not stable.
  static bool falls(const RunResult& result) {
    const auto& last = result.samples.back().equilibrium;
    return last && last->negative_pivots > 0;
  }

  /// Whether steps follow the motion, and what runs differ by does not fall with them: the motion magnifies it. Where
  /// the longest step limits most of them, vibrations that no run follows may be behind it, and shorter steps tell.
  bool sensitive(const Seen& run) const {
    const SolverCounters& solver = run.result.solver;
    const std::size_t by_error = solver.limited_by[static_cast<std::size_t>(StepLimit::error)];
    return !time_places_.falls && 2 * by_error > solver.steps;
  }

  /// Runs the finest of a chain again, with steps shorter by the ratio, and sets that before the chain. Not where it
  /// fails, or takes another order of work than the ratio lets expect.
  bool repeat(std::vector<Seen*>& chain, double ratio) {
    auto finer = std::make_unique<Seen>(Seen{longer_steps(chain[0]->scene, 1 / ratio)});
    finer->scene.output = main_.scene.output;
    finer->event_shapes = output_.event_shapes;
    const double most_steps = most_growth * ratio * static_cast<double>(chain[0]->result.solver.steps);
    double steps = 0;
    const auto at_step = [&](double t) { return ++steps <= most_steps && (!progress_ || progress_(t)); };
    run(*finer, times_, at_step, ShapesOf::the_scene);
    again_.push_back(std::move(finer));
    if (!ended_well(again_.back()->result)) return false;
    ++error_.repeats;
    chain[0]->ratio = ratio;
    chain.insert(chain.begin(), again_.back().get());
    return true;
  }

  void conclude(Seen& last) {
    if (!ended_well(last.result)) return;
    const Scene& scene = main_.scene;
    const double most = most_of_mesh();
    const bool judged_time = error_.time && scene.integrator.automatic;
    for (const Sample& sample : last.result.samples) {
      if (judged_time && time_places_.at(sample.t) > error_.allowed) break;
      if (error_.mesh && mesh_places_.at(sample.t) > most) break;
      error_.trusted_until = sample.t;
    }
    std::vector<Warning>& warnings = last.result.warnings;
    if (!error_.time && scene.integrator.automatic && scene.analysis == Analysis::dynamics) {
      warnings.push_back({WarningKind::error_in_time, "nothing tells what the steps make wrong: " + error_.no_time,
                          "\"vlbeam converge\", or an /integrator with a type and steps of your own"});
    }
    if (judged_time && *error_.time > error_.allowed) {
      warnings.push_back(
          {WarningKind::error_in_time,
           in_words("the steps may make places wrong by ", *error_.time, " m", time_places_.but_for_axis(),
                    "; the accuracy asked allows ", error_.allowed, " m",
                    sensitive(last) ? ", and shorter steps change as much" : ""),
           (sensitive(last) ? "what calms the motion: damping (/beam/material/damping), a start without a jolt"
                            : "a finer accuracy: {\"accuracy\": " + six_digits(scene.integrator.accuracy / 10) +
                                  "} for /integrator") +
               "; or look no further than " + six_digits(error_.trusted_until) + " s"});
    }
    if (error_.elements_wanted > 0) {
      warnings.push_back({WarningKind::error_of_mesh,
                          in_words("the elements may make places wrong by ", *error_.mesh, " m",
                                   mesh_places_.but_for_axis(), ", of a motion of ", error_.motion, " m"),
                          falls(last.result)
                              ? "more /statics/steps: the equilibrium found is not stable, and another one "
                                "than that of fewer elements"
                              : "about " + std::to_string(error_.elements_wanted) + " elements (/beam/elements)"});
    }
    if (const auto warning = sudden_gravity(scene, last.result)) warnings.push_back(*warning);
    last.result.error = std::make_shared<const RunError>(std::move(error_));
  }

  const ProgressCallback& progress_;
  const RunOutput& output_;
  int jobs_;
  Seen main_;
  std::vector<double> times_;
  Companions time_, mesh_, again_;
  std::atomic<bool> stop_{false};
  std::atomic<double> allowed_work_{std::numeric_limits<double>::infinity()};
  double work_ = 0;
  RunError error_;
  Places mesh_places_, time_places_;
};

}  // namespace

ErrorOrders::ErrorOrders(double ratio, double next_ratio, OrderRange orders)
    : ratio_(ratio),
      orders_(orders),
      lowest_(power(ratio, next_ratio, orders.lowest)),
      least_seen_(growth(power(ratio, next_ratio, least_order_seen))) {
  // powers of half an order are square roots, which all machines take alike
  Powers step = power(ratio, next_ratio, orders.best - orders.lowest);
  for (Powers& half : halves_) half = step = {std::sqrt(step.first), std::sqrt(step.next)};
}

ErrorOrders::Powers ErrorOrders::power(double ratio, double next_ratio, double order) {
  return {portable::pow(ratio, order), portable::pow(next_ratio, order)};
}

double ErrorOrders::growth(Powers of) { return of.first * (of.next - 1) / (of.first - 1); }

ToldError ErrorOrders::told(double distance, double next) const {
  if (next < 0) return {distance / (ratio_ - 1), 1};
  double low = orders_.lowest, high = orders_.best;
  Powers at_low = lowest_;
  for (const Powers& half : halves_) {
    const double middle = (low + high) / 2;
    const Powers at_middle{at_low.first * half.first, at_low.next * half.next};
    if (growth(at_middle) * distance < next) {
      low = middle;
      at_low = at_middle;
    } else {
      high = middle;
    }
  }
  const double order = (low + high) / 2;
  return {distance / (portable::pow(ratio_, order) - 1), order, next >= least_seen_ * distance};
}

bool has_automatic_steps(const Scene& scene) {
  return scene.integrator.automatic || scene.analysis == Analysis::statics;
}

RunResult checked_run(const Scene& scene, const ProgressCallback& progress, const RunOutput& output, int jobs,
                      double* work) {
  Checked checked(scene, progress, output, jobs);
  RunResult result = checked();
  if (work != nullptr) *work = checked.work();
  return result;
}

}  // namespace vlbeam
