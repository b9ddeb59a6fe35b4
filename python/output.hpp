#pragma once

#include "sweepface/evaluator.hpp"

#include "values.hpp"

namespace sweepface::python {

/// Where the vectors of all frames are written: a float32 array [V × 3], or [F × V × 3]. None if
/// they are not wanted.
class Output {
 public:
  /// Nothing, a new array or the one that was given; messages call it `what`.
  static Output from(const py::object& given, const std::vector<py::ssize_t>& shape,
                     const char* what);

  bool isWanted() const { return data_ != nullptr; }
  const py::object& array() const { return array_; }
  VectorsOut of(std::size_t frame) const;
  /// Whether the two may write to the same memory. They may be parts of the same rows.
  bool crosses(const Output& other) const;

 private:
  Output() = default;
  explicit Output(py::array array);
  char* end() const;

  py::object array_ = py::none();
  char* data_ = nullptr;
  std::size_t frames_ = 0, frameStride_ = 0, vertices_ = 0, stride_ = 0;  // strides in bytes
};

}  // namespace sweepface::python
