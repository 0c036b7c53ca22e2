#include "io/json.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "io/files.hpp"

namespace vlbeam {
namespace {

constexpr std::size_t deepest = 100;

/// Line and column, from 1, of a byte of a text.
std::string place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::string_view of_line = before.substr(before.rfind('\n') + 1);
  const auto column = 1 + std::ranges::count_if(of_line, [](char c) { return (c & 0xc0) != 0x80; });  // not bytes
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// What is wrong with a text, out of the parser's message: "... parse error at line 1, column 2: syntax error while
/// parsing value - invalid literal; last read: 'N'".
std::string reason_of(const std::string& message) {
  if (message.find("out_of_range") != std::string::npos) return "it must be within the range of numbers, +-1.8e308";
  const auto dash = message.find(" - ");
  std::string reason = dash == std::string::npos ? message : message.substr(dash + 3);
  if (const auto last = reason.find("; last read: "); last != std::string::npos) {
    const auto next = reason.find(';', last + 1);
    reason.erase(last, (next == std::string::npos ? reason.size() : next) - last);
  }
  return "it is no JSON: " + reason;
}

/// Builds a value while it is parsed. Refuses two equal keys in one object, of which a parser would keep the last, and
/// nesting that no file of ours has and that recursive functions could not take.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(std::string_view text) : text_(text) {}

  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
  bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (!open_.back().keys.insert(name).second) {
      throw InvalidInput(pointer() + "/" + escaped(name), "a second key of this name", "keep one");
    }
    open_.back().key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    if (position > text_.size() || position == 0) {
      throw InvalidInput(place_of(text_, text_.size()), "the end of the text", reason_of(error.what()));
    }
    // The parser's token is what it read last; only of strings and numbers it is sure to have begun there.
    const bool whole = token.size() > 1 && (token.front() == '"') == (token.back() == '"') &&
                       token.size() <= position && token.find_first_of(" \n:,") == std::string::npos;
    const std::size_t start = position - (whole ? token.size() : 1);
    constexpr const char* of_words = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.";
    const std::size_t end = std::max(position, std::min(text_.find_first_not_of(of_words, start), text_.size()));
    const std::string_view found = text_.substr(start, end - start);
    throw InvalidInput(place_of(text_, start), found.front() == '"' ? std::string(found) : excerpt(std::string(found)),
                       reason_of(error.what()));
  }

 private:
  struct Open {
    Json* value;
    std::string key = {};
    std::set<std::string> keys = {};
  };

  /// Where the parser is, as a JSON pointer.
  std::string pointer() const {
    std::string path;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) path += "/" + segment(open_[i]);
    return path;
  }
  static std::string segment(const Open& open) {
    return open.value->is_array() ? std::to_string(open.value->size() - 1) : escaped(open.key);
  }

  Json* place(Json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    Json& parent = *open_.back().value;
    if (parent.is_array()) return &parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
    return &parent.get_ref<Json::object_t&>().emplace_back(open_.back().key, std::move(value)).second;
  }
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json empty) {
    if (open_.size() == deepest) {
      throw InvalidInput(open_.front().value->is_array() ? "/0/..." : "/" + escaped(open_.front().key) + "/...",
                         "arrays and objects nested more than " + std::to_string(deepest) + " deep",
                         "no file here is deeper than ten");
    }
    Json* const value = place(std::move(empty));
    if (value->is_object()) value->get_ref<Json::object_t&>().reserve(few_keys);  // as it grows it copies what it holds
    open_.push_back({value});
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  static constexpr std::size_t few_keys = 8;

  std::string_view text_;
  Json root_;
  std::vector<Open> open_;
};

bool is_leaf_row(const Json& value) {
  return value.is_array() && std::ranges::all_of(value, [](const Json& item) {
           return item.is_primitive() ||
                  (item.is_array() && std::ranges::all_of(item, [](const Json& x) { return x.is_primitive(); }));
         });
}

constexpr std::size_t longest_excerpt = 60;

/// Appends the compact text of a value, as far as an excerpt needs it.
void append_excerpt(const Json& value, std::string& text) {
  if (!value.is_structured()) {
    const bool long_text = value.is_string() && value.get_ref<const std::string&>().size() > longest_excerpt;
    text += (long_text ? Json(value.get_ref<const std::string&>().substr(0, longest_excerpt + 1)) : value)
                .dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  text += value.is_object() ? '{' : '[';
  bool first = true;
  for (const auto& item : value.items()) {
    if (text.size() > longest_excerpt) return;
    if (!first) text += ',';
    first = false;
    if (value.is_object()) {
      append_excerpt(Json(item.key()), text);
      text += ':';
    }
    append_excerpt(item.value(), text);
  }
  text += value.is_object() ? '}' : ']';
}

}  // namespace

Json parse_json(std::string_view text) {
  Builder builder(text);
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string escaped(std::string key) {
  const auto replace_all = [&key](char from, std::string_view to) {
    for (std::size_t at = key.find(from); at != std::string::npos; at = key.find(from, at + to.size())) {
      key.replace(at, 1, to);
    }
  };
  replace_all('~', "~0");
  replace_all('/', "~1");
  return key;
}

Json read_json(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return naming_file(file, [&] { return parse_json(text); });
}

std::string excerpt(const Json& value) {
  std::string text;
  append_excerpt(value, text);
  if (text.size() <= longest_excerpt) return text;
  std::size_t end = longest_excerpt;
  while ((text[end] & 0xc0) == 0x80) --end;  // not within a letter
  return text.substr(0, end) + "...";
}

void append_pretty(const Json& value, std::size_t depth, std::string& text) {
  if (value.is_structured() && !value.empty() && !is_leaf_row(value)) {
    const bool object = value.is_object();
    text += object ? "{" : "[";
    bool first = true;
    for (const auto& item : value.items()) {
      text += first ? "\n" : ",\n";
      first = false;
      text.append(2 * (depth + 1), ' ');
      if (object) text += Json(item.key()).dump() + ": ";
      append_pretty(item.value(), depth + 1, text);
    }
    text += "\n";
    text.append(2 * depth, ' ');
    text += object ? "}" : "]";
  } else {
    text += value.dump();
  }
}

std::string pretty(const Json& value) {
  std::string text;
  append_pretty(value, 0, text);
  text += '\n';
  return text;
}

}  // namespace vlbeam
