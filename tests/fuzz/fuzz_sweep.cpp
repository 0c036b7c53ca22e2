// The reader of sweeps: any text is a sweep whose cases can be modelled, or InvalidInput.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/own_sweep.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // Allowed, and slow: up to a million cases.
  if (text.find("count") != std::string_view::npos) return -1;
  try {
    if (vlbeam::sweep_from_json(vlbeam::parse_json(text), "/nonexistent").cases.empty()) std::abort();
  } catch (const vlbeam::InvalidInput&) {
  }
  return 0;
}
