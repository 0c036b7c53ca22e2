#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/scene_json.hpp"
#include "io/schema.hpp"
#include "io/schema_parts.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "scene/sample_quantities.hpp"

namespace vlbeam {
namespace {

Json record(const Json& properties, const std::vector<std::string>& optional = {}) {
  Json required = Json::array();
  for (const auto& item : properties.items()) {
    if (std::find(optional.begin(), optional.end(), item.key()) == optional.end()) required.push_back(item.key());
  }
  return {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
}

const Json any_number = {{"type", "number"}};
const Json nullable_number = {{"type", {"number", "null"}}};
const Json any_text = {{"type", "string"}};
const Json whole = {{"type", "integer"}, {"minimum", 0}};
const Json any_point = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 3}};
const Json any_object = {{"type", "object"}};

Json choice(const std::vector<std::string>& values) { return {{"enum", values}}; }

template <NamedEnum E>
Json choice_of() {
  std::vector<std::string> values;
  for (const auto& entry : names(E{})) values.emplace_back(entry.name);
  return choice(values);
}

/// What the parts of a run's samples are.
std::string part_description(const std::string& part) {
  static const std::map<std::string, std::string> parts = {
      {"energy", "energies of beam and mass"},
      {"contact", "between the sliding mass and the beam, by the accelerations that belong to the state"},
      {"axial_strain", "over the whole beam, at 25 points an element and its ends"},
      {"axial_force", "over the whole beam, along the axis"},
      {"bending_moment", "over the whole beam, without torsion"},
      {"shear_force", "over the whole beam, across the axis"},
      {"torque", "over the whole beam, of sections with frames"},
      {"stress", "over the whole beam, of a section with sizes"},
      {"angles", "of the beam at its ends"},
      {"tension", "at the ends that something holds"},
      {"places", "places of the scene, by their names; null where they are not on the beam"},
      {"supports", "of points between the ends, by their names or numbers"},
      {"vehicles", "vehicles of the scene, by their names"},
      {"curvature", "over the whole beam"},
      {"reactions", "of the supports, by the accelerations that belong to the state"},
      {"flow", "what else there is to see of a beam that spins, flows or bears loads"},
      {"ledger", "what has crossed the boundary; the change of energy is the sum of ends, loads and mesh"}};
  const auto found = parts.find(part);
  return found == parts.end() ? "of the support at this node" : found->second;
}

/// With a description, and the unit in brackets where there is one.
Json described(const Json& schema, const std::string& description, const std::string& unit = "") {
  Json result = schema;
  result["description"] = description + (unit.empty() || unit == "-" ? "" : " [" + unit + "]");
  return result;
}

/// Scenes with everything that adds to the samples of a run.
std::vector<Scene> scenes_with_every_quantity() {
  Scene moving = scene_with_every_part();
  moving.gravity_ramp = 1;
  moving.start.type = moving.end.type = SupportType::clamp;
  moving.flow->nodes.front() = {.node = 1, .x = {}, .support = SupportType::slide};
  Scene several = moving;
  several.sliding_joints.push_back(several.sliding_joints.front());
  Scene at_rest;
  at_rest.analysis = Analysis::statics;
  at_rest.sliding_mass.emplace();
  Scene with_frames;
  with_frames.dimension = 3;
  with_frames.beam.section = {.type = Section::Type::rectangle, .width = 1, .height = 2};
  with_frames.places = moving.places;
  return {moving, several, at_rest, with_frames};
}

/// The samples of a run as columns, out of the table of quantities: those that every scene has are required.
Json samples_schema() {
  Scene rope;  // it does not bend, and nothing holds it
  rope.beam.section.type = Section::Type::stiffness;
  const auto needed = sample_quantities(rope);
  const auto is_needed = [&needed](const std::string& path) {
    return std::ranges::any_of(needed, [&path](const SampleQuantity& quantity) {
      return quantity.path == path || quantity.path.starts_with(path + "/");
    });
  };
  Json root = record(Json::object());
  std::vector<SampleQuantity> all;
  for (const Scene& scene : scenes_with_every_quantity()) {
    for (SampleQuantity& quantity : sample_quantities(scene)) {
      if (std::ranges::find(all, quantity.path, &SampleQuantity::path) == all.end()) all.push_back(std::move(quantity));
    }
  }
  for (const SampleQuantity& quantity : all) {
    Json* object = &root;
    std::string path;
    const auto parts = segments("/" + quantity.path);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      path += (path.empty() ? "" : "/") + parts[i];
      const bool numbered = parts[i].starts_with("node_"),
                 named = i == 1 && (parts[0] == "places" || parts[0] == "supports" || parts[0] == "vehicles");
      const bool axle = i == 2 && parts[0] == "vehicles";
      const std::string pattern = numbered ? "^node_[0-9]+$" : axle ? "^axle_[0-9]+$" : named ? "^[A-Za-z0-9_]+$" : "";
      Json& entry = pattern.empty() ? (*object)["properties"][parts[i]] : (*object)["patternProperties"][pattern];
      if (is_needed(path)) {
        Json& required = (*object)["required"];
        if (std::find(required.begin(), required.end(), parts[i]) == required.end()) required.push_back(parts[i]);
      }
      const bool leaf = i + 1 == parts.size() && !quantity.columns.empty();
      if (!leaf) {
        if (entry.is_null()) {
          entry = described(record(Json::object()), axle    ? "a wheel"
                                                    : named ? "one of the scene"
                                                            : part_description(parts[i]));
        }
        object = &entry;
        continue;
      }
      Json cell = nullable_number;
      if (quantity.shape != SampleShape::number) cell = {{"type", {"array", "null"}}, {"items", nullable_number}};
      if (quantity.shape == SampleShape::vectors) cell = array_of(cell);
      entry = described(array_of(cell), quantity.description + "; one entry a sample", quantity.unit);
    }
  }
  return described(root, "the observed quantities, each a column with one entry a sample");
}

/// Of several beams and bodies: their names are those of the scene.
Json samples_of_several_schema() {
  return described(
      {{"type", "object"},
       {"properties", {{"t", array_of(any_number)}, {"energy", {{"type", "object"}}}}},
       {"required", {"t", "energy"}},
       {"not", {{"required", {"beam_length"}}}},
       {"additionalProperties", {{"type", {"array", "object"}}}}},
      "of several beams and bodies: energies and momenta of the whole, and below the name of each part what it "
      "has");
}

Json run_error_schema() {
  const Json quantity = record({{"quantity", described(any_text, "what may be off")},
                                {"unit", described(any_text, "of both numbers")},
                                {"time", described(nullable_number, "by the steps, at most over the run")},
                                {"mesh", described(nullable_number, "by the elements, at most over the run")}});
  return record(
      {{"time", described(nullable_number, "of places, by the steps, at most over the run", "m")},
       {"mesh", described(nullable_number, "of places, by the elements, at most over the run", "m")},
       {"trusted_until", described(nullable_number,
                                   "the error in time keeps to what is allowed, that of the mesh to 1 % of the motion, "
                                   "until then; null in statics",
                                   "s")},
       {"allowed_in_time", described(nullable_number, "by the accuracy asked; null where none is", "m")},
       {"motion", described(any_number, "by which places move at most", "m")},
       {"repeats", described(whole, "how often the run was done again with a finer tolerance", "-")},
       {"elements_wanted", described({{"type", {"integer", "null"}}},
                                     "that would bring the mesh's error to 1 % of the motion; null where it is below")},
       {"no_time", described(any_text, "why there is no error in time")},
       {"no_mesh", described(any_text, "why there is no error of the mesh")},
       {"quantities", described(array_of(quantity), "the same, quantity by quantity")}},
      {"no_time", "no_mesh"});
}

}  // namespace

Json run_schema() {
  const Json flag = {{"type", "boolean"}};
  const Json kink = record({{"node", described(whole, "number of the node, from 0", "-")},
                            {"r_x", described(any_point, "slope behind it", "-")},
                            {"r_x_rate", described(any_point, "its rate", "1/s")}});
  const Json rest = record({{"r", described(array_of(any_point), "positions", "m")},
                            {"r_x", described(array_of(any_point), "slopes", "-")}});
  const Json axis = record({{"element", described(array_of(any_number), "number of the element, from 0", "-")},
                            {"x", described(array_of(any_number), "material coordinate", "m")},
                            {"r", described(array_of(any_point), "position", "m")},
                            {"v", described(array_of(any_point), "velocity of the material point", "m/s")},
                            {"strain", described(array_of(any_number), "axial strain, from the rest shape", "-")},
                            {"curvature", described(array_of(any_number), "magnitude of the curvature", "1/m")},
                            {"tension", described(array_of(any_number), "axial force, damping included", "N")},
                            {"shear", described(array_of(any_number), "shear force; 0 with frames", "N")},
                            {"moment", described(array_of(any_number), "bending moment", "N m")},
                            {"torque", described(array_of(any_number), "about the axis, with frames", "N m")}});
  const Json action = record({{"x", described(any_number, "material coordinate", "m")},
                              {"force", described(any_point, "force, as far as it acts inside an element", "N")}});
  const Json configuration = record(
      {{"t", described(any_number, "time", "s")},
       {"beam", described(any_text, "which of several beams")},
       {"x", described(array_of(any_number), "material coordinates of the nodes", "m")},
       {"r", described(array_of(any_point), "positions of the nodes", "m")},
       {"r_x", described(array_of(any_point), "slopes at the nodes; at a kink that before it", "-")},
       {"weights", described(array_of(array_of(any_number)), "the four rational weights of each element", "-")},
       {"angles", described(array_of(any_number), "of the section about the axis, at the nodes; with spin", "rad")},
       {"x_rate", described(array_of(any_number), "rates of the material coordinates", "m/s")},
       {"v", described(array_of(any_point),
                       "velocities of the material points at the nodes; a node itself moves with "
                       "v + r_x x_rate",
                       "m/s")},
       {"r_x_rate", described(array_of(any_point), "rates of the slopes at the nodes", "1/s")},
       {"spins", described(array_of(any_number), "rates of the angles; with spin", "rad/s")},
       {"rest", described(rest,
                          "nodes of the rest shape of these elements, from which strains are measured; "
                          "where it is not a straight beam")},
       {"kink", described(kink, "where the beam may be kinked, at the sliding mass")},
       {"kinks", described(array_of(kink), "the same where there are several, at sliding joints")},
       {"actions", described(array_of(action), "where something acts on the beam: moment and shear have a kink there")},
       {"moments", described(array_of(array_of(array_of(any_number))),
                             "at two Gauss points of each element: about the section's axes y and z, and about the "
                             "tangent; with frames",
                             "N m")},
       {"axis", described(axis, "points along the axis, those at nodes once for each element; with output.points")}},
      {"beam", "kink", "kinks", "rest", "angles", "spins", "actions", "moments", "axis"});
  const Json jumps = record(
      {{"kinetic", described(nullable_number, "of kinetic energy", "J")},
       {"axial", described(nullable_number, "of the strain energy of stretching", "J")},
       {"bending", described(nullable_number, "of the strain energy of bending", "J")},
       {"gravity", described(nullable_number, "of the potential energy", "J")},
       {"discrete_total", described(nullable_number, "of the total, by the model's own quadrature points", "J")}});
  const Json event = record(
      {{"t", described(any_number, "time", "s")},
       {"type", described(choice_of<EventType>(), "what happened to the mesh")},
       {"beam", described(any_text, "of which of several beams")},
       {"joint",
        described(whole, "which of the scene's sliding joints, from 0; behind them the ends that feed the beam", "-")},
       {"joint_position", described(any_number, "its material coordinate", "m")},
       {"weights", described(array_of(any_number), "k_0, k_1, k_2 of the merged element, over the last", "-")},
       {"unit_fallback", described(flag, "whether the fit found a weight <= 0 and unit weights were taken")},
       {"energy_jumps", described(jumps, "after minus before, by a 25-point rule")},
       {"momentum_jumps", described(array_of(any_number),
                                    "linear [kg m/s], then angular about the origin [kg m^2/s]; none "
                                    "where the mass leaves")},
       {"relaxation",
        described(whole, "iterations until the nodes beside it had given way, where they are relaxed", "-")},
       {"energy_restored",
        described(flag, "false where velocities are conservative and yet the total energy changed")}},
      {"beam"});
  const auto residual = [](const std::string& of, const char* position, const char* velocity) {
    return described(record({{"position", described(any_number, "largest", position)},
                             {"velocity", described(any_number, "largest of its rate", velocity)}}),
                     of);
  };
  const Json solver = record(
      {{"steps", described(whole, "accepted steps", "-")},
       {"rejected", described(whole, "steps that were repeated, shorter", "-")},
       {"limited_by",
        described(
            record({{"given_step", described(whole,
                                             "by the step given, the longest one of a method that adapts, "
                                             "or the end of the run",
                                             "-")},
                    {"error", described(whole, "by the tolerance of the error", "-")},
                    {"newton", described(whole, "by Newton's iteration, which failed in a longer one", "-")},
                    {"events",
                     described(whole,
                               "by an event, at which they end, or by the search for one, which failed in a longer one",
                               "-")}}),
            "accepted steps by what kept them from being longer")},
       {"rejected_by",
        described(record({{"error", described(whole,
                                              "by the tolerance of the error, or with a state that is not "
                                              "finite",
                                              "-")},
                          {"newton", described(whole, "by Newton's iteration, which failed", "-")},
                          {"events", described(whole, "too long for an event to be looked for in them", "-")}}),
                  "rejected steps by what rejected them")},
       {"rhs_evaluations",
        described(whole, "evaluations of the equations of motion, as accelerations or residual", "-")},
       {"smallest_step", described(nullable_number, "of the accepted ones that no event cut short", "s")},
       {"newton_iterations", described(whole, "of implicit methods", "-")},
       {"tangents", described(whole, "factored by implicit methods", "-")},
       {"longest_newton_iteration",
        described(array_of(any_number), "corrections, one after the other, of the iteration that took most of them",
                  "-")},
       {"constraint_residual", residual("how far samples were from their constraints, with multipliers", "m", "m/s")},
       {"slope_residual", residual("how far the slopes at a kinked mass were from what ties them", "-", "1/s")},
       {"largest_kinetic_energy", described(nullable_number, "of all samples", "J")},
       {"largest_energy_drift",
        described(
            nullable_number,
            "of all samples: change of the total energy by the model's own points, less what is supplied and what "
            "changes at events",
            "J")}});
  const Json ledger =
      record({{"change", described(nullable_number, "of the total energy, what is dissipated included", "J")},
              {"supplied",
               described(nullable_number, "by moving supports, growing gravity, loads, and through the ends", "J")},
              {"dissipated", described(nullable_number, "by damping and friction", "J")},
              {"at_events", described(nullable_number, "sum of the jumps at length-control events", "J")},
              {"event_jumps", described(nullable_number, "sum of their magnitudes", "J")},
              {"at_contacts", described(nullable_number, "by impacts of the mass on supports", "J")},
              {"unexplained",
               described(nullable_number, "change - supplied - at_events - at_contacts, at the last sample", "J")},
              {"largest_unexplained", described(nullable_number, "the same, largest magnitude of all samples", "J")}});
  const Json warning = record({{"kind", described(choice_of<WarningKind>(), "what it is about")},
                               {"message", described(any_text, "what has happened, with numbers")},
                               {"remedy", described(any_text, "what to try")}});
  const Json extreme = record({{"largest", nullable_number},
                               {"largest_at", described(nullable_number, "when", "s")},
                               {"least", nullable_number},
                               {"least_at", described(nullable_number, "when", "s")},
                               {"unit", any_text}});
  Json scene = scene_schema();
  scene.erase("$schema");
  return with_head(
      "vlbeam run report",
      record(
          {{"schema_version", described({{"const", "vlbeam.run/1"}}, "what this file is, and its version")},
           {"status", described(choice_of<RunStatus>(),
                                "how the run ended; separated: the mass left the beam, and "
                                "the run went on to its end")},
           {"failure", described(record({{"message", described(any_text, "what went wrong")},
                                         {"t", described(any_number, "when", "s")}}),
                                 "of a run that failed; what was computed until then is in the report")},
           {"warnings", described(array_of(warning), "what the results do not show by themselves")},
           {"error", described(run_error_schema(),
                               "of a checked run: what companions with longer steps and on coarser "
                               "meshes tell of its errors")},
           {"scene", described(scene, "as understood, every default filled in")},
           {"law", described(any_text, "how the axial force follows from the stretch, in words")},
           {"samples", described({{"anyOf", {samples_schema(), samples_of_several_schema()}}},
                                 "the observed quantities, each a column with one entry a sample")},
           {"extremes",
            described({{"type", "object"}, {"additionalProperties", extreme}},
                      "of each number of the samples over all steps, by its name; where /output/extremes asks for it")},
           {"configurations", described(array_of(configuration), "the whole shape at the times asked for")},
           {"events", described(array_of(event), "changes of the mesh, located in time")},
           {"energy_ledger", described(ledger,
                                       "where energy came from and went, from the first sample to the last, by "
                                       "a 25-point rule: change = supplied + at_events + at_contacts + unexplained")},
           {"frequencies", described(array_of(any_number),
                                     "the lowest natural ones about the last equilibrium, where asked for; of a "
                                     "direction in which it is not stable minus the rate of growth over 2 pi",
                                     "Hz")},
           {"initial_equilibrium",
            described(record({{"negative_pivots", described(whole, "directions in which the potential energy falls")},
                              {"holding_force",
                               described(any_number, "on the joint's material coordinate until t = 0", "N")}}),
                      "of a motion that starts from one: stable where the first is 0")},
           {"solver", described(solver, "what the integrator did")},
           {"integrator_choice",
            described(record({{"accuracy", described(any_number, "asked of positions in time, over the length", "-")},
                              {"reason", described(any_text, "why this method was taken")}}),
                      "of a run whose scene leaves the integrator to the program")},
           {"provenance", described(any_object, "program, commit, compiler, flags, host and date")},
           {"timing", described(any_object, "wall times: motion, length_control [s]")}},
          {"failure", "error", "law", "extremes", "frequencies", "initial_equilibrium", "integrator_choice"}));
}

Json study_schema() {
  const Json profile = choice({"ci", "full"});
  const Json gate_kind = choice({"exact", "independent", "self", "regression"});
  const Json cell = {{"type", {"number", "string", "boolean", "null"}}};
  const Json study_case =
      record({{"options", Json::object()}, {"results", Json::object()}, {"failure", any_text}}, {"failure"});
  const Json fit = record({{"quantity", any_text},
                           {"levels", array_of(any_number)},
                           {"errors", array_of(nullable_number)},
                           {"errors_known_to", any_number},
                           {"fitted_from", whole},
                           {"fitted_to", whole},
                           {"pairwise_orders", array_of(nullable_number)},
                           {"pair_uncertainties", array_of(any_number)},
                           {"slope", nullable_number},
                           {"slope_uncertainty", nullable_number},
                           {"excluded", any_text},
                           {"refusal", any_text}},
                          {"excluded", "refusal"});
  const Json grid_convergence = record({{"quantity", any_text},
                                        {"levels", array_of(any_number)},
                                        {"values", array_of(nullable_number)},
                                        {"order", nullable_number},
                                        {"limit", nullable_number},
                                        {"safety_factor", any_number},
                                        {"uncertainty", nullable_number},
                                        {"refusal", any_text}},
                                       {"refusal"});
  const Json gate = record({{"name", any_text},
                            {"kind", gate_kind},
                            {"value", nullable_number},
                            {"uncertainty", any_number},
                            {"bound", any_text},
                            {"reason", any_text},
                            {"guards", any_text},
                            {"passed", {{"type", "boolean"}}},
                            {"failure", any_text}},
                           {"uncertainty", "reason", "guards", "failure"});
  const Json table = record({{"name", any_text},
                             {"caption", any_text},
                             {"file", any_text},
                             {"columns", array_of(any_text)},
                             {"rows", array_of(array_of(cell))}},
                            {"rows"});
  const Json figure = record({{"name", any_text}, {"caption", any_text}, {"file", any_text}});
  return with_head(
      "vlbeam study report",
      record({{"schema_version", {{"const", "vlbeam.study/1"}}},
              {"study", any_text},
              {"profile", profile},
              {"status", choice({"completed", "failed", "interrupted"})},
              {"failure", any_text},
              {"measured", {{"type", "object"}, {"additionalProperties", nullable_number}}},
              {"cases", array_of(study_case)},
              {"fits", array_of(fit)},
              {"grid_convergence", array_of(grid_convergence)},
              {"gate_kinds", record({{"exact", whole}, {"independent", whole}, {"self", whole}, {"regression", whole}},
                                    {"exact", "independent", "self", "regression"})},
              {"gates", array_of(gate)},
              {"tables", array_of(table)},
              {"figures", array_of(figure)}},
             {"failure", "grid_convergence", "gate_kinds"}));
}

Json gates_schema() {
  const Json nonempty = {{"type", "string"}, {"minLength", 1}};
  const Json order = record(
      {{"expected", any_number}, {"tolerance", any_number}, {"at_most", any_number}, {"finest_error", any_number}});
  Json gate = record(
      {{"name", nonempty},
       {"kind", choice({"exact", "independent", "self", "regression"})},
       {"reason", nonempty},
       {"guards", nonempty},
       {"profiles", {{"type", "array"}, {"items", choice({"ci", "full"})}, {"minItems", 1}}},
       {"quantity", nonempty},
       {"max", any_number},
       {"min", any_number},
       {"equals", any_number},
       {"tolerance", {{"type", "number"}, {"minimum", 0}}},
       {"uncertainty", {{"type", {"number", "string"}}}},
       {"fit", nonempty},
       {"order", order}},
      {"reason", "guards", "profiles", "quantity", "max", "min", "equals", "tolerance", "uncertainty", "fit", "order"});
  const auto needs = [](const char* key) { return Json{{"required", {key}}}; };
  gate["oneOf"] = Json::array({needs("quantity"), needs("fit")});
  gate["dependentSchemas"] = {{"quantity", {{"anyOf", Json::array({needs("max"), needs("min"), needs("equals")})}}},
                              {"fit", needs("order")},
                              {"tolerance", needs("equals")}};
  // One of kind regression says what it guards, evidence has a reason; a quantity of kind self has an uncertainty.
  const auto is = [](const char* kind) { return Json{{"properties", {{"kind", {{"const", kind}}}}}}; };
  const auto without = [](const char* key) { return Json{{"not", {{"required", {key}}}}}; };
  gate["allOf"] =
      Json::array({{{"if", is("regression")},
                    {"then", {{"allOf", Json::array({needs("guards"), without("reason")})}}},
                    {"else", {{"allOf", Json::array({needs("reason"), without("guards")})}}}},
                   {{"if", is("self")}, {"then", {{"anyOf", Json::array({needs("fit"), needs("uncertainty")})}}}}});
  return with_head("vlbeam gates", record({{"schema", {{"const", "vlbeam.gates/1"}}}, {"gates", array_of(gate)}}));
}

Json converge_schema() {
  const Json flag = {{"type", "boolean"}};
  const Json setting = {{"type", "object"},
                        {"properties",
                         {{"elements", whole},
                          {"quadrature_points", whole},
                          {"step", described(any_number, "of methods that do not choose it", "s")},
                          {"rtol", described(any_number, "of the others; atol keeps its ratio to it", "-")}}},
                        {"required", {"elements", "quadrature_points"}},
                        {"additionalProperties", false}};
  Json setting_or_null = setting;
  setting_or_null["type"] = {"object", "null"};
  const Json part = record({{"quantity", any_text},
                            {"levels", array_of(any_number)},
                            {"values", array_of(nullable_number)},
                            {"order", described(nullable_number, "of the three finest", "-")},
                            {"limit", described(nullable_number, "Richardson's extrapolation")},
                            {"safety_factor", any_number},
                            {"uncertainty", nullable_number},
                            {"refusal", described(any_text, "why there is no order: not asymptotic")}},
                           {"refusal"});
  Json level = record({{"refined", choice({"mesh", "time", "quadrature"})}}, {});
  level["properties"].update(setting.at("properties"));
  level["properties"].update(
      Json{{"value", nullable_number},
           {"difference", described(nullable_number, "from the answer, its magnitude")},
           {"error_bound", described(nullable_number, "difference and uncertainty of the answer together")},
           {"work", described(any_number, "evaluations times elements and quadrature points", "-")},
           {"events", described(whole, "of length control, contacts and separation")},
           {"failure", described(any_text, "why there is no value")}});
  Json properties = {
      {"schema_version", {{"const", "vlbeam.converge/1"}}},
      {"title", any_text},
      {"quantity", any_text},
      {"unit", any_text},
      {"t", described(any_number, "time of the answer; 1, the load factor, of an equilibrium", "s")},
      {"error", described(any_number, "wanted, in the unit")},
      {"answer", described(nullable_number, "of the finest setting, in the unit")},
      {"uncertainty", described(nullable_number, "of the answer: of mesh, time and quadrature together")},
      {"reached", described(flag, "whether the uncertainty is no more than the error wanted")},
      {"reason", described(any_text, "why not")},
      {"predictable_until", described(any_number, "the error wanted is kept until this sample", "s")},
      {"horizon",
       described(any_number, "a density changed in its 8th digit matters less than the error until then", "s")},
      {"setting", described(setting_or_null, "the cheapest of those run that keeps the error wanted")},
      {"finest", described(setting, "that of the answer")},
      {"parts",
       {{"type", "object"},
        {"properties", {{"mesh", part}, {"time", part}, {"quadrature", part}}},
        {"additionalProperties", false}}},
      {"levels", described(array_of(level), "all runs: work and precision")},
      {"cost", record({{"runs", whole}, {"in_runs_of_the_finest", nullable_number}})},
      {"scene", described(any_object, "in the cheapest setting, or as given where there is none")},
      {"provenance", any_object},
      {"timing", record({{"seconds", described(array_of(any_number), "of each level", "s")}})}};
  return with_head("vlbeam convergence of a scene", record(properties, {"reason", "horizon", "predictable_until"}));
}

Json sweep_schema() {
  const Json range = record({{"from", any_number},
                             {"to", any_number},
                             {"count", {{"type", "integer"}, {"minimum", 2}, {"maximum", 1000000}}},
                             {"spacing", choice({"linear", "logarithmic"})}},
                            {"spacing"});
  const Json list = {{"type", "array"}, {"minItems", 1}};
  const Json properties = {
      {"schema", {{"const", "vlbeam.sweep/1"}}},
      {"title", any_text},
      {"scene", described({{"type", {"object", "string"}}}, "the scene, or its file's name, beside this file")},
      {"combine", described(choice({"product", "zip"}),
                            "all combinations (default), or the first values of all options, "
                            "then the second, and so on")},
      {"over", described({{"type", "object"}, {"additionalProperties", {{"anyOf", {list, range}}}}},
                         "JSON pointers into the scene, several separated by spaces, and their values")},
      {"quantities", described(array_of(any_text), "whose last samples are kept, by the names that converge takes")}};
  return with_head("vlbeam sweep", record(properties, {"title", "combine", "quantities"}));
}

}  // namespace vlbeam
