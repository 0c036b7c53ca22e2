#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "scene/result.hpp"

namespace vlbeam {

/// Shows the shapes of a run one by one, in their order, as often as it is called: they need not be in memory.
using Shapes = std::function<void(const std::function<void(const Configuration&)>& show)>;

/// Those that a result keeps; it must be there as long as they are shown.
Shapes shapes_of(const RunResult& result);

/// Keeps shapes in a file without a name, in the folder for temporary files (TMPDIR), until they are shown: those of a
/// long beam may be more than the memory holds. What cannot be written there stays in memory.
class ShapeSpool {
 public:
  void add(const Configuration& shape);
  /// Throws std::runtime_error where they cannot be read back. The spool must be there as long as they are shown.
  Shapes shapes() const;

 private:
  void show_all(const std::function<void(const Configuration&)>& show) const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<std::size_t> sizes_;        ///< of those in the file [bytes]
  std::vector<Configuration> in_memory_;  ///< those behind them
};

}  // namespace vlbeam
