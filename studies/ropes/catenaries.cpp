#include "studies/ropes/catenaries.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/elementary.hpp"
#include "scene/shape.hpp"

namespace vlbeam::ropes {
namespace {

constexpr double w = 9.81;  // [N/m]
constexpr int points_an_element = 4;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], 0}; }
double size(const Point& a) { return portable::hypot(a[0], a[1]); }
Point along(const Point& a, double length) { return {a[0] / size(a) * length, a[1] / size(a) * length, 0}; }

}  // namespace

double Catenary::vertical(double s) const { return V - w * (length - s); }
double Catenary::tension(double s) const { return portable::hypot(H, vertical(s)); }
Point Catenary::place(double s) const {
  const double stretch_up = (vertical(0) * s + w * s * s / 2) / EA;
  if (H == 0) return {0, stretch_up + std::copysign(s, vertical(s / 2)), 0};
  const double a = vertical(0) / H, b = vertical(s) / H, c = H / w;
  return {H * s / EA + c * (portable::asinh(b) - portable::asinh(a)),
          stretch_up + c * (std::sqrt(1 + b * b) - std::sqrt(1 + a * a)), 0};
}

HangingRope::HangingRope(Hanging hanging, double EA_over_weight, int elements) : hanging_(hanging) {
  const double EA = EA_over_weight * w;
  scene_.analysis = Analysis::statics;
  scene_.gravity = {0, -w, 0};
  scene_.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0, .rhoA = 1};
  scene_.beam.elements = elements;
  scene_.statics.steps = 1;
  scene_.duration = 1;
  scene_.output.configurations = {1};
  scene_.start.type = SupportType::pin;
  if (hanging == Hanging::held) draw_held(EA);
  if (hanging == Hanging::ring) draw_ring(EA);
  if (hanging == Hanging::free) {
    scene_.beam.curve.end = {0.6, -0.8, 0};
    parts_ = {{.EA = EA, .length = 1, .H = 0, .V = 0}};
  }
}

/// A pin that goes from where it is drawn to where it is to be.
void HangingRope::hold(SupportSpec& support, const Point& drawn, const Point& there) const {
  const Point way = minus(there, drawn);
  support.type = SupportType::pin;
  support.motion = SupportMotionSpec{.direction = way, .displacement = {.value = size(way)}};
}

void HangingRope::draw_held(double EA) {
  parts_ = {{.EA = EA, .length = 1, .H = 3, .V = 5}};
  scene_.beam.curve.end = {1, 0, 0};
  hold(scene_.end, scene_.beam.curve.end, parts_.front().place(1));
}

/// With 5 N at the ring on both sides, where 0.45 m of the rope hang before it; it is drawn with 0.4 m there.
void HangingRope::draw_ring(double EA) {
  const double before = 0.45, drawn_before = 0.4, pull = 5, up = 4, down = 4.5;
  parts_ = {{.EA = EA, .length = before, .H = std::sqrt(pull * pull - up * up), .V = up},
            {.EA = EA, .length = 1 - before, .H = std::sqrt(pull * pull - down * down), .V = w * (1 - before) - down}};
  start_ = minus({}, parts_[0].place(before));
  const Point end = parts_[1].place(1 - before);
  CurveSpec& curve = scene_.beam.curve;
  curve.type = CurveType::polyline;
  curve.points = {along(start_, drawn_before), {}, along(end, 1 - drawn_before)};
  hold(scene_.start, curve.points.front(), start_);
  hold(scene_.end, curve.points.back(), end);
  SlidingJointSpec& ring = scene_.sliding_joints.emplace_back();
  ring.support = SupportType::pin;
  ring.position = drawn_before;
  ring.slopes = JointSlopes::free;
}

CatenaryError HangingRope::error_of(const RunResult& run) const {
  CatenaryError error{0, 0};
  const Catenary &first = parts_.front(), &last = parts_.back();
  const double most = std::max({first.tension(0), first.tension(first.length), last.tension(last.length)});
  for (const ShapePoint& point : points_along(scene_, run.configurations.back(), points_an_element)) {
    const bool behind = parts_.size() > 1 && point.x > first.length;
    const Catenary& part = behind ? last : first;
    const double s = behind ? point.x - first.length : point.x;
    const Point from = minus(point.r, part.place(s));
    error.shape = std::max(error.shape, size(behind ? from : minus(from, start_)));
    error.tension = std::max(error.tension, std::abs(point.tension - part.tension(s)) / most);
  }
  return error;
}

}  // namespace vlbeam::ropes
