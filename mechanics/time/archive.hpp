#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace vlbeam {

/// What something keeps from step to step, as numbers: written by the calls that read it again, in the same order, so
/// that one function does both. Integers must be exact as doubles.
class Archive {
 public:
  /// To be written.
  Archive() = default;
  /// To be read. Reading past the end throws std::out_of_range.
  explicit Archive(std::vector<double> numbers) : numbers_(std::move(numbers)), reads_(true) {}

  bool reads() const { return reads_; }
  const std::vector<double>& numbers() const { return numbers_; }
  /// All has been read.
  bool at_end() const { return at_ == numbers_.size(); }

  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void operator()(Number& number) {
    if (reads_) {
      number = static_cast<Number>(numbers_.at(at_++));
    } else {
      numbers_.push_back(static_cast<double>(number));
    }
  }
  void operator()(Eigen::VectorXd& vector) { exchange(vector); }
  void operator()(std::vector<double>& vector) { exchange(vector); }
  template <std::size_t N>
  void operator()(std::array<double, N>& numbers) {
    for (double& number : numbers) (*this)(number);
  }

 private:
  template <class Vector>
  void exchange(Vector& vector) {
    auto size = static_cast<std::size_t>(vector.size());
    (*this)(size);
    if (reads_) {
      if (size > numbers_.size() - at_) throw std::out_of_range("a memory that is too short");
      vector.resize(static_cast<decltype(vector.size())>(size));
    }
    for (double& number : vector) (*this)(number);
  }

  std::vector<double> numbers_;
  std::size_t at_ = 0;
  bool reads_ = false;
};

}  // namespace vlbeam
