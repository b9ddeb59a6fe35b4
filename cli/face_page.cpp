#include "face_page.hpp"

#include "lod_mesh.hpp"

namespace sweepface::cli {

Result<void> FacePage::layOut(const Page::Plan& plan, PictureSize panel) {
  const RenderArguments& a = what_.arguments;
  PictureSize size = Page::sizeFor(panel, plan);
  if (!a.size.empty()) {
    const Result<PictureSize> wanted = parseSize(a.size);
    if (!wanted) return std::unexpected(wanted.error());
    size = *wanted;
  }
  Result<Page> page = Page::make(size, plan);
  if (!page) return std::unexpected(page.error());
  page_ = std::move(*page);
  const Surface& surface = what_.rig.surface;
  if (auto ok = checkFineness(surface, a.lod); !ok) return ok;
  // A close-up shows part of a larger picture; more than twice as fine, shadows take too long.
  const int scale = a.close.empty() ? 1 : 2;
  const PictureSize whole{scale * page_->panel().width, scale * page_->panel().height};
  Index lod = a.lod > 0 ? a.lod : lodFor(surface, what_.style, whole);
  while (lod > 1 && !checkFineness(surface, lod)) --lod;
  scenes_.emplace(what_.rig, lod);
  pictures_ = plan.columns * plan.rows;
  return {};
}

Result<std::vector<Vec3>> FacePage::shown(std::span<const double> weights) const {
  const std::string& close = what_.arguments.close;
  if (close.empty()) return scenes_->drawn(weights);
  const std::vector<Vec3> points = scenes_->points(weights);
  const Result<std::vector<Index>> moved = region(close);
  if (!moved) return std::unexpected(moved.error());
  // A single vertex has no extent from which to derive the camera's distance.
  std::vector<Vec3> near;
  for (const Index v : scenes_->around(*moved)) near.push_back(points[v]);
  return near;
}

Result<void> FacePage::shoot(const Studio& studio, const Camera& camera, Index column, Index row,
                             const std::string& caption, std::span<const PictureBox> boxes) {
  Result<Image> image = studio.shoot(camera, panel());
  if (!image) return std::unexpected(image.error());
  drawBoxes(*image, boxes);
  page_->place(column, row, *image, caption);
  bar_.show("rendering", static_cast<double>(++done_) / pictures_);
  return {};
}

}  // namespace sweepface::cli
