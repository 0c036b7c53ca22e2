#include "studies/harness/json.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "core/error.hpp"

namespace vlbeam {
namespace {

/// nlohmann::json keeps the last of two equal keys silently; this notices them while parsing.
class DuplicateKeys {
 public:
  bool operator()(int, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) {
      open_.emplace_back();
    } else if (event == Event::object_end) {
      open_.pop_back();
    } else if (event == Event::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!open_.back().insert(key).second) throw InvalidInput("/" + key, "a second key of this name", "keep one");
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

bool is_leaf_row(const Json& value) {
  return value.is_array() && std::ranges::all_of(value, [](const Json& item) {
           return item.is_primitive() ||
                  (item.is_array() && std::ranges::all_of(item, [](const Json& x) { return x.is_primitive(); }));
         });
}

void write(const Json& value, std::size_t depth, std::string& out) {
  if (value.is_structured() && !value.empty() && !is_leaf_row(value)) {
    const bool object = value.is_object();
    out += object ? "{" : "[";
    bool first = true;
    for (const auto& item : value.items()) {
      out += first ? "\n" : ",\n";
      first = false;
      out.append(2 * (depth + 1), ' ');
      if (object) out += Json(item.key()).dump() + ": ";
      write(item.value(), depth + 1, out);
    }
    out += "\n";
    out.append(2 * depth, ' ');
    out += object ? "}" : "]";
  } else {
    out += value.dump();
  }
}

}  // namespace

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text, DuplicateKeys{});
  } catch (const Json::exception& error) {
    throw InvalidInput("the text", "what is not JSON", error.what());
  }
}

std::string excerpt(const Json& value) {
  constexpr std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

std::string pretty(const Json& value) {
  std::string out;
  write(value, 0, out);
  out += '\n';
  return out;
}

}  // namespace vlbeam
