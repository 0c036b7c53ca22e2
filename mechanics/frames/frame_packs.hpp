#pragma once

#include <array>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/pack.hpp"
#include "mechanics/frames/frame_table.hpp"

namespace vlbeam {

struct FrameNode;

/// Elements with frames of fixed length, four at a time.
class FramePacks {
 public:
  void clear() { packs_.clear(); }
  /// Puts element k, between node k and the next, behind those that are there.
  void add(int k, const FrameTable& table);

  /// Adds what the elements do to the nodes, from `force` on those of the first node, and to their angles from
  /// `torque` on. `turned` is the twist of each element of the beam, to within half a turn [rad].
  void add_forces(const FrameSection& section, const std::vector<FrameNode>& nodes, const std::vector<double>& turned,
                  double* force, double* torque) const;
  /// The same with what damping adds, at the rates of nodes, an array like `force`, and spins of nodes; returns the
  /// power that is lost [W].
  double add_damped_forces(const FrameSection& section, const std::vector<FrameNode>& nodes,
                           const std::vector<double>& turned, const double* rate, const std::vector<double>& spins,
                           double* force, double* torque) const;
  /// Adds `by` times the second derivative of their energy.
  void add_tangents(const FrameSection& section, const std::vector<FrameNode>& nodes, const std::vector<double>& turned,
                    double by, BeamMatrix<3>& tangent) const;

 private:
  struct Four {
    int count = 0;
    std::array<std::size_t, Pack::width> elements{};  ///< lanes beyond the last repeat it
    FrameTableOf<Pack> table;
  };
  std::vector<Four> packs_;
};

}  // namespace vlbeam
