#include "io/run_outcome.hpp"

#include <concepts>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "io/messages.hpp"

namespace vlbeam {
namespace {

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

// The members of all that is more than its bytes. A structured binding names every one of them: without a new one it
// does not compile.
auto members(Is<FlowSample> auto& of) {
  auto& [mass, end_angles, spin_momentum, loads, supports, torques, ledger] = of;
  return std::tie(mass, end_angles, spin_momentum, loads, supports, torques, ledger);
}
auto members(Is<SectionSample> auto& of) {
  auto& [axial, moment, shear, torque, stress, angles, tension, places, bearings, axles] = of;
  return std::tie(axial, moment, shear, torque, stress, angles, tension, places, bearings, axles);
}
auto members(Is<Sample> auto& of) {
  auto& [t, joint_position, mass_position, end, beam_length, beam_length_rate, winches, energy, discrete_total,
         momentum, angular_momentum, reactions, strains, joint, joints, flow, equilibrium, sections, extremes,
         assembly] = of;
  return std::tie(t, joint_position, mass_position, end, beam_length, beam_length_rate, winches, energy, discrete_total,
                  momentum, angular_momentum, reactions, strains, joint, joints, flow, equilibrium, sections, extremes,
                  assembly);
}
auto members(Is<AssemblySample> auto& of) {
  auto& [beams, bodies, links] = of;
  return std::tie(beams, bodies, links);
}
auto members(Is<Configuration::Rest> auto& of) {
  auto& [r, r_x] = of;
  return std::tie(r, r_x);
}
auto members(Is<Configuration::Rates> auto& of) {
  auto& [x, v, r_x, spins] = of;
  return std::tie(x, v, r_x, spins);
}
auto members(Is<Configuration> auto& of) {
  auto& [t, beam, x, r, r_x, angles, weights, rest, kinks, rates, actions, moments] = of;
  return std::tie(t, beam, x, r, r_x, angles, weights, rest, kinks, rates, actions, moments);
}
auto members(Is<Event> auto& of) {
  auto& [t, type, beam, joint, joint_position, weights, unit_fallback, energy_jump, discrete_jump, momentum_jump,
         relaxation, restored, before, after] = of;
  return std::tie(t, type, beam, joint, joint_position, weights, unit_fallback, energy_jump, discrete_jump,
                  momentum_jump, relaxation, restored, before, after);
}
auto members(Is<NewtonCounters> auto& of) {
  auto& [iterations, tangents, failures, longest, constraints, multipliers] = of;
  return std::tie(iterations, tangents, failures, longest, constraints, multipliers);
}
auto members(Is<SolverCounters> auto& of) {
  auto& [steps, rejected, limited_by, rejected_by, rhs_evaluations, smallest_step, newton] = of;
  return std::tie(steps, rejected, limited_by, rejected_by, rhs_evaluations, smallest_step, newton);
}
auto members(Is<Warning> auto& of) {
  auto& [kind, message, remedy] = of;
  return std::tie(kind, message, remedy);
}
auto members(Is<QuantityError> auto& of) {
  auto& [quantity, unit, time, mesh] = of;
  return std::tie(quantity, unit, time, mesh);
}
auto members(Is<RunError> auto& of) {
  auto& [time, mesh, allowed, motion, trusted_until, repeats, elements_wanted, no_time, no_mesh, quantities] = of;
  return std::tie(time, mesh, allowed, motion, trusted_until, repeats, elements_wanted, no_time, no_mesh, quantities);
}
auto members(Is<RunResult> auto& of) {
  auto& [status, failure, failure_time, samples, configurations, events, max_kinetic, max_energy_drift, slopes,
         pressures, frequencies, solver, warnings, error, timing] = of;
  return std::tie(status, failure, failure_time, samples, configurations, events, max_kinetic, max_energy_drift, slopes,
                  pressures, frequencies, solver, warnings, error, timing);
}
auto members(Is<RunOutcome> auto& of) {
  auto& [result, thrown] = of;
  return std::tie(result, thrown);
}

template <class T>
concept Trivial = std::is_trivially_copyable_v<T>;
template <class T>
concept Row = requires(T& row) {
  row.resize(1);
};
template <class T>
concept Shared = requires(T& pointer) {
  pointer.use_count();
};

class ByteWriter {
 public:
  explicit ByteWriter(const TextSink& sink) : sink_(sink) {}

  template <class T>
  void operator()(const T& value) {
    if constexpr (Trivial<T>) {
      append(&value, sizeof value);
    } else if constexpr (Row<T>) {
      (*this)(value.size());
      if constexpr (Trivial<typename T::value_type>) {
        append(value.data(), value.size() * sizeof(typename T::value_type));
      } else {
        for (const auto& item : value) (*this)(item);
      }
    } else if constexpr (Shared<T>) {
      (*this)(value != nullptr);
      if (value) (*this)(*value);
    } else {
      std::apply([this](const auto&... member) { ((*this)(member), ...); }, members(value));
    }
  }

 private:
  void append(const void* from, std::size_t count) { sink_({static_cast<const char*>(from), count}); }

  const TextSink& sink_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }

  template <class T>
  void operator()(T& value) {
    if constexpr (Trivial<T>) {
      take(&value, sizeof value);
    } else if constexpr (Row<T>) {
      std::size_t size = 0;
      (*this)(size);
      if (size > bytes_.size()) throw std::out_of_range("fewer bytes than were written");
      value.resize(size);
      if constexpr (Trivial<typename T::value_type>) {
        take(value.data(), size * sizeof(typename T::value_type));
      } else {
        for (auto& item : value) (*this)(item);
      }
    } else if constexpr (Shared<T>) {
      bool there = false;
      (*this)(there);
      if (!there) return;
      auto pointee = std::make_shared<std::remove_const_t<typename T::element_type>>();
      (*this)(*pointee);
      value = std::move(pointee);
    } else {
      std::apply([this](auto&... member) { ((*this)(member), ...); }, members(value));
    }
  }

 private:
  void take(void* to, std::size_t count) {
    if (count > bytes_.size()) throw std::out_of_range("fewer bytes than were written");
    if (count > 0) std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;
};

template <class T>
T from_bytes(std::string_view bytes) {
  T value;
  ByteReader reader(bytes);
  reader(value);
  if (!reader.at_end()) throw std::out_of_range("more bytes than were written");
  return value;
}

}  // namespace

RunOutcome RunOutcome::of(const std::function<RunResult()>& run) {
  try {
    return {.result = run(), .thrown = {}};
  } catch (const InvalidInput& error) {
    return {.result = {}, .thrown = {error.field, error.value, error.allowed}};
  } catch (const std::exception& error) {
    return {.result = {}, .thrown = {explained(error)}};
  }
}

RunResult RunOutcome::get() && {
  if (thrown.size() == 3) throw InvalidInput(thrown[0], thrown[1], thrown[2]);
  if (!thrown.empty()) throw std::runtime_error(thrown.front());
  return std::move(result);
}

std::string to_bytes(const RunOutcome& outcome) {
  std::string bytes;
  const TextSink sink = [&bytes](std::string_view piece) { bytes += piece; };
  ByteWriter{sink}(outcome);
  return bytes;
}
RunOutcome outcome_from_bytes(std::string_view bytes) { return from_bytes<RunOutcome>(bytes); }

void write_bytes(const Configuration& shape, const TextSink& sink) { ByteWriter{sink}(shape); }
Configuration configuration_from_bytes(std::string_view bytes) { return from_bytes<Configuration>(bytes); }

}  // namespace vlbeam
