#include "tests/folders.hpp"

// The only file that knows where the tree stands: all others have the same text in each copy of it, so that a cache of
// compiled files serves all copies.
namespace vlbeam::test {

std::filesystem::path source_folder() { return VLBEAM_SOURCE_DIR; }
std::filesystem::path program() { return VLBEAM_PROGRAM; }

}  // namespace vlbeam::test
