#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "sweepface/ode.hpp"

#include "bindings.hpp"

namespace sweepface::python {
namespace {

/// A basis at parameters u [N], or their derivatives of an order: [N, functions].
template <typename Basis>
py::array_t<double> functionsAt(const Basis& basis, const Doubles& u, int order) {
  if (order < 0 || order > 3)
    throw Failure(fmt::format("Derivatives are of orders 0 to 3, not {}.", order));
  return rowsAt(u, basis.at(0).size(), [&](double at, std::span<double> row) {
    if (!(at >= 0 && at <= 1)) throw Failure(fmt::format("u is between 0 and 1, not {}.", at));
    std::ranges::copy(basis.at(at, order), row.begin());
  });
}

/// A boundary curve and two curves that belong to it, all with the same number of points.
struct Curves {
  std::vector<Vec3> boundary, first, second;

  Curves(const Doubles& points, const Doubles& one, const Doubles& other, const char* names)
      : boundary(pointsFrom(points, "The boundary curve")),
        first(pointsFrom(one, names)),
        second(pointsFrom(other, names)) {
    if (first.size() != boundary.size() || second.size() != boundary.size())
      throw Failure(fmt::format("{} must have as many points as the boundary curve, {}.", names,
                                boundary.size()));
  }
};

py::tuple derivatives(const Doubles& boundary, const Doubles& control2, const Doubles& control3,
                      double u2, double u3) {
  Curves curves(boundary, control2, control3, "The control curves");
  for (std::size_t k = 0; k < curves.boundary.size(); ++k) {
    const auto [first, second] = valueOf(
        derivativesFromControls(curves.boundary[k], curves.first[k], curves.second[k], {u2, u3}));
    curves.first[k] = first, curves.second[k] = second;
  }
  return py::make_tuple(arrayOfPoints(curves.first), arrayOfPoints(curves.second));
}

py::tuple controls(const Doubles& boundary, const Doubles& first, const Doubles& second, double u2,
                   double u3) {
  Curves curves(boundary, first, second, "The derivatives");
  for (std::size_t k = 0; k < curves.boundary.size(); ++k) {
    std::tie(curves.first[k], curves.second[k]) =
        controlsFromDerivatives(curves.boundary[k], {curves.first[k], curves.second[k]}, {u2, u3});
    if (!isFinite(curves.first[k]) || !isFinite(curves.second[k]))
      throw Failure("The curves would not be finite; give other parameters or derivatives.");
  }
  return py::make_tuple(arrayOfPoints(curves.first), arrayOfPoints(curves.second));
}

py::tuple spacing(const Doubles& boundary, const Doubles& control2, const Doubles& control3,
                  double length) {
  const Curves curves(boundary, control2, control3, "The control curves");
  const auto [u2, u3] =
      valueOf(spacingFromChords(curves.boundary, curves.first, curves.second, length));
  return py::make_tuple(u2, u3);
}

}  // namespace

void addEquation(py::module_& m) {
  py::class_<SweepBasis>(m, "SweepBasis",
                         "The functions g1 to g6 of the sweep S(u) = sum of g_i(u) c_i, u in [0, "
                         "1], that solves rho S'''''' + eta S'''' + lambda S'' = 0: c1, c2, c3 are "
                         "S, S', S'' at u = 0 and c4, c5, c6 the same at u = 1.")
      .def(py::init([](double rho, double eta, double lambda, double length) {
             return valueOf(SweepBasis::make({rho, eta, lambda}, length));
           }),
           py::arg("rho") = 1, py::arg("eta") = 0, py::arg("lambda_") = 0, py::arg("length") = 1,
           "Shape parameters per unit length, and the length of the sweep. Always succeeds for "
           "eta / rho <= 0 and lambda / rho >= 0; refuses parameters near which there is no "
           "solution.")
      .def("__call__", &functionsAt<SweepBasis>, py::arg("u"), py::arg("order") = 0,
           "The functions at u [N], or their derivatives by u of an order up to 3: [N, 6].");
  py::class_<TangentBasis>(m, "TangentBasis",
                           "The functions g1 to g4 of eta S'''' + lambda S'' = 0, u in [0, 1], for "
                           "S and S' at u = 0, then at u = 1.")
      .def(py::init([](double eta, double lambda, double length) {
             return valueOf(TangentBasis::make({1, eta, lambda}, length));
           }),
           py::arg("eta") = 1, py::arg("lambda_") = 0, py::arg("length") = 1,
           "Always succeeds for lambda / eta <= 0; refuses parameters near which there is no "
           "solution.")
      .def("__call__", &functionsAt<TangentBasis>, py::arg("u"), py::arg("order") = 0,
           "The functions at u [N], or their derivatives by u of an order up to 3: [N, 4].");
  m.def("derivatives_from_controls", &derivatives, py::arg("boundary"), py::arg("control2"),
        py::arg("control3"), py::arg("u2"), py::arg("u3"),
        "First and second derivatives across a boundary curve, [N, 3] each: those of the parabolas "
        "through its points and the points of two control curves at parameters u2 and u3, all [N, "
        "3].");
  m.def("controls_from_derivatives", &controls, py::arg("boundary"), py::arg("first"),
        py::arg("second"), py::arg("u2"), py::arg("u3"),
        "The inverse of derivatives_from_controls.");
  m.def("spacing_from_chords", &spacing, py::arg("boundary"), py::arg("control2"),
        py::arg("control3"), py::arg("length"),
        "Parameters (u2, u3) of control curves [N, 3] by mean chord length, as a share of the "
        "sweep's length.");
}

}  // namespace sweepface::python
