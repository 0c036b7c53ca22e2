#pragma once

#include "io/json.hpp"

namespace vlbeam {

/// Where numbers come from: commit (of the sources the program is made of), compiler, flags, host, date. Belongs in
/// files that are not committed.
Json provenance();

}  // namespace vlbeam
