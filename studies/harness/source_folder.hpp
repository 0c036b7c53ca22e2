#pragma once

#include <filesystem>
#include <string>

namespace vlbeam {

/// A folder of the source tree that the program reads at run time, and why it is there.
struct SourceFolder {
  std::filesystem::path path;
  bool of_the_build = false;  ///< none was beside the program: it is the one the program was built from
};

/// The folder named by `given`, or, where that is empty, the first there is of ../NAME and ../share/vlbeam/NAME beside
/// the program, which a copied or moved tree brings along, and the one of the source tree it was built from. `name` is
/// "studies" or "scenes", `marker` a file that it must hold. Throws InvalidInput, of the option --NAME, naming all that
/// was looked for.
SourceFolder find_source_folder(const std::string& name, const std::filesystem::path& given,
                                const std::filesystem::path& marker);

}  // namespace vlbeam
