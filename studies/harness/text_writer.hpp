#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "studies/harness/files.hpp"

namespace vlbeam {

/// Collects a text, and hands it on to its sink whenever there is enough of it.
class TextWriter {
 public:
  explicit TextWriter(const TextSink& sink) : sink_(sink) { text_.reserve(2 * enough); }
  ~TextWriter() = default;
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > enough) flush();
    return *this;
  }
  /// As short as it can be without losing a digit.
  TextWriter& operator<<(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }
  /// Call it at the end.
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t enough = 1 << 16;

  const TextSink& sink_;
  std::string text_;
};

}  // namespace vlbeam
