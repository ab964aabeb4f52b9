#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "app/runs/picture_scene.h"
#include "engine/dynamics/regular_times.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "python/gas.h"
#include "python/toml_text.h"

namespace py = pybind11;
using namespace py::literals;

namespace clatter {

namespace {

/// Asks Python some 20 times a second whether a signal handler has raised an exception. Python
/// handles signals on its main thread only.
class Signals {
 public:
  bool raised() {
    if (std::this_thread::get_id() != thread_ || raised_) return raised_;
    const auto now = Clock::now();
    if (now < due_) return false;
    due_ = now + std::chrono::milliseconds(50);
    const py::gil_scoped_acquire acquired;
    raised_ = PyErr_CheckSignals() != 0;
    return raised_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point due_ = Clock::now();
  std::atomic_bool raised_ = false;
};

/// Returns work(stop), which other threads of Python run beside. `stop` is made if a signal handler
/// raises an exception, which is then thrown.
template <class Work>
auto without_gil(const Work& work) {
  Signals signals;
  try {
    const py::gil_scoped_release released;
    return work(StopRequest([&signals] { return signals.raised(); }));
  } catch (const Interrupted&) {
    throw py::error_already_set();
  }
}

py::object from_json(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

template <class Vector>
py::array_t<double> array_of(const std::vector<Vector>& vectors) {
  constexpr py::ssize_t kSize = Vector::RowsAtCompileTime;
  static_assert(sizeof(Vector) == kSize * sizeof(double));
  const double* const first = vectors.empty() ? nullptr : vectors.front().data();
  return py::array_t<double>({static_cast<py::ssize_t>(vectors.size()), kSize}, first);
}

py::array_t<double> positions(Gas& gas) {
  return std::visit([](const auto& state) { return array_of(state.positions); }, gas.state());
}

py::array_t<double> velocities(Gas& gas) {
  return std::visit([](const auto& state) { return array_of(state.velocities); }, gas.state());
}

py::object spins(Gas& gas) {
  return std::visit(
      [](const auto& state) -> py::object {
        if (state.spins.empty()) return py::none();
        py::array_t<double> array = array_of(state.spins);
        if (array.shape(1) == 1) return array.attr("reshape")(-1);
        return array;
      },
      gas.state());
}

// A number of each particle, of its grain; `alike` if the particles are alike.
template <class Value>
py::array_t<double> numbers_of(Gas& gas, double alike, const Value& value) {
  return std::visit(
      [&](const auto& state) {
        std::vector<double> numbers(state.positions.size(), alike);
        std::ranges::transform(state.grains, numbers.begin(), value);
        return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
      },
      gas.state());
}

py::array_t<double> diameters(Gas& gas) {
  return numbers_of(gas, 1.0, [](const Grain& grain) { return 2.0 * grain.radius; });
}

py::array_t<double> masses(Gas& gas) {
  return numbers_of(gas, 1.0, [](const Grain& grain) { return grain.mass; });
}

// The elements of a list of names at places, as an array of text.
py::object names_at(const std::vector<std::string>& names,
                    const py::array_t<std::int64_t>& places) {
  return py::module_::import("numpy").attr("array")(names, "dtype"_a = "U")[places];
}

py::object species(Gas& gas) {
  const std::vector<std::string> names = gas.species();
  if (names.empty()) return py::none();
  return std::visit(
      [&](const auto& state) {
        std::vector<std::int64_t> places;
        for (const Grain& grain : state.grains) places.push_back(grain.species);
        return names_at(names, py::array_t<std::int64_t>(static_cast<py::ssize_t>(places.size()),
                                                         places.data()));
      },
      gas.state());
}

// Raises an error with its words. Bytes of file names that are no text become surrogates, as in
// os.fsdecode.
void raise(const char* type, const std::exception& error) {
  const auto words = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(error.what()));
  PyErr_SetObject(py::module_::import("clatter").attr(type).ptr(), words.ptr());
}

// Lets other exceptions pass, to the translators of pybind11.
void translate(std::exception_ptr exception) {
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const UserError& error) {
    raise("SceneError", error);
  } catch (const PhysicalStop& error) {
    raise("PhysicalStop", error);
  } catch (const RunError& error) {
    raise("RunError", error);
  }
}

Scene scene_of(const py::object& source, const std::vector<Override>& settings) {
  if (py::isinstance<py::dict>(source)) {
    return parse_scene(scene_text(source.cast<py::dict>()), "scene", settings);
  }
  return load_any_scene(py::module_::import("os").attr("fsencode")(source).cast<std::string>(),
                        settings);
}

// particles__count=500 is the key particles.count.
py::dict with_keywords(const py::object& set, const py::kwargs& keywords) {
  py::dict all;
  if (!set.is_none()) all.attr("update")(set);
  for (const auto& [name, value] : keywords) {
    all[py::str(name).attr("replace")("__", ".")] = value;
  }
  return all;
}

std::unique_ptr<Gas> load_gas(const py::object& source, std::uint64_t seed, const py::object& set,
                              const py::kwargs& keywords) {
  const Scene scene = scene_of(source, overrides_of(with_keywords(set, keywords)));
  return without_gil(
      [&](const StopRequest& stop) { return std::make_unique<Gas>(scene, seed, stop); });
}

std::unique_ptr<Gas> copy_of(Gas& gas) {
  return Gas::restored(gas.saved());
}

void run_until(Gas& gas, double time) {
  without_gil([&](const StopRequest& stop) { gas.run_until(time, stop); });
}

py::object measure_gas(Gas& gas, const std::optional<double>& duration) {
  return from_json(
      without_gil([&](const StopRequest& stop) { return gas.measure(duration, stop); }));
}

// The names of the species of the particles whose numbers are at a place of the records. The wall
// has none.
py::object names_of_particles(const EventTable& table, std::vector<std::string> names,
                              std::size_t place) {
  const auto wall = static_cast<std::int64_t>(names.size());
  names.emplace_back();
  std::vector<std::int64_t> places;
  const std::size_t size = record_size(table.quantities);
  for (std::size_t k = place; k < table.records.size(); k += size) {
    const double particle = table.records[k];
    places.push_back(particle < 0.0 ? wall : table.species[static_cast<std::size_t>(particle)]);
  }
  return names_at(
      names, py::array_t<std::int64_t>(static_cast<py::ssize_t>(places.size()), places.data()));
}

constexpr std::size_t kParticlePlace = 2;  // of the number in a record; the partner follows

// A structured array with a field of each quantity, or of each of its components if it is flat.
py::object events(Gas& gas, long count, bool flat) {
  const EventTable table =
      without_gil([&](const StopRequest& stop) { return gas.events(count, stop); });
  const auto size = static_cast<py::ssize_t>(record_size(table.quantities));
  const auto rows = static_cast<py::ssize_t>(table.records.size()) / size;
  const py::array_t<double> numbers({rows, size}, table.records.data());
  py::list fields;
  py::list columns;
  for (const auto& [name, unit, components, whole] : table.quantities) {
    const bool scalar = components.size() == 1 && components.front().empty();
    const char* const type = whole ? "i8" : "f8";
    for (const std::string& component : components) {
      columns.append(py::make_tuple(name + component, type));
    }
    const py::tuple vector = py::make_tuple(name, type, py::make_tuple(components.size()));
    fields.append(scalar ? py::tuple(py::make_tuple(name, type)) : vector);
  }
  const std::vector<std::string> names = gas.species();
  for (const char* field : {"species", "partner_species"}) {
    if (names.empty()) break;
    const auto longest = std::ranges::max(names, {}, &std::string::size).size();
    const py::tuple texts = py::make_tuple(field, "U" + std::to_string(longest));
    fields.append(texts);
    columns.append(texts);
  }
  py::object array = py::module_::import("numpy").attr("empty")(rows, "dtype"_a = fields);
  py::ssize_t place = 0;
  for (const auto& [name, unit, components, whole] : table.quantities) {
    const auto width = static_cast<py::ssize_t>(components.size());
    const bool scalar = width == 1 && components.front().empty();
    const py::object all = py::slice{py::none(), py::none(), py::none()};
    const py::object part =
        scalar ? py::object(py::int_(place)) : py::object(py::slice(place, place + width, 1));
    array[py::str(name)] = numbers[py::make_tuple(all, part)];
    place += width;
  }
  if (!names.empty()) {
    array["species"] = names_of_particles(table, names, kParticlePlace);
    array["partner_species"] = names_of_particles(table, names, kParticlePlace + 1);
  }
  return flat ? array.attr("view")(columns) : array;
}

py::array_t<unsigned char> draw_gas(Gas& gas, int width) {
  const Image image = without_gil([&](const StopRequest& stop) { return gas.draw(width, stop); });
  return py::array_t<unsigned char>({image.size.height, image.size.width, 4}, image.rgba.data());
}

/// The gas at regular times, see RegularTimes.
struct Frames {
  py::object gas;
  RegularTimes times;
  std::uint64_t next = 0;
  double until = 0.0;
};

Frames frames(const py::object& gas, double every, double until) {
  constexpr double kMost = 1e15;
  const double last = std::max(until, gas.cast<Gas&>().time());
  if (!(every > 0.0) || !(last / every < kMost)) {
    throw UserError({"frames"}, "there would be no end of frames",
                    "give an interval > 0 and a finite time");
  }
  return {gas, RegularTimes(every), 0, until};
}

py::object next_frame(Frames& frames) {
  Gas& gas = frames.gas.cast<Gas&>();
  frames.next = std::max(frames.next, frames.times.first_from(gas.time()));
  const double time = frames.times.of(frames.next);
  if (time > frames.until) throw py::stop_iteration();
  run_until(gas, time);
  ++frames.next;
  return frames.gas;
}

std::string description(Gas& gas) {
  return py::str("<clatter.Gas of {} particles at t = {}>")
      .format(particle_count(gas.state()), gas.time());
}

}  // namespace

// NOLINTNEXTLINE
PYBIND11_MODULE(clatter, module) {
  module.doc() =
      "Event-driven simulation of driven granular gases.\n\n"
      "Lengths are in particle diameters and masses in particle masses, as in the scene file. "
      "Time, speeds and temperatures follow from the scene.";
  module.attr("__version__") = CLATTER_VERSION;
  py::exception<UserError>(module, "SceneError", PyExc_ValueError).doc() =
      "An error in a scene, a key or an argument: place, problem and fix.";
  py::exception<RunError>(module, "RunError", PyExc_RuntimeError).doc() =
      "A task cannot continue although the input is correct.";
  py::exception<PhysicalStop>(module, "PhysicalStop", PyExc_RuntimeError).doc() =
      "A physical reason ends the run, for example inelastic collapse. The gas keeps its state, "
      "and may continue under other laws.";
  py::register_exception_translator(translate);

  py::class_<Frames>(module, "Frames", "Iterator of Gas.frames().")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", next_frame);

  py::class_<Gas>(module, "Gas",
                  "A gas of disks or spheres. clatter.load() makes one. Only one thread at a time "
                  "may use a gas; different gases run in parallel.")
      .def("__repr__", description)
      .def("__copy__", copy_of)
      .def("__deepcopy__", [](Gas& gas, const py::dict&) { return copy_of(gas); })
      .def(py::pickle([](Gas& gas) { return py::bytes(gas.saved()); },
                      [](const py::bytes& saved) { return Gas::restored(saved); }))
      .def_property_readonly("time", &Gas::time, "Simulation time, in units of time.")
      .def_property_readonly("temperature", &Gas::temperature,
                             "Granular temperature T = (m/DN) sum v^2 now, in units of energy, "
                             "with the particle mass m = 1.")
      .def_property_readonly("hash", &Gas::hash,
                             "Hash of the state now, 16 hexadecimal digits: state_hash in the "
                             "result of clatter measure. Equal runs have equal hashes.")
      .def_property_readonly("seed", &Gas::seed, "Seed of all random numbers of the run.")
      .def_property_readonly(
          "scene", [](Gas& gas) { return from_json(gas.scene_json()); },
          "The scene at the start as a dict, with every default and all changes of laws so far, as "
          "the key scene of a result. Lengths are in diameters.")
      .def_property_readonly("positions", positions,
                             "Centres now, in diameters: a copy, (N, D) float64, wrapped into the "
                             "box.")
      .def_property_readonly("velocities", velocities,
                             "Velocities now, in diameters per unit of time: a copy, (N, D) "
                             "float64.")
      .def_property_readonly("spins", spins,
                             "Angular velocities now, in radians per unit of time: a copy, (N,) "
                             "float64 for disks and (N, 3) for spheres. None if particles do not "
                             "spin.")
      .def_property_readonly("diameters", diameters,
                             "Diameters of the particles: a copy, (N,) float64. All are 1 without "
                             "species.")
      .def_property_readonly("masses", masses,
                             "Masses of the particles: a copy, (N,) float64. All are 1 without "
                             "species.")
      .def_property_readonly("species", species,
                             "Names of the species of the particles: a copy, (N,) text, so that "
                             "gas.positions[gas.species == \"large\"] are those of one species. "
                             "None without species.")
      .def("run_until", run_until, "time"_a,
           "Runs to a simulation time, with the [[change]] tables of the scene.\n\n"
           "Ctrl-C halts it within about 0.1 s with KeyboardInterrupt. The gas then is at a time "
           "before, and can continue. Other threads of Python run meanwhile. Raises SceneError "
           "for an earlier time, and PhysicalStop.")
      .def("frames", frames, "every"_a, "until"_a,
           "Iterates over the gas at the times 0, every, 2 every and so on up to `until`, in "
           "simulation time. It begins at the first of these times that is not before gas.time. "
           "These are the times of clatter measure --trajectory.")
      .def("measure", measure_gas, "duration"_a = py::none(),
           "Runs the gas on and measures it. Returns a dict with the keys and values of the JSON "
           "result of clatter measure.\n\n"
           "Means are averages over the simulation times from `start` to `start + duration`. "
           "start is the key measure.burn_in, or gas.time if that is later. duration is in "
           "simulation time, by default the key measure.duration. Afterwards the gas is at the "
           "end of this time. On a gas at time 0 the result is the one of clatter measure. The "
           "series of temperatures begins at gas.time and includes the burn-in. Collisions "
           "(key events) are those of the averaging time. docs/results.md describes the keys.\n\n"
           "The key performance has the CPU time of the whole process. Raises SceneError, RunError "
           "and PhysicalStop. These, and Ctrl-C, lose the averages and keep the gas.")
      .def("events", events, "n"_a, "flat"_a = false,
           "Runs the gas on for n collisions of particles and with walls. Returns them as a "
           "structured array, (n,): the quantities of an event log, described in "
           "docs/results.md. Vectors are fields with D components, or D fields with the names of "
           "the CSV columns if `flat`, as pandas.DataFrame needs. With species there are also the "
           "fields species and partner_species: names, empty for a wall.\n\n"
           "Afterwards the gas is at the time of the last of them. Raises PhysicalStop, SceneError "
           "for n < 1, and RunError if no more collisions occur. These, and Ctrl-C, lose the "
           "collisions and keep the gas.")
      .def(
          "set", [](Gas& gas, const py::dict& laws) { gas.change(overrides_of(laws)); }, "laws"_a,
          "Changes laws now, with the rules of [[change]] in the scene: a dict of keys and values, "
          "{\"particles.restitution\": 0.8}. All values change at once. Raises SceneError or "
          "PhysicalStop if the change is impossible; the old laws then remain.")
      .def("draw", draw_gas, "width"_a = 640,
           "The picture of the gas now, as by clatter render: (H, W, 4) uint8, RGBA, top row "
           "first. W is `width` in pixels; H follows the box.\n\n"
           "Averages, trails and angles of the scene's view are observed from time 0. Raises "
           "SceneError, and RunError without OpenGL.");

  module.def("load", load_gas, "scene"_a, "seed"_a = 1, "set"_a = py::none(),
             "The gas of a scene, at time 0.\n\n"
             "scene: path of a scene file or of a picture by clatter, name in the gallery, or a "
             "nested dict with the keys of a scene file. Files that a dict names are relative to "
             "the current folder.\n"
             "seed: seed of all random numbers, a whole number >= 0.\n"
             "set: dict of keys and values as in --set, {\"particles.count\": 500}. The keyword "
             "particles__count=500 is the same.\n\n"
             "Raises SceneError.");
}

}  // namespace clatter
