#include "scene/sections.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/ropes/laws_along.hpp"
#include "scene/build.hpp"
#include "scene/build_drag.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

std::string piece_key(std::size_t piece) { return "/beam/sections/" + std::to_string(piece); }

/// The beam as if it had that section all along.
BeamSpec with_section(BeamSpec beam, const Section& section) {
  beam.section = section;
  beam.sections.clear();
  return beam;
}

double piece_end(const BeamPieceSpec& piece, double length) { return piece.to.value_or(length); }

void check_piece_ends(const Scene& scene, double length) {
  const auto& pieces = scene.beam.sections;
  double before = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string at = piece_key(i) + "/to";
    const bool last = i + 1 == pieces.size();
    if (!pieces[i].to) {
      if (last) break;
      refuse(at, InvalidInput::missing, "only the last piece goes to the end of the beam: it must be given [m]");
    }
    const double to = *pieces[i].to;
    if (!(to > before + corner_rounding * length)) {
      refuse(at, number_text(to), "pieces stand in order along the beam: it must be more than " + number_text(before));
    }
    if (last && std::abs(to - length) > corner_rounding * length) {
      refuse(at, number_text(to),
             "the last piece ends where the beam does, at " + number_text(length) + " [m]: say so, or leave it out");
    }
    if (!last && !(to < length * (1 - corner_rounding))) {
      refuse(at, number_text(to), "it must be on the beam, less than " + number_text(length) + " [m]");
    }
    before = to;
  }
  if (pieces.size() > static_cast<std::size_t>(scene.beam.elements)) {
    refuse("/beam/elements", std::to_string(scene.beam.elements),
           "each of the " + std::to_string(pieces.size()) + " sections needs an element");
  }
}

/// What a scene may not have beside sections that change, by its key.
void check_beside_sections(const Scene& scene) {
  const std::string key = "/beam/sections";
  const auto without = [&](bool there, const std::string& what) {
    if (there) refuse(key, "this key", "sections that change do not go together with " + what + " yet");
  };
  const auto bends = [](const BeamPieceSpec& piece) { return !is_rope_section(piece.section); };
  const bool mixed = !is_rope(scene.beam) && !std::ranges::all_of(scene.beam.sections, bends);
  without(mixed && !sliding_joints(scene).empty(), "joints, where some of them bend and others (EI = 0) do not,");
  without(has_frames(scene), "sections that have frames (/beam/space_law)");
  without(scene.spin.has_value(), "/spin");
  without(flows(scene), "/flow and rotary inertia");
  without(fed(scene), "a winch, a feed or a drum");
  without(scene.analysis == Analysis::dynamics && scene.integrator.type == IntegratorType::energy_momentum,
          "the integrator energy-momentum");
}

}  // namespace

const Section& main_section(const BeamSpec& beam) {
  if (beam.sections.empty()) return beam.section;
  const double length = drawn_axis<3>(beam.curve).length();
  const auto bends = [](const BeamPieceSpec& piece) { return !is_rope_section(piece.section); };
  const bool any_bends = std::ranges::any_of(beam.sections, bends);
  double before = 0, longest = 0;
  const Section* main = nullptr;
  for (const BeamPieceSpec& piece : beam.sections) {
    const double end = piece_end(piece, length);
    if (bends(piece) == any_bends && (main == nullptr || end - before > longest * (1 + corner_rounding))) {
      main = &piece.section;
      longest = end - before;
    }
    before = end;
  }
  return *main;
}

std::vector<const Section*> sections_of(const BeamSpec& beam) {
  if (beam.sections.empty()) return {&beam.section};
  std::vector<const Section*> sections;
  for (const BeamPieceSpec& piece : beam.sections) sections.push_back(&piece.section);
  return sections;
}

bool knows_stress(const BeamSpec& beam) {
  return std::ranges::all_of(sections_of(beam), [](const Section* section) { return has_sizes(section->type); });
}

const Section& section_at(const BeamSpec& beam, double x) {
  for (const BeamPieceSpec& piece : beam.sections) {
    if (!piece.to || x < *piece.to) return piece.section;
  }
  return beam.sections.empty() ? beam.section : beam.sections.back().section;
}

void validate_sections(const Scene& scene) {
  if (scene.beam.sections.empty()) return;
  check_piece_ends(scene, drawn_axis<3>(scene.beam.curve).length());
  check_beside_sections(scene);
}

std::vector<double> section_changes(const BeamSpec& beam) {
  std::vector<double> changes;
  for (std::size_t i = 0; i + 1 < beam.sections.size(); ++i) changes.push_back(beam.sections[i].to.value_or(0));
  return changes;
}

SectionPieces build_pieces(const Scene& scene) {
  const BeamSpec& beam = scene.beam;
  if (beam.sections.empty()) return {};
  const BeamSection own = build_section(beam);
  const Axis<3> axis = build_axis<3>(scene);
  std::vector<SectionPieces::Piece> pieces;
  for (const BeamPieceSpec& piece : beam.sections) {
    const BeamSection here = build_section(with_section(beam, piece.section));
    const double EI = own.stiffness.EI;
    pieces.push_back(
        {position_on_axis(beam.curve, axis.breaks(), piece_end(piece, axis.length())),
         {here.rhoA / own.rhoA, here.stiffness.EA / own.stiffness.EA, EI > 0 ? here.stiffness.EI / EI : 1}});
  }
  return SectionPieces(std::move(pieces));
}

double stiffest_EA(const BeamSpec& beam) {
  double largest = 0;
  for (const Section* section : sections_of(beam)) {
    largest = std::max(largest, build_section(with_section(beam, *section)).stiffness.EA);
  }
  return largest;
}

double mean_mass(const BeamSpec& beam, double length) {
  if (beam.sections.empty()) return build_section(beam).rhoA;
  double sum = 0, before = 0;
  for (const BeamPieceSpec& piece : beam.sections) {
    const double end = piece_end(piece, length);
    sum += (end - before) * build_section(with_section(beam, piece.section)).rhoA;
    before = end;
  }
  return sum / length;
}

template <int D>
void add_laws_along(const Scene& scene, BeamModel<D>& model) {
  if constexpr (has_room("ropes")) {
    if (scene.beam.sections.empty()) return;
    const auto line_force = std::exchange(model.loads.line_force, {});
    const TimeFunction share = acting({.value = 1, .ramp = scene.gravity_ramp}, scene.analysis);
    std::vector<LawAlong<D>> laws;
    bool acts = false;
    for (const BeamPieceSpec& piece : scene.beam.sections) {
      LawAlong<D> law{.end = piece_end(piece, beam_length(scene)), .drag = {}, .push = line_force};
      const double rhoA = build_section(with_section(scene.beam, piece.section)).rhoA;
      const DragSpec drag = piece.drag ? *piece.drag : scene.drag.value_or(DragSpec{});
      law.drag = build_drag<D>(scene, drag, rhoA, model.quadrature_points);
      if (scene.fluid) {
        const double area = displaces(piece.section.type) ? displaced_area(piece.section) : piece.area.value_or(0);
        const Vec<double, D> lift = -scene.fluid->density * area * vector_of<D>(scene.gravity);
        if (!lift.isZero(0)) {
          law.push = [share, lift, line_force](double t) -> Vec<double, D> {
            const Vec<double, D> sum = share(t).value * lift;
            return line_force ? Vec<double, D>(sum + line_force(t)) : sum;
          };
        }
      }
      acts = acts || law.drag.present() || law.push;
      laws.push_back(std::move(law));
    }
    if (acts) model.parts.push_back(laws_along<D>(std::move(laws), model.quadrature_points));
  }
}
template void add_laws_along(const Scene&, BeamModel<2>&);
template void add_laws_along(const Scene&, BeamModel<3>&);

std::vector<std::string> pieces_in_words(const BeamSpec& beam) {
  std::vector<std::string> lines;
  double before = 0;
  const double length = drawn_axis<3>(beam.curve).length();
  for (const BeamPieceSpec& piece : beam.sections) {
    const BeamSpec here = with_section(beam, piece.section);
    const BeamSection section = build_section(here);
    std::ostringstream text;
    text.precision(4);
    text << before << " to " << piece_end(piece, length) << " m: ";
    if (const std::string words = section_in_words(here); !words.empty()) {
      text << words;
    } else {
      text << "EA = " << section.stiffness.EA << " N, EI = " << section.stiffness.EI << " N m^2, " << section.rhoA
           << " kg/m";
    }
    lines.push_back(text.str());
    before = piece_end(piece, length);
  }
  return lines;
}

}  // namespace vlbeam
