#include "head.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"

#include "bindings.hpp"
#include "clip.hpp"

namespace sweepface::python {
namespace {

// ---- Angles from Python ----

struct Part {
  const char* name;
  Angles HeadPose::* angles;
};
constexpr Part kParts[]{{"head", &HeadPose::head},
                        {"left_eye", &HeadPose::leftEye},
                        {"right_eye", &HeadPose::rightEye}};

/// Angles of a part, for all frames or one a frame: yaw and pitch, and roll if it is told.
std::vector<Angles> anglesFrom(const py::handle& given, const std::string& part,
                               std::size_t frames) {
  const auto rows = as<Doubles>(given, ("The angles '" + part + "'").c_str(), "an array");
  const auto columns = rows.ndim() > 0 ? rows.shape(rows.ndim() - 1) : 0;
  const auto count = rows.ndim() == 2 ? static_cast<std::size_t>(rows.shape(0)) : 1;
  if (rows.ndim() < 1 || rows.ndim() > 2 || columns < 2 || columns > 3 ||
      (rows.ndim() == 2 && count != frames))
    throw Failure(
        fmt::format("The angles '{}' must be yaw, pitch and roll, or a row of these for each of {} "
                    "frames.",
                    part, frames));
  std::vector<Angles> angles;
  const double* x = rows.data();
  for (std::size_t f = 0; f < count; ++f, x += columns) {
    if (!std::all_of(x, x + columns, [](double angle) { return std::isfinite(angle); }))
      throw Failure("Angles must be finite numbers.");
    angles.push_back({x[0], x[1], columns == 3 ? x[2] : 0});
  }
  return angles;
}

py::array_t<double> quaternionsOf(const Doubles& angles) {
  if (angles.ndim() < 1 || angles.shape(angles.ndim() - 1) != 3)
    throw Failure("Angles must be an array of yaw, pitch and roll, [..., 3].");
  std::vector<py::ssize_t> shape(angles.shape(), angles.shape() + angles.ndim());
  shape.back() = 4;
  py::array_t<double> quaternions(shape);
  const double* from = angles.data();
  double* to = quaternions.mutable_data();
  for (py::ssize_t k = 0; k < angles.size() / 3; ++k, from += 3, to += 4) {
    if (!std::all_of(from, from + 3, [](double angle) { return std::isfinite(angle); }))
      throw Failure("Angles must be finite numbers.");
    std::ranges::copy(quaternionOf({from[0], from[1], from[2]}), to);
  }
  return quaternions;
}

// ---- Angles of clips ----

py::dict anglesOf(const Clip& clip, const py::object& times) {
  const ClipAngles angles(clip);
  py::dict table;
  for (const Part& part : kParts)
    table[part.name] = rowsOver(clip, times, 3, [&](double seconds, std::span<double> row) {
      const HeadPose stands = angles.at(clip, seconds);
      const Angles& a = stands.*part.angles;
      row[0] = a.yaw, row[1] = a.pitch, row[2] = a.roll;
    });
  return table;
}

}  // namespace

Looks Looks::from(const py::object& given, std::size_t frames) {
  Looks looks;
  if (given.is_none()) return looks;
  looks.poses_.resize(1);
  for (const auto& [key, value] : mappingFrom(given, "Where eyes look")) {
    const auto name = textFrom(key, "The name of an eye");
    const auto part = std::ranges::find(kParts, name, &Part::name);
    if (part == std::end(kParts))
      throw Failure("There is no '" + name + "' to look with; there are left_eye and right_eye.");
    const std::vector<Angles> angles = anglesFrom(value, name, frames);
    if (looks.poses_.size() == 1 && angles.size() != 1)
      looks.poses_.resize(frames, HeadPose(looks.poses_.front()));
    for (std::size_t f = 0; f < looks.poses_.size(); ++f)
      looks.poses_[f].*part->angles = angles[angles.size() == 1 ? 0 : f];
  }
  return looks;
}

HeadTrack headTrackOf(const Rig& rig, const Clip* clip, const py::object& pivot) {
  if (!clip) throw Failure("The head turns by the angles of a clip; give one.");
  const ClipAngles angles(*clip);
  if (!angles.head()) throw Failure("The clip has no angles of the head; leave head out.");
  HeadTrack track;
  for (const double time : clip->times) {
    track.times.push_back(time - clip->times.front());
    track.rotations.push_back(quaternionOf(angles.at(*clip, track.times.back()).head));
  }
  if (pivot.is_none()) {
    const Tessellation grid(rig.surface, 1);
    track.pivot = Box(grid.positions(blend(rig, {}))).centre();
    return track;
  }
  const auto place = as<Doubles>(pivot, "The pivot", "three numbers");
  const auto x = numbersIn(place, "The pivot");
  if (x.size() != 3 || !std::ranges::all_of(x, [](double c) { return std::abs(c) <= 1e30; }))
    throw Failure("The pivot must be three numbers of single precision.");
  track.pivot = {x[0], x[1], x[2]};
  return track;
}

void addHead(py::module_& m) {
  using namespace py::literals;
  m.def("quaternion_of", &quaternionsOf, "angles"_a,
        "x, y, z and w of the quaternions that turn by angles [..., 3] in radians: yaw about y "
        "(positive: to the face's left), pitch about x (down) and roll about z (to its right), as "
        "Ry Rx Rz: [..., 4].");
  py::reinterpret_borrow<py::class_<Clip>>(m.attr("Clip"))
      .def("angles", &anglesOf, "times"_a = py::none(),
           "Yaw, pitch and roll at times (those of the frames if not given) as quaternion_of takes "
           "them, by 'head', 'left_eye' and 'right_eye': [T, 3] each, 0 where the clip has none. "
           "Its columns, HeadYaw and so on, are left-handed.")
      .def_property_readonly(
          "turns_head", [](const Clip& clip) { return ClipAngles(clip).turnsHead(); },
          "Whether any angle of the head is ever other than 0.")
      .def_property_readonly(
          "turns_eyes", [](const Clip& clip) { return ClipAngles(clip).eyes(); },
          "The same for yaw and pitch of the eyes, which then count instead of eyeLook weights.");
}

}  // namespace sweepface::python
