#pragma once

#include <functional>
#include <utility>

#include "scene/result.hpp"

namespace vlbeam {

/// What a run hands on or leaves out, because a long beam may have more of it than the memory holds.
struct RunOutput {
  /// Takes each shape as it comes; RunResult::configurations then stays empty. It must not throw but std::bad_alloc.
  std::function<void(const Configuration&)> shape = {};
  bool event_shapes = true;  ///< false: Event::before and after stay empty

  /// Hands a shape on, or leaves it in the result.
  void add(Configuration&& of, RunResult& result) const {
    if (shape) {
      shape(of);
    } else {
      result.configurations.push_back(std::move(of));
    }
  }
};

}  // namespace vlbeam
