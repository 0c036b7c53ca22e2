#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace vlbeam {

/// What is known beforehand of how equations change with time. They have corners, where a derivative of theirs may
/// jump, and between these quantities that change in a given time. A method that controls its error sees neither: what
/// happens within one step of a beam at rest happens to nobody.
class Timetable {
 public:
  /// A stretch of time in which something changes smoothly. There are corners at both its ends.
  struct Stretch {
    double from = 0, to = never;  ///< [s]
    double longest = never;       ///< [s], of the steps in it
  };
  static constexpr double never = std::numeric_limits<double>::infinity();

  Timetable() = default;
  explicit Timetable(const std::vector<Stretch>& stretches);

  bool empty() const { return pieces_.empty(); }

  struct Step {
    double length;                      ///< [s]
    std::optional<double> corner = {};  ///< [s], at which it ends: the equations are those before it all the way
    double longest = never;             ///< [s], of steps there
  };
  /// The next step from t, of at most `dt`. It ends at a corner rather than just before one, and before the corner that
  /// is next it is no longer than the stretches in which it is allow.
  Step step(double t, double dt) const;

 private:
  struct Piece {
    double from, longest;
  };

  std::vector<Piece> pieces_;  ///< from one corner to the next, in order
};

}  // namespace vlbeam
