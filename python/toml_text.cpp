#include "python/toml_text.h"

#include <nlohmann/json.hpp>

namespace clatter {

namespace py = pybind11;

// TOML has the escapes of JSON. Only JSON keeps the control character 127.
static std::string quoted(const std::string& text) {
  std::string quoted = nlohmann::json(text).dump();
  for (std::size_t at; (at = quoted.find('\x7f')) != std::string::npos;) {
    quoted.replace(at, 1, "\\u007f");
  }
  return quoted;
}

namespace {

// A nested value. Python limits the depth.
struct Nesting {
  Nesting() {
    if (Py_EnterRecursiveCall(" in a value of the scene") != 0) throw py::error_already_set();
  }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() { Py_LeaveRecursiveCall(); }
};

}  // namespace

static std::string assignment(const py::handle& key, const py::handle& value) {
  return quoted(py::str(key)) + " = " + toml_text(value);
}

std::string toml_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value);
  // numpy.float64 is a float with another text.
  if (py::isinstance<py::float_>(value)) return py::repr(py::float_(value.cast<double>()));
  if (py::isinstance<py::str>(value)) return quoted(py::str(value));
  if (py::hasattr(value, "tolist")) return toml_text(value.attr("tolist")());
  const Nesting nesting;
  std::string text;
  const auto add = [&](const std::string& item) { text += (text.empty() ? "" : ", ") + item; };
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, item] : value.cast<py::dict>()) add(assignment(key, item));
    return "{" + text + "}";
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle item : value) add(toml_text(item));
    return "[" + text + "]";
  }
  throw py::type_error("a value of the scene is of type " +
                       std::string(py::str(py::type::of(value).attr("__name__"))) +
                       "; give a bool, a number, a str, a list or a dict");
}

std::string scene_text(const py::dict& scene) {
  std::string text;
  for (const auto& [key, value] : scene) text += assignment(key, value) + '\n';
  return text;
}

std::vector<Override> overrides_of(const py::dict& settings) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : settings) {
    overrides.push_back({py::str(key), toml_text(value)});
  }
  return overrides;
}

}  // namespace clatter
