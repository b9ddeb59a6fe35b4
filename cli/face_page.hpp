#pragma once

#include "output.hpp"
#include "render.hpp"

namespace sweepface::cli {

/// A page of pictures of one face. Call layOut() before anything is drawn.
class FacePage {
 public:
  explicit FacePage(const Rendering& what) : what_(what), bar_(what.arguments.quiet) {}

  /// `panel` is the pictures' size if none was asked for.
  Result<void> layOut(const Page::Plan& plan, PictureSize panel);

  PictureSize panel() const { return page_->panel(); }
  const FaceScenes& scenes() const { return *scenes_; }

  /// The vertices that move most under the targets whose names contain `name`.
  Result<std::vector<Index>> region(std::string_view name) const {
    return scenes_->region(name, what_.following.count);
  }
  /// The points that a picture of an expression has to show.
  Result<std::vector<Vec3>> shown(std::span<const double> weights) const;

  Result<void> shoot(const Studio& studio, const Camera& camera, Index column, Index row,
                     const std::string& caption, std::span<const PictureBox> boxes = {});
  /// What the style's colours mean.
  void addLegend() { page_->addLegend(scenes_->legend(what_.style)); }
  void addScale(double top, std::string_view title) { page_->addScale(top, title); }
  const Image& image() const { return page_->image(); }

 private:
  const Rendering& what_;
  ProgressBar bar_;
  std::optional<Page> page_;
  std::optional<FaceScenes> scenes_;
  int pictures_ = 1, done_ = 0;
};

}  // namespace sweepface::cli
