#include "studies/harness/histories.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/measures.hpp"

namespace vlbeam {
namespace {

std::string text_of(double t) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.4g", t);
  return text.data();
}

/// Central difference of the beam's length, one-sided at the ends.
double length_rate(const std::vector<Sample>& samples, std::size_t i) {
  const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, samples.size() - 1);
  return (samples[b].beam_length - samples[a].beam_length) / (samples[b].t - samples[a].t);
}

Json value_of(const std::vector<Sample>& samples, std::size_t i, const std::string& quantity) {
  const Sample& s = samples[i];
  if (quantity == "joint") return s.joint_position ? Json(*s.joint_position) : Json();
  if (quantity == "mass_x") return s.mass_position ? Json((*s.mass_position)[0]) : Json();
  if (quantity == "mass_y") return s.mass_position ? Json((*s.mass_position)[1]) : Json();
  if (quantity == "end_x") return s.end[0];
  if (quantity == "end_y") return s.end[1];
  if (quantity == "beam_length") return s.beam_length;
  if (quantity == "beam_length_rate") return length_rate(samples, i);
  if (quantity == "kinetic") return s.energy.kinetic;
  if (quantity == "axial") return s.energy.axial;
  if (quantity == "bending") return s.energy.bending;
  if (quantity == "strain") return s.energy.axial + s.energy.bending;
  if (quantity == "gravity") return s.energy.gravity;
  if (quantity == "total") return s.energy.total();
  throw std::invalid_argument("no quantity \"" + quantity + "\"");
}

}  // namespace

Table histories(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs,
                const std::vector<std::string>& quantities) {
  Table table{.name = name, .caption = caption, .columns = {"t"}, .curve = true};
  if (runs.empty()) return table;
  for (const Sample& sample : runs.front().result->samples) table.rows.push_back({sample.t});
  for (const NamedRun& run : runs) {
    const auto& samples = run.result->samples;
    for (const auto& quantity : quantities) {
      table.columns.push_back(quantity + "_" + run.name);
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.rows[i].push_back(i < samples.size() ? value_of(samples, i, quantity) : Json());
      }
    }
  }
  return table;
}

Table shapes(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs, int points) {
  Table table{.name = name, .caption = caption, .columns = {"share"}, .curve = true};
  for (int i = 0; i < points; ++i) table.rows.push_back({static_cast<double>(i) / (points - 1)});
  for (const NamedRun& run : runs) {
    for (const Configuration& shape : run.result->configurations) {
      table.columns.push_back(run.name + "_" + text_of(shape.t) + "_x");
      table.columns.push_back(run.name + "_" + text_of(shape.t) + "_y");
      for (auto& row : table.rows) {
        const auto r =
            point_at(shape, shape.x.front() + row.front().get<double>() * (shape.x.back() - shape.x.front()));
        row.push_back(r[0]);
        row.push_back(r[1]);
      }
    }
  }
  return table;
}

Table shape_nodes(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs) {
  Table table{.name = name, .caption = caption, .columns = {"run", "t", "x", "y", "joint"}, .curve = true};
  for (const NamedRun& run : runs) {
    for (const Configuration& shape : run.result->configurations) {
      const Sample* sample = sample_at(*run.result, shape.t);
      for (std::size_t k = 0; k < shape.x.size(); ++k) {
        const bool joint = sample && sample->joint_position && std::abs(*sample->joint_position - shape.x[k]) < 1e-9;
        table.rows.push_back({run.name, shape.t, shape.r[k][0], shape.r[k][1], joint ? 1 : 0});
      }
    }
  }
  return table;
}

}  // namespace vlbeam
