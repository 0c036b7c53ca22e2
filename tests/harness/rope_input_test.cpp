// What people get wrong about ropes, rings, wheels and winches: each is refused by path and value, with what is
// allowed.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/error.hpp"
#include "io/scene_json.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

/// A rope from a winch over a ring, with a weight at its end.
const char* const rope = R"({
  "schema": "vlbeam.scene/1",
  "beam": {"curve": {"type": "polyline", "points": [[0, 0], [1, 1], [2, 0]]},
           "section": {"type": "stiffness", "EA": 1e6, "EI": 0, "rhoA": 0.01}, "elements": 10},
  "supports": [{"at": "start", "type": "pin"}],
  "sliding_joints": [{"position": 1.4142135623730951, "support": "pin", "slopes": "free"}],
  "point_masses": [{"node": 10, "mass": 1}],
  "duration": 0.1
})";

struct Wrong {
  const char* patch;    ///< merged into the scene
  const char* field;    ///< that is refused
  const char* allowed;  ///< what the message says of it, in part

  friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.patch; }
};

class WrongRope : public testing::TestWithParam<Wrong> {};

TEST_P(WrongRope, IsRefusedByPathAndValueWithWhatIsAllowed) {
  Json scene = Json::parse(rope);
  scene.merge_patch(Json::parse(GetParam().patch));
  try {
    validate(scene_from_json(scene));
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field) << error.what();
    EXPECT_FALSE(error.value.empty()) << error.what();
    EXPECT_NE(error.allowed.find(GetParam().allowed), std::string::npos) << error.what();
  }
}

TEST(WrongRope, IsRightToBeginWith) { EXPECT_NO_THROW(validate(scene_from_json(Json::parse(rope)))); }

#define SUPPORT(keys) R"({"supports": [{"at": "start", "type": "pin", )" keys "}]}"
#define JOINT(keys) \
  R"({"sliding_joints": [{"position": 1.4142135623730951, "support": "pin", "slopes": "free", )" keys "}]}"
#define BLOCK(joints, blocks) R"({"sliding_joints": [)" joints R"(], "blocks": [)" blocks "]}"
#define FREE_AT(x) R"({"mass": 1, "position": )" x R"(, "slopes": "free"})"

INSTANTIATE_TEST_SUITE_P(
    Curves, WrongRope,
    testing::Values(
        Wrong{R"({"beam": {"curve": {"points": [[0, 0]]}}})", "/beam/curve/points", "at least two"},
        Wrong{R"({"beam": {"curve": {"points": [[0, 0], [0, 0], [1, 0]]}}})", "/beam/curve/points/1", "length > 0"},
        Wrong{R"({"beam": {"curve": {"points": [[0, 0, 0], [1, 0, 0]]}}})", "/beam/curve/points", "2 numbers"},
        Wrong{R"({"beam": {"curve": {"points": "here"}}})", "/beam/curve/points", "array"},
        Wrong{R"({"beam": {"elements": 1}})", "/beam/elements", "whole number"},
        Wrong{R"({"beam": {"section": {"EI": 3}, "curve": {"points": [[0, 0], [1, 1], [2, 0], [3, 1]]}}})",
              "/beam/curve/points/2", "a rope"},
        Wrong{R"({"beam": {"compression": "some"}})", "/beam/compression", "\"none\""},
        Wrong{R"({"beam": {"compression": "full", "slack_over": 1e-4}})", "/beam/slack_over", "compression"},
        Wrong{R"({"beam": {"compression": "none", "slack_over": 0}})", "/beam/slack_over", "(0, 1]"},
        Wrong{R"({"beam": {"compression": "none", "slack_over": 2}})", "/beam/slack_over", "(0, 1]"},
        Wrong{R"({"beam": {"compression": "none"}, "integrator": {"type": "energy-momentum"}})", "/integrator/type",
              "other"}));
INSTANTIATE_TEST_SUITE_P(
    Winches, WrongRope,
    testing::Values(
        Wrong{SUPPORT(R"("drum": {"inertia": 1})"), "/supports/0/drum/radius", "> 0"},
        Wrong{SUPPORT(R"("drum": {"radius": 0, "inertia": 1})"), "/supports/0/drum/radius", "> 0"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": -1})"), "/supports/0/drum/inertia", ">= 0"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1, "torque": 3})"), "/supports/0/drum/torque",
              "\"value\": 3"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "feed": {"rate": 1, "rate_ramp": 1})"),
              "/supports/0/feed", "one of them"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "held_tension": {"value": 1})"), "/supports/0/drum",
              "one of them"},
        Wrong{SUPPORT(R"("feed": {"rate": 1})"), "/supports/0/feed", "rate_ramp"},
        Wrong{SUPPORT(R"("feed": {"value": 1})"), "/supports/0/feed/value", "ramp > 0"},
        Wrong{SUPPORT(R"("feed": {"rate": 1, "ramp": 1, "rate_ramp": 1})"), "/supports/0/feed/rate_ramp", "ramp"},
        Wrong{SUPPORT(R"("feed": {"rate": 1, "rate_ramp": -1})"), "/supports/0/feed/rate_ramp", ">= 0"},
        Wrong{SUPPORT(R"("feed": {"table": [[0, 0], [0, 1]]})"), "/supports/0/feed/table/1/0", "must grow"},
        Wrong{SUPPORT(R"("feed": {"table": [[0, 0]]})"), "/supports/0/feed/table", "two"},
        Wrong{SUPPORT(R"("feed": {"table": [[0, 0], [1, 1]], "rate": 1})"), "/supports/0/feed/table", "stands alone"},
        Wrong{SUPPORT(R"("feed": {"table": [[0, 0], [0.1, -5]]})"), "/supports/0/feed", "draw in less"},
        Wrong{R"({"supports": [{"at": "end", "type": "free", "feed": {"rate": 1, "rate_ramp": 1}}]})",
              "/supports/0/type", "\"pin\""},
        Wrong{SUPPORT(R"("end_stop": {"most": 1, "stiffness": 1, "depth": 1})"), "/supports/0/end_stop", "no winch"},
        Wrong{SUPPORT(R"("feed": {"rate": 1, "rate_ramp": 1}, "end_stop": {"most": 1, "stiffness": 1, "depth": 1})"),
              "/supports/0/end_stop", "\"drum\""},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "end_stop": {"stiffness": 1, "depth": 1})"),
              "/supports/0/end_stop", "one of them"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "end_stop": {"most": -1, "stiffness": 1, "depth": 1})"),
              "/supports/0/end_stop/most", "at least 0"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "end_stop": {"most": 1, "depth": 1})"),
              "/supports/0/end_stop/stiffness", "> 0"},
        Wrong{SUPPORT(R"("drum": {"radius": 1, "inertia": 1}, "end_stop": {"most": 1, "stiffness": 1, "depth": 0})"),
              "/supports/0/end_stop/depth", "> 0"}));
INSTANTIATE_TEST_SUITE_P(
    Joints, WrongRope,
    testing::Values(Wrong{JOINT(R"("pulley": {"radius": 0, "inertia": 1})"), "/sliding_joints/0/pulley/radius", "> 0"},
                    Wrong{JOINT(R"("pulley": {"radius": 1})"), "/sliding_joints/0/pulley/inertia", ">= 0"},
                    Wrong{JOINT(R"("pulley": {"radius": 1, "inertia": 1}, "friction": {"coefficient": 0.1})"),
                          "/sliding_joints/0/friction", "slip"},
                    Wrong{JOINT(R"("friction": {"coefficient": -0.1})"), "/sliding_joints/0/friction/coefficient",
                          ">= 0"},
                    Wrong{JOINT(R"("velocity": 1)"), "/sliding_joints/0/velocity", "at rest"},
                    Wrong{R"({"sliding_joints": [{"position": 9, "support": "pin", "slopes": "free"}]})",
                          "/sliding_joints/0/position", "inside"},
                    Wrong{R"({"sliding_joints": [{"position": 1.4142135623730951, "slopes": "free"}]})",
                          "/sliding_joints/0/mass", "> 0"},
                    Wrong{R"({"sliding_joints": [{"position": 1.4142135623730951, "support": "pin"}]})",
                          "/sliding_joints/0/slopes", "equal-stretch"},
                    Wrong{R"({"sliding_joints": [{"position": 0.7, "support": "slide"}]})", "/sliding_joints/0/support",
                          "\"pin\""}));
INSTANTIATE_TEST_SUITE_P(
    Blocks, WrongRope,
    testing::Values(
        Wrong{BLOCK(FREE_AT("0.5") "," FREE_AT("1"), R"({"joints": [0], "mass": 1})"), "/blocks/0/joints",
              "at least two"},
        Wrong{BLOCK(FREE_AT("0.5") "," FREE_AT("1"), R"({"joints": [0, 2], "mass": 1})"), "/blocks/0/joints/1",
              "0 to 1"},
        Wrong{BLOCK(FREE_AT("0.5") "," FREE_AT("1"), R"({"joints": [0, 0], "mass": 1})"), "/blocks/0/joints/1", "once"},
        Wrong{BLOCK(FREE_AT("0.5") "," FREE_AT("1"), R"({"joints": [0, 1]})"), "/blocks/0/mass", "> 0"},
        Wrong{BLOCK(FREE_AT("0.5") "," FREE_AT("1"), R"({"joints": [0, 1.5], "mass": 1})"), "/blocks/0/joints",
              "whole numbers"},
        Wrong{BLOCK(FREE_AT("0.5") ","
                                   R"({"position": 1, "support": "pin", "slopes": "free"})",
                    R"({"joints": [0, 1], "mass": 1})"),
              "/sliding_joints/1/support", "\"free\""},
        Wrong{BLOCK(FREE_AT("0.5") ","
                                   R"({"mass": 1, "position": 1, "slopes": "free", "friction": {"coefficient": 0.1}})",
                    R"({"joints": [0, 1], "mass": 1})"),
              "/blocks", "neither friction nor a nut"},
        Wrong{R"({"blocks": [{"joints": [0, 1], "mass": 1}]})", "/blocks/0/joints/1", "0 to 0"}));
INSTANTIATE_TEST_SUITE_P(
    Surroundings, WrongRope,
    testing::Values(Wrong{R"({"fluid": {"density": 1000}})", "/fluid/area", "must be given"},
                    Wrong{R"({"fluid": {"density": -1, "area": 1}})", "/fluid/density", ">= 0"},
                    Wrong{R"({"fluid": {"velocity": [1, 0]}})", "/fluid/velocity", "/drag"},
                    Wrong{R"({"ground": {"height": 0}})", "/ground/stiffness", "> 0"},
                    Wrong{R"({"ground": {"stiffness": 1e4, "damping": -1}})", "/ground/damping", ">= 0"},
                    Wrong{R"({"ground": {"stiffness": 1e4}, "gravity": [0, 0]})", "/ground", "gravity"},
                    Wrong{R"({"point_masses": [{"node": 11, "mass": 1}]})", "/point_masses/0/node", "10"},
                    Wrong{R"({"point_masses": [{"node": 10, "mass": 0}]})", "/point_masses/0/mass", "> 0"}));

}  // namespace
}  // namespace vlbeam
