// The reader of scenes: any text is a scene that reads back as itself, or InvalidInput.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/scene_json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const vlbeam::Scene scene = vlbeam::parse_scene({reinterpret_cast<const char*>(data), size});
    const vlbeam::Json echo = vlbeam::scene_to_json(scene);
    if (vlbeam::scene_to_json(vlbeam::scene_from_json(echo)) != echo) std::abort();
  } catch (const vlbeam::InvalidInput&) {
  }
  return 0;
}
