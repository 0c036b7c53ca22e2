#include "studies/harness/claims.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/files.hpp"

namespace vlbeam {
namespace {

constexpr double recorded_to = 1e-3;  // of the value: four digits are kept

bool digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Length of the number that begins here, 0 if none does.
std::size_t number_length(const std::string& text, std::size_t at) {
  std::size_t i = at;
  if (i < text.size() && text[i] == '-') ++i;
  const std::size_t digits = i;
  while (i < text.size() && digit(text[i])) ++i;
  if (i == digits) return 0;
  if (i + 1 < text.size() && text[i] == '.' && digit(text[i + 1])) {
    ++i;
    while (i < text.size() && digit(text[i])) ++i;
  }
  if (i < text.size() && text[i] == 'e') {
    std::size_t j = i + 1;
    if (j < text.size() && (text[j] == '-' || text[j] == '+')) ++j;
    const std::size_t exponent = j;
    while (j < text.size() && digit(text[j])) ++j;
    if (j > exponent) i = j;
  }
  return i - at;
}

/// Whether this place lies inside a word or a number: behind a letter, a decimal point, the sign of a number or of its
/// exponent. The second number of a range, 8-12, does not.
bool within(const std::string& text, std::size_t at) {
  if (at == 0) return false;
  const char before = text[at - 1];
  if (before == '.') return at > 1 && digit(text[at - 2]);
  if (before != '-' && before != '+') return letter(before);
  if (at == 1 || (!letter(text[at - 2]) && before == '-')) return true;
  return at > 2 && text[at - 2] == 'e' && digit(text[at - 3]);
}

/// A text whose white space is single blanks, and where its characters come from.
struct Flat {
  std::string text;
  std::vector<std::size_t> from;
};

Flat flattened(const std::string& text) {
  Flat flat;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool blank = space(text[i]);
    if (blank && !flat.text.empty() && flat.text.back() == ' ') continue;
    flat.text += blank ? ' ' : text[i];
    flat.from.push_back(i);
  }
  return flat;
}

struct TextRange {
  std::size_t begin, length;
};

std::vector<std::string> pieces_of(const std::string& pattern) {
  const std::string text = flattened(pattern).text;
  std::vector<std::string> pieces;
  std::size_t from = 0;
  for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}", from)) {
    pieces.push_back(text.substr(from, at - from));
    from = at + 2;
  }
  pieces.push_back(text.substr(from));
  return pieces;
}

/// Where a pattern stands in a flat text, and the numbers in it.
struct Match {
  TextRange all{};
  std::vector<TextRange> numbers;
};

/// A pattern that begins at a place of a flat text; nothing if it does not.
std::optional<Match> match_at(const std::string& text, const std::vector<std::string>& pieces, std::size_t at) {
  Match match{.all = {at, 0}, .numbers = {}};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0) {
      const std::size_t length = number_length(text, at);
      if (length == 0 || within(text, at)) return std::nullopt;
      match.numbers.push_back({at, length});
      at += length;
    }
    if (text.compare(at, pieces[i].size(), pieces[i]) != 0) return std::nullopt;
    at += pieces[i].size();
  }
  match.all.length = at - match.all.begin;
  return match;
}

std::vector<Match> matches(const std::string& text, const std::string& pattern) {
  const auto pieces = pieces_of(pattern);
  std::vector<Match> found;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!pieces.front().empty()) {
      at = text.find(pieces.front(), at);
      if (at == std::string::npos) break;
      // a text that begins with a letter or a digit begins at the start of a word
      if (at > 0 && letter(text[at]) && letter(text[at - 1])) continue;
    }
    if (auto match = match_at(text, pieces, at)) found.push_back(std::move(*match));
  }
  return found;
}

/// Whether each character of a markdown text is to be looked at: under one of the headings, and not `code`.
std::vector<bool> looked_at(const std::string& text, const std::vector<std::string>& headings) {
  std::vector<bool> looked(text.size(), headings.empty());
  bool inside = headings.empty();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.starts_with("## ")) {
      inside = headings.empty() || std::ranges::find(headings, line.substr(3)) != headings.end();
    }
    for (std::size_t i = begin; i < end; ++i) looked[i] = inside;
    begin = end + 1;
  }
  bool code = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') code = !code;
    if (code) looked[i] = false;
  }
  for (std::size_t i = text.find("]("); i != std::string::npos; i = text.find("](", i + 1)) {
    for (std::size_t j = i; j < text.size() && text[j] != ')'; ++j) looked[j] = false;
  }
  return looked;
}

[[noreturn]] void refuse(const Json& value, const std::string& why) {
  throw InvalidInput("value", excerpt(value), why);
}

std::vector<double> numbers_of(const Json& value, const std::string& study, ReportFolder& reports);

double only(const Json& value, const std::string& study, ReportFolder& reports) {
  const auto numbers = numbers_of(value, study, reports);
  if (numbers.size() != 1)
    refuse(value, "the report holds " + std::to_string(numbers.size()) + " numbers here, not one");
  return numbers.front();
}

std::vector<double> named(const Json& value, const std::string& study, ReportFolder& reports) {
  std::string name = value.get<std::string>(), of = study;
  const std::size_t colon = name.find(':');
  if (colon != std::string::npos && name.find('/') > colon) {
    of = name.substr(0, colon);
    name = name.substr(colon + 1);
  }
  const Json& report = reports.report(of);
  std::vector<double> numbers;
  const auto add = [&](const Json& found) {
    if (found.is_number()) numbers.push_back(found.get<double>());
  };
  if (name.starts_with('/')) {
    const Json::json_pointer pointer(name);
    if (report.contains(pointer)) add(report.at(pointer));
  } else if (name.ends_with('*')) {
    for (const auto& [key, found] : report.at("measured").items()) {
      if (key.starts_with(name.substr(0, name.size() - 1))) add(found);
    }
  } else {
    add(report.at("measured").value(name, Json()));
  }
  if (numbers.empty()) refuse(value, "the report of " + of + " holds no such number");
  return numbers;
}

std::vector<double> cells(const Json& value, const Json& report) {
  std::vector<double> numbers;
  for (const Json& table : report.at("tables")) {
    if (table.at("name") != value.at("table")) continue;
    const auto columns = table.at("columns").get<std::vector<std::string>>();
    const auto place = [&](const std::string& column) {
      const auto at = std::ranges::find(columns, column);
      if (at == columns.end()) refuse(value, "the table has no column \"" + column + "\"");
      return static_cast<std::size_t>(at - columns.begin());
    };
    const std::size_t column = place(value.at("column").get<std::string>());
    for (const Json& row : table.at("rows")) {
      bool fits = true;
      const Json where = value.value("where", Json::object());
      for (const auto& [key, cell] : where.items()) fits = fits && row.at(place(key)) == cell;
      if (fits && row.at(column).is_number()) numbers.push_back(row.at(column).get<double>());
    }
  }
  if (numbers.empty()) refuse(value, "no such row with a number");
  return numbers;
}

double entry_of(const Json& list, const Json& value, const char* kind) {
  for (const Json& entry : list) {
    if (entry.at("quantity") != value.at(kind)) continue;
    const Json::json_pointer place("/" + (value.contains("pair") ? "pairwise_orders/" + value.at("pair").dump()
                                                                 : value.value("key", std::string())));
    if (entry.contains(place) && entry.at(place).is_number()) return entry.at(place).get<double>();
  }
  refuse(value, "the report holds no such number");
}

double gates_of(const Json& report, const Json& kind) {
  return static_cast<double>(std::ranges::count_if(
      report.at("gates"), [&](const Json& gate) { return kind == "all" || gate.value("kind", "") == kind; }));
}

std::vector<double> numbers_of(const Json& value, const std::string& study, ReportFolder& reports) {
  if (value.is_number()) return {value.get<double>()};
  if (value.is_string()) return named(value, study, reports);
  if (!value.is_object() || value.empty()) refuse(value, "a value is a name, a pointer, a number or an operation");
  const std::string operation = value.begin().key();
  const Json& operands = value.begin().value();
  const std::string of = value.value("in", study);
  if (operation == "table") return cells(value, reports.report(of));
  const auto entry = [&](const char* list) {
    return std::vector{entry_of(reports.report(of).value(list, Json::array()), value, operation.c_str())};
  };
  if (operation == "fit") return entry("fits");
  if (operation == "convergence") return entry("grid_convergence");
  if (operation == "gates") {
    if (of != "*") return {gates_of(reports.report(of), operands)};
    double sum = 0;
    for (const Json* report : reports.all()) sum += gates_of(*report, operands);
    return {sum};
  }
  if (operation == "abs") return {std::abs(only(operands, study, reports))};
  if (!operands.is_array() || operands.empty()) refuse(value, "this is no operation");
  if (operation == "ratio" || operation == "difference") {
    if (operands.size() != 2) refuse(value, "it takes two numbers");
    const double a = only(operands.at(0), study, reports), b = only(operands.at(1), study, reports);
    return {operation == "ratio" ? a / b : a - b};
  }
  std::vector<double> all;
  for (const Json& operand : operands) {
    const auto more = numbers_of(operand, study, reports);
    all.insert(all.end(), more.begin(), more.end());
  }
  if (operation == "max") return {*std::ranges::max_element(all)};
  if (operation == "min") return {*std::ranges::min_element(all)};
  double result = operation == "product" ? 1 : 0;
  for (const double number : all) result = operation == "product" ? result * number : result + number;
  if (operation == "product" || operation == "sum") return {result};
  refuse(value, "this is no operation");
}

/// The next power of ten that is three times the number at least: another machine's rounding is not this one's.
std::string bound_of(double number) {
  return "1e" + std::to_string(static_cast<int>(std::ceil(portable::log10(3 * std::abs(number)))));
}

double four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", value);
  return std::strtod(text, nullptr);
}

const Json& list(const Json& claims, const char* key) {
  static const Json none = Json::array();
  if (!claims.contains(key)) return none;
  if (!claims.at(key).is_array())
    throw InvalidInput(std::string("/") + key, excerpt(claims.at(key)), "it must be an array");
  return claims.at(key);
}

void check_form(const Json& claims) {
  const auto refuse_key = [](const std::string& at, const std::string& what) {
    throw InvalidInput(at, what, "see claims.hpp");
  };
  if (!claims.is_object() || claims.value("schema", "") != "vlbeam.claims/1") {
    throw InvalidInput("/schema", excerpt(claims), "it must be \"vlbeam.claims/1\"");
  }
  for (const auto& item : claims.items()) {
    const std::string& key = item.key();
    if (key != "schema" && key != "study" && key != "document" && key != "checked" && key != "given" &&
        key != "claims") {
      refuse_key("/" + key, "an unknown key");
    }
  }
  for (std::size_t i = 0; i < list(claims, "claims").size(); ++i) {
    const Json& claim = claims.at("claims").at(i);
    const std::string at = "/claims/" + std::to_string(i);
    if (!claim.is_object() || !claim.contains("text") || !claim.at("text").is_string() || !claim.contains("values") ||
        !claim.at("values").is_array()) {
      refuse_key(at, "no \"text\" with \"values\"");
    }
    const auto wanted = pieces_of(claim.at("text").get<std::string>()).size() - 1;
    if (wanted == 0 || wanted != claim.at("values").size()) refuse_key(at, "one value for each {} is needed");
  }
}

}  // namespace

const Json& ReportFolder::report(const std::string& study) {
  auto found = reports_.find(study);
  if (found == reports_.end()) found = reports_.emplace(study, read_json(folder_ / (study + ".json"))).first;
  return found->second;
}

std::vector<const Json*> ReportFolder::all() {
  std::vector<std::string> studies;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = entry.path().stem().string();
    if (name.ends_with(".json") && stem.find('.') == std::string::npos) studies.push_back(stem);
  }
  std::ranges::sort(studies);
  std::vector<const Json*> found;
  for (const std::string& study : studies) found.push_back(&report(study));
  return found;
}

double claimed_value(const Json& value, const std::string& study, ReportFolder& reports) {
  return only(value, study, reports);
}

std::string number_like(double value, const std::string& like) {
  const std::size_t e = like.find('e');
  const std::string mantissa = like.substr(0, e);
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  char text[64];
  std::snprintf(text, sizeof text, e == std::string::npos ? "%.*f" : "%.*e", decimals, value);
  if (e == std::string::npos) return text;
  const std::string written = text;
  const std::size_t exponent = written.find('e');
  return written.substr(0, exponent) + "e" + std::to_string(std::atoi(written.c_str() + exponent + 1));
}

ClaimsVerdict check_claims(const Json& claims, const std::string& document, ReportFolder& reports) {
  check_form(claims);
  const std::string study = claims.value("study", "");
  const Flat flat = flattened(document);
  std::vector<bool> accounted(document.size(), false);
  const auto account = [&](const TextRange& span) {
    for (std::size_t i = 0; i < span.length; ++i) accounted[flat.from[span.begin + i]] = true;
  };
  struct Change {
    std::size_t at, length;
    std::string text;
  };
  std::vector<Change> changes;
  ClaimsVerdict verdict;
  verdict.claims = claims;
  for (Json& claim : verdict.claims["claims"]) {
    const auto text = claim.at("text").get<std::string>();
    const auto found = matches(flat.text, text);
    if (found.size() != 1) {
      verdict.failures.push_back("\"" + text + "\" occurs " + std::to_string(found.size()) + " times, not once");
      continue;
    }
    const Json recorded = claim.value("recorded", Json::array());
    claim["recorded"] = Json::array();
    account(found.front().all);
    for (std::size_t i = 0; i < found.front().numbers.size(); ++i) {
      const TextRange& span = found.front().numbers[i];
      const Json& value = claim.at("values").at(i);
      const bool bounded = value.is_object() && value.contains("at_most");
      ++verdict.numbers;
      double number = 0;
      try {
        number = claimed_value(bounded ? value.at("at_most") : value, study, reports);
      } catch (const InvalidInput& error) {
        verdict.failures.push_back("\"" + text + "\": " + error.what());
        claim["recorded"].push_back(nullptr);
        continue;
      }
      const std::string written = flat.text.substr(span.begin, span.length);
      if (bounded) {  // what is rounding has no digits to record
        claim["recorded"].push_back(nullptr);
        if (std::abs(number) <= std::strtod(written.c_str(), nullptr)) continue;
        const std::string wanted = bound_of(number);
        verdict.failures.push_back("\"" + text + "\" says at most " + written + ", the report has " +
                                   Json(number).dump() + " (" + value.dump() + ")");
        changes.push_back({flat.from[span.begin], span.length, wanted});
        continue;
      }
      claim["recorded"].push_back(four_digits(number));
      const std::string wanted = number_like(number, written);
      if (wanted != written) {
        verdict.failures.push_back("\"" + text + "\" says " + written + ", the report " + wanted + " (" + value.dump() +
                                   ")");
        changes.push_back({flat.from[span.begin], span.length, wanted});
      } else if (i >= recorded.size() || !recorded[i].is_number() ||
                 !(std::abs(recorded[i].get<double>() - number) <= recorded_to * std::abs(number))) {
        verdict.failures.push_back("\"" + text + "\": " + written + " is recorded as " +
                                   (i < recorded.size() ? recorded[i].dump() : "nothing") + ", the report has " +
                                   Json(four_digits(number)).dump() + " (" + value.dump() + ")");
      }
    }
  }
  for (const Json& given : list(claims, "given")) {
    const auto found = matches(flat.text, given.get<std::string>());
    if (found.empty()) verdict.failures.push_back("\"" + given.get<std::string>() + "\", given, occurs nowhere");
    for (const Match& match : found) account(match.all);
  }

  std::vector<std::string> headings;
  for (const Json& heading : list(claims, "checked")) headings.push_back(heading.get<std::string>());
  const auto looked = looked_at(document, headings);
  for (std::size_t i = 0; i < document.size(); ++i) {
    if (!digit(document[i]) || (i > 0 && letter(document[i - 1]))) continue;
    const std::size_t length = number_length(document, i);
    if (looked[i] && !accounted[i]) {
      const std::size_t begin = i < 40 ? 0 : i - 40;
      verdict.failures.push_back("\"" + flattened(document.substr(begin, i + length + 20 - begin)).text +
                                 "\": " + document.substr(i, length) + " is neither claimed nor given");
    }
    i += length - 1;
  }

  verdict.document = document;
  std::ranges::sort(changes, std::ranges::greater{}, &Change::at);
  for (const Change& change : changes) verdict.document.replace(change.at, change.length, change.text);
  return verdict;
}

std::string claims_text(const Json& claims) {
  std::string text = "{\n";
  for (const auto& [key, value] : claims.items()) {
    if (key == "claims") continue;
    text += "  " + Json(key).dump() + ": " + value.dump() + ",\n";
  }
  text += "  \"claims\": [";
  bool first = true;
  for (const Json& claim : claims.at("claims")) {
    text += std::string(first ? "" : ",") + "\n    " + claim.dump();
    first = false;
  }
  return text + "\n  ]\n}\n";
}

}  // namespace vlbeam
