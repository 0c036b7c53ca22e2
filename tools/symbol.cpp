#include "tools/symbol.hpp"

#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"

namespace vlbeam {
namespace {

using Pair = std::array<double, 2>;
using Line = std::vector<Pair>;

Line circle(double radius, Pair center, double from = 0, double to = 360) {
  Line line;
  constexpr int parts = 20;
  for (int i = 0; i <= parts; ++i) {
    const double angle = (from + (to - from) * i / parts) * std::numbers::pi / 180;
    line.push_back({center[0] + radius * portable::cos(angle), center[1] + radius * portable::sin(angle)});
  }
  return line;
}

/// Hatched ground, across the way from the place, `depth` away from it.
void add_ground(std::vector<Line>& lines, double depth, double half) {
  lines.push_back({{depth, -half}, {depth, half}});
  constexpr int strokes = 4;
  for (int i = 0; i < strokes; ++i) {
    const double y = -half + 2 * half * (i + 1) / strokes;
    lines.push_back({{depth, y}, {depth + 0.3, y - 0.3}});
  }
}

void add_triangle(std::vector<Line>& lines) { lines.push_back({{0, 0}, {0.8, -0.5}, {0.8, 0.5}, {0, 0}}); }

/// Of unit size, the place at the origin, its way along the first axis.
std::vector<Line> drawn(Symbol::Kind kind) {
  std::vector<Line> lines;
  switch (kind) {
    case Symbol::Kind::pin:
      add_triangle(lines);
      add_ground(lines, 0.8, 0.7);
      break;
    case Symbol::Kind::roller:
      add_triangle(lines);
      lines.push_back(circle(0.13, {0.93, -0.28}));
      lines.push_back(circle(0.13, {0.93, 0.28}));
      add_ground(lines, 1.06, 0.7);
      break;
    case Symbol::Kind::clamp:
      add_ground(lines, 0, 0.9);
      break;
    case Symbol::Kind::winch:
      lines.push_back(circle(0.7, {0.7, 0}));
      lines.push_back({{0.2, -0.5}, {1.2, 0.5}});
      lines.push_back({{0.2, 0.5}, {1.2, -0.5}});
      break;
    case Symbol::Kind::wheel:
      lines.push_back(circle(0.5, {-0.5, 0}));
      break;
    case Symbol::Kind::spring: {
      Line zigzag{{0, 0}, {0.2, 0}};
      for (int i = 0; i < 6; ++i) zigzag.push_back({0.25 + 0.1 * i, i % 2 == 0 ? 0.25 : -0.25});
      zigzag.insert(zigzag.end(), {{0.8, 0}, {1, 0}});
      lines.push_back(zigzag);
      add_ground(lines, 1, 0.7);
      break;
    }
    case Symbol::Kind::force:
      lines.push_back({{-2, 0}, {0, 0}});
      lines.push_back({{-0.5, 0.2}, {0, 0}, {-0.5, -0.2}});
      break;
    case Symbol::Kind::moment: {
      const Line arc = circle(0.8, {0, 0}, -120, 120);
      lines.push_back(arc);
      lines.push_back(
          {{arc.back()[0] + 0.45, arc.back()[1] + 0.05}, arc.back(), {arc.back()[0] + 0.2, arc.back()[1] - 0.4}});
      break;
    }
    case Symbol::Kind::hinge:
      lines.push_back(circle(0.2, {0, 0}));
      break;
    case Symbol::Kind::block:
      lines.push_back({{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}});
      break;
    case Symbol::Kind::rail:
      lines.push_back({{-2.5, 0}, {2.5, 0}});
      for (const double side : {-0.35, 0.35}) lines.push_back({{-0.6, side}, {0.6, side}});
      break;
    case Symbol::Kind::hanger:
    case Symbol::Kind::floor:
    case Symbol::Kind::coil:
    case Symbol::Kind::rod:
      break;
  }
  return lines;
}

/// A spring between two places, with coils of `size`.
Line coil_between(Pair from, Pair to, Pair size) {
  const Pair way{to[0] - from[0], to[1] - from[1]}, in_sizes{way[0] / size[0], way[1] / size[1]};
  const double length = portable::hypot(in_sizes[0], in_sizes[1]);
  const auto at = [&](double part, double aside) {
    const Pair across = length > 0 ? Pair{-in_sizes[1] / length, in_sizes[0] / length} : Pair{};
    return Pair{from[0] + part * way[0] + aside * across[0] * size[0],
                from[1] + part * way[1] + aside * across[1] * size[1]};
  };
  Line line{from, at(0.2, 0)};
  constexpr int turns = 10;
  for (int i = 0; i < turns; ++i) line.push_back(at(0.2 + 0.6 * (i + 0.5) / turns, i % 2 == 0 ? 0.25 : -0.25));
  line.insert(line.end(), {at(0.8, 0), to});
  return line;
}

}  // namespace

std::vector<std::vector<std::array<double, 2>>> lines_of(const Symbol& symbol, std::array<double, 2> size, double left,
                                                         double right) {
  std::vector<Line> lines;
  if (symbol.kind == Symbol::Kind::floor) {
    lines.push_back({{left, symbol.at[1]}, {right, symbol.at[1]}});
    const double step = 0.6 * size[0];
    for (double x = left + step; x <= right; x += step) {
      lines.push_back({{x, symbol.at[1]}, {x - 0.3 * size[0], symbol.at[1] - 0.3 * size[1]}});
    }
    return lines;
  }
  if (symbol.kind == Symbol::Kind::hanger) {
    lines = lines_of({Symbol::Kind::pin, symbol.other, symbol.way, {}, symbol.frame}, size, left, right);
    lines.push_back({symbol.at, symbol.other});
    return lines;
  }
  if (symbol.kind == Symbol::Kind::rod) return {{symbol.at, symbol.other}};
  if (symbol.kind == Symbol::Kind::coil) return {coil_between(symbol.at, symbol.other, size)};
  lines = drawn(symbol.kind);
  for (Line& line : lines) {
    for (Pair& point : line) {
      const Pair turned{symbol.way[0] * point[0] - symbol.way[1] * point[1],
                        symbol.way[1] * point[0] + symbol.way[0] * point[1]};
      point = {symbol.at[0] + size[0] * turned[0], symbol.at[1] + size[1] * turned[1]};
    }
  }
  return lines;
}

}  // namespace vlbeam
