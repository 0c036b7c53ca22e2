#pragma once

#include <string>
#include <string_view>

#include "scene/options.hpp"

namespace vlbeam {

/// How the tables of a scene's options write their lines: by what a visitor is told of each.
template <class Visitor, class SceneT>
struct OptionLines {
  Visitor& visitor;
  SceneT& scene;

  static constexpr std::string_view paper = "Ding & Ouyang 2022";
  static constexpr std::string_view example1 = "Ding & Ouyang 2022, §6.1";
  static constexpr std::string_view analysis = "/analysis";
  static constexpr std::string_view initial_shape = "/initial_shape";

  bool in_time() const { return scene.analysis == Analysis::dynamics; }
  Condition of_analysis(Analysis which) const { return only_if(analysis, scene.analysis, which); }
  /// There is no such option in statics, where there is no time.
  Option in_motion(Option line = {}) const {
    if (!in_time()) line.when = of_analysis(Analysis::dynamics);
    return line;
  }

  /// An option by what all have; `line` says the rest.
  static Option named(Option line, std::string_view pointer, std::string_view description) {
    line.pointer = pointer;
    line.description = description;
    return line;
  }
  /// One or several numbers with a range.
  template <class Member>
  void number(std::string_view pointer, std::string_view unit, const Range& range, std::string_view description,
              Member& member, Option line = {}) {
    line.unit = unit;
    line.range = range;
    visitor(named(line, pointer, description), member);
  }
  /// One or several points or directions, with as many components as the scene has dimensions unless `line` has some.
  template <class Member>
  void vector(std::string_view pointer, std::string_view unit, std::string_view description, Member& member,
              Option line = {}) {
    line.unit = unit;
    if (line.components == 0) line.components = scene.dimension;
    visitor(named(line, pointer, description), member);
  }
  /// A name, true or false, or a text.
  template <class Member>
  void choice(std::string_view pointer, std::string_view description, Member& member, const Option& line = {}) {
    visitor(named(line, pointer, description), member);
  }
  void section(std::string_view pointer, std::string_view description, const Option& line = {}) {
    visitor.section(named(line, pointer, description));
  }
  template <class Part>
  bool present(std::string_view pointer, std::string_view description, Part& part) {
    return visitor.present(named({}, pointer, description), part);
  }
  template <class List>
  void list(std::string_view pointer, std::string_view description, List& entries) {
    visitor.list(named({}, pointer, description), entries);
  }
  /// The coefficients of a drag below the pointer `at`.
  template <class Drag>
  void drag_at(const std::string& at, Drag& drag) {
    section(at + "/linear", "in proportion to the velocity");
    section(at + "/quadratic", "in proportion to the square of the velocity");
    const auto coefficient = [&](const std::string& pointer, std::string_view unit, std::string_view description,
                                 auto& member) { number(pointer, unit, Range::non_negative(), description, member); };
    coefficient(at + "/linear/normal", "N s/m^2", "of the velocity across the axis", drag.linear.normal);
    coefficient(at + "/linear/tangential", "N s/m^2", "of the velocity along the axis", drag.linear.tangential);
    coefficient(at + "/quadratic/normal", "N s^2/m^3",
                "of the velocity across the axis: half the density of the air "
                "times the coefficient of drag and the width",
                drag.quadratic.normal);
    coefficient(at + "/quadratic/tangential", "N s^2/m^3", "of the velocity along the axis", drag.quadratic.tangential);
  }
  /// A function of time: value, rate, ... below the pointer `at`.
  template <class Function>
  void time_function(const std::string& at, const std::string& unit, Function& f, const Condition& when = {}) {
    const auto part = [&](const char* key, const std::string& part_unit, const char* description, const Range& range,
                          auto& member) {
      number(at + "/" + key, part_unit, range, description, member, {.when = when});
    };
    section(at, "a function of time, S(t/ramp) (value + rate t + acceleration t^2/2 + oscillation), or a table");
    part("value", unit, "of a function of time: its constant part", {}, f.value);
    part("rate", unit + "/s", "its part that grows evenly", {}, f.rate);
    part("acceleration", unit + "/s^2", "its part that grows with t^2/2", {}, f.acceleration);
    part("amplitude", unit, "of its part that oscillates", {}, f.amplitude);
    part("frequency", "Hz", "of its part that oscillates", {}, f.frequency);
    part("phase_degrees", "degrees", "of its part that oscillates, a sine", {}, f.phase_degrees);
    part("ramp", "s",
         "time over which all of it grows smoothly from 0; 0 is at once. A rate runs up to 1.9 times as fast meanwhile",
         Range::non_negative(), f.ramp);
    part("rate_ramp", "s", "time over which its rate alone grows smoothly from 0 and never beyond; 0 is at once",
         Range::non_negative(), f.rate_ramp);
    part("until", "s", "time from which on it goes on evenly, at the rate it has then; if not given it never does",
         Range::non_negative(), f.until);
    vector(
        at + "/table", "s, " + unit,
        "pairs of a time and a value, in order of time, in place of all the others: a smooth curve through them that "
        "rises and falls where they do, and rests before the first and after the last",
        f.table, {.components = 2, .when = when});
    choice(at + "/smooth",
           "of a table: true is a spline, whose acceleration does not jump and which may swing a little beyond the "
           "values; false rises and falls where they do. Both rest where two neighbouring values are the same; if not "
           "given, true for motions of supports, rings and sleeves, and false for all else",
           f.smooth, {.when = when});
    if constexpr (requires { visitor.time_function(at, f); }) visitor.time_function(at, f);
  }
};

}  // namespace vlbeam
