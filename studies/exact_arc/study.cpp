// How exactly rational elements hold circles, other conics and NURBS curves, on any mesh and while a joint slides
// along them (Ding & Ouyang 2022, §6.3).
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/element/moving_element.hpp"
#include "core/element/quadrature.hpp"
#include "core/geometry/axis.hpp"
#include "core/geometry/elementary.hpp"

namespace vlbeam {
namespace exact_arc {
namespace {

constexpr int samples_an_element = 60;

template <int D>
struct Element {
  NodalCubic<double, D> e;
  Weights<double> w;
  double l;

  std::array<Vec<double, D>, 4> at(double u) const { return RationalCubic<double, D>::from_nodal(e, l, w).evaluate(u); }
};

std::vector<double> equal_nodes(double length, int n) {
  std::vector<double> x;
  for (int k = 0; k <= n; ++k) x.push_back(length * k / n);
  return x;
}

template <int D>
std::vector<Element<D>> rational_elements(const Axis<D>& axis, const std::vector<double>& x) {
  const auto chain = exact_chain(axis, x);
  std::vector<Element<D>> elements;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    elements.push_back(
        {{chain.r[k], chain.r_x[k], chain.r[k + 1], chain.r_x[k + 1]}, chain.weights[k], x[k + 1] - x[k]});
  }
  return elements;
}

/// Cubic Hermite elements through the axis, with its unit tangents.
template <int D>
std::vector<Element<D>> polynomial_elements(const Axis<D>& axis, const std::vector<double>& x) {
  std::vector<Element<D>> elements;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    elements.push_back({{axis.position(x[k]), axis.tangent(x[k]), axis.position(x[k + 1]), axis.tangent(x[k + 1])},
                        unit_weights,
                        x[k + 1] - x[k]});
  }
  return elements;
}

template <int D, class Measure>
double largest(const std::vector<Element<D>>& elements, const Measure& measure) {
  double most = 0;
  for (const auto& element : elements) {
    for (int i = 0; i <= samples_an_element; ++i) {
      most = std::max(most, std::abs(measure(element, static_cast<double>(i) / samples_an_element)));
    }
  }
  return most;
}

double radius_gap(const Element<2>& element, double u, double R) { return element.at(u)[0].norm() - R; }

double strain(const Element<2>& element, double u) {
  return 0.5 * (element.at(u)[1].squaredNorm() / (element.l * element.l) - 1);
}

/// Axial energy of elements whose strains are measured from a straight beam [J].
double axial_energy(const std::vector<Element<2>>& elements, double EA) {
  double sum = 0;
  for (const auto& element : elements) {
    for (const auto& [u, weight] : gauss_legendre(25)) {
      const double eps = strain(element, u);
      sum += 0.5 * EA * eps * eps * weight * element.l;
    }
  }
  return sum;
}

/// Distance of a point from a curve: Newton's iteration for its foot from the nearest of many samples.
template <int D>
double distance(const std::vector<NurbsSpan<D>>& spans, const Vec<double, D>& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& span : spans) {
    constexpr int starts = 32;
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= starts; ++i) {
      const double u = static_cast<double>(i) / starts, d = (span.curve.evaluate(u)[0] - point).norm();
      if (d < least) {
        least = d;
        best = u;
      }
    }
    for (int iteration = 0; iteration < 8; ++iteration) {
      const auto at = span.curve.evaluate(best);
      const Vec<double, D> gap = at[0] - point;
      const double slope = at[1].squaredNorm() + gap.dot(at[2]);
      best = std::clamp(best - gap.dot(at[1]) / slope, 0.0, 1.0);
    }
    nearest = std::min({nearest, least, (span.curve.evaluate(best)[0] - point).norm()});
  }
  return nearest;
}

/// Nodes with all breaks among them, elements between two breaks equal.
template <int D>
std::vector<double> nodes_with_breaks(const Axis<D>& axis, int n) {
  const auto& breaks = axis.breaks();
  const int share = std::max(1, n / static_cast<int>(breaks.size() - 1));
  std::vector<double> x{0};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 1; k <= share; ++k) x.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / share);
  }
  return x;
}

template <int D>
Nurbs<D> read_nurbs(const Json& json) {
  Nurbs<D> curve{json.at("degree"), json.at("knots"), json.at("weights"), {}};
  for (const auto& point : json.at("control_points")) {
    Vec<double, D> r = Vec<double, D>::Zero();
    for (std::size_t c = 0; c < point.size(); ++c) r[static_cast<int>(c)] = point[c];
    curve.points.push_back(r);
  }
  return curve;
}

class Report {
 public:
  explicit Report(const StudyContext& context) : config_(context.config), folder_(context.folder.string()) {}

  StudyReport operator()() {
    add_meshes();
    add_moved();
    add_curves();
    const GnuplotVariables variables{{"folder", folder_}};
    report_.figures = {
        {.name = "meshes",
         .caption = "Semicircle: distance from the circle and spurious strain against the number of elements",
         .script = "meshes.gp",
         .variables = variables},
        {.name = "moved",
         .caption = "Distance from the circle while a joint slides along it",
         .script = "moved.gp",
         .variables = variables}};
    return std::move(report_);
  }

 private:
  void add_meshes() {
    const double R = config_.at("radius"), EA = config_.at("section").at("EA");
    const auto axis = Axis<2>::arc({0, 0}, R, std::numbers::pi, 2 * std::numbers::pi);
    Table table{.name = "meshes",
                .caption =
                    "Semicircle: largest distance from the circle over R, largest axial strain and axial energy [J] "
                    "measured from a straight beam, of rational elements (Eq. 43) and of polynomial ones",
                .columns = {"elements", "rational_distance", "rational_strain", "rational_energy",
                            "polynomial_distance", "polynomial_strain", "polynomial_energy"}};
    std::vector<double> levels, distances, energies;
    double exact = 0;
    for (const int n : config_.at("elements").get<std::vector<int>>()) {
      if (n < 3) continue;  // an element turns by less than pi
      const auto x = equal_nodes(axis.length(), n);
      const auto rational = rational_elements(axis, x), polynomial = polynomial_elements(axis, x);
      auto gap = [&](const Element<2>& e, double u) { return radius_gap(e, u, R) / R; };
      const double of_rational = largest(rational, gap), of_polynomial = largest(polynomial, gap);
      const double energy = axial_energy(rational, EA);
      table.rows.push_back({n, of_rational, largest(rational, strain), energy, of_polynomial,
                            largest(polynomial, strain), axial_energy(polynomial, EA)});
      exact = std::max(exact, of_rational);
      report_.measured["axial_energy_n" + std::to_string(n)] = energy;
      levels.push_back(n);
      distances.push_back(of_polynomial);
      energies.push_back(energy);
    }
    // the mesh of the paper's example: the joint at 1/16 of the beam
    const double L = axis.length();
    const auto uneven = rational_elements(axis, {0, L / 16, L / 2, 3 * L / 4, L});
    exact = std::max(exact, largest(uneven, [&](const auto& e, double u) { return radius_gap(e, u, R) / R; }));
    report_.measured["rational_distance"] = exact;
    report_.measured["uneven_strain"] = largest(uneven, strain);
    report_.fits.push_back(fit_order("polynomial distance from the circle", levels, distances, {.floor = 1e-14}));
    report_.fits.push_back(fit_order("spurious axial energy of rational elements", levels, energies));
    report_.tables.push_back(std::move(table));
  }

  /// Two elements that are one arc each, and the node between them moves along the circle.
  void add_moved() {
    Table table{.name = "moved",
                .caption =
                    "Two elements of the angle given, their common node moved to the share of an element's length: "
                    "largest distance from the circle over R with frozen and transported weights, and of "
                    "polynomial elements",
                .columns = {"angle", "share", "frozen", "transported", "polynomial"}};
    double transported_most = 0, frozen_least = 1;
    for (const double degrees : config_.at("moved").at("angles_degrees").get<std::vector<double>>()) {
      const double angle = degrees * std::numbers::pi / 180;
      const auto axis = Axis<2>::arc({0, 0}, 1, 0, 2 * angle);
      // one curve over both, cut in the middle: what the joint starts from
      const auto whole = rational_elements(axis, {0, 2 * angle}).front();
      const auto curve = RationalCubic<double, 2>::from_nodal(whole.e, whole.l, whole.w);
      const WeightFunction stored{whole.w, 0, 2 * angle};
      const Weights<double> first = stored.on(0.0, angle), second = stored.on(angle, 2 * angle);
      for (const double share : config_.at("moved").at("shares").get<std::vector<double>>()) {
        const double x = share * angle;
        const auto at = curve.evaluate(share / 2);
        const Vec<double, 2>& r = at[0];
        const Vec<double, 2> r_x = at[1] / (2 * angle);
        auto pair = [&](const Weights<double>& left, const Weights<double>& right) -> std::vector<Element<2>> {
          return {{{whole.e.r_a, whole.e.s_a, r, r_x}, left, x},
                  {{r, r_x, whole.e.r_b, whole.e.s_b}, right, 2 * angle - x}};
        };
        auto gap = [](const Element<2>& e, double u) { return radius_gap(e, u, 1); };
        const double frozen = largest(pair(first, second), gap);
        const double transported = largest(pair(stored.on(0.0, x), stored.on(x, 2 * angle)), gap);
        const double polynomial = largest(polynomial_elements(axis, {0, x, 2 * angle}), gap);
        table.rows.push_back({degrees, share, frozen, transported, polynomial});
        transported_most = std::max(transported_most, transported);
        if (std::abs(share - 1) > 0.15) frozen_least = std::min(frozen_least, frozen);
      }
    }
    report_.measured["transported_distance"] = transported_most;
    report_.measured["frozen_distance"] = frozen_least;
    report_.tables.push_back(std::move(table));
  }

  void add_curves() {
    Table table{.name = "curves",
                .caption =
                    "NURBS curves as rational elements: largest distance from the curve over its length, its "
                    "length [m], smallest and largest slope at a node",
                .columns = {"curve", "elements", "distance", "length", "least_slope", "largest_slope"}};
    double worst = 0;
    for (const Json& item : config_.at("curves")) {
      const auto nurbs = read_nurbs<3>(item.at("nurbs"));
      const auto spans = rational_spans(nurbs);
      const auto axis = Axis<3>::nurbs(nurbs);
      for (const int n : item.at("elements").get<std::vector<int>>()) {
        const auto x = nodes_with_breaks(axis, n);
        const auto elements = rational_elements(axis, x);
        double gap = largest(elements, [&](const Element<3>& e, double u) { return distance<3>(spans, e.at(u)[0]); });
        if (item.contains("conic")) {  // and from the equation of the ellipse
          const double a = item.at("conic").at("a"), b = item.at("conic").at("b");
          gap = std::max(gap, largest(elements, [&](const Element<3>& e, double u) {
                           const Vec<double, 3> r = e.at(u)[0];
                           const double f = r[0] * r[0] / (a * a) + r[1] * r[1] / (b * b) - 1;
                           return f / (2 * portable::hypot(r[0] / (a * a), r[1] / (b * b)));
                         }));
        }
        double least = 1e300, most = 0;
        for (const auto& element : elements) {
          for (const double s : {element.e.s_a.norm(), element.e.s_b.norm()}) {
            least = std::min(least, s);
            most = std::max(most, s);
          }
        }
        table.rows.push_back({item.at("name"), elements.size(), gap / axis.length(), axis.length(), least, most});
        worst = std::max(worst, gap / axis.length());
      }
    }
    report_.measured["nurbs_distance"] = worst;
    report_.tables.push_back(std::move(table));
  }

  const Json& config_;
  std::string folder_;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace exact_arc

Study exact_arc_study();

Study exact_arc_study() {
  return {.name = "exact_arc",
          .title = "Exact circles, conics and NURBS curves, and what sliding does to them",
          .run = exact_arc::run};
}

}  // namespace vlbeam
