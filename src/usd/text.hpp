#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace sweepface::usd {

/// The text of a USD layer, or of some of its prims, line by line.
class Text {
 public:
  using Lines = std::initializer_list<std::string_view>;

  /// Within `depth` prims.
  explicit Text(int depth = 0) : depth_(depth) {}

  /// `def Mesh "name"`, its metadata, and a brace; close() ends it.
  void open(std::string_view type, std::string_view name, Lines metadata = {});
  void close();
  /// A property with its value: `uniform token[] joints = ["head"]`.
  void set(std::string_view property, std::string_view value, Lines metadata = {});
  /// A property without one.
  void declare(std::string_view property);
  /// A property with other values over time; addSample() them, then close().
  void openSamples(std::string_view property);
  void addSample(std::string_view time, std::string_view value);
  /// Prims of the same depth, which are given up.
  void append(Text&& prims);

  int depth() const { return depth_; }
  std::string take() { return std::move(text_); }

 private:
  void separate();
  std::string indent() const { return std::string(4 * static_cast<std::size_t>(depth_), ' '); }
  void addMetadata(Lines metadata);

  int depth_;
  std::string text_;
};

}  // namespace sweepface::usd
