#pragma once

#include <filesystem>
#include <string>

#include "io/shapes.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Writes shapes as a series that ParaView opens: one shape_NNNN.vtu (VTK XML, ASCII) each, and shape.pvd, which holds
/// their times and appears last. Points have material_coordinate [m], axial_strain [-], curvature [1/m], tension [N]
/// and velocity [m/s]; an element is `per_element` lines. The folder is made where it is not there. Throws
/// std::runtime_error where a file cannot be written.
void write_vtk(const Scene& scene, const Shapes& shapes, int per_element, const std::filesystem::path& folder);

/// Throws InvalidInput, naming the `option`, where the folder has a file of such a name that is not VTK's.
void check_vtk_folder(const std::string& option, const std::filesystem::path& folder);

/// Writes the same points as a table: t, element, x, r, v, axial_strain, curvature, tension, with units in its first
/// line.
void write_shapes_csv(const Scene& scene, const Shapes& shapes, int per_element, const std::filesystem::path& file);

}  // namespace vlbeam
