#include "scene/validate_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/nurbs.hpp"
#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/model_errors.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"
#include "scene/slack.hpp"

namespace vlbeam {
namespace {

constexpr double regularization_share = 1e-3;  // of the curvature 1/L: a suggestion
constexpr double smallest_weight_ratio = 1e-6;
constexpr double largest_quantity = 1e100;

/// Of weights of one curve: `field` is where they stand.
void check_weight_ratio(const std::string& field, const double* weights, std::size_t count) {
  const auto [least, largest] = std::minmax_element(weights, weights + count);
  if (count == 0 || *least >= smallest_weight_ratio * *largest) return;
  refuse(field + "/" + std::to_string(least - weights), number_text(*least),
         "weights of one curve must be within " + number_text(1 / smallest_weight_ratio) +
             " of each other: the largest here is " + number_text(*largest));
}

/// Every span between two knots needs an element, and no knot stands more often than the degree.
void check_knots(const Scene& scene) {
  const CurveSpec& curve = scene.beam.curve;
  const std::size_t most = static_cast<std::size_t>(curve.degree) * (static_cast<std::size_t>(scene.beam.elements) + 3);
  if (curve.knots.size() > most) {
    refuse("/beam/curve/knots", std::to_string(curve.knots.size()) + " entries",
           "with " + std::to_string(scene.beam.elements) + " elements there can be at most " + std::to_string(most) +
               ": each span between two knots needs an element");
  }
  check_weight_ratio("/beam/curve/weights", curve.weights.data(), curve.weights.size());
}

/// Quantities whose squares and products must not leave the range of numbers.
bool of_usual_size(double value) { return value > 1 / largest_quantity && value < largest_quantity; }

/// Walls that leave something hollow. `at` is the key of the section.
void check_walls(const Section& section, const std::string& key) {
  const auto at_most = [&key](const char* wall, double value, double most, const char* of) {
    if (value < most) return;
    refuse(key + "/" + wall, number_text(value),
           "it must be less than " + std::string(of) + ", " + number_text(most) + " m");
  };
  if (section.type == Section::Type::tube) at_most("wall", section.wall, section.radius, "the radius");
  const double smaller = std::min(section.width, section.height) / 2;
  if (section.type == Section::Type::box) at_most("wall", section.wall, smaller, "half of width and height");
  if (section.type != Section::Type::profile || section.standard) return;
  at_most("flange", section.flange, section.height / 2, "half of the height");
  at_most("web", section.web, section.width, "the width");
  at_most("fillet", section.fillet, std::min((section.width - section.web) / 2, section.height / 2 - section.flange),
          "what the plates leave");
}

/// Of a beam that has the section with that key all along.
void check_sizes(const BeamSpec& beam, const std::string& key) {
  check_walls(beam.section, key);
  const bool solid = has_sizes(beam.section.type);
  const BeamSection section = build_section(beam);
  const auto check = [&](const char* name, double value) {
    if (of_usual_size(value)) return;
    const std::string bounds = "it must be between 1e-100 and 1e100";
    if (!solid) {
      const bool given = beam.section.type == Section::Type::stiffness;
      refuse(key + "/" + (given ? name : "diameter"), number_text(given ? value : beam.section.diameter), bounds);
    }
    const bool circle = beam.section.type == Section::Type::circle || beam.section.type == Section::Type::tube;
    const Material material = named(beam.material);
    refuse(key + (circle ? "/radius" : "/height"), number_text(circle ? beam.section.radius : beam.section.height),
           "with /beam/material/density = " + number_text(material.density) + " and youngs_modulus = " +
               number_text(material.youngs_modulus) + " it makes " + name + " = " + number_text(value) + "; " + bounds);
  };
  check("rhoA", section.rhoA);
  check("EA", section.stiffness.EA);
  if (solid || section.stiffness.EI > 0) check("EI", section.stiffness.EI);
}

void check_sections(const BeamSpec& beam) {
  if (beam.sections.empty()) return check_sizes(beam, "/beam/section");
  for (std::size_t i = 0; i < beam.sections.size(); ++i) {
    BeamSpec piece = beam;
    piece.section = beam.sections[i].section;
    piece.sections.clear();
    check_sizes(piece, "/beam/sections/" + std::to_string(i) + "/section");
  }
}

/// Each piece of a drawn axis with corners needs an element.
void check_pieces(const Scene& scene, std::size_t pieces, const std::string& what) {
  if (pieces <= static_cast<std::size_t>(scene.beam.elements)) return;
  refuse("/beam/elements", std::to_string(scene.beam.elements),
         "the curve has " + std::to_string(pieces) + " " + what + ", each of which needs an element");
}

void check_points(const Scene& scene) {
  const auto& points = scene.beam.curve.points;
  if (points.size() < 2) {
    refuse("/beam/curve/points", std::to_string(points.size()) + " entries", "there must be at least two points");
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] != points[i - 1]) continue;
    refuse("/beam/curve/points/" + std::to_string(i), "the same point as the one before",
           "the beam needs a length > 0 [m] between them");
  }
  check_pieces(scene, points.size() - 1, "pieces between its points");
}

/// Where a scene writes the corner of a drawn axis, and how.
std::string corner_key(const CurveSpec& curve, double at) {
  std::size_t piece = 0;
  const auto breaks = drawn_axis<3>(curve).breaks();
  while (breaks[piece] < at) ++piece;
  if (curve.type == CurveType::polyline) return "/beam/curve/points/" + std::to_string(piece);
  return "/beam/curve/knots/" + std::to_string(rational_spans(drawn_nurbs<3>(curve))[piece].knot);
}

/// A corner is for a joint, or on a rope.
void check_corners(const Scene& scene) {
  if (!may_have_corners(scene.beam.curve)) return;
  const auto drawn = drawn_axis<3>(scene.beam.curve);
  constexpr double degrees = 180 / std::numbers::pi, sharpest = 150;
  const auto joints = sliding_joints(scene);
  const auto round = rounded_corners(scene, drawn);
  for (const double at : drawn.kinks()) {
    const double turn = drawn.turn_at(at) * degrees;
    const std::string corner = "a corner of " + number_text(turn) + " degrees at " + number_text(at) + " m";
    const auto there = std::ranges::find_if(joints, [&](const SlidingJointSpec& joint) {
      return std::abs(joint.position - at) <= corner_rounding * drawn.length();
    });
    const bool is_round = std::ranges::find(round, at) != round.end();
    if (there != joints.end()) {
      const std::string key = joint_key(scene, static_cast<std::size_t>(there - joints.begin()));
      if (there->slopes == JointSlopes::continuous || there->slopes == JointSlopes::tangent) {
        refuse(key + "/slopes", quoted(there->slopes),
               "the beam's axis has " + corner + ", where this joint is: take \"free\" or \"equal-stretch\"");
      }
      if (there->velocity != 0) {
        refuse(key + "/velocity", number_text(there->velocity), "at " + corner + " it must be 0: the beam is at rest");
      }
    } else if (!is_rope(scene.beam)) {
      refuse(corner_key(scene.beam.curve, at), corner,
             "a beam that bends may have one only where a joint of /sliding_joints is whose slopes are \"free\" or "
             "\"equal-stretch\"; a rope (\"EI\": 0) anywhere");
    } else if (is_round && turn > sharpest) {
      refuse(corner_key(scene.beam.curve, at), corner,
             "where no joint and no mass is it is rounded off, and must turn by at most " + number_text(sharpest) +
                 " degrees");
    }
  }
  if (!drawn.kinks().empty() && axis_form(scene) == AxisForm::exact) {
    refuse("/beam/axis", "\"exact\"", "with corners it must be \"even\"");
  }
}

void check_curve(const Scene& scene) {
  const CurveSpec& curve = scene.beam.curve;
  double length = 0;
  switch (curve.type) {
    case CurveType::line:
      length = beam_length(scene);
      if (curve.start == curve.end) {
        refuse("/beam/curve/end", "the same point as /beam/curve/start", "the beam needs a length > 0 [m]");
      }
      break;
    case CurveType::arc: {
      length = beam_length(scene);
      if (!(length > 0)) {
        refuse("/beam/curve/to_degrees", number_text(curve.to_degrees),
               "it must not be /beam/curve/from_degrees: the beam needs a length > 0 [m]");
      }
      if (curve.pitch != 0 && scene.dimension == 2) {
        refuse("/beam/curve/pitch", number_text(curve.pitch),
               "a helix needs \"dimension\": 3: in the plane it must be 0");
      }
      if (curve.pitch != 0 && axis_form(scene) == AxisForm::exact) {
        refuse("/beam/axis", "\"exact\"", "no rational cubic is a helix: with a pitch it must be \"even\"");
      }
      const double turn = std::abs(curve.to_degrees - curve.from_degrees);
      if (!(turn / scene.beam.elements < 180)) {
        refuse("/beam/elements", std::to_string(scene.beam.elements),
               "an element must turn by less than 180 degrees: take more than " + number_text(turn / 180) + " of them");
      }
      break;
    }
    case CurveType::nurbs:
      check_knots(scene);
      try {
        length = drawn_axis<3>(curve).length();
      } catch (const NurbsError& error) {
        const auto& numbers = error.field == "knots" ? curve.knots : curve.weights;
        const bool entry = error.field != "control_points" && error.index < numbers.size();
        refuse("/beam/curve/" + error.field + (entry ? "/" + std::to_string(error.index) : ""),
               entry ? number_text(numbers[error.index]) : std::to_string(error.index) + " entries", error.what());
      }
      check_pieces(scene, drawn_axis<3>(curve).breaks().size() - 1, "spans between its knots");
      break;
    case CurveType::polyline:
      check_points(scene);
      length = drawn_axis<3>(curve).length();
      break;
  }
  if (!of_usual_size(length)) {
    refuse("/beam/curve", "a length of " + number_text(length) + " m", "it must be between 1e-100 and 1e100 m");
  }
  check_corners(scene);
}

void check_beam(const Scene& scene) {
  const BeamSpec& beam = scene.beam;
  const auto check_points = [](const char* key, int points) {
    if (points != 1 && points != 2) return;
    refuse(key, std::to_string(points),
           "it must be 0 (the default) or 3 to 25: the mass matrix is singular with fewer points");
  };
  check_points("/beam/quadrature_points", beam.quadrature_points);
  check_points("/beam/polynomial_points", beam.polynomial_points);

  check_weight_ratio("/beam/weights", beam.weights.data(), beam.weights.size());
  const auto unequal = std::ranges::find_if(beam.weights, [](double w) { return w != 1; });
  if (unequal != beam.weights.end()) {
    const std::string field = "/beam/weights/" + std::to_string(unequal - beam.weights.begin());
    if (beam.element == ElementKind::ancf || beam.element == ElementKind::ale_ancf) {
      refuse(field, number_text(*unequal),
             std::string(to_string(beam.element)) + " has unit weights; other weights need RANCF or ALE-RANCF");
    }
    if (beam.curve.type != CurveType::line) {
      refuse(field, number_text(*unequal), "the weights of a curved beam are those of its curve: leave this out");
    }
  }

  const bool bends = build_section(beam).bends();
  if (beam.compression == Compression::none && bends) {
    refuse("/beam/compression", quoted(*beam.compression), "only a rope goes slack, \"EI\": 0: take \"full\"");
  }
  if (beam.slack_over && compression(scene) != Compression::none) {
    refuse("/beam/slack_over", number_text(*beam.slack_over),
           "only a rope (\"EI\": 0) with \"compression\": \"none\" goes slack: leave it out");
  }
  const bool curved_in_space = scene.dimension == 3 && bends && has_rest_shape(scene) && is_curved(scene);
  const bool frames = has_frames(scene);
  if (curved_in_space && !frames && !beam.out_of_plane) {
    refuse("/beam/out_of_plane", InvalidInput::missing,
           "a beam that is curved at rest does not resist loads across its plane with the scalar law, for its strain "
           "energy has the magnitude of the curvature and no torsion: write \"none\" if nothing leaves that plane, or "
           "\"space_law\": \"frames\", or \"dimension\": 2");
  }
  if (frames && beam.out_of_plane) {
    refuse("/beam/out_of_plane", quoted(*beam.out_of_plane),
           "bending and torsion resist it with /beam/space_law \"frames\": leave one of the two out");
  }
  if (!curved_in_space && beam.out_of_plane) {
    refuse("/beam/out_of_plane", quoted(*beam.out_of_plane),
           "it is to be left out but where \"dimension\" is 3 and a beam that bends is curved at rest");
  }
  if (scene.dimension == 3 && bends && !frames && beam.material.damping > 0 &&
      beam.material.curvature_regularization == 0) {
    refuse("/beam/material/curvature_regularization", "0",
           "bending damping in 3D has no direction on a straight beam: it must be a number > 0 [1/m], such as " +
               number_text(regularization_share / beam_length(scene)) + ", or the damping 0");
  }
  if (axis_form(scene) == AxisForm::exact && beam.curve.type != CurveType::line) {
    if (beam.element == ElementKind::ale_ancf || beam.element == ElementKind::ancf) {
      refuse("/beam/axis", "\"exact\"",
             "a polynomial element holds no conic: it must be \"even\", or the element rational");
    }
    if (has_rest_shape(scene) && sliding_joint(scene)) {
      refuse(
          "/beam/axis", "\"exact\"",
          "a mass that slides along an \"as-built\" beam needs \"even\": at an uneven speed the stretch at a node is "
          "the mesh's, and changes as the mesh does");
    }
  }
  if (scene.dimension == 3 && bends && !frames && beam.material.curvature_regularization == 0 &&
      has_rest_shape(scene)) {
    refuse("/beam/material/curvature_regularization", "0",
           "a curved rest shape in 3D has no direction where the beam is straight: it must be a number > 0 [1/m], such "
           "as " +
               number_text(regularization_share / beam_length(scene)) + ", or \"rest_shape\": \"paper\"");
  }
}

}  // namespace

void validate_beam(const Scene& scene) {
  check_sections(scene.beam);
  check_curve(scene);
  validate_sections(scene);
  check_beam(scene);
}

}  // namespace vlbeam
