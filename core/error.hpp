#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace vlbeam {

/// A number in a message.
inline std::string in_digits(double value, int digits) {
  std::ostringstream stream;
  stream.precision(digits);
  stream << (value == 0 ? 0.0 : value);  // not -0
  return stream.str();
}
inline std::string six_digits(double value) { return in_digits(value, 6); }

/// What the user asked for cannot be understood or cannot be modelled. Programs answer with exit code 2.
class InvalidInput : public std::runtime_error {
 public:
  /// `field` is a JSON pointer into the scene ("/sliding_mass/position"), `value` what stands there,
  /// `allowed` what may stand there.
  InvalidInput(std::string field_, std::string value_, std::string allowed_)
      : std::runtime_error(field_ + ": " + (value_ == missing ? "is missing; " : value_ + " is not allowed; ") +
                           allowed_),
        field(std::move(field_)),
        value(std::move(value_)),
        allowed(std::move(allowed_)) {}

  static constexpr const char* missing = "a missing key";  ///< `value` of what should be there and is not

  std::string field;
  std::string value;
  std::string allowed;
};

/// The same, found by a room below scene/: `field` is what of the model is not allowed, in words ("drives", "radius").
/// core/scene says where that stands in a scene.
class ModelError : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

[[noreturn]] inline void refuse(std::string field, std::string value, std::string allowed) {
  throw InvalidInput(std::move(field), std::move(value), std::move(allowed));
}

/// The computation broke down at time `t` [s]: tangled mesh, step underflow, degenerate curve, event cascade.
/// Programs answer with exit code 3 and keep what was computed until then.
class ComputationFailed : public std::runtime_error {
 public:
  ComputationFailed(const std::string& what, double t_) : std::runtime_error(what), t(t_) {}

  double t;
};

}  // namespace vlbeam
