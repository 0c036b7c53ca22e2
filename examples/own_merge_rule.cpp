// A merge policy of one's own: the merged element gets the weights with which it would run evenly along the circle
// through its ends and the node it has lost, w_1 = w_2 = (theta cot(theta/4) - 1)/3 for an arc that turns by theta. Run
// beside the paper's point fit and unit weights, and judged by the energy that merges change.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <vlbeam/vlbeam.hpp>

namespace {

double distance(const vlbeam::LostNode::Point& a, const vlbeam::LostNode::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The angle of the triangle at the lost node is pi less half of what the arc turns by.
std::array<double, 3> circular(const vlbeam::LostNode& merge) {
  const double a = distance(merge.r, merge.r_a), b = distance(merge.r, merge.r_b), c = distance(merge.r_a, merge.r_b);
  const double turn = 2 * std::acos(std::clamp((c * c - a * a - b * b) / (2 * a * b), -1.0, 1.0));
  if (turn < 1e-6) return {1, 1, 1};  // where rounding is all there is
  const double middle = std::max((turn / std::tan(turn / 4) - 1) / 3, 0.1);
  return {1, middle, middle};
}

/// Sum of |energy jumps| at merges [J].
double jumps(const vlbeam::Scene& scene) {
  const vlbeam::RunResult result = vlbeam::simulate(scene);
  if (result.status == vlbeam::RunStatus::failed) {
    std::cerr << result.failure << '\n';
    std::exit(3);
  }
  double sum = 0;
  for (const vlbeam::Event& event : result.events) sum += std::abs(event.energy_jump.total());
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: own_merge_rule SCENE.json\n";
    return 2;
  }
  vlbeam::Scene scene = vlbeam::read_scene(argv[1]);
  scene.length_control.merge = vlbeam::MergePolicy::unit;
  std::cout << "unit weights    " << jumps(scene) << " J\n";
  scene.length_control.merge = vlbeam::MergePolicy::point_fit;
  std::cout << "point fit       " << jumps(scene) << " J\n";
  scene.length_control.merge = vlbeam::MergePolicy::own;
  scene.length_control.merge_rule = circular;
  std::cout << "circular, own   " << jumps(scene) << " J\n";
  return 0;
}
