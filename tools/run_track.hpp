#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// What a quantity is of.
enum class TrackKind {
  place,  ///< counts in what a run may be off in space
  force,  ///< at one place: its errors change their sign from mesh to mesh, and have no order
  other,
};

/// What two runs of a scene are compared by: quantities over time, each a point of up to several numbers.
struct Track {
  struct Row {
    std::string quantity, unit;
    TrackKind kind = TrackKind::place;
    std::vector<double> t;                    ///< [s]
    std::vector<std::vector<double>> values;  ///< one a time; NaN where the quantity is not there
  };
  std::vector<Row> rows;
};

/// Times at which runs keep shapes to be compared by: some of the scene's samples.
std::vector<double> probe_times(const Scene& scene);
/// Places on the beam in one of its shapes, at even shares of its length, one behind another.
std::vector<double> probes(const Scene& scene, const Configuration& shape);

/// The end, the joints, the masses, what winches have paid out, angles, energies and the largest forces of the samples,
/// reactions, places and forces of links by their names, frequencies, and the shape at `times`, as probes() gives it.
/// Of statics the first and the last equilibrium, as times 0 and 1, and the shape as it is drawn and at last: a chain
/// may hang in nearly one shape under all of its loads.
Track track_of(const Scene& scene, const RunResult& result, const std::vector<double>& times,
               const std::vector<std::vector<double>>& shapes);

/// Largest distance of two rows up to each of their times, as far as both go and both are there.
std::vector<double> largest_distance(const Track::Row& a, const Track::Row& b);
/// The same from where the row starts.
std::vector<double> largest_way(const Track::Row& row);

}  // namespace vlbeam
