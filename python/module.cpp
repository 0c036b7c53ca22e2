// The binding behind the Python package vlbeam: scenes and reports pass as JSON text, samples as arrays.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <future>
#include <limits>
#include <map>
#include <thread>

#include "io/quantity.hpp"
#include "io/schema.hpp"
#include "scene/names.hpp"
#include "scene/sample_quantities.hpp"
#include "scene/shape.hpp"
#include "tools/checked_run.hpp"
#include "tools/converge.hpp"
#include "tools/interrupt.hpp"
#include "tools/own_sweep.hpp"
#include "tools/scene_library.hpp"
#include "tools/sweep.hpp"
#include "vlbeam/vlbeam.hpp"

namespace py = pybind11;

namespace vlbeam {
namespace {

using Shape = std::vector<py::ssize_t>;

/// An array that owns these numbers: they are moved, not copied.
py::array_t<double> array_of(std::vector<double> numbers, const Shape& shape) {
  auto* kept = new std::vector<double>(std::move(numbers));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<double>*>(p); });
  return py::array_t<double>(shape, kept->data(), owner);
}

/// Does the work on another thread, without Python's lock. `tell` is called with it, 20 times a second, to say how far
/// the work is. Ctrl-C, or an exception of `tell`, asks the work to stop and is raised once it has stopped.
template <class Work>
auto without_lock(const Work& work, const std::function<void(int)>& stop, const std::function<void()>& tell) {
  std::future<decltype(work())> result;
  std::exception_ptr raised;
  {
    const py::gil_scoped_release unlocked;
    result = std::async(std::launch::async, work);
    while (!raised && result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      const py::gil_scoped_acquire locked;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        tell();
      } catch (const py::error_already_set&) {
        raised = std::current_exception();
      }
    }
    if (raised) {
      stop(SIGINT);
      result.wait();
      stop(0);
    }
  }
  if (raised) std::rethrow_exception(raised);
  return result.get();
}

int jobs_or_processors(int jobs) {
  return jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// A run and its arrays.
class Run {
 public:
  Run(const std::string& text, std::optional<bool> check, const py::object& progress) : scene_(parse_scene(text)) {
    std::atomic<bool> go_on{true};
    std::atomic<double> reached{0};
    const auto at_step = [&](double t) {
      reached = t;
      return go_on.load();
    };
    const auto tell = [&] {
      if (!progress.is_none() && scene_.analysis == Analysis::dynamics) progress(reached / scene_.duration, "");
    };
    const auto run = [&] {
      return check.value_or(has_automatic_steps(scene_)) ? checked_run(scene_, at_step, {}, jobs_or_processors(0))
                                                         : simulate(scene_, at_step);
    };
    result_ = without_lock(
        run, [&](int signal) { go_on = signal == 0; }, tell);
    quantities_ = sample_quantities(scene_);
  }

  std::string status() const { return std::string(to_string(result_.status)); }
  std::string title() const { return scene_.title; }
  int dimension() const { return scene_.dimension; }
  std::string failure() const { return result_.failure; }
  double failure_time() const { return result_.failure_time; }
  std::string summary() const { return run_summary(scene_, result_); }
  std::string report_text() const {
    const py::gil_scoped_release unlocked;
    return report(scene_, result_);
  }
  std::string csv() const {
    const py::gil_scoped_release unlocked;
    return samples_csv(scene_, result_);
  }

  /// (path, unit, description) of all that was sampled.
  std::vector<std::array<std::string, 3>> paths() const {
    std::vector<std::array<std::string, 3>> list;
    for (const SampleQuantity& quantity : quantities_) {
      if (!quantity.columns.empty()) list.push_back({quantity.path, quantity.unit, quantity.description});
    }
    return list;
  }

  /// Samples of a quantity: shape (samples,), (samples, components) or (samples, vectors, components); NaN where it is
  /// not there.
  py::array_t<double> samples(const std::string& path) const {
    for (const SampleQuantity& quantity : quantities_) {
      if (quantity.path != path || quantity.columns.empty()) continue;
      const std::size_t width = quantity.columns.size();
      std::vector<double> numbers(width * result_.samples.size(), std::numeric_limits<double>::quiet_NaN());
      std::vector<double> values(width);
      for (std::size_t i = 0; i < result_.samples.size(); ++i) {
        if (quantity.values(result_.samples[i], values.data())) {
          std::copy(values.begin(), values.end(), numbers.begin() + static_cast<std::ptrdiff_t>(i * width));
        }
      }
      Shape shape{static_cast<py::ssize_t>(result_.samples.size())};
      if (quantity.shape == SampleShape::vector && width > 1) shape.push_back(static_cast<py::ssize_t>(width));
      if (quantity.shape == SampleShape::vectors) {
        shape.push_back(static_cast<py::ssize_t>(width / quantity.dimension));
        shape.push_back(static_cast<py::ssize_t>(quantity.dimension));
      }
      return array_of(std::move(numbers), shape);
    }
    throw py::key_error(path);
  }

  /// Samples of one number, by the name that `vlbeam converge` and `vlbeam plot` know it by: "end.y".
  py::array_t<double> column(const std::string& name) const {
    const Quantity quantity = find_quantity(scene_, name, "quantity");
    std::vector<double> numbers;
    numbers.reserve(result_.samples.size());
    for (const Sample& sample : result_.samples) numbers.push_back(quantity.of(sample));
    return array_of(std::move(numbers), {static_cast<py::ssize_t>(result_.samples.size())});
  }

  /// (name, unit) of every single number that was sampled, the time left out.
  std::vector<std::pair<std::string, std::string>> columns() const {
    std::vector<std::pair<std::string, std::string>> list;
    for (const Quantity& quantity : quantities(scene_)) list.emplace_back(quantity.name, quantity.unit);
    return list;
  }

  /// Of every single number over all steps: name to (least, its time, largest, its time); empty where the scene does
  /// not ask for it.
  std::map<std::string, std::array<double, 4>> extremes() const {
    std::map<std::string, std::array<double, 4>> found;
    if (result_.samples.empty() || !result_.samples.back().extremes) return found;
    for (const Quantity& quantity : quantities(scene_)) {
      const Extreme& of = (*result_.samples.back().extremes)[quantity.number];
      found[quantity.name] = {of.least, of.at_least, of.largest, of.at_largest};
    }
    return found;
  }

  std::vector<double> shape_times() const {
    std::vector<double> times;
    for (const Configuration& shape : result_.configurations) times.push_back(shape.t);
    return times;
  }

  /// Points along the axis of a shape that was kept.
  py::dict shape(std::size_t i, int points) const {
    if (points < 1) throw InvalidInput("points", std::to_string(points), "it must be 1 or more");
    const std::vector<ShapePoint> along = points_along(scene_, result_.configurations.at(i), points);
    const auto n = static_cast<py::ssize_t>(along.size());
    const auto numbers = [&](const auto& of) {
      std::vector<double> values;
      for (const ShapePoint& point : along) values.push_back(std::invoke(of, point));
      return array_of(std::move(values), {n});
    };
    const auto vectors = [&](Point ShapePoint::*member) {
      std::vector<double> values;
      for (const ShapePoint& point : along) {
        values.insert(values.end(), (point.*member).begin(), (point.*member).begin() + scene_.dimension);
      }
      return array_of(std::move(values), {n, scene_.dimension});
    };
    py::dict found;
    found["t"] = result_.configurations.at(i).t;
    if (const std::string& beam = result_.configurations.at(i).beam; !beam.empty()) found["beam"] = beam;
    found["x"] = numbers(&ShapePoint::x);
    found["r"] = vectors(&ShapePoint::r);
    found["r_x"] = vectors(&ShapePoint::r_x);
    found["v"] = vectors(&ShapePoint::v);
    found["strain"] = numbers(&ShapePoint::strain);
    found["tension"] = numbers(&ShapePoint::tension);
    found["curvature"] = numbers(&ShapePoint::curvature);
    found["shear"] = numbers([](const ShapePoint& point) { return point.force.shear; });
    found["moment"] = numbers([](const ShapePoint& point) { return point.force.moment; });
    found["torque"] = numbers([](const ShapePoint& point) { return point.force.torque; });
    return found;
  }

 private:
  Scene scene_;
  RunResult result_;
  std::vector<SampleQuantity> quantities_;
};

std::string converge_text(const std::string& text, const std::string& quantity, double error, bool relative,
                          std::optional<double> at, bool horizon, int jobs, std::optional<double> limit,
                          const py::object& progress) {
  const Scene scene = parse_scene(text);
  std::atomic<int> runs{0};
  const ConvergeOptions options{.quantity = quantity,
                                .error = error,
                                .relative = relative,
                                .at = at,
                                .horizon = horizon,
                                .jobs = jobs_or_processors(jobs),
                                .seconds = limit.value_or(std::numeric_limits<double>::infinity()),
                                .on_level = [&](const ConvergeLevel&) { ++runs; }};
  const auto tell = [&] {
    if (!progress.is_none()) progress(-1.0, std::to_string(runs) + " runs done");
  };
  return without_lock([&] { return pretty(convergence_to_json(scene, converge(scene, options))); }, ask_to_stop, tell);
}

std::string sweep_text(const std::string& text, int jobs, const py::object& progress) {
  const SweepPlan plan = sweep_from_json(parse_json(text), ".");
  std::atomic<std::size_t> done{0};
  const auto tell = [&] {
    const double whole = static_cast<double>(plan.cases.size());
    if (progress.is_none()) return;
    progress(static_cast<double>(done) / whole, std::to_string(done) + " of " + std::to_string(plan.cases.size()));
  };
  return without_lock(
      [&] {
        std::vector<Json> cases(plan.cases.size());
        run_tasks("sweep", std::vector<double>(cases.size(), 1.0), jobs_or_processors(jobs), [&](std::size_t i) {
          cases[i] = run_sweep_case(plan, i);
          ++done;
        });
        return pretty({{"quantities", plan.quantities}, {"cases", cases}});
      },
      ask_to_stop, tell);
}

std::string schema_text(const std::string& of) {
  if (of == "scene") return pretty(scene_schema());
  if (of == "run") return pretty(run_schema());
  if (of == "converge") return pretty(converge_schema());
  if (of == "sweep") return pretty(sweep_schema());
  throw InvalidInput("schema", "\"" + of + "\"", "there are: scene, run, converge, sweep");
}

}  // namespace
}  // namespace vlbeam

PYBIND11_MODULE(_vlbeam, module) {
  using namespace vlbeam;
  module.attr("version") = provenance().at("program").get<std::string>().substr(std::string("vlbeam ").size());

  py::object type = py::exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  type.attr("__module__") = "vlbeam";
  static const py::handle invalid_input = type.release();  // it outlives the module
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InvalidInput& error) {
      const py::object value = invalid_input(error.what());
      value.attr("field") = error.field;
      value.attr("value") = error.value;
      value.attr("allowed") = error.allowed;
      PyErr_SetObject(invalid_input.ptr(), value.ptr());
    }
  });

  py::class_<Run>(module, "Run")
      .def(py::init<const std::string&, std::optional<bool>, const py::object&>())
      .def_property_readonly("title", &Run::title)
      .def_property_readonly("dimension", &Run::dimension)
      .def_property_readonly("status", &Run::status)
      .def_property_readonly("failure", &Run::failure)
      .def_property_readonly("failure_time", &Run::failure_time)
      .def("summary", &Run::summary)
      .def("report", &Run::report_text)
      .def("csv", &Run::csv)
      .def("paths", &Run::paths)
      .def("samples", &Run::samples)
      .def("column", &Run::column)
      .def("columns", &Run::columns)
      .def("extremes", &Run::extremes)
      .def("shape_times", &Run::shape_times)
      .def("shape", &Run::shape);
  module.def("converge", &converge_text);
  module.def("sweep", &sweep_text);
  module.def("schema", &schema_text);
  module.def("scene",
             [](const std::string& folder, const std::string& name) { return library_scene_text(folder, name); });
  module.def("scenes", [](const std::string& folder) {
    std::vector<std::pair<std::string, std::string>> list;
    for (const LibraryScene& scene : library_scenes(folder)) list.emplace_back(scene.name, scene.title);
    return list;
  });
}
