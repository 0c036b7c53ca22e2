#pragma once

#include <string>
#include <string_view>

#include "io/files.hpp"
#include "scene/options.hpp"

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
  TextWriter& operator<<(double value) { return *this << number_text(value); }
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
