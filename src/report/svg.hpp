#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sweepface/plot.hpp"

#include "report/colours.hpp"

// Pieces of SVG that plots are drawn with.
namespace sweepface::svg {

/// `content` is escaped; `more` are further attributes.
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view colour = kSoft, std::string_view more = "");
std::string line(double x1, double y1, double x2, double y2, std::string_view colour,
                 std::string_view more = "");
std::string dot(double x, double y, std::string_view colour, double radius = 3.5);
std::string framed(double width, double height, const std::string& title, const std::string& body);

/// The attribute for a series' dashes, or nothing.
std::string_view dashes(const Series& series);

/// The width of a UTF-8 text, in Latin letters.
double letters(std::string_view text);
/// Shortens a name to at most the width of `most` letters. Leaves out the middle, since names often
/// begin or end alike.
std::string shortened(const std::string& name, double most);

/// Draws the keys of a plot in lines from `x` to `right`, the first at `y`; returns where the last
/// is.
double addKeys(std::string& drawn, const std::vector<Series>& series, double x, double y,
               double right);

}  // namespace sweepface::svg
