#pragma once

#include "io/json.hpp"

namespace vlbeam {

/// JSON Schemas (draft 2020-12) of what users write and read. The scene's is made from the option table.
Json scene_schema();
Json run_schema();
Json study_schema();
Json gates_schema();
Json converge_schema();
Json sweep_schema();

}  // namespace vlbeam
