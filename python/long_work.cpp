#include "long_work.hpp"

namespace sweepface::python {

LongWork::LongWork(py::object progress) : progress_(std::move(progress)) {
  if (!progress_.is_none() && !PyCallable_Check(progress_.ptr()))
    throw Failure("progress must be a function of what is going on and how far it is.");
}

std::function<void(std::string_view, double)> LongWork::report() {
  return [this](std::string_view what, double done) {
    const std::scoped_lock lock(telling_);
    what_ = what, done_ = done, isNew_ = true;
  };
}

void LongWork::attend() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  std::unique_lock lock(telling_);
  if (!isNew_ || progress_.is_none()) return;
  isNew_ = false;
  const std::string what = what_;
  const double done = done_;
  lock.unlock();
  progress_(what, done);
}

}  // namespace sweepface::python
