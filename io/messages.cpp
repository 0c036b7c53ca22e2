#include "io/messages.hpp"

#include <array>
#include <cstdio>
#include <new>
#include <sstream>

namespace vlbeam {

std::string printable(std::string_view text, Lines lines) {
  std::string shown;
  const auto escape = [&shown](unsigned code) {
    std::array<char, 8> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "\\u%04x", code);
    shown += buffer.data();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (byte == '\n' && lines == Lines::several) {
      shown += '\n';
    } else if (byte < 0x20 || byte == 0x7f) {
      escape(byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // U+0080 to U+009F
      escape(next);
      ++i;
    } else {
      shown += text[i];
    }
  }
  return shown;
}

std::string explained(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) == nullptr) return error.what();
  return "out of memory: take fewer elements, samples (/output/interval), shapes (/output/configurations) or runs at a "
         "time (--jobs), or more memory";
}

std::string digits(double value, int count) {
  std::ostringstream text;
  text.precision(count);
  text << value;
  return text.str();
}

}  // namespace vlbeam
