#include "io/schema.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/scene_json.hpp"

namespace vlbeam {
namespace {

/// Counts the keys of an echoed scene that the schema does not describe.
std::size_t undescribed(const Json& value, const Json& schema, const std::string& at) {
  if (schema.contains("anyOf") && !schema.contains("properties")) {
    return undescribed(value, schema.at("anyOf").back(), at);
  }
  std::size_t count = 0;
  for (const auto& item : value.items()) {
    if (value.is_array()) {
      if (item.value().is_object()) count += undescribed(item.value(), schema.at("items"), at);
      continue;
    }
    if (!schema.at("properties").contains(item.key())) {
      ADD_FAILURE() << at << "/" << item.key();
      ++count;
    } else if (item.value().is_structured()) {
      count += undescribed(item.value(), schema.at("properties").at(item.key()), at + "/" + item.key());
    }
  }
  return count;
}

TEST(SceneSchema, DescribesEveryKeyOfAScene) {
  EXPECT_EQ(undescribed(scene_to_json(scene_with_every_part()), scene_schema(), ""), 0U);
}

TEST(SceneSchema, ComesFromTheOptionTable) {
  const Json schema = scene_schema();
  const auto at = [&schema](const char* pointer) { return schema.at(Json::json_pointer(pointer)); };
  EXPECT_EQ(at("/properties/beam/properties/elements/minimum"), 2.0);
  EXPECT_EQ(at("/properties/beam/properties/element/enum"), (Json{"ALE-RANCF", "ALE-ANCF", "RANCF", "ANCF"}));
  EXPECT_EQ(at("/properties/sliding_mass/required"), (Json{"mass", "position"}));
  EXPECT_EQ(at("/properties/supports/items/properties/at/anyOf/0/enum"), (Json{"start", "end"}));
  EXPECT_FALSE(at("/properties/supports/items/properties/type").contains("default")) << "it is required";
  EXPECT_EQ(at("/properties/sliding_joints/items/properties/support/enum"), (Json{"clamp", "pin", "free"}));
  EXPECT_EQ(at("/properties/sliding_joints/items/properties/support/default"), "free");
  EXPECT_EQ(at("/properties/integrator/anyOf/1/properties/rtol/minimum"), 1e-14);
  EXPECT_EQ(at("/properties/integrator/anyOf/1/properties/atol/type"), (Json{"number", "object"}));
  EXPECT_EQ(at("/properties/integrator/anyOf/1/properties/atol/required"), (Json{"length", "velocity"}));
}

}  // namespace
}  // namespace vlbeam
