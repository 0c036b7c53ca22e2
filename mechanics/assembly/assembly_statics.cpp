#include "mechanics/assembly/assembly_statics.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "mechanics/assembly/assembly_equations.hpp"

namespace vlbeam {
namespace {

constexpr int most_corrections_at_rest = 400, most_halved_loads = 8;
constexpr double largest_move_at_rest = 0.1,
                 largest_turn_at_rest = 0.4;  // of one correction: over the length, and of slopes
constexpr double calm = 0.3;                  // by_a falls by that where corrections fall
constexpr double least_mass = 1e-9;           // of the first by_a
constexpr double falls_beyond = 1e-9;         // of the largest eigenvalue seen: below, rounding hides the sign

/// Sizes of an array of coordinates: positions, and slopes and angles.
struct Sizes {
  double position = 0, slope = 0;
};

template <int D>
class Search {
 public:
  Search(AssemblySystem<D>& system, const AssemblyStaticsOptions& options, SolverCounters& counters)
      : equations(system), system_(system), options_(options), counters_(counters) {
    equations.expand(system.initial_state(), q, zero);
    zero.setZero();
    a = zero;
    fields_ = equations.fields();
  }

  Sizes sizes(const Eigen::VectorXd& x) const {
    const FieldNorms norms = field_norms(fields_, x);
    const auto of = [&](Field field) { return norms[static_cast<std::size_t>(field)]; };
    return {std::max({of(Field::position), of(Field::mark), of(Field::mass)}),
            std::max({of(Field::slope), of(Field::angle)})};
  }

  /// Whether the start is an equilibrium.
  bool rests(double factor) {
    equations.residual(q, zero, a, factor, r_);
    Eigen::VectorXd loaded = r_;
    equations.residual(q, zero, a, 1, loaded);
    return r_.norm() <= 1e-9 * loaded.norm();
  }

  /// Whether the whole has a mass matrix of its own.
  bool has_mass() {
    Eigen::VectorXd inertia;
    return equations.inertia(q, zero, 0, inertia);
  }

  /// Corrects q and the multipliers until they are an equilibrium at that factor; false where they do not come to one.
  bool solve(double factor) {
    if (by_a_ == 0) first_mass(factor);
    Eigen::VectorXd offset;  // supports are where the factor has them
    if (equations.driven_offset(q, factor, offset)) q -= offset;
    double by_a = by_a_, before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_corrections_at_rest; ++i) {
      const auto [step, share, there] = correct(factor, by_a);
      if (!there) return false;
      const double size = std::max(step.position / options_.length, step.slope);
      if (size <= options_.tolerance) return true;
      if (size < before) {
        by_a = std::max(calm * by_a, least_mass * by_a_);
      } else if (share < 1) {
        by_a = std::min(2 * by_a, by_a_);
      } else if (by_a <= least_mass * by_a_ && size < settled) {
        return true;  // rounding: corrections do not fall any more
      }
      before = size;
    }
    return false;
  }

  /// Goes from an equilibrium in which the energy falls, as exp(t sqrt(rate)), to one below it: pushed off, the whole
  /// creeps down as if in honey, for its mass times twice that rate resists each step.
  bool slide_down(double factor, double rate) {
    constexpr int most = 300;
    constexpr double push = 1e-5, far = 1e-2, near = 1e-4;  // of the length
    double uneven = 0;
    for_each_coordinate(fields_, [&](Field field, Eigen::Index i) {
      uneven += 0.6180339887;
      uneven -= uneven > 1 ? 1 : 0;
      if (field == Field::position) q[i] += push * options_.length * (uneven - 0.5);
    });
    bool on_its_way = false;
    for (int i = 0; i < most; ++i) {
      const auto [step, share, there] = correct(factor, 2 * rate);
      if (!there) return false;
      on_its_way = on_its_way || step.position > far * options_.length;
      if (on_its_way && step.position < near * options_.length) break;
    }
    return solve(factor);
  }

  /// A direction of the path, or a point of it.
  struct Along {
    Eigen::VectorXd q, a;
    double factor = 0;
  };

  /// dq/df and the like, of length 1, on the side of `before`.
  bool direction(double factor, Along& before) {
    if (!factor_at(factor)) return false;
    Along now{Eigen::VectorXd(-by_load_), {}, 1};
    const double size = std::sqrt(inner(by_load_, by_load_) + 1);
    const double sign = before.q.size() > 0 && inner(now.q, before.q) + before.factor < 0 ? -1 : 1;
    now.q *= sign / size;
    now.factor = sign / size;
    before = std::move(now);
    return true;
  }
  /// Goes a step along the path, and back onto it across that direction.
  bool follow(double& factor, const Along& along, double step, int& iterations) {
    const Eigen::Index own = q.size() - equations.multipliers();
    const auto move = [&](const Eigen::VectorXd& by, double size) {
      q.head(own) += size * by.head(own);
      a.tail(a.size() - own) += size * by_arc_ * by.tail(by.size() - own);
    };
    move(along.q, step);
    factor += step * along.factor;
    double before = std::numeric_limits<double>::infinity();
    for (iterations = 1; iterations <= most_arc_iterations; ++iterations) {
      ++counters_.newton.iterations;
      if (!factor_at(factor)) return false;
      const double change = inner(along.q, r_) / (along.factor - inner(along.q, by_load_));
      r_ += change * by_load_;
      move(r_, -1);
      factor += change;
      const Sizes moved = sizes(r_);
      const double size = std::max(moved.position / options_.length, moved.slope);
      if (!std::isfinite(size) || size > 1) return false;
      if (size <= options_.tolerance || (size < settled && size > 0.3 * before)) return true;
      before = size;
    }
    return false;
  }

  AssemblyEquilibrium point(double factor) {
    AssemblyEquilibrium at;
    at.factor = factor;
    at.y = system_.initial_state();
    equations.contract(q, zero, at.y);
    at.multipliers = a;
    equations.residual(q, zero, a, factor, r_);  // hands out the forces of links
    return at;
  }
  void go_to(const AssemblyEquilibrium& at) {
    Eigen::VectorXd v;
    equations.expand(at.y, q, v);
    a = at.multipliers;
  }

  AssemblyEquations<D> equations;
  Eigen::VectorXd q, a, zero;

 private:
  /// A correction towards the equilibrium, that mass times `by_a` resists; only a share of it where it is large.
  struct Correction {
    Sizes step = {};
    double share = 1;
    bool there = false;  ///< else it could not be found
  };
  Correction correct(double factor, double by_a) {
    const Eigen::Index own = q.size() - equations.multipliers();
    equations.residual(q, zero, a, factor, r_);
    if (!r_.allFinite() || !equations.linearize(q, zero, a, factor, {1, 0, by_a})) return {};
    equations.solve(r_);
    if (!r_.allFinite()) return {};
    ++counters_.newton.iterations;
    const Sizes step = sizes(r_);
    const double share = 1 / std::max({1.0, step.position / (largest_move_at_rest * options_.length),
                                       step.slope / largest_turn_at_rest});
    q.head(own) -= share * r_.head(own);
    a.tail(a.size() - own) -= share * by_a * r_.tail(r_.size() - own);
    return {step, share, true};
  }

  /// by_a with which what acts would move the whole by its length.
  void first_mass(double factor) {
    equations.residual(q, zero, zero, factor, r_);
    Eigen::VectorXd inertia, ones = zero;
    for (const FieldRun& run : fields_) {
      if (run.field == Field::position) {
        for_each_coordinate(std::array{run}, [&](Field, Eigen::Index i) { ones[i] = 1; });
      }
    }
    const bool weighs = equations.inertia(q, ones, factor, inertia);
    const double mass = weighs ? std::abs(ones.dot(inertia)) / D : 1;
    double force = 0;
    for_each_coordinate(fields_, [&](Field field, Eigen::Index i) {
      if (field == Field::position) force += std::abs(r_[i]);
    });
    by_a_ = std::max(force, 1e-300) / std::max(mass * options_.length, 1e-300);
  }

  /// Corrections at a factor and what the load adds to them, r_ and by_load_; false where there are none.
  bool factor_at(double factor) {
    if (by_a_ == 0) first_mass(1);
    by_arc_ = arc_mass * by_a_;
    equations.residual(q, zero, a, factor + 1, by_load_);
    equations.residual(q, zero, a, factor, r_);
    by_load_ -= r_;
    if (!r_.allFinite() || !equations.linearize(q, zero, a, factor, {1, 0, by_arc_})) return false;
    equations.solve(r_);
    equations.solve(by_load_);
    return r_.allFinite() && by_load_.allFinite();
  }
  /// Of positions over the length, and slopes: what makes a length of a path.
  double inner(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
    double sum = 0, count = 0;
    for_each_coordinate(fields_, [&](Field field, Eigen::Index i) {
      const double unit = field == Field::position ? options_.length : 1;
      if (field != Field::position && field != Field::slope) return;
      sum += x[i] * y[i] / (unit * unit);
      ++count;
    });
    return sum / std::max(count, 1.0);
  }

  static constexpr double settled = 1e-9, arc_mass = 1e-6;
  static constexpr int most_arc_iterations = 25;

  AssemblySystem<D>& system_;
  AssemblyStaticsOptions options_;
  SolverCounters& counters_;
  std::vector<FieldRun> fields_;
  double by_a_ = 0, by_arc_ = 0;
  Eigen::VectorXd r_, by_load_;
};

/// Eigenvalues of K x = l M x about a point, within what links allow.
struct Spectrum {
  std::vector<double> nearest = {};  ///< to minus the shift, in their order
  int below = 0;                     ///< values below 0 that were seen, wherever they are: at least as many there are
  double lowest = 0;                 ///< of those seen
};

template <int D>
Spectrum eigenvalues(Search<D>& search, double factor, double shift, int wanted) {
  AssemblyEquations<D>& equations = search.equations;
  if (!equations.linearize(search.q, search.zero, search.a, factor, {1, 0, shift})) {
    throw ComputationFailed("the tangent about this equilibrium is singular", factor);
  }
  const Eigen::Index n = search.q.size(), own = n - equations.multipliers();
  const auto weigh = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd mx(n);
    if (!equations.inertia(search.q, x, factor, mx)) {
      throw ComputationFailed("beams whose sections have frames give an assembly no frequencies yet", factor);
    }
    return mx;
  };
  const auto apply = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y = weigh(x);
    y.tail(n - own).setZero();
    equations.solve(y);
    y.tail(n - own).setZero();
    return y;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  double uneven = 0;
  for (Eigen::Index i = 0; i < own; ++i) {
    uneven += 0.6180339887;
    uneven -= uneven > 1 ? 1 : 0;
    x[i] = 0.5 + uneven;
  }
  x = apply(apply(x));  // within what links allow
  const auto most = static_cast<Eigen::Index>(std::min<Eigen::Index>(own, 6 * wanted + 60));
  std::vector<Eigen::VectorXd> basis, weighed;
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(most, most);
  Eigen::Index count = 0;
  for (; count < most; ++count) {
    for (int twice = 0; twice < 2; ++twice) {
      for (std::size_t k = 0; k < basis.size(); ++k) x -= basis[k] * weighed[k].dot(x);
    }
    Eigen::VectorXd mx = weigh(x);
    const double size = std::sqrt(std::max(x.dot(mx), 0.0));
    if (!(size > 1e-13)) break;  // all directions are there
    x /= size;
    basis.push_back(x);
    weighed.push_back(mx / size);
    x = apply(basis.back());
    for (Eigen::Index k = 0; k <= count; ++k) {
      projected(k, count) = projected(count, k) = weighed[static_cast<std::size_t>(k)].dot(x);
    }
    const double norm = std::sqrt(std::max(x.dot(weigh(x)), 0.0));
    if (norm > 0) x /= norm;
  }
  if (count == 0 || !projected.allFinite()) return {};
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected.topLeftCorner(count, count), Eigen::EigenvaluesOnly)
          .eigenvalues();
  constexpr double rounding = 1e-10;  // of the largest inverse
  const double largest_inverse = values.cwiseAbs().maxCoeff();
  std::vector<double> all;
  for (const double value : values) {
    if (std::abs(value) > rounding * largest_inverse) all.push_back(1 / value - shift);
  }
  std::ranges::sort(all, [shift](double p, double q) { return std::abs(p + shift) < std::abs(q + shift); });
  Spectrum found;
  const auto nearest = static_cast<std::ptrdiff_t>(std::min(all.size(), static_cast<std::size_t>(wanted)));
  found.nearest.assign(all.begin(), all.begin() + nearest);
  std::ranges::sort(found.nearest);
  const double largest = std::max(std::abs(found.nearest.front()), std::abs(found.nearest.back()));
  found.below = static_cast<int>(std::ranges::count_if(all, [&](double v) { return v < -falls_beyond * largest; }));
  found.lowest = std::ranges::min(all);
  return found;
}

/// The same with a shift of the size of the lowest, which is looked for from that of axial waves down.
template <int D>
Spectrum lowest_eigenvalues(Search<D>& search, double factor, double wave_rate, int wanted) {
  double shift = wave_rate * wave_rate;
  Spectrum found;
  for (int i = 0; i < 6; ++i) {
    found = eigenvalues(search, factor, shift, wanted);
    if (found.nearest.empty()) return found;
    const double lowest = std::ranges::min(found.nearest, {}, [](double value) { return std::abs(value); });
    constexpr double beside = 1.37;  // minus a value below 0 is no shift: the tangent is singular there
    const double next = std::clamp(lowest < 0 ? -beside * lowest : lowest, 1e-4 * shift, shift);
    if (next > 0.1 * shift) break;
    shift = next;
  }
  return found;
}

/// Steps along the path until the load factor is 1.
template <int D, class Point>
void follow_arc(Search<D>& search, const AssemblyStaticsOptions& options, const Point& point,
                const std::function<bool(const AssemblyEquilibrium&)>& on_point, SolverCounters& counters) {
  constexpr int most_points = 50, most_halved = 20;  // of the former for each step asked for
  double factor = 0, step = 0, longest = 0;
  typename Search<D>::Along along;
  for (int n = 0; n < most_points * options.steps; ++n) {
    if (!search.direction(factor, along)) throw ComputationFailed("the path ends: its tangent is singular", factor);
    if (n == 0) step = longest = 1 / (std::abs(along.factor) * options.steps);
    const Eigen::VectorXd q = search.q, a = search.a;
    double next = factor;
    int iterations = 0, halved = 0;
    while (!search.follow(next, along, step, iterations)) {
      search.q = q;
      search.a = a;
      next = factor;
      step /= 2;
      ++counters.rejected;
      if (++halved > most_halved)
        throw ComputationFailed("the path ends at load factor " + in_digits(factor, 4), factor);
    }
    ++counters.steps;
    if (next >= 1) {
      const Eigen::VectorXd beyond = search.q;
      search.q = q + (1 - factor) / (next - factor) * (search.q - q);
      if (search.solve(1)) {
        on_point(point(1));
        return;
      }
      search.q = beyond;
    }
    factor = next;
    if (!on_point(point(factor))) return;
    if (iterations <= 4) step = std::min(1.5 * step, longest);
    if (iterations > 8) step /= 1.5;
  }
  throw ComputationFailed("the load factor is " + in_digits(factor, 4) + " after " +
                              std::to_string(most_points * options.steps) + " points of the path: it may never be 1",
                          factor);
}

}  // namespace

template <int D>
void trace_equilibria(AssemblySystem<D>& system, const AssemblyStaticsOptions& options,
                      const std::function<bool(const AssemblyEquilibrium&)>& on_point, SolverCounters& counters) {
  constexpr int most_slides = 5;
  Search<D> search(system, options, counters);
  double falls_at = 0;  // the steepest eigenvalue below 0, of the last point
  const auto point = [&](double factor) {
    AssemblyEquilibrium at = search.point(factor);
    at.falls_known = factor > 0 && search.has_mass();
    if (at.falls_known) {
      const Spectrum spectrum = lowest_eigenvalues(search, factor, options.wave_rate, 3);
      at = search.point(factor);
      at.falls_known = true;
      at.falls = spectrum.below;
      falls_at = -spectrum.lowest;
    }
    return at;
  };
  const bool rested = search.rests(0);
  if (rested && !on_point(point(0))) return;
  if (options.arc_length) return follow_arc(search, options, point, on_point, counters);
  const auto advance = [&](const auto& self, double from, double to, int halvings) -> bool {
    const Eigen::VectorXd q = search.q, a = search.a;
    if (search.solve(to)) return true;
    search.q = q;
    search.a = a;
    ++counters.rejected;
    const double middle = (from + to) / 2;
    return halvings > 0 && self(self, from, middle, halvings - 1) && self(self, middle, to, halvings - 1);
  };
  for (int step = 1; step <= options.steps; ++step) {
    const double from = static_cast<double>(step - 1) / options.steps, to = static_cast<double>(step) / options.steps;
    if (!advance(advance, from, to, most_halved_loads)) {
      throw ComputationFailed("no equilibrium near the last one at load factor " + in_digits(to, 4) +
                                  ": something moves freely, or the path has a limit point",
                              from);
    }
    ++counters.steps;
    AssemblyEquilibrium at = point(to);
    for (int slide = 0; slide < most_slides && !rested && at.falls > 0; ++slide) {
      if (search.slide_down(to, falls_at)) {
        at = point(to);
      } else {
        search.go_to(at);
        break;
      }
    }
    if (!on_point(at)) return;
  }
}

template <int D>
std::vector<double> natural_frequencies(AssemblySystem<D>& system, const AssemblyStaticsOptions& options,
                                        const AssemblyEquilibrium& at, int count) {
  SolverCounters counters;
  Search<D> search(system, options, counters);
  search.go_to(at);
  std::vector<double> frequencies;
  for (const double value : lowest_eigenvalues(search, at.factor, options.wave_rate, count).nearest) {
    frequencies.push_back((value < 0 ? -1 : 1) * std::sqrt(std::abs(value)) / (2 * std::numbers::pi));
  }
  return frequencies;
}

template void trace_equilibria(AssemblySystem<2>&, const AssemblyStaticsOptions&,
                               const std::function<bool(const AssemblyEquilibrium&)>&, SolverCounters&);
template void trace_equilibria(AssemblySystem<3>&, const AssemblyStaticsOptions&,
                               const std::function<bool(const AssemblyEquilibrium&)>&, SolverCounters&);
template std::vector<double> natural_frequencies(AssemblySystem<2>&, const AssemblyStaticsOptions&,
                                                 const AssemblyEquilibrium&, int);
template std::vector<double> natural_frequencies(AssemblySystem<3>&, const AssemblyStaticsOptions&,
                                                 const AssemblyEquilibrium&, int);

}  // namespace vlbeam
