#pragma once

#include <sstream>
#include <string>

namespace vlbeam {

/// A number as a message writes it: four digits.
inline std::string brief(double value) {
  std::ostringstream stream;
  stream.precision(4);
  stream << value;
  return stream.str();
}

}  // namespace vlbeam
