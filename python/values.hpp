#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface::python {

namespace py = pybind11;

/// What Python sees as sweepface.Error.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A text for Python, with the bytes escaped that are not UTF-8, as those of paths may be.
py::str textOf(std::string_view text);

/// Leaves the interpreter to other threads. A thread that comes back after the interpreter has
/// ended waits for the process to end, too: Python would unwind it, which ends the process by
/// std::terminate.
class Released {
 public:
  Released() : state_(PyEval_SaveThread()) {}
  Released(const Released&) = delete;
  ~Released();

 private:
  PyThreadState* state_;
};
/// What `work()` returns, which must not touch Python.
template <typename Work>
auto released(const Work& work) {
  const Released others;
  return work();
}

/// A message as a sentence: some are made to stand behind the name of a file.
std::string sentenceOf(std::string message);

/// The value of a result; its error becomes an exception, as Python expects.
template <typename T>
T valueOf(Result<T> result) {
  if (!result) throw Failure(sentenceOf(std::move(result.error().message)));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// A Python object as a C++ value; messages say that `what` must be `kind`.
template <typename T>
T as(const py::handle& object, const char* what, const char* kind) {
  try {
    return py::cast<T>(object);
  } catch (const py::cast_error&) {
  } catch (const py::reference_cast_error&) {     // of None in a list
  } catch (const py::error_already_set& error) {  // NumPy's own, or of a mapping for a list
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError) &&
        !error.matches(PyExc_LookupError))
      throw;
  }
  throw Failure(std::string(what) + " must be " + kind + ".");
}
inline double numberFrom(const py::handle& object, const char* what) {
  return as<double>(object, what, "a number");
}
inline std::string textFrom(const py::handle& object, const char* what) {
  return as<std::string>(object, what, "a text");
}
/// Whether it has keys; tables of numbers that have keys, too, count as arrays.
bool isMapping(const py::object& object);
/// The keys and values of any mapping, copied: converting them may run code that changes it.
py::dict mappingFrom(const py::object& object, const char* what);

/// Fails unless there is such a patch.
void checkPatch(const Surface& surface, std::int64_t patch);
/// Fails unless edges can be cut into so many; 0: the source's own vertices.
void checkLevel(Index level);

/// The one of these that is not None, if any.
std::optional<Budget> budgetFrom(const py::object& vertices, const py::object& edgeLength,
                                 const py::object& error);

/// Fails if a file to be written has another extension.
void checkKind(const std::filesystem::path& path, const char* extension);

/// Warns as Python's own libraries do, so that programs can filter the sentences.
void warn(std::span<const std::string> sentences);

// ---- Arrays: whatever NumPy can turn into them goes in, new arrays come out ----

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The rows of an array [N × 3]; messages call it `what`.
std::vector<Vec3> pointsFrom(const Doubles& array, const char* what);
/// The numbers of an array [N].
std::span<const double> numbersIn(const Doubles& array, const char* what);

/// What motions are given, which know no names: weights [K], and the number of a weight.
Doubles weightsOfMotion(const py::object& given, const char* what);
std::size_t weightOfMotion(const py::object& given);

/// [N × 3]
py::array_t<double> arrayOfPoints(std::span<const Vec3> points);

/// An array of a shape whose sizes multiply to the number of values.
template <typename T>
py::array_t<T> arrayOf(std::span<const T> values, std::vector<py::ssize_t> shape) {
  return py::array_t<T>(std::move(shape), values.data());
}
template <typename T>
py::array_t<T> arrayOf(const std::vector<T>& values) {
  return arrayOf(std::span<const T>(values), {static_cast<py::ssize_t>(values.size())});
}

/// An array [N × columns], a row for each place, which `write(place, row)` fills.
template <typename Write>
py::array_t<double> rowsAt(const Doubles& places, std::size_t columns, const Write& write) {
  const std::span<const double> at = numbersIn(places, "Times and parameters");
  py::array_t<double> rows({at.size(), columns});
  double* row = rows.mutable_data();
  for (std::size_t k = 0; k < at.size(); ++k, row += columns) {
    if (std::isnan(at[k])) throw Failure("Times and parameters must be numbers, not nan.");
    write(at[k], std::span<double>(row, columns));
  }
  return rows;
}

// ---- Weights ----

/// Weights [K] from None, a dict of names and weights, or K numbers.
Weights weightsFrom(const Rig& rig, const py::object& given);
/// Refuses weights that are not finite or too large to be meant.
void checkWeights(std::span<const double> weights);

}  // namespace sweepface::python
