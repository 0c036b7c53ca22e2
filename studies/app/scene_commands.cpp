// `vlbeam list`, `scene`, `schema`, `import`: scenes to begin with.
#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/moordyn.hpp"
#include "io/scene_json.hpp"
#include "io/schema.hpp"
#include "io/schema_text.hpp"
#include "scene/validate.hpp"
#include "studies/app/command.hpp"
#include "studies/app/registry.hpp"
#include "studies/app/run_outputs.hpp"
#include "studies/harness/source_folder.hpp"
#include "tools/scene_library.hpp"

namespace vlbeam {
namespace {

/// Scenes are only printed: where they were read is of no account.
std::filesystem::path scenes_folder(const std::string& given) {
  return find_source_folder("scenes", given, "falling_beam.json").path;
}

std::shared_ptr<std::string> add_scenes_option(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  app.add_option("--scenes", *folder, "Folder scenes/ (default: beside the program, else where it was built)");
  return folder;
}

int list_all(bool names_only, const std::string& scenes) {
  if (!names_only) std::cout << "Studies (vlbeam study NAME)\n";
  for (const Study& study : all_studies()) {
    std::cout << (names_only ? "" : "  ") << study.name << (names_only ? "" : "  " + study.title) << '\n';
  }
  if (names_only) return done;
  std::cout << "Scenes (vlbeam scene NAME)\n";
  for (const LibraryScene& scene : library_scenes(scenes_folder(scenes))) {
    std::cout << "  " << scene.name << "  " << printable(scene.title) << '\n';
  }
  return done;
}

struct SchemaArguments {
  std::string of;
  std::string part;   ///< JSON pointer; empty: all of it
  bool text = false;  ///< to read, in place of JSON
};

int carry_out(const SchemaArguments& arguments) {
  const std::map<std::string, Json (*)()> all{{"scene", scene_schema},       {"run", run_schema},
                                              {"study", study_schema},       {"gates", gates_schema},
                                              {"converge", converge_schema}, {"sweep", sweep_schema}};
  const auto found = all.find(arguments.of);
  if (found == all.end()) {
    throw InvalidInput("schema", "\"" + arguments.of + "\"", "there are: scene, run, study, gates, converge, sweep");
  }
  const Json schema = part_of_schema(found->second(), arguments.part);
  std::cout << (arguments.text ? schema_text(schema, arguments.part) : pretty(schema));
  return done;
}

struct ImportArguments {
  std::string format, file;  ///< "-" is standard input
  std::string out = "-";     ///< "-" is standard output
};

int carry_out(const ImportArguments& arguments) {
  RunOutputs outputs({{"the " + arguments.format + " file", arguments.file}}, {{"-o", arguments.out}}, true);
  const ImportedScene imported =
      naming_file(arguments.file, [&] { return scene_of_moordyn(read_text(arguments.file)); });
  validate(scene_from_json(imported.scene));
  outputs.write(arguments.out, RunStatus::completed, [&](const TextSink& sink) { sink(pretty(imported.scene)); });
  for (const std::string& what : imported.left_out) std::cerr << "  left out    " << printable(what) << '\n';
  outputs.tell();
  return outputs.all_written() ? done : computation_failed;
}

}  // namespace

Command list_command() {
  return {.name = "list",
          .help = "List the studies and the scenes",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto names_only = std::make_shared<bool>(false);
            app.add_flag("--names", *names_only, "Names of the studies only");
            const auto scenes = add_scenes_option(app);
            return [=] { return list_all(*names_only, *scenes); };
          },
          .examples = "  vlbeam list\n"};
}

Command scene_command() {
  return {.name = "scene",
          .help = "Print an example scene, to run or to copy",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto name = std::make_shared<std::string>();
            app.add_option("name", *name, "Name of the scene, see list")->required();
            const auto scenes = add_scenes_option(app);
            return [=] {
              std::cout << library_scene_text(scenes_folder(*scenes), *name);
              return done;
            };
          },
          .examples = "  vlbeam scene falling_beam > scene.json\n"};
}

Command schema_command() {
  return {.name = "schema",
          .help = "Print a JSON Schema",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<SchemaArguments>();
            app.add_option("of", arguments->of, "scene, run, study, gates, converge or sweep")->required();
            app.add_option("part", arguments->part, "Only what is below this key: /beam/material");
            app.add_flag("--text", arguments->text, "A line a key, to read: what it may be, unit and default");

            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam schema scene --text                                every key, its unit, range and default\n"
              "  vlbeam schema scene /beam/material --text                 those of the material\n"
              "  vlbeam schema run                                         the JSON Schema of reports\n"};
}

Command import_command() {
  return {.name = "import",
          .help = "Make a scene of another program's input; says what it left out",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<ImportArguments>();
            app.add_option("format", arguments->format, "moordyn: mooring lines, versions 1 and 2")
                ->required()
                ->check(CLI::IsMember({"moordyn"}));
            app.add_option("file", arguments->file, "Input file; - reads standard input")->required();
            app.add_option("-o,--out", arguments->out, "Write the scene (JSON) here; - is standard output")
                ->capture_default_str();
            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam import moordyn lines.txt -o lines.json\n"
              "  vlbeam import moordyn lines.txt | vlbeam run - --report lines.report.json\n"};
}

}  // namespace vlbeam
