#pragma once

#include <string>
#include <vector>

#include "sweepface/vec.hpp"

// Plots as inline SVG.
namespace sweepface {

struct Series {
  std::string name, colour;
  std::vector<Vec2> points;
  bool dots = false;  ///< marks the points
  int dashes = 0;     ///< 0: a solid line; below kDashes
};
inline constexpr int kDashes = 4;

struct Axis {
  std::string title;
  bool logarithmic = false;  ///< values that are not positive are left out
};

/// Curves over a common axis, without points that are not finite; empty if there is nothing to
/// show.
std::string linePlot(const std::string& title, const Axis& x, const Axis& y,
                     std::vector<Series> series);

/// A row for each name with a mark for each series: points[k].x is its value in row k. The values
/// start at 0; a vertical line marks `limit` if that is positive.
std::string rowPlot(const std::string& title, const std::string& axis,
                    const std::vector<std::string>& names, const std::vector<Series>& series,
                    double limit);

/// Plots of linePlot() two by two, as a file of its own.
std::string plotSheet(std::vector<std::string> plots);

/// Numbers that are easy to read, from no more than the smallest value to no less than the largest.
std::vector<double> niceTicks(double low, double high, bool logarithmic);

}  // namespace sweepface
