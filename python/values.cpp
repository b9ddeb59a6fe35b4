#include "values.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <thread>

#include "sweepface/evaluator.hpp"
#include "sweepface/io.hpp"

namespace sweepface::python {

void warn(std::span<const std::string> sentences) {
  const py::handle category(PyExc_UserWarning);
  for (const std::string& sentence : sentences)
    py::module_::import("warnings").attr("warn")(textOf(sentence), category);
}

py::str textOf(std::string_view text) {
  PyObject* const decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace");
  if (!decoded) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

std::string sentenceOf(std::string message) {
  if (message.empty() || message.ends_with('.') || message.ends_with('?')) return message;
  if (message[0] >= 'a' && message[0] <= 'z') message[0] += 'A' - 'a';
  return message + '.';
}

Released::~Released() {
  try {
    PyEval_RestoreThread(state_);
  } catch (...) {  // the unwinding by which Python ends threads
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

py::dict mappingFrom(const py::object& object, const char* what) {
  if (!isMapping(object)) throw Failure(std::string(what) + " must be a dict.");
  return py::reinterpret_steal<py::dict>(PyDict_Copy(py::dict(object).ptr()));
}

bool isMapping(const py::object& object) {
  return py::hasattr(object, "keys") && !py::hasattr(object, "__array__");
}

void checkPatch(const Surface& surface, std::int64_t patch) {
  if (patch >= 0 && patch < surface.patchCount()) return;
  throw Failure(
      fmt::format("There is no patch {}; there are {}, from 0 on.", patch, surface.patchCount()));
}

void checkLevel(Index level) {
  if (level >= 0 && level <= kMostLevel) return;
  throw Failure(fmt::format("A level is between 0 and {}, not {}.", kMostLevel, level));
}

void checkKind(const std::filesystem::path& path, const char* extension) {
  if (extensionOf(path) == extension) return;
  throw Failure(path.string() + " must end in " + extension + "; choose another name.");
}

std::optional<Budget> budgetFrom(const py::object& vertices, const py::object& edgeLength,
                                 const py::object& error) {
  std::optional<Budget> budget;
  for (const auto& [kind, value] :
       {std::pair(Budget::Kind::vertices, vertices),
        std::pair(Budget::Kind::edgeLength, edgeLength), std::pair(Budget::Kind::error, error)}) {
    if (value.is_none()) continue;
    if (budget) throw Failure("Give one of vertices, edge_length and error.");
    budget = Budget{kind, numberFrom(value, "A budget")};
  }
  return budget;
}

std::vector<Vec3> pointsFrom(const Doubles& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw Failure(std::string(what) + " must be an array of three numbers a row, [N, 3].");
  std::vector<Vec3> points(static_cast<std::size_t>(array.shape(0)));
  const double* x = array.data();
  for (Vec3& p : points) p = {x[0], x[1], x[2]}, x += 3;
  return points;
}

std::span<const double> numbersIn(const Doubles& array, const char* what) {
  if (array.ndim() > 1) throw Failure(std::string(what) + " must be an array of numbers, [N].");
  return {array.data(), static_cast<std::size_t>(array.size())};
}

Doubles weightsOfMotion(const py::object& given, const char* what) {
  return as<Doubles>(given, what, "an array [K]; Rig.weights makes one of a dict");
}

std::size_t weightOfMotion(const py::object& given) {
  return as<std::size_t>(given, "A weight",
                         "a whole number from 0; Rig.target tells that of a name");
}

py::array_t<double> arrayOfPoints(std::span<const Vec3> points) {
  py::array_t<double> array({points.size(), std::size_t{3}});
  double* x = array.mutable_data();
  for (const Vec3& p : points) x[0] = p.x, x[1] = p.y, x[2] = p.z, x += 3;
  return array;
}

void checkWeights(std::span<const double> weights) {
  if (!std::ranges::all_of(weights, isPlausibleWeight))
    throw Failure("Weights must be numbers between -1,000,000 and 1,000,000.");
}

namespace {

Weights weightsByName(const Rig& rig, const py::dict& given) {
  Weights weights(rig.targets.size());
  for (const auto& [key, value] : given) {
    const std::string name = textFrom(key, "The name of a target");
    weights[static_cast<std::size_t>(valueOf(findTarget(rig, name)))] =
        numberFrom(value, ("The weight of '" + name + "'").c_str());
  }
  return weights;
}

}  // namespace

Weights weightsFrom(const Rig& rig, const py::object& given) {
  Weights weights(rig.targets.size());
  if (isMapping(given)) {
    weights = weightsByName(rig, mappingFrom(given, "Weights"));
  } else if (!given.is_none()) {
    const auto array = as<Doubles>(given, "Weights", "None, a dict, or an array of numbers [K]");
    const std::span<const double> numbers = numbersIn(array, "Weights");
    if (numbers.size() != weights.size())
      throw Failure("There are " + std::to_string(numbers.size()) + " weights for " +
                    std::to_string(weights.size()) +
                    " targets; give one each, or a dict of their names.");
    std::ranges::copy(numbers, weights.begin());
  }
  checkWeights(weights);
  return weights;
}

}  // namespace sweepface::python
