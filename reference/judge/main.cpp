// vlbeam_judge cases.json judge.json [case ...]: computes the cases, or the named ones, and writes them to judge.json,
// in which the others stay what they are.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "refine.hpp"

namespace {

/// Objects a key a line, lists of numbers on one line.
std::string text(const nlohmann::ordered_json& value, const std::string& margin = "\n") {
  const bool nested = value.is_structured() &&
                      std::any_of(value.begin(), value.end(), [](const auto& item) { return item.is_structured(); });
  if (!nested && (value.is_array() || !value.is_object())) return value.dump();
  std::string out;
  for (const auto& item : value.items()) {
    out += (out.empty() ? "" : ",") + margin + " ";
    if (value.is_object()) out += "\"" + item.key() + "\": ";
    out += text(item.value(), margin + " ");
  }
  return value.is_object() ? "{" + out + margin + "}" : "[" + out + margin + "]";
}

}  // namespace

int main(int argc, char** argv) try {
  using nlohmann::json, nlohmann::ordered_json;
  if (argc < 3) {
    std::cerr << "vlbeam_judge cases.json judge.json [case ...]\n";
    return 2;
  }
  const std::vector<std::string> wanted(argv + 3, argv + argc);
  const json cases = json::parse(std::ifstream(argv[1]));
  ordered_json kept = {{"cases", ordered_json::array()}};
  if (std::ifstream file(argv[2]); file && !wanted.empty()) kept = ordered_json::parse(file);
  ordered_json all = ordered_json::array();
  for (const json& item : cases.at("cases")) {
    const std::string name = item.at("case");
    if (wanted.empty() || std::count(wanted.begin(), wanted.end(), name) != 0) {
      all.push_back(judge::refine(item));
    } else {
      for (const ordered_json& old : kept.at("cases")) {
        if (old.at("case") == name) all.push_back(old);
      }
    }
  }
  const ordered_json out = {
      {"source",
       "reference/judge: Lagrange's equations of a p-version beam with moving marks, by automatic "
       "differentiation of its energies (vlbeam_judge cases.json judge.json)"},
      {"units", {{"t", "s"}, {"positions", "m"}, {"energies", "J"}}},
      {"cases", all}};
  std::ofstream(argv[2]) << text(out) << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
