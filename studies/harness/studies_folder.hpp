#pragma once

#include <filesystem>

namespace vlbeam {

/// Where the data, gates and scripts of the studies are, and why there.
struct StudiesFolder {
  std::filesystem::path path;
  bool of_the_build = false;  ///< none was beside the program: it is the one the program was built from
};

/// The folder named by `given`, or, where that is empty, the first there is of ../studies and ../share/vlbeam/studies
/// beside the program, which a copied or moved tree brings along, and the one of the source tree it was built from.
/// `marker` is a file that it must hold. Throws InvalidInput naming all that was looked for.
StudiesFolder find_studies_folder(const std::filesystem::path& given, const std::filesystem::path& marker);

}  // namespace vlbeam
