#include "studies/harness/vtk.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include "scene/options.hpp"
#include "scene/shape.hpp"
#include "studies/harness/files.hpp"

namespace vlbeam {
namespace {

using Points = std::vector<ShapePoint>;

constexpr const char* head = "<?xml version=\"1.0\"?>\n";

void data_array(std::string& text, const std::string& attributes, const Points& points,
                const std::function<void(std::string&, const ShapePoint&)>& value) {
  text += "        <DataArray " + attributes + " format=\"ascii\">\n";
  for (const ShapePoint& point : points) {
    text += "          ";
    value(text, point);
    text += "\n";
  }
  text += "        </DataArray>\n";
}

std::string vector_text(const Point& v) {
  return number_text(v[0]) + " " + number_text(v[1]) + " " + number_text(v[2]);
}

std::string grid(const Points& points, std::size_t elements, int per_element) {
  const auto lines = elements * static_cast<std::size_t>(per_element);
  std::string text = head;
  text += "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <UnstructuredGrid>\n";
  text += "    <Piece NumberOfPoints=\"" + std::to_string(points.size()) + "\" NumberOfCells=\"" +
          std::to_string(lines) + "\">\n      <Points>\n";
  data_array(text, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", points,
             [](std::string& out, const ShapePoint& p) { out += vector_text(p.r); });
  text += "      </Points>\n      <Cells>\n        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i].element != points[i + 1].element) continue;
    text += "          " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  }
  text += "        </DataArray>\n        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= lines; ++i) text += "          " + std::to_string(2 * i) + "\n";
  text += "        </DataArray>\n        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  constexpr const char* line_cell = "          3\n";
  for (std::size_t i = 0; i < lines; ++i) text += line_cell;
  text += "        </DataArray>\n      </Cells>\n      <PointData Scalars=\"tension\" Vectors=\"velocity\">\n";
  const auto scalar = [&](const char* name, double ShapePoint::*member) {
    data_array(text, std::string("type=\"Float64\" Name=\"") + name + "\"", points,
               [member](std::string& out, const ShapePoint& p) { out += number_text(p.*member); });
  };
  scalar("material_coordinate", &ShapePoint::x);
  scalar("axial_strain", &ShapePoint::strain);
  scalar("curvature", &ShapePoint::curvature);
  scalar("tension", &ShapePoint::tension);
  data_array(text, "type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\"", points,
             [](std::string& out, const ShapePoint& p) { out += vector_text(p.v); });
  text += "      </PointData>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

std::string file_name(std::size_t i) {
  std::string digits = std::to_string(i);
  return "shape_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits + ".vtu";
}

}  // namespace

void write_vtk(const Scene& scene, const std::vector<Configuration>& shapes, int per_element,
               const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string series = head;
  series += "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    write_text(folder / file_name(i),
               grid(points_along(scene, shapes[i], per_element), shapes[i].weights.size(), per_element));
    series += "    <DataSet timestep=\"" + number_text(shapes[i].t) + "\" part=\"0\" file=\"" + file_name(i) + "\"/>\n";
  }
  series += "  </Collection>\n</VTKFile>\n";
  write_text(folder / "shape.pvd", series);
}

void write_shapes_csv(const Scene& scene, const std::vector<Configuration>& shapes, int per_element,
                      const std::filesystem::path& file) {
  constexpr std::array axes{"x", "y", "z"};
  const auto d = static_cast<std::size_t>(scene.dimension);
  write_file(file, [&](const TextSink& sink) {
    std::string text = "t [s],element [-],x [m]";
    for (std::size_t i = 0; i < d; ++i) text += std::string(",r_") + axes[i] + " [m]";
    for (std::size_t i = 0; i < d; ++i) text += std::string(",v_") + axes[i] + " [m/s]";
    text += ",axial_strain [-],curvature [1/m],tension [N]\n";
    for (const Configuration& shape : shapes) {
      for (const ShapePoint& point : points_along(scene, shape, per_element)) {
        text += number_text(shape.t) + "," + std::to_string(point.element) + "," + number_text(point.x);
        for (std::size_t i = 0; i < d; ++i) text += "," + number_text(point.r[i]);
        for (std::size_t i = 0; i < d; ++i) text += "," + number_text(point.v[i]);
        text += "," + number_text(point.strain) + "," + number_text(point.curvature) + "," +
                number_text(point.tension) + "\n";
      }
      sink(text);
      text.clear();
    }
    sink(text);
  });
}

}  // namespace vlbeam
