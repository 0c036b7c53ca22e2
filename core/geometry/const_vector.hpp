#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// A vector of any size, or a part of one, that is read.
using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

}  // namespace vlbeam
