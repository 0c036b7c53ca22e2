// A beam in a plane: marks, the stretches between them, and their equations of motion.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "given.hpp"
#include "stretch.hpp"

namespace judge {

using State = std::vector<double>;  ///< coordinates, then their rates

/// A place on the beam where something is: an end, a support, a mass, a ring. Numbers are those of coordinates.
struct Mark {
  int x = 0;
  int r[2] = {}, before[2] = {}, after[2] = {};  ///< place; dr/dx on the side before and behind it
  double mass = 0;
};

class Beam {
 public:
  /// A scene (vlbeam.scene/1; what is not modelled here is refused), and a degree for each stretch. Between
  /// joints and ends there may be further marks that rest.
  Beam(const nlohmann::json& scene, const std::vector<int>& degrees, double points_per_degree,
       const std::vector<double>& between = {});

  State initial() const;
  void rates(const State& y, State& out, double t);
  std::size_t unknowns() const { return unknowns_; }
  double length() const { return length_; }

  Energies energies(const State& y, double t);
  /// Names and values of what is reported.
  std::vector<std::pair<std::string, double>> quantities(const State& y, double t);

 private:
  /// Free: place in the state. Given: base + direction * displacement(t).
  struct Coordinate {
    int free = -1;
    double base = 0, direction = 0;
    Given displacement;
  };
  int add(double base, bool free);
  Mark add_mark(double x, bool travels);
  void hold(int coordinate, const nlohmann::json* motion, int component);
  void support(Mark& mark, const nlohmann::json& said);
  void joint(Mark& mark, const nlohmann::json& said);
  void read_curve(const nlohmann::json& beam);
  Eigen::Matrix<double, 2, 3> curve(double x) const;  ///< place, tangent, and its derivative
  void gather(const State& y, double t);
  Eigen::Vector2d gravity(double t) const;

  Section section_;
  bool arc_ = false;
  Eigen::Vector2d start_{0, 0}, along_{1, 0}, center_{0, 0};
  double length_ = 0, radius_ = 0, from_ = 0, turn_ = 1;
  Eigen::Vector2d gravity_{0, 0};
  Given gravity_share_;

  std::vector<Coordinate> coordinates_;
  std::vector<Mark> marks_;
  std::vector<int> joints_;  ///< marks that are joints
  std::vector<Stretch> stretches_;
  int free_ = 0;
  std::size_t unknowns_ = 0;
  std::vector<double> q_, rate_, acceleration_;
};

}  // namespace judge
