#include "studies/app/run_outputs.hpp"

#include <array>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "core/error.hpp"
#include "io/messages.hpp"
#include "scene/names.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

bool ended_well(RunStatus status) { return status == RunStatus::completed || status == RunStatus::separated; }

/// Whether a file holds something that a run which did not end well must not replace.
bool holds_a_result(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::is_empty(file, error)) return false;
  std::array<char, 200> head{};  // a report opens with its status
  std::ifstream(file, std::ios::binary).read(head.data(), head.size() - 1);
  const std::string text = head.data();
  for (const RunStatus status : {RunStatus::failed, RunStatus::interrupted}) {
    if (text.find("\"status\": " + quoted(status)) != std::string::npos) return false;
  }
  return true;
}

fs::path beside(const fs::path& file, RunStatus status) {
  return file.parent_path() / (file.stem().string() + "." + std::string(to_string(status)) + file.extension().string());
}

}  // namespace

RunOutputs::RunOutputs(const std::vector<Named>& reads, const std::vector<Named>& files, bool force) : force_(force) {
  const auto in = [](const std::string& name) { return fs::path(name == "-" ? "/dev/stdin" : name); };
  const auto out = [](const std::string& name) { return fs::path(name == "-" ? "/dev/stdout" : name); };
  for (const auto& [option, name] : files) {
    if (name.empty()) continue;
    check_writable(option, name);
    for (const auto& [what, read] : reads) {
      if (read.empty()) continue;
      bool replaced = same_file(in(read), out(name));
      for (const RunStatus status : {RunStatus::failed, RunStatus::interrupted}) {
        replaced = replaced || (name != "-" && !force && same_file(in(read), beside(name, status)));
      }
      if (replaced) {
        throw InvalidInput(option, "\"" + name + "\"", "it must not be " + what + ": give another name");
      }
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (files[i].second.empty() || files[k].second.empty()) continue;
      if (!same_file(out(files[i].second), out(files[k].second))) continue;
      throw InvalidInput(files[i].first, "\"" + files[i].second + "\"",
                         "it must not be the same as " + files[k].first + ": give another name");
    }
  }
}

void RunOutputs::write(const std::string& name, RunStatus status, const std::function<void(const TextSink&)>& content) {
  write_with(name, status, [&content](const fs::path& file) { write_file(file, content); });
}

void RunOutputs::write_with(const std::string& name, RunStatus status,
                            const std::function<void(const fs::path&)>& write) {
  if (name.empty()) return;
  fs::path file = name;
  if (name != "-" && !force_ && !ended_well(status) && holds_a_result(file)) file = beside(file, status);
  try {
    write(file);
    if (file != name) {
      written_.push_back(file.string() + "; " + name + " holds an earlier result and stays (--force replaces it)");
    } else if (name != "-") {
      written_.push_back(name);
    }
  } catch (const std::exception& error) {
    problems_.push_back(explained(error));
  }
}

void RunOutputs::attempt(const std::string& name, const std::function<void()>& write) {
  try {
    write();
    written_.push_back(name);
  } catch (const std::exception& error) {
    problems_.push_back(explained(error));
  }
}

void RunOutputs::tell() const {
  for (const std::string& file : written_) std::cerr << "  written     " << printable(file) << '\n';
  for (const std::string& problem : problems_) std::cerr << "vlbeam: " << printable(problem) << '\n';
}

}  // namespace vlbeam
