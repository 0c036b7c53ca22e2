#pragma once

#include <string>
#include <vector>

#include "studies/harness/study.hpp"

namespace vlbeam {

/// Every study the program knows, in the order they are run: those that measure time come last.
const std::vector<Study>& all_studies();

/// The study of this name. Throws InvalidInput naming the studies there are.
const Study& find_study(const std::string& name);

}  // namespace vlbeam
