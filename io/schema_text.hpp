#pragma once

#include <string>

#include "io/json.hpp"

namespace vlbeam {

/// What a JSON Schema of this project says of the key at a pointer ("/beam/material", "/loads/0/type"); all of it for
/// an empty one. Throws InvalidInput where there is no such key.
Json part_of_schema(const Json& schema, const std::string& pointer);

/// The same for a reader: a line a key, with what it may be, unit, default and description; `pointer` is where `schema`
/// stands.
std::string schema_text(const Json& schema, const std::string& pointer);

}  // namespace vlbeam
