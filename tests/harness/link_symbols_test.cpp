#include "tools/link_symbols.hpp"

#include <gtest/gtest.h>

#include "io/files.hpp"
#include "io/run_report.hpp"
#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

TEST(LinkSymbols, StandWhereLinksAndArmsAre) {
  const Scene scene = parse_scene(R"({"gravity": [0, -9.81], "duration": 0.02,
    "output": {"interval": 0.01, "configurations": [0]},
    "beams": [{"name": "girder", "curve": {"type": "line", "start": [0, 0], "end": [10, 0]}, "elements": 10,
               "section": {"type": "stiffness", "EA": 1e8, "EI": 1e6, "rhoA": 10},
               "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "pin"}]}],
    "bodies": [{"name": "cart", "mass": 50, "inertia": [10], "position": [5, 1.5], "rotation": 90,
                "points": {"left": [-0.5, 1]}}],
    "links": [{"name": "spring", "type": "spring", "stiffness": 1e4,
               "between": [{"body": "cart", "point": "left"}, {"beam": "girder", "at": {"x": 4}}]},
              {"name": "guide", "type": "rail", "between": [{"body": "cart"}, {"ground": [5, 0]}], "direction": [0, 1]}]})");
  const RunResult result = simulate(scene);
  const TemporaryFolder folder;
  write_file(folder / "r.json", [&](const TextSink& sink) { write_run_report(scene, result, Json::object(), sink); });
  const RunFile run = read_run_file(folder / "r.json");
  const std::vector<Symbol> symbols = link_symbols(run, run.configurations(), 0, 1);
  ASSERT_EQ(symbols.size(), 3U);
  const auto stands = [](const Symbol& symbol, Symbol::Kind kind, std::array<double, 2> at,
                         std::array<double, 2> other) {
    EXPECT_EQ(symbol.kind, kind);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(symbol.at[c], at[c], 1e-12);
      EXPECT_NEAR(symbol.other[c], other[c], 1e-12);
    }
  };
  stands(symbols[0], Symbol::Kind::rod, {5, 1.5}, {4, 1});  // (-0.5, 1) turned by 90 degrees is (-1, -0.5)
  stands(symbols[1], Symbol::Kind::coil, {4, 1}, {4, 0});
  EXPECT_EQ(symbols[2].kind, Symbol::Kind::rail);
  EXPECT_NEAR(symbols[2].way[1], 1, 1e-12);
}

}  // namespace
}  // namespace vlbeam
