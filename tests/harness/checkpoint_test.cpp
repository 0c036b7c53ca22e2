// A run that goes on from a checkpoint has the digits of one that was never stopped.
#include "io/checkpoint_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "io/scene_json.hpp"
#include "scene/simulate.hpp"
#include "tests/harness/report_of.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

using ::testing::HasSubstr;

/// A scene with length-control events, output at times that no step ends at, and shapes kept.
Json falling(int elements = 6) {
  Json scene = parse_json(R"({
    "schema": "vlbeam.scene/1", "beam": {"elements": 6, "element": "ALE-ANCF"},
    "supports": [{"at": "start", "type": "clamp", "clamp": "direction"}],
    "sliding_mass": {"mass": 0.8, "position": 0.1}, "duration": 0.45,
    "output": {"interval": 0.0137, "configurations": [0.1, 0.3]}})");
  scene["beam"]["elements"] = elements;
  return scene;
}

struct Case {
  std::string name;
  std::function<void(Json&)> change;
};
void PrintTo(const Case& value, std::ostream* out) { *out << value.name; }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* type : {"dopri5", "cash-karp", "fehlberg78", "bulirsch-stoer"}) {
    all.push_back({type, [type](Json& scene) { scene["integrator"] = {{"type", type}, {"rtol", 1e-6}}; }});
  }
  all.push_back({"rosenbrock4", [](Json& scene) {
                   scene["beam"]["elements"] = 5;
                   scene["integrator"] = {{"type", "rosenbrock4"}, {"rtol", 1e-4}};
                 }});
  all.push_back({"adams-bashforth-moulton", [](Json& scene) {
                   scene["integrator"] = {{"type", "adams-bashforth-moulton"}, {"step", 5e-5}};
                 }});
  const auto alpha = [](Json& scene) { scene["integrator"] = {{"type", "generalized-alpha"}, {"step", 1e-3}}; };
  all.push_back({"modified Newton", alpha});
  all.push_back({"full Newton", [alpha](Json& scene) {
                   alpha(scene);
                   scene["integrator"]["newton"] = "full";
                 }});
  all.push_back({"adaptive", [alpha](Json& scene) {
                   alpha(scene);
                   scene["integrator"].update({{"adaptive", true}, {"rtol", 1e-4}, {"atol", 1e-4}});
                 }});
  all.push_back({"automatic", [](Json& scene) { scene["integrator"] = {{"accuracy", 1e-3}}; }});
  all.push_back({"multipliers, kinked in space", [alpha](Json& scene) {
                   alpha(scene);
                   scene.update({{"dimension", 3}, {"constraints", "multipliers"}, {"gravity", {0.5, -9.81, 2}}});
                   scene["beam"]["curve"] = {{"type", "line"}, {"start", {0, 0, 0}}, {"end", {1, 0, 0}}};
                   scene["sliding_mass"]["slopes"] = "tangent";
                 }});
  all.push_back({"energy-momentum", [](Json& scene) {
                   scene["integrator"] = {{"type", "energy-momentum"}, {"step", 1e-3}};
                 }});
  all.push_back({"gravity that grows", [alpha](Json& scene) {
                   alpha(scene);
                   scene["gravity_ramp"] = 0.3;
                   scene["sliding_mass"]["velocity"] = 0.7;
                   scene["length_control"] = {{"velocities", "projected"}};
                 }});
  all.push_back({"friction and damping", [](Json& scene) {
                   scene["integrator"] = {{"type", "dopri5"}, {"rtol", 1e-6}};
                   scene["sliding_mass"]["friction"] = {{"coefficient", 0.1}, {"velocity", 0.01}};
                   scene["beam"]["material"] = {{"damping", 1e-4}};
                 }});
  all.push_back({"a mass that leaves", [alpha](Json& scene) {
                   alpha(scene);
                   scene["sliding_mass"].update({{"position", 0.8}, {"velocity", 1.5}});
                 }});
  all.push_back({"from an equilibrium", [alpha](Json& scene) {
                   alpha(scene);
                   scene["initial_shape"] = "equilibrium";
                   scene["sliding_mass"]["velocity"] = 0.7;
                 }});
  all.push_back({"two masses", [alpha](Json& scene) {
                   alpha(scene);
                   scene.erase("sliding_mass");
                   scene["beam"]["elements"] = 8;
                   scene["sliding_joints"] = {{{"mass", 0.8}, {"position", 0.3}}, {{"mass", 0.5}, {"position", 0.7}}};
                 }});
  const auto piled = [](Json& scene) {  // the first one rests against a support, and then the second one against it
    scene.erase("sliding_mass");
    scene["beam"].update({{"elements", 8}, {"material", {{"density", 1200}, {"youngs_modulus", 5e6}}}});
    scene["supports"] = {{{"at", "start"}, {"type", "pin"}}, {{"at", "end"}, {"type", "pin"}}};
    scene["sliding_joints"] = {{{"mass", 0.8}, {"position", 0.2}, {"velocity", -2}, {"at_support", "rest"}},
                               {{"mass", 0.5}, {"position", 0.5}, {"velocity", -2}}};
    scene["contact"] = {{"joints", "rest"}};
  };
  all.push_back({"masses that rest", [alpha, piled](Json& scene) {
                   alpha(scene);
                   piled(scene);
                 }});
  all.push_back({"masses that rest, explicit", [piled](Json& scene) {
                   scene["integrator"] = {{"type", "dopri5"}, {"rtol", 1e-6}};
                   piled(scene);
                 }});
  all.push_back({"a nut on a screw", [](Json& scene) {
                   scene.erase("sliding_mass");
                   scene["integrator"] = {{"type", "dopri5"}, {"rtol", 1e-6}};
                   scene["sliding_joints"] = {{{"mass", 0.8}, {"position", 0.3}, {"pitch", 0.5}}};
                   scene["spin"] = {{"angles", "hermite"}, {"rate", -10}};
                 }});
  all.push_back(
      {"a clamp that turns", [alpha](Json& scene) {
         alpha(scene);
         scene["supports"][0].update(
             {{"clamp", "full"}, {"motion", {{"angle", {{"amplitude", 0.2}, {"frequency", 2}, {"ramp", 0.1}}}}}});
       }});
  return all;
}

class Continued : public ::testing::TestWithParam<Case> {};

TEST_P(Continued, ChangeNoDigit) {
  Json json = falling();
  GetParam().change(json);
  const Scene scene = scene_from_json(json);
  const RunResult whole = simulate(scene);
  ASSERT_EQ(whole.failure, "");
  ASSERT_FALSE(whole.events.empty());
  const Json expected = report_of(scene, whole);

  std::vector<Checkpoint> kept;
  Checkpoints checkpoints;
  checkpoints.every = 0.06;
  checkpoints.keep = [&](const Checkpoint& one) { kept.push_back(one); };
  EXPECT_EQ(Json::diff(report_of(scene, simulate(scene, {}, &checkpoints)), expected), Json::array());
  ASSERT_GE(kept.size(), 7U);
  const Checkpoint last = kept.back();
  for (const std::size_t i : {std::size_t{0}, kept.size() / 2, kept.size() - 2}) {
    SCOPED_TRACE(kept[i].t);
    const Checkpoint from = kept[i];
    checkpoints.from = from;
    EXPECT_EQ(Json::diff(report_of(scene, simulate(scene, {}, &checkpoints)), expected), Json::array());
    // and leaves the same checkpoints
    EXPECT_EQ(kept.back().t, last.t);
    EXPECT_EQ(kept.back().y, last.y);
    EXPECT_EQ(kept.back().method, last.method);
    EXPECT_EQ(kept.back().past.size(), last.past.size());
  }
}

// A checkpoint at the end of a step that an event ends: the next step has not started yet.
TEST(Checkpoint, BehindAnEventChangesNoDigit) {
  Json json = falling();
  json["integrator"] = {{"accuracy", 1e-3}};
  const Scene scene = scene_from_json(json);
  const RunResult whole = simulate(scene);
  ASSERT_GE(whole.events.size(), 2U);
  std::vector<Checkpoint> kept;
  Checkpoints checkpoints;
  checkpoints.every = whole.events[1].t - 1e-8;
  checkpoints.keep = [&](const Checkpoint& one) { kept.push_back(one); };
  simulate(scene, {}, &checkpoints);
  ASSERT_FALSE(kept.empty());
  ASSERT_EQ(kept.front().t, whole.events[1].t);
  checkpoints.from = kept.front();
  checkpoints.keep = {};
  EXPECT_EQ(Json::diff(report_of(scene, simulate(scene, {}, &checkpoints)), report_of(scene, whole)), Json::array());
}

INSTANTIATE_TEST_SUITE_P(All, Continued, ::testing::ValuesIn(cases()));

TEST(Checkpoint, IsLeftWhereARunIsStopped) {
  Json json = falling();
  json["integrator"] = {{"type", "generalized-alpha"}, {"step", 1e-3}};
  const Scene scene = scene_from_json(json);
  Checkpoints checkpoints;
  checkpoints.keep = [&](const Checkpoint& one) { checkpoints.from = one; };
  const RunResult stopped = simulate(
      scene, [](double t) { return t < 0.2; }, &checkpoints);
  ASSERT_EQ(stopped.status, RunStatus::interrupted);
  ASSERT_TRUE(checkpoints.from);
  EXPECT_NEAR(checkpoints.from->t, 0.2, 2e-3);
  const Json expected = report_of(scene, simulate(scene));
  EXPECT_EQ(Json::diff(report_of(scene, simulate(scene, {}, &checkpoints)), expected), Json::array());
}

TEST(Checkpoint, IsRefusedInStaticsAndWhereItDoesNotFit) {
  const Scene scene = scene_from_json(falling()), other = scene_from_json(falling(7));
  Checkpoints checkpoints;
  checkpoints.every = 0.1;
  checkpoints.keep = [&](const Checkpoint& one) { checkpoints.from = one; };
  simulate(
      scene, [](double t) { return t < 0.2; }, &checkpoints);
  ASSERT_TRUE(checkpoints.from);
  EXPECT_THROW(simulate(other, {}, &checkpoints), InvalidInput);
  checkpoints.from->method.pop_back();
  EXPECT_THROW(simulate(scene, {}, &checkpoints), InvalidInput);

  Json json = falling();
  json.erase("duration");
  json.erase("sliding_mass");
  json.erase("output");
  json["analysis"] = "statics";
  EXPECT_THROW(simulate(scene_from_json(json), {}, &checkpoints), InvalidInput);
}

class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile() {
    json_["integrator"] = {{"type", "generalized-alpha"}, {"step", 1e-3}};
    scene_ = scene_from_json(json_);
    Checkpoints checkpoints;
    checkpoints.every = 0.1;
    checkpoints.keep = [&](const Checkpoint& one) { kept_ = one; };
    simulate(
        scene_, [](double t) { return t < 0.25; }, &checkpoints);
    write_checkpoint(file_, scene_, kept_);
    text_ = read_text(file_);
  }
  std::string refusal(const Scene& scene) const {
    try {
      read_checkpoint(file_, scene);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "none";
  }
  std::string refusal_of(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    return refusal(scene_);
  }

  Json json_ = falling();
  Scene scene_;
  Checkpoint kept_;
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "run.checkpoint";
  std::string text_;
};

TEST_F(CheckpointFile, HoldsItAll) {
  const Checkpoint read = read_checkpoint(file_, scene_);
  EXPECT_EQ(read.t, kept_.t);
  EXPECT_EQ(read.y, kept_.y);
  EXPECT_EQ(read.system, kept_.system);
  EXPECT_EQ(read.method, kept_.method);
  ASSERT_EQ(read.past.size(), kept_.past.size());
  for (std::size_t i = 0; i < read.past.size(); ++i) {
    EXPECT_EQ(read.past[i].guard, kept_.past[i].guard);
    EXPECT_EQ(read.past[i].t, kept_.past[i].t);
    EXPECT_EQ(read.past[i].y, kept_.past[i].y);
    EXPECT_EQ(read.past[i].system, kept_.past[i].system);
  }
}

TEST_F(CheckpointFile, OfAnotherSceneIsRefused) {
  json_["beam"]["elements"] = 7;
  EXPECT_THAT(refusal(scene_from_json(json_)), HasSubstr("another scene is not allowed; it differs at /beam/elements"));
}

TEST_F(CheckpointFile, ThatIsTruncatedOrDamagedOrNoneIsRefused) {
  for (const std::size_t size : {text_.size() - 1, text_.size() / 2, std::size_t{22}, std::size_t{20}}) {
    EXPECT_THAT(refusal_of(text_.substr(0, size)), HasSubstr("truncated or damaged")) << size;
  }
  std::string damaged = text_;
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_THAT(refusal_of(damaged), HasSubstr("truncated or damaged"));
  for (const char* text : {"", "vlbeam", "{\"schema\": \"vlbeam.scene/1\"}"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("it must be a checkpoint")) << text;
  }
}

TEST_F(CheckpointFile, OfAnotherBuildIsRefused) {
  std::string other = text_.substr(0, text_.size() - 4);
  const std::size_t at = other.find("vlbeam", 20);  // behind the head: the name of the program
  ASSERT_NE(at, std::string::npos);
  other[at] = 'V';
  boost::crc_32_type crc;
  crc.process_bytes(other.data(), other.size());
  for (int byte = 0; byte < 4; ++byte) other.push_back(static_cast<char>(crc.checksum() >> (8 * byte) & 0xff));
  EXPECT_THAT(refusal_of(other), HasSubstr("another build"));
}

}  // namespace
}  // namespace vlbeam
