#include "scene/section_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/geometry/elementary.hpp"
#include "scene/build.hpp"
#include "scene/names.hpp"

namespace vlbeam {
namespace {

constexpr double pi = std::numbers::pi;

/// Saint-Venant's series (Timoshenko & Goodier, Theory of Elasticity, section 109).
double rectangle_torsion(double one, double other) {
  const double a = std::max(one, other), b = std::min(one, other);
  double sum = 0;
  for (int n = 1; n < 100; n += 2) {
    const double n5 = static_cast<double>(n) * n * n * n * n;
    sum += portable::tanh(n * pi * a / (2 * b)) / n5;
  }
  constexpr double pi5 = pi * pi * pi * pi * pi;
  return a * b * b * b / 3 * (1 - 192 / pi5 * b / a * sum);
}

SectionSizes tube(double outer, double wall) {
  const double inner = outer - wall, r2 = outer * outer + inner * inner;
  const double area = pi * (outer + inner) * wall;
  return {area, r2 / 4, r2 / 4, area * r2 / 2, outer, outer};
}

/// Torsion of a thin wall (Bredt).
SectionSizes box(double w, double h, double wall) {
  const double w_in = w - 2 * wall, h_in = h - 2 * wall, area = w * h - w_in * h_in;
  const double w_mid = w - wall, h_mid = h - wall;
  return {area,
          (w * h * h * h - w_in * h_in * h_in * h_in) / (12 * area),
          (h * w * w * w - h_in * w_in * w_in * w_in) / (12 * area),
          2 * wall * w_mid * w_mid * h_mid * h_mid / (w_mid + h_mid),
          w / 2,
          h / 2};
}

double cube(double x) { return x * x * x; }

/// Torsion without warping of two flanges and a web: that of thin strips, or, with fillets, of these with what the
/// junctions add (El Darwish & Johnston 1965), as tables of rolled profiles have it.
double profile_torsion(double w, double h, double web, double flange, double fillet) {
  const double h_in = h - 2 * flange;
  if (fillet == 0) return (2 * w * cube(flange) + h_in * cube(web)) / 3;
  const double one = fillet + web / 2, other = fillet + flange;
  const double circle = (one * one + other * other - fillet * fillet) / (2 * fillet + flange);
  return 2.0 / 3 * (w - 0.63 * flange) * cube(flange) + h_in * cube(web) / 3 +
         2 * web / flange * (0.145 + 0.1 * fillet / flange) * circle * cube(circle);
}

/// Two flanges and a web between them, with four fillets.
SectionSizes profile(double w, double h, double web, double flange, double fillet) {
  const double h_in = h - 2 * flange, r2 = fillet * fillet;
  const double corner = r2 * (1 - pi / 4), middle = fillet * (10 - 3 * pi) / (12 - 3 * pi);  // of one, from its edges
  const double own = r2 * r2 * (1.0 / 3 - pi / 16 - 1 / (9 * (4 - pi)));
  const auto fillets = [&](double distance) { return 4 * (own + corner * distance * distance); };
  const double area = 2 * w * flange + h_in * web + 4 * corner;
  return {area,
          ((w * cube(h) - (w - web) * cube(h_in)) / 12 + fillets(h_in / 2 - middle)) / area,
          ((2 * flange * cube(w) + h_in * cube(web)) / 12 + fillets(web / 2 + middle)) / area,
          profile_torsion(w, h, web, flange, fillet),
          w / 2,
          h / 2};
}

/// Axial stiffness and mass of a line over the square of its diameter [N/m^2], [kg/m^3], and the outer diameter of
/// what it displaces over it.
struct Line {
  double EA, rhoA, displaced;
};

/// Typical data by which lines are modelled where no data sheet is at hand: Orcina, OrcaFlex documentation, line type
/// wizard, "Chain" and "Rope/Wire". A chain displaces its steel.
Line line_of(const Section& section) {
  const auto chain = [](double EA, double rhoA) -> Line { return {EA, rhoA, std::sqrt(4 * rhoA / (7850 * pi))}; };
  if (section.type == Section::Type::chain) {
    return section.links == ChainLinks::studlink ? chain(1.01e11, 21.9e3) : chain(0.854e11, 19.9e3);
  }
  switch (section.construction) {
    case RopeConstruction::wire_fibre_core:
      return {3.67e10, 3.6109e3, 0.82};
    case RopeConstruction::wire_wire_core:
      return {4.04e10, 3.9897e3, 0.80};
    case RopeConstruction::nylon:
      return {1.18e8, 0.6476e3, 0.85};
    case RopeConstruction::polyester:
      return {1.09e9, 0.7978e3, 0.86};
    case RopeConstruction::polypropylene:
      return {1.06e9, 0.4526e3, 0.80};
  }
  return {};
}

template <class... Parts>
std::string in_words(const Parts&... parts) {
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

}  // namespace

std::optional<SectionSizes> sizes_of(const Section& section) {
  switch (section.type) {
    case Section::Type::circle: {
      const double r2 = section.radius * section.radius, area = pi * r2;
      return SectionSizes{area, r2 / 4, r2 / 4, area * r2 / 2, section.radius, section.radius};
    }
    case Section::Type::rectangle: {
      const double w = section.width, h = section.height;
      return SectionSizes{w * h, h * h / 12, w * w / 12, rectangle_torsion(w, h), w / 2, h / 2};
    }
    case Section::Type::tube:
      return tube(section.radius, section.wall);
    case Section::Type::box:
      return box(section.width, section.height, section.wall);
    case Section::Type::profile: {
      if (!section.standard) return profile(section.width, section.height, section.web, section.flange, section.fillet);
      const ProfileSizes& mm = sizes_of(*section.standard);
      return profile(mm.width / 1000, mm.height / 1000, mm.web / 1000, mm.flange / 1000, mm.fillet / 1000);
    }
    case Section::Type::stiffness:
    case Section::Type::rope:
    case Section::Type::chain:
      break;
  }
  return {};
}

double displaced_area(const Section& section) {
  const bool line = section.type == Section::Type::rope || section.type == Section::Type::chain;
  const double radius = line ? line_of(section).displaced * section.diameter / 2 : section.radius;
  return pi * radius * radius;
}

Section with_stiffness(const Section& section) {
  if (section.type != Section::Type::rope && section.type != Section::Type::chain) return section;
  const Line line = line_of(section);
  const double d2 = section.diameter * section.diameter;
  return {.type = Section::Type::stiffness, .EA = line.EA * d2, .EI = 0, .rhoA = line.rhoA * d2};
}

bool is_rope_section(const Section& section) {
  const Section given = with_stiffness(section);
  return given.type == Section::Type::stiffness && given.EI_y.value_or(given.EI) == 0;
}

Material named(const Material& material) {
  Material result = material;
  const auto set = [&result](double density, double E, double nu) {
    result.density = density;
    result.youngs_modulus = E;
    result.poisson_ratio = nu;
  };
  switch (material.name) {
    case MaterialName::own:
      break;
    case MaterialName::steel:
      set(7850, 2.1e11, 0.3);
      break;
    case MaterialName::aluminium:
      set(2700, 7e10, 0.33);
      break;
    case MaterialName::timber:
      set(420, 1.1e10, 0.3);
      break;
  }
  return result;
}

std::string section_in_words(const BeamSpec& beam) {
  const Section::Type type = beam.section.type;
  const bool sized = has_sizes(type), named_material = sized && beam.material.name != MaterialName::own;
  if (type == Section::Type::stiffness) return {};
  if (!named_material && (type == Section::Type::circle || type == Section::Type::rectangle)) return {};
  const BeamSection section = build_section(beam);
  std::string text(beam.section.standard ? to_string(*beam.section.standard) : to_string(type));
  if (type == Section::Type::rope) text += ", " + std::string(to_string(beam.section.construction));
  if (type == Section::Type::chain) text += ", " + std::string(to_string(beam.section.links));
  if (named_material) text += " of " + std::string(to_string(beam.material.name));
  text += in_words(": EA = ", section.stiffness.EA, " N, ");
  if (sized) text += in_words("EI = ", section.stiffness.EI, " N m^2, ");
  return text + in_words(section.rhoA, " kg/m");
}

BeamSpec with_mass(BeamSpec beam, double factor) {
  beam.material = named(beam.material);
  beam.material.name = MaterialName::own;
  beam.material.density *= factor;
  const auto enlarge = [factor](Section& section) {
    if (has_sizes(section.type)) return;  // by its density
    section = with_stiffness(section);
    section.rhoA *= factor;
  };
  enlarge(beam.section);
  for (BeamPieceSpec& piece : beam.sections) enlarge(piece.section);
  return beam;
}

}  // namespace vlbeam
