// How a scene (vlbeam.scene/1) becomes marks and stretches. Keys that say how the program computes are passed over; a
// key of the physics that is not modelled here is refused.
#include <cmath>
#include <set>
#include <stdexcept>

#include "beam.hpp"

namespace judge {

using nlohmann::json;

namespace {

constexpr double pi = 3.14159265358979323846;

void only(const json& object, const std::set<std::string>& known, const std::string& where) {
  for (const auto& item : object.items()) {
    if (known.count(item.key()) == 0) throw std::invalid_argument(where + "/" + item.key() + " is not modelled");
  }
}

Eigen::Vector2d pair(const json& said) { return {said.at(0).get<double>(), said.at(1).get<double>()}; }

}  // namespace

Given Given::from(const json& said) {
  only(said, {"value", "rate", "amplitude", "frequency", "ramp", "direction"}, "a function of time");
  Given g;
  g.value = said.value("value", 0.0);
  g.rate = said.value("rate", 0.0);
  g.amplitude = said.value("amplitude", 0.0);
  g.frequency = said.value("frequency", 0.0);
  g.ramp = said.value("ramp", 0.0);
  return g;
}

void Beam::read_curve(const json& beam) {
  const json& said = beam.at("curve");
  if (said.at("type") == "line") {
    start_ = pair(said.at("start"));
    const Eigen::Vector2d way = pair(said.at("end")) - start_;
    length_ = way.norm();
    along_ = way / length_;
  } else if (said.at("type") == "arc") {
    arc_ = true;
    center_ = pair(said.at("center"));
    radius_ = said.at("radius");
    from_ = said.at("from_degrees").get<double>() * pi / 180;
    const double angle = said.at("to_degrees").get<double>() * pi / 180 - from_;
    turn_ = angle > 0 ? 1 : -1;
    length_ = radius_ * std::abs(angle);
  } else {
    throw std::invalid_argument("curve/type is not modelled");
  }
  const json& section = beam.at("section");
  if (section.at("type") == "circle") {
    const double r = section.at("radius"), A = pi * r * r, E = beam.at("material").at("youngs_modulus");
    section_ = {E * A, E * A * r * r / 4, beam.at("material").at("density").get<double>() * A, 0};
  } else {
    section_ = {section.at("EA"), section.at("EI"), section.at("rhoA"), 0};
  }
  const std::string rest = beam.value("rest_shape", "as-built");
  if (arc_ && rest == "as-built") section_.kappa0 = turn_ / radius_;
}

Eigen::Matrix<double, 2, 3> Beam::curve(double x) const {
  Eigen::Matrix<double, 2, 3> c;
  if (!arc_) {
    c << start_ + x * along_, along_, Eigen::Vector2d::Zero();
    return c;
  }
  const double angle = from_ + turn_ * x / radius_;
  const Eigen::Vector2d out{std::cos(angle), std::sin(angle)}, tangent = turn_ * Eigen::Vector2d{-out[1], out[0]};
  c << center_ + radius_ * out, tangent, -out / radius_;
  return c;
}

int Beam::add(double base, bool free) {
  coordinates_.push_back({free ? free_++ : -1, base, 0, {}});
  return static_cast<int>(coordinates_.size()) - 1;
}

Mark Beam::add_mark(double x, bool travels) {
  const auto c = curve(x);
  Mark mark;
  mark.x = add(x, travels);
  for (int k = 0; k < 2; ++k) {
    mark.r[k] = add(c(k, 0), true);
    mark.before[k] = mark.after[k] = add(c(k, 1), true);
  }
  return mark;
}

/// The coordinate keeps its value, or has that of a motion.
void Beam::hold(int i, const json* motion, int component) {
  const int was = coordinates_[i].free;
  if (was < 0) return;
  coordinates_[i].free = -1;
  --free_;
  for (Coordinate& c : coordinates_) {
    if (c.free > was) --c.free;
  }
  if (motion == nullptr) return;
  coordinates_[i].direction = pair(motion->at("direction")).normalized()[component];
  coordinates_[i].displacement = Given::from(*motion);
}

void Beam::support(Mark& mark, const json& said) {
  only(said, {"at", "type", "clamp", "motion", "feed"}, "supports");
  const json* motion = said.contains("motion") ? &said.at("motion") : nullptr;
  for (int k = 0; k < 2; ++k) hold(mark.r[k], motion, k);
  if (said.at("type") == "clamp") {
    const bool full = said.value("clamp", "direction") == "full";
    for (int k = 0; k < 2; ++k) {
      const double tangent = coordinates_[mark.after[k]].base;
      if (!full && std::abs(tangent) > 1e-14 && std::abs(tangent) < 1 - 1e-14) {
        throw std::invalid_argument("a clamp that is not along an axis is not modelled");
      }
      if (full || std::abs(tangent) <= 1e-14) hold(mark.after[k], nullptr, k);
    }
  }
  if (said.contains("feed")) {
    Coordinate& x = coordinates_[mark.x];
    x.direction = said.at("at") == "start" ? -1 : 1;
    x.displacement = Given::from(said.at("feed"));
  }
}

void Beam::joint(Mark& mark, const json& said) {
  only(said, {"position", "support", "mass", "motion", "slopes"}, "joints");
  mark.mass = said.value("mass", 0.0);
  const std::string kind = said.value("support", "free");
  if (kind == "free") return;
  const json* motion = said.contains("motion") ? &said.at("motion") : nullptr;
  for (int k = 0; k < 2; ++k) hold(mark.r[k], motion, k);
  if (kind != "clamp") return;
  // A sleeve holds the direction; the stretch may jump in it, but for slopes that are said to be continuous.
  const bool one = said.value("slopes", "tangent") == "continuous";
  for (int k = 0; k < 2; ++k) {
    const double tangent = coordinates_[mark.after[k]].base;
    if (std::abs(tangent) <= 1e-14) {
      hold(mark.after[k], nullptr, k);
    } else if (std::abs(tangent) > 1 - 1e-14) {
      if (!one) mark.before[k] = add(tangent, true);
    } else {
      throw std::invalid_argument("a sleeve that is not along an axis is not modelled");
    }
  }
}

Beam::Beam(const json& scene, const std::vector<int>& degrees, double points_per_degree,
           const std::vector<double>& between) {
  only(scene,
       {"schema", "title", "dimension", "gravity", "gravity_ramp", "beam", "supports", "sliding_mass", "sliding_joints",
        "point_masses", "duration", "output", "weights", "length_control", "integrator", "accuracy"},
       "");
  only(scene.at("beam"), {"curve", "section", "material", "rest_shape", "axis", "axial_strain", "elements", "element"},
       "beam");
  read_curve(scene.at("beam"));
  if (scene.contains("gravity")) gravity_ = pair(scene.at("gravity"));
  gravity_share_.value = 1;
  gravity_share_.ramp = scene.value("gravity_ramp", 0.0);

  json joints = scene.value("sliding_joints", json::array());
  if (scene.contains("sliding_mass")) joints.push_back(scene.at("sliding_mass"));
  marks_.push_back(add_mark(0, false));
  const auto resting = [&](double from, double to) {
    for (const double x : between) {
      if (from < x && x < to) marks_.push_back(add_mark(x, false));
    }
  };
  double last = 0;
  for (const json& said : joints) {
    resting(last, said.at("position"));
    last = said.at("position");
    joints_.push_back(static_cast<int>(marks_.size()));
    marks_.push_back(add_mark(said.at("position"), true));
    joint(marks_.back(), said);
  }
  resting(last, length_);
  marks_.push_back(add_mark(length_, false));
  for (const json& said : scene.value("supports", json::array())) {
    support(said.at("at") == "start" ? marks_.front() : marks_.back(), said);
  }
  for (const json& said : scene.value("point_masses", json::array())) {
    if (said.at("node") != "end") throw std::invalid_argument("a mass is at the end only");
    marks_.back().mass += said.at("mass").get<double>();
  }
  if (degrees.size() != marks_.size() - 1) throw std::invalid_argument("a degree is wanted for each stretch");
  unknowns_ = free_;
  for (const int degree : degrees) {
    stretches_.emplace_back(section_, degree, static_cast<int>(points_per_degree * degree) + 4);
    unknowns_ += 2 * stretches_.back().bubbles();
  }
  q_.resize(coordinates_.size());
  rate_ = acceleration_ = q_;
}

}  // namespace judge
