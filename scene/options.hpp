#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/names.hpp"
#include "scene/scene.hpp"

/// The one table of everything a scene may say. Reading a scene, checking it, echoing it into a report, its JSON
/// Schema and its documentation are all visitors of this table: a new option is one new line in scene_options.hpp.
namespace vlbeam {

/// A number as short as it can be written without losing a digit.
inline std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// The finite numbers an option may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< `low` itself is excluded
  bool high_open = false;  ///< `high` itself is excluded

  static constexpr Range positive() { return {.low = 0, .low_open = true}; }
  static constexpr Range non_negative() { return {.low = 0}; }
  static constexpr Range closed(double low, double high) { return {.low = low, .high = high}; }

  bool contains(double x) const {
    return std::isfinite(x) && (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
  }

  /// " > 0", " in [2, 3]", or nothing where every finite number will do.
  std::string text() const {
    const bool bounded_below = std::isfinite(low);
    const bool bounded_above = std::isfinite(high);
    if (bounded_below && bounded_above) {
      return std::string(" in ") + (low_open ? "(" : "[") + number_text(low) + ", " + number_text(high) +
             (high_open ? ")" : "]");
    }
    if (bounded_below) return (low_open ? " > " : " >= ") + number_text(low);
    if (bounded_above) return (high_open ? " < " : " <= ") + number_text(high);
    return "";
  }
};

/// An option that means something only while another option has one of certain values.
struct Condition {
  std::string_view pointer = {};              ///< the other option; empty: no condition
  std::vector<std::string_view> values = {};  ///< the names it may have
  bool holds = true;                          ///< whether it has one, in the scene being visited, or `or_else` holds
  std::vector<Condition> or_else = {};        ///< others, one of which is enough

  /// "a", or "a" or "b".
  std::string text() const {
    std::string text;
    for (const auto value : values) text += (text.empty() ? "\"" : " or \"") + std::string(value) + "\"";
    return text;
  }
};

template <NamedEnum E, std::same_as<E>... Es>
Condition only_if(std::string_view pointer, E is, Es... one_of) {
  return {.pointer = pointer, .values = {to_string(one_of)...}, .holds = ((is == one_of) || ...)};
}

inline Condition either(Condition one, const Condition& other) {
  one.holds = one.holds || other.holds;
  one.or_else.push_back(other);
  return one;
}

/// One line of the table. `pointer` is a JSON pointer; a segment `at=start` stands for that entry of a list whose key
/// `at` is "start".
struct Option {
  std::string_view pointer = {};
  std::string_view unit = "";  ///< SI; "-" for a pure number, empty for what is no number
  std::string_view description = "";
  std::string_view source = "";  ///< where the option comes from
  Range range = {};
  int components = 0;  ///< length of a Point as written: the scene's dimension
  Condition when = {};
  bool required = false;           ///< where its parent is given
  std::string_view instead = "";   ///< keys beside it, with one of which it is not required; spaces between them
  std::string_view without = "";   ///< of the names there are one that means nothing here
  std::string_view standard = "";  ///< the name that is the default, where it is not that of the scene at hand

  bool allows(std::string_view name) const { return name != without; }
};

/// An option that takes a choice of names, or is left out.
template <class T>
concept OptionalEnum = requires {
  typename T::value_type;
}
&&NamedEnum<typename T::value_type>&& std::same_as<T, std::optional<typename T::value_type>>;

/// An option that takes a number, a point of them, or true or false, or is left out.
template <class T>
concept OptionalNumber = std::same_as<T, std::optional<double>> || std::same_as<T, std::optional<int>> ||
    std::same_as<T, std::optional<Point>> || std::same_as<T, std::optional<bool>>;

/// What an option may be, in words: "a number > 0 [m]".
template <class T>
std::string allowed_text(const Option& option) {
  const std::string unit = option.unit.empty() ? "" : " [" + std::string(option.unit) + "]";
  if constexpr (NamedEnum<T>) {
    std::string text;
    for (const auto& entry : names(T{})) {
      if (option.allows(entry.name)) text += (text.empty() ? "\"" : ", \"") + std::string(entry.name) + "\"";
    }
    return (names(T{}).size() > 1 ? "one of " : "") + text;
  } else if constexpr (OptionalEnum<T> || OptionalNumber<T>) {
    return allowed_text<typename T::value_type>(option);
  } else if constexpr (std::same_as<T, bool>) {
    return "true or false";
  } else if constexpr (std::same_as<T, std::string>) {
    return "a string";
  } else if constexpr (std::same_as<T, int>) {
    return "a whole number" + option.range.text();
  } else if constexpr (std::same_as<T, Point>) {
    return "an array of " + std::to_string(option.components) + " numbers" + unit;
  } else if constexpr (std::same_as<T, std::array<double, 4>>) {
    return "an array of 4 numbers" + option.range.text() + unit;
  } else if constexpr (std::same_as<T, std::vector<int>>) {
    return "an array of whole numbers" + option.range.text();
  } else if constexpr (std::same_as<T, std::vector<double>>) {
    return "an array of numbers" + option.range.text() + unit;
  } else if constexpr (std::same_as<T, std::vector<Point>>) {
    return "an array of arrays of " + std::to_string(option.components) + " numbers" + unit;
  } else {
    static_assert(std::same_as<T, double>);
    return "a number" + option.range.text() + unit;
  }
}

/// A choice with a single value so far; it keeps the place of the ones to come.
enum class SceneSchema { v1 };
constexpr auto names(SceneSchema) { return std::to_array<Named<SceneSchema>>({{SceneSchema::v1, "vlbeam.scene/1"}}); }

}  // namespace vlbeam
