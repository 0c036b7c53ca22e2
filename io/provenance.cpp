#include "io/provenance.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <string>

#include <vlbeam_commit.hpp>

namespace vlbeam {
namespace {

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

Json provenance() {
  return {{"program", "vlbeam " VLBEAM_VERSION},
          {"commit", VLBEAM_COMMIT},
          {"compiler", VLBEAM_COMPILER},
          {"flags", VLBEAM_FLAGS},
          {"host", host()},
          {"date", utc_now()}};
}

}  // namespace vlbeam
