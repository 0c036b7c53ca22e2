#include "io/vtk.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/files.hpp"
#include "io/text_writer.hpp"
#include "scene/assembly.hpp"
#include "scene/options.hpp"
#include "scene/shape.hpp"

namespace vlbeam {
namespace {

using Points = std::vector<ShapePoint>;

constexpr const char* file_head = "<?xml version=\"1.0\"?>\n";

TextWriter& operator<<(TextWriter& out, const Point& v) { return out << v[0] << " " << v[1] << " " << v[2]; }

template <class Of>
void data_array(const std::string& attributes, const Points& points, const Of& of, TextWriter& out) {
  out << "        <DataArray " << attributes << " format=\"ascii\">\n";
  for (const ShapePoint& point : points) out << "          " << std::invoke(of, point) << "\n";
  out << "        </DataArray>\n";
}

void write_grid(const Points& points, std::size_t elements, int per_element, TextWriter& out) {
  const auto lines = elements * static_cast<std::size_t>(per_element);
  out << file_head
      << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <UnstructuredGrid>\n"
      << "    <Piece NumberOfPoints=\"" << std::to_string(points.size()) << "\" NumberOfCells=\""
      << std::to_string(lines) << "\">\n      <Points>\n";
  data_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", points, &ShapePoint::r, out);
  out << "      </Points>\n      <Cells>\n        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i].element != points[i + 1].element) continue;
    out << "          " << std::to_string(i) << " " << std::to_string(i + 1) << "\n";
  }
  out << "        </DataArray>\n        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= lines; ++i) out << "          " << std::to_string(2 * i) << "\n";
  out << "        </DataArray>\n        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  constexpr const char* line_cell = "          3\n";
  for (std::size_t i = 0; i < lines; ++i) out << line_cell;
  out << "        </DataArray>\n      </Cells>\n      <PointData Scalars=\"tension\" Vectors=\"velocity\">\n";
  const auto scalar = [&](const char* name, double ShapePoint::*member) {
    data_array(std::string("type=\"Float64\" Name=\"") + name + "\"", points, member, out);
  };
  scalar("material_coordinate", &ShapePoint::x);
  scalar("axial_strain", &ShapePoint::strain);
  scalar("curvature", &ShapePoint::curvature);
  scalar("tension", &ShapePoint::tension);
  data_array(
      "type=\"Float64\" Name=\"shear\"", points, [](const ShapePoint& p) { return p.force.shear; }, out);
  data_array(
      "type=\"Float64\" Name=\"moment\"", points, [](const ShapePoint& p) { return p.force.moment; }, out);
  data_array("type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\"", points, &ShapePoint::v, out);
  out << "      </PointData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

std::string file_name(std::size_t i) {
  std::string digits = std::to_string(i);
  return "shape_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits + ".vtu";
}

}  // namespace

void write_vtk(const Scene& scene, const Shapes& shapes, int per_element, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string series = file_head;
  series += "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  std::size_t count = 0;
  const auto part_of = [&scene](const Configuration& shape) {
    if (!scene.assembly) return std::size_t{0};
    const auto& beams = scene.assembly->beams;
    return static_cast<std::size_t>(std::ranges::find(beams, shape.beam, &AssemblySpec::Beam::name) - beams.begin());
  };
  shapes([&](const Configuration& shape) {
    const std::string name = file_name(count++);
    write_file(folder / name, [&](const TextSink& sink) {
      TextWriter out(sink);
      write_grid(points_along(scene, shape, per_element), shape.weights.size(), per_element, out);
      out.flush();
    });
    series += "    <DataSet timestep=\"" + number_text(shape.t) + "\" part=\"" + std::to_string(part_of(shape)) +
              "\" file=\"" + name + "\"/>\n";
  });
  series += "  </Collection>\n</VTKFile>\n";
  write_text(folder / "shape.pvd", series);
}

void check_vtk_folder(const std::string& option, const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == "shape.pvd" || (name.starts_with("shape_") && name.ends_with(".vtu"));
    if (ours) check_own(option, entry.path(), "<VTKFile");
  }
}

void write_shapes_csv(const Scene& scene, const Shapes& shapes, int per_element, const std::filesystem::path& file) {
  constexpr std::array axes{"x", "y", "z"};
  const auto d = static_cast<std::size_t>(scene.dimension);
  write_file(file, [&](const TextSink& sink) {
    TextWriter out(sink);
    out << (scene.assembly ? "beam,t [s],element [-],x [m]" : "t [s],element [-],x [m]");
    for (std::size_t i = 0; i < d; ++i) out << ",r_" << axes[i] << " [m]";
    for (std::size_t i = 0; i < d; ++i) out << ",v_" << axes[i] << " [m/s]";
    out << ",axial_strain [-],curvature [1/m],tension [N],shear [N],moment [N m],torque [N m]\n";
    shapes([&](const Configuration& shape) {
      for (const ShapePoint& point : points_along(scene, shape, per_element)) {
        if (scene.assembly) out << shape.beam << ",";
        out << shape.t << "," << std::to_string(point.element) << "," << point.x;
        for (std::size_t i = 0; i < d; ++i) out << "," << point.r[i];
        for (std::size_t i = 0; i < d; ++i) out << "," << point.v[i];
        out << "," << point.strain << "," << point.curvature << "," << point.tension << "," << point.force.shear << ","
            << point.force.moment << "," << point.force.torque << "\n";
      }
    });
    out.flush();
  });
}

}  // namespace vlbeam
