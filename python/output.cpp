#include "output.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace sweepface::python {
namespace {

constexpr py::ssize_t kNumber = sizeof(float), kVector = 3 * kNumber;

/// Whether an array has room for three floats a vertex, side by side, with nothing in two places.
bool hasRoom(const py::array& array, const std::vector<py::ssize_t>& shape) {
  using Api = py::detail::npy_api;
  if (!py::isinstance<py::array_t<float>>(array) || !array.writeable() ||
      !py::detail::check_flags(array.ptr(), Api::NPY_ARRAY_ALIGNED_) ||
      !std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()))
    return false;
  const py::ssize_t* const strides = array.strides() + array.ndim();
  const py::ssize_t vertices = shape[shape.size() - 2], stride = strides[-2];
  if (strides[-1] != kNumber || stride < kVector) return false;
  if (shape.size() == 2 || shape[0] < 2) return true;
  const py::ssize_t frames = shape[0], frameStride = strides[-3];
  return frameStride >= (vertices - 1) * stride + kVector ||
         (frameStride >= kVector && stride >= (frames - 1) * frameStride + kVector);
}

}  // namespace

Output::Output(py::array array) : array_(array), data_(static_cast<char*>(array.mutable_data())) {
  const auto sizeAt = [&](py::ssize_t axis) { return static_cast<std::size_t>(array.shape(axis)); };
  const py::ssize_t* const strides = array.strides() + array.ndim();
  vertices_ = sizeAt(array.ndim() - 2), stride_ = static_cast<std::size_t>(strides[-2]);
  frames_ = array.ndim() == 3 ? sizeAt(0) : 1;
  if (frames_ > 1) frameStride_ = static_cast<std::size_t>(strides[-3]);
}

Output Output::from(const py::object& given, const std::vector<py::ssize_t>& shape,
                    const char* what) {
  if (py::isinstance<py::bool_>(given) && py::cast<bool>(given))
    return Output(py::array_t<float>(shape));
  if (py::isinstance<py::bool_>(given) || given.is_none()) return {};
  if (py::isinstance<py::array>(given))
    if (const auto array = py::cast<py::array>(given); hasRoom(array, shape)) return Output(array);
  throw Failure(fmt::format(
      "{} must be written to a float32 array of shape {} whose rows go forwards in memory, with "
      "the numbers of a vertex side by side.",
      what, py::cast<std::string>(py::str(py::cast(shape)))));
}

VectorsOut Output::of(std::size_t frame) const {
  if (!data_) return {};
  return {reinterpret_cast<float*>(data_ + frame * frameStride_), static_cast<Index>(vertices_),
          stride_};
}

char* Output::end() const {
  if (frames_ == 0 || vertices_ == 0) return data_;
  return data_ + (frames_ - 1) * frameStride_ + (vertices_ - 1) * stride_ + kVector;
}

bool Output::crosses(const Output& other) const {
  if (!data_ || !other.data_ || data_ >= other.end() || other.data_ >= end()) return false;
  if (stride_ != other.stride_ || frameStride_ != other.frameStride_) return true;
  const auto frames = static_cast<std::ptrdiff_t>(frames_),
             rows = static_cast<std::ptrdiff_t>(vertices_);
  const auto row = static_cast<std::ptrdiff_t>(stride_),
             frame = static_cast<std::ptrdiff_t>(frameStride_);
  for (std::ptrdiff_t f = 1 - frames; f < frames; ++f) {
    const std::ptrdiff_t apart = other.data_ - data_ - f * frame;
    for (const std::ptrdiff_t v : {apart / row, apart / row + (apart < 0 ? -1 : 1)})
      if (std::abs(v) < rows && std::abs(apart - v * row) < kVector) return true;
  }
  return false;
}

}  // namespace sweepface::python
