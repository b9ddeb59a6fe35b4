#include "regions.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numeric>

#include "sweepface/io.hpp"
#include "sweepface/region_file.hpp"
#include "sweepface/timeline.hpp"

#include "bindings.hpp"
#include "codec/utf8.hpp"

namespace sweepface::python {

// ---- What others need of them ----

namespace {

std::vector<Region> regionsIn(const py::object& listed) {
  return as<std::vector<Region>>(listed, "Regions", "a list of regions");
}

}  // namespace

std::vector<Region> dividedRegionsIn(const py::object& listed) {
  std::vector<Region> regions = regionsIn(listed);
  std::vector<double> sums;
  for (const Region& region : regions) {
    sums.resize(std::max(sums.size(), region.shares.size()));
    for (std::size_t n = 0; n < region.shares.size(); ++n) sums[n] += region.shares[n];
  }
  if (!std::ranges::all_of(sums, [](double sum) { return std::abs(sum - 1) <= 1e-9; }))
    throw Failure(
        "The shares of these regions do not sum to 1 everywhere; take what Rig.divide "
        "makes of them, or Face.regions.");
  return regions;
}

std::vector<Region> dividedBy(const Rig& rig, const py::object& listed) {
  return valueOf(dividedFace(rig, regionsIn(listed)));
}

namespace {

/// An array of weights [F, R, K], [R, K] or, of a face that is not divided, [F, K].
struct WeightRows {
  Doubles rows;
  std::size_t frames, told, targets;  // told: for how many regions
};

WeightRows weightRowsIn(const Doubles& rows, std::optional<std::size_t> regions) {
  const auto sizeFromEnd = [&](py::ssize_t axis) {
    return axis <= rows.ndim() ? static_cast<std::size_t>(rows.shape(rows.ndim() - axis)) : 1;
  };
  if (regions) return {rows, sizeFromEnd(3), sizeFromEnd(2), sizeFromEnd(1)};
  return {rows, sizeFromEnd(2), 1, sizeFromEnd(1)};
}

void checkShape(const WeightRows& given, const Rig& rig, std::optional<std::size_t> regions) {
  if (given.rows.ndim() > (regions ? 3 : 2))
    throw Failure(regions ? "Weights of regions have at most three axes: frames, regions, targets."
                          : "Weights have at most two axes, frames and targets, unless the face is "
                            "divided into regions.");
  if (given.targets != rig.targets.size())
    throw Failure(fmt::format("There are {} weights a frame for {} targets.", given.targets,
                              rig.targets.size()));
  if (regions && given.told != 1 && given.told != *regions)
    throw Failure(fmt::format("There are weights of {} regions for a face that has {}.", given.told,
                              *regions));
}

}  // namespace

RegionalWeights RegionalWeights::from(const Rig& rig, const py::object& given,
                                      std::optional<std::size_t> regions) {
  const std::size_t targets = rig.targets.size(), all = regions.value_or(1);
  RegionalWeights made;
  const auto repeat = [&](std::span<const double> row) {
    made.weights.insert(made.weights.end(), row.begin(), row.end());
  };
  const bool isArray = !given.is_none() && !isMapping(given);
  const auto rows = isArray
                        ? as<Doubles>(given, "Weights",
                                      regions ? "None, a dict, or an array [K], [R, K] or [F, R, K]"
                                              : "None, a dict, or an array [K] or [F, K]")
                        : Doubles();
  if (!isArray || rows.ndim() < 2) {
    const Weights one = weightsFrom(rig, isArray ? py::object(rows) : given);
    for (std::size_t r = 0; r < all; ++r) repeat(one);
    return made;
  }
  const WeightRows told = weightRowsIn(rows, regions);
  checkShape(told, rig, regions);
  const std::span<const double> numbers(rows.data(), static_cast<std::size_t>(rows.size()));
  checkWeights(numbers);
  made.frames = told.frames;
  made.isOne = rows.ndim() == (regions ? 2 : 1);
  if (told.told == all) {
    repeat(numbers);
  } else {
    for (std::size_t f = 0; f < told.frames; ++f)
      for (std::size_t r = 0; r < all; ++r) repeat(numbers.subspan(f * targets, targets));
  }
  return made;
}

// ---- Painting ----

namespace {

Region regionFrom(const std::string& name, const Doubles& shares, double mass, double stiffness,
                  double delay) {
  if (!codec::isUtf8(name)) throw Failure("A region's name is a text without control characters.");
  const Matter matter{mass, stiffness, delay};
  valueOf(check(matter));
  const std::span<const double> numbers = numbersIn(shares, "Shares");
  return {name, matter, {numbers.begin(), numbers.end()}};
}

std::vector<Vec3> placesFrom(const py::object& given, const char* what) {
  if (given.is_none()) return {};
  return pointsFrom(as<Doubles>(given, what, "an array of three numbers a row, [N, 3]"), what);
}

Brush brushFrom(const py::object& parts, const py::object& points, const py::object& line,
                const py::object& curves, const py::object& nodes, double whole, double fade,
                const std::string& over) {
  using Names = std::vector<std::string>;
  if (over != "surface" && over != "space")
    throw Failure("A brush reaches over 'surface' or 'space', not '" + over + "'.");
  Brush brush;
  brush.parts = as<Names>(parts, "Parts", "a list of names");
  brush.points = placesFrom(points, "Points");
  brush.line = placesFrom(line, "A line");
  brush.curves = as<Names>(curves, "Curves", "a list of names");
  if (!nodes.is_none())
    for (const auto& [node, share] : mappingFrom(nodes, "Nodes"))
      brush.nodes.emplace_back(textFrom(node, "The name of a node"),
                               numberFrom(share, "The share of a node"));
  brush.whole = whole, brush.fade = fade, brush.alongSurface = over == "surface";
  return brush;
}

py::array_t<double> painted(const Rig& rig, const py::object& parts, const py::object& points,
                            const py::object& line, const py::object& curves,
                            const py::object& nodes, double whole, double fade,
                            const std::string& over, const py::object& bands) {
  const Brush brush = brushFrom(parts, points, line, curves, nodes, whole, fade, over);
  if (bands.is_none()) return arrayOf(released([&] { return valueOf(paint(rig, brush)); }));
  const int count = as<int>(bands, "bands", "a whole number");
  if (count < 1 || count > static_cast<int>(kMostRegions))
    throw Failure(fmt::format("bands must be from 1 to {}.", kMostRegions));
  const auto all = released([&] {
    if (count == 1) return std::vector<std::vector<double>>{valueOf(paint(rig, brush))};
    return valueOf(paintBands(rig, brush, count));
  });
  std::vector<double> shares;
  for (const std::vector<double>& band : all) shares.insert(shares.end(), band.begin(), band.end());
  return arrayOf(std::span<const double>(shares),
                 {count, static_cast<py::ssize_t>(shares.size()) / count});
}

std::vector<Region> parsedRegions(const Rig& rig, const std::string& text,
                                  const std::string& name) {
  const Released others;
  const auto regions = valueOf(parseRegions(text, name));
  // A timeline without regions is one for the whole face; elsewhere they were misspelt.
  if (regions.empty() && !isTimeline(text))
    throw Failure(name + " has no regions; see docs/regions.md.");
  auto divided = paintRegions(rig, regions);
  if (!divided) throw Failure(name + ": " + divided.error().message);
  return std::move(*divided);
}

// ---- Parts of targets ----

/// A rig with parts of its targets as targets of their own.
struct SplitRig {
  std::shared_ptr<const Rig> whole;
  std::shared_ptr<Rig> rig;
  std::size_t regions;
  RegionalTargets targets;
  std::vector<Index> still;  // targets that are not split
};

SplitRig splitRig(const std::shared_ptr<Rig>& whole, const py::object& regions,
                  const py::object& targets) {
  std::vector<Index> numbers(whole->targets.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  if (!targets.is_none()) {
    numbers.clear();
    for (const std::string& name :
         as<std::vector<std::string>>(targets, "Targets", "a list of names")) {
      const Index target = valueOf(findTarget(*whole, name));
      if (std::ranges::find(numbers, target) == numbers.end()) numbers.push_back(target);
    }
  }
  std::vector<Index> still;
  for (Index k = 0; k < static_cast<Index>(whole->targets.size()); ++k)
    if (std::ranges::find(numbers, k) == numbers.end()) still.push_back(k);
  const std::vector<Region> divided = dividedBy(*whole, regions);
  const Released others;
  const auto rig = std::make_shared<Rig>(*whole);
  auto parts = RegionalTargets::addTo(*rig, divided, numbers);
  return {whole, rig, divided.size(), std::move(parts), std::move(still)};
}

/// Refuses weights that a target without parts cannot show.
void checkWhole(const SplitRig& split, std::span<const double> weights) {
  const std::size_t targets = split.whole->targets.size();
  for (const Index k : split.still)
    for (std::size_t r = 1; r < split.regions; ++r)
      if (weights[r * targets + static_cast<std::size_t>(k)] !=
          weights[static_cast<std::size_t>(k)])
        throw Failure(
            fmt::format("The weights of '{}' differ between regions, but it is not split; "
                        "name it among the targets.",
                        split.whole->targets[k].name));
}

py::array_t<double> spreadOver(const SplitRig& split, const py::object& given) {
  const auto told = RegionalWeights::from(*split.whole, given, split.regions);
  const std::size_t in = split.regions * split.whole->targets.size(),
                    out = split.rig->targets.size();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(out)};
  if (!told.isOne) shape.insert(shape.begin(), static_cast<py::ssize_t>(told.frames));
  py::array_t<double> spread(shape);
  for (std::size_t f = 0; f < told.frames; ++f) {
    const auto weights = std::span(told.weights).subspan(f * in, in);
    checkWhole(split, weights);
    split.targets.spread(weights, {spread.mutable_data() + f * out, out});
  }
  return spread;
}

}  // namespace

void addRegions(py::module_& m) {
  using namespace py::literals;
  const Matter usual;
  py::class_<Region>(m, "Region",
                     "A part of a face that moves in its own way: its share of every node of the "
                     "wireframe, and its mass and stiffness compared with those of the rest.")
      .def(
          py::init(&regionFrom), "name"_a, "shares"_a, py::kw_only(), "mass"_a = usual.mass,
          "stiffness"_a = usual.stiffness, "delay"_a = usual.delay,
          "Shares [nodes] from 0 to 1, as Rig.paint returns them. mass and stiffness are 0.0001 to "
          "10,000; it sets out delay seconds later than the rest, at most 60.")
      .def_readonly("name", &Region::name)
      .def_property_readonly(
          "shares", [](const Region& region) { return arrayOf(region.shares); }, "[nodes]")
      .def_property_readonly("mass", [](const Region& region) { return region.matter.mass; })
      .def_property_readonly("stiffness",
                             [](const Region& region) { return region.matter.stiffness; })
      .def_property_readonly(
          "delay", [](const Region& region) { return region.matter.delay; }, "Seconds.")
      .def(py::pickle(
          [](const Region& region) {
            const auto& [mass, stiffness, delay] = region.matter;
            return py::make_tuple(region.name, arrayOf(region.shares), mass, stiffness, delay);
          },
          [](const py::tuple& told) {
            return regionFrom(told[0].cast<std::string>(), told[1].cast<Doubles>(),
                              told[2].cast<double>(), told[3].cast<double>(),
                              told[4].cast<double>());
          }))
      .def("__repr__", [](const Region& region) {
        return textOf(fmt::format(
            "<sweepface.Region '{}': mass {:g}, stiffness {:g}, delay {:g} s>", region.name,
            region.matter.mass, region.matter.stiffness, region.matter.delay));
      });
}

void addRegionsOfRigs(py::module_& m) {
  using namespace py::literals;
  const py::tuple none;
  py::reinterpret_borrow<py::class_<Rig, std::shared_ptr<Rig>>>(m.attr("Rig"))
      .def_property_readonly(
          "node_count", [](const Rig& rig) { return rig.surface.wireframe().nodes.size(); },
          "Nodes of the wireframe, of which regions have shares.")
      .def(
          "paint", &painted, py::kw_only(), "parts"_a = none, "points"_a = py::none(),
          "line"_a = py::none(), "curves"_a = none, "nodes"_a = py::none(), "whole"_a = 0,
          "fade"_a = 0, "over"_a = "surface", "bands"_a = py::none(),
          "Shares of the nodes [nodes] by a brush: 1 up to the distance whole from what is named, "
          "falling to 0 over the further distance fade; over 'surface' along the neutral's curves, "
          "over 'space' straight. parts are materials and groups of the source, points [N, 3] "
          "single places, line [N, 3] places joined by a line, curves names or numbers ('c12'), "
          "nodes a dict of names and exact shares. With bands, those of so many neighbouring bands "
          "that cover the face: [bands, nodes].")
      .def("divide", &dividedBy, "regions"_a,
           "The regions with the rest of the face first, if anything is left of it; their shares "
           "then sum to 1 at every node. Where regions overlap, each gets less in proportion.")
      .def("parse_regions", &parsedRegions, "text"_a, "name"_a = "The text",
           "Those of the 'regions' in a JSON text, which messages call by the name, with the rest "
           "first.")
      .def(
          "read_regions",
          [](const Rig& rig, const std::filesystem::path& path) {
            return parsedRegions(rig, valueOf(readFile(path)), path.string());
          },
          "path"_a, "The same from a file; it may be a timeline or an export of Audio2Face.");
  py::class_<SplitRig>(m, "RegionalTargets",
                       "A rig with parts of its targets as further targets, jawOpen@cheeks, so "
                       "that programs without "
                       "regions can move each region by its own weights.")
      .def(py::init(&splitRig), py::arg("rig").none(false), "regions"_a, "targets"_a = py::none(),
           "Splits targets, all if no names are given, in the regions as Rig.divide returns them.")
      .def_readonly("rig", &SplitRig::rig, "With the parts behind its own targets.")
      .def_property_readonly(
          "wholes", [](const SplitRig& split) { return arrayOf(split.targets.wholes()); },
          "The target that each of its targets is a part of, or itself.")
      .def("spread", &spreadOver, "weights"_a,
           "Weights of regions [R, K] or [F, R, K] as weights of its targets, in a row for each "
           "frame. Those of targets that are not split must be the same in all regions.");
}

}  // namespace sweepface::python
