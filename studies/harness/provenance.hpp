#pragma once

#include "studies/harness/json.hpp"

namespace vlbeam {

/// Where numbers come from: commit, compiler, flags, host, date. Belongs in files that are not committed.
Json provenance();

}  // namespace vlbeam
