#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <optional>

#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"
#include "sweepface/motion.hpp"
#include "sweepface/picture.hpp"

#include "command.hpp"
#include "following.hpp"
#include "lod_mesh.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct RenderArguments {
  std::string face, output, weights, views = "front", style = "shaded", size, from, close;
  std::optional<std::string> to;
  std::vector<std::string> compare, laws, boxes;
  FollowingArguments following;
  int lod = 0, frames = 5;
  bool quiet = false;
};

void addOptions(CLI::App& app, RenderArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output, "The .png file to write");
  addWeights(app, a.weights);
  app.add_option("--view,--views", a.views,
                 "From where: front, side, three-quarter, back, or AZIMUTH,ELEVATION in degrees; "
                 "several, separated by commas, stand beside each other")
      ->capture_default_str()
      ->type_name("VIEW,...");
  app.add_option("--style", a.style,
                 "What is shown: shaded, patches, wireframe, joins, normals, zebra; with --compare "
                 "also error and angle, or with --arcs, --eyes or --combine, what they change")
      ->capture_default_str()
      ->type_name("STYLE");
  app.add_option("--size", a.size, "Of the whole picture, in pixels, 16 to 16384 each way")
      ->check(notEmpty())
      ->type_name("WxH");
  app.add_option("--close", a.close,
                 "Show nothing but what the targets move whose names contain NAME")
      ->check(notEmpty())
      ->type_name("NAME");
  addFollowing(app, a.following);
  addLod(app, a.lod, "Cut every edge of the source into N; by the size if not given");
  app.add_option(
         "--compare", a.compare,
         "Show the meshes that it was made from beside it: the neutral, then expressions or "
         "folders of them")
      ->type_name("NEUTRAL [TARGET...]");
  CLI::Option* to = app.add_option("--to", a.to, "Show the way from one expression to this one")
                        ->type_name("NAME=W,...");
  app.add_option("--from", a.from, "Where it starts; the neutral if not given")
      ->needs(to)
      ->type_name("NAME=W,...");
  oneEachTime(
      app.add_option("--law", a.laws,
                     "How it moves: newton, brake, accelerate-brake, linear; several, separated by "
                     "commas, stand one above the other; newton if not given"))
      ->delimiter(',')
      ->needs(to)
      ->type_name("LAW,...");
  app.add_option("--frames", a.frames, "How many pictures there are on the way, 2 to 32")
      ->transform(wholeNumber(2, 32))
      ->needs(to)
      ->capture_default_str()
      ->type_name("N");
  oneEachTime(
      app.add_option("--box", a.boxes,
                     "Draw the same box into each: round what the targets move whose names contain "
                     "NAME, or at X,Y,W,H, shares of the picture from its upper left corner"))
      ->needs(to)
      ->type_name("NAME|X,Y,W,H");
  for (const char* other : {"--compare", "--weights"}) app.get_option(other)->excludes(to);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n"
      "  sweepface render face.sweep -o smile.png --weights smile=1 --view three-quarter\n"
      "  sweepface render face.sweep -o views.png --views front,side,40,10 --style joins\n"
      "  sweepface render face.sweep -o error.png --style error --compare neutral.obj targets/\n"
      "  sweepface render face.sweep -o strip.png --to jawOpen=1 --law linear,newton --box jaw");
}

bool isHeat(Style style) { return style == Style::error || style == Style::angle; }

/// The command: a page of pictures of one rig.
class Renderer {
 public:
  Renderer(const RenderArguments& a, const Rig& rig, const Following& following, Style style,
           std::vector<View> views)
      : a_(a),
        rig_(rig),
        following_(following),
        style_(style),
        views_(std::move(views)),
        bar_(a.quiet) {}

  Result<Image> make() {
    if (a_.to) return strips();
    Result<Weights> weights = parseWeights(rig_, a_.weights);
    if (!weights) return std::unexpected(weights.error());
    const Weights plain = *weights;
    following_.apply(*weights);
    if (!a_.compare.empty()) return comparison(*weights);
    return isHeat(style_) ? followed(plain, *weights) : portraits(*weights);
  }

 private:
  /// The page and the scenes for its pictures. `panel` is the pictures' size if none is given.
  Result<void> layOut(const Page::Plan& plan, PictureSize panel) {
    PictureSize size = Page::sizeFor(panel, plan);
    if (!a_.size.empty()) {
      const Result<PictureSize> wanted = parseSize(a_.size);
      if (!wanted) return std::unexpected(wanted.error());
      size = *wanted;
    }
    Result<Page> page = Page::make(size, plan);
    if (!page) return std::unexpected(page.error());
    page_ = std::move(*page);
    if (auto ok = checkFineness(rig_.surface, a_.lod); !ok) return ok;
    Index lod = a_.lod > 0 ? a_.lod : lodFor(rig_.surface, style_, page_->panel());
    while (lod > 1 && !checkFineness(rig_.surface, lod)) --lod;
    scenes_.emplace(rig_, lod);
    pictures_ = plan.columns * plan.rows;
    return {};
  }

  /// What a picture has to show of an expression.
  Result<std::vector<Vec3>> shown(std::span<const double> weights) const {
    if (a_.close.empty()) return scenes_->drawn(weights);
    const std::vector<Vec3> points = scenes_->points(weights);
    const Result<std::vector<Index>> region = scenes_->region(a_.close);
    if (!region) return std::unexpected(region.error());
    // A vertex alone has no size that would tell how far the eye must be.
    std::vector<Vec3> near;
    for (const Index v : scenes_->around(*region)) near.push_back(points[v]);
    return near;
  }

  Index viewCount() const { return static_cast<Index>(views_.size()); }

  Result<Image> portraits(const Weights& weights) {
    const bool keyed = style_ == Style::wireframe || style_ == Style::joins;
    const Page::Plan plan{viewCount(), 1, viewCount() > 1, keyed};
    if (auto ok = layOut(plan, viewCount() > 1 ? PictureSize{640, 800} : PictureSize{960, 1200});
        !ok)
      return std::unexpected(ok.error());
    const Result<Studio> studio = Studio::make(scenes_->scene(weights, style_));
    if (!studio) return std::unexpected(studio.error());
    const auto points = shown(weights);
    if (!points) return std::unexpected(points.error());
    const auto cameras = frameCameras(*points, views_, page_->panel());
    for (Index k = 0; k < viewCount(); ++k)
      if (auto ok = shoot(*studio, cameras[k], k, 0, plan.captions ? nameOf(views_[k]) : ""); !ok)
        return std::unexpected(ok.error());
    if (keyed) page_->addLegend(scenes_->legend(style_));
    return page_->image();
  }

  Result<void> shoot(const Studio& studio, const Camera& camera, Index column, Index row,
                     const std::string& caption) {
    const Result<Image> image = studio.shoot(camera, page_->panel());
    if (!image) return std::unexpected(image.error());
    page_->place(column, row, *image, caption);
    bar_.show("rendering", static_cast<double>(++done_) / pictures_);
    return {};
  }

  // ---- Beside the original ----

  Result<Image> comparison(const Weights& weights) {
    const std::vector<std::string> targets(a_.compare.begin() + 1, a_.compare.end());
    const Result<RigSource> read = readMeshes(a_.compare.front(), targets, bar_);
    if (!read) return std::unexpected(read.error());
    const Result<std::vector<Vec3>> positions = originalPositions(rig_, read->rig, weights);
    if (!positions) return std::unexpected(positions.error());
    return beside({"original", *positions, diagonal(read->rig.neutral)}, "recreated", weights);
  }

  /// What arcs and the like change of the plain blend.
  Result<Image> followed(const Weights& plain, const Weights& weights) {
    const Tessellation grid(rig_.surface, 1);
    const auto places = [&](const Weights& w) {
      return sourcePositions(rig_, grid, blend(rig_, w), w);
    };
    PolygonMesh rest;
    rest.positions = places({});
    return beside({"straight", places(plain), diagonal(rest)},
                  a_.following.arcs == "on" ? "on arcs" : "followed", weights);
  }

  /// What the face is compared with.
  struct Original {
    std::string name;
    std::vector<Vec3> positions;
    double diagonal;
  };

  Result<Image> beside(const Original& original, const std::string& name, const Weights& weights) {
    const bool heat = isHeat(style_);
    const bool keyed = heat || style_ == Style::wireframe || style_ == Style::joins;
    const bool oneView = viewCount() == 1;
    const Page::Plan plan{oneView ? 2 : viewCount(), oneView ? 1 : 2, true, keyed};
    if (auto ok = layOut(plan, {640, 800}); !ok) return std::unexpected(ok.error());

    HeatMap map = heat ? scenes_->heatMap(weights, original.positions, style_)
                       : HeatMap{scenes_->scene(weights, style_), 0, 0, {}};
    const auto points = shown(weights);
    if (!points) return std::unexpected(points.error());
    const auto cameras = frameCameras(*points, views_, page_->panel());
    const Result<Studio> first = Studio::make(scenes_->original(original.positions));
    if (!first) return std::unexpected(first.error());
    const Result<Studio> second = Studio::make(std::move(map.scene));
    if (!second) return std::unexpected(second.error());
    for (Index k = 0; k < viewCount(); ++k) {
      const std::string view = oneView ? "" : ", " + nameOf(views_[k]);
      const Index column = oneView ? 1 : k, row = oneView ? 0 : 1;
      if (auto ok = shoot(*first, cameras[k], k, 0, original.name + view); !ok)
        return std::unexpected(ok.error());
      if (auto ok = shoot(*second, cameras[k], column, row, name + view); !ok)
        return std::unexpected(ok.error());
    }
    if (style_ == Style::error && a_.compare.empty())
      map.title = fmt::format("distance from the straight blend, {:.3g} at worst", map.worst);
    if (style_ == Style::error)
      map.title += fmt::format(" ({:.2g} % of the diagonal)", 100 * map.worst / original.diagonal);
    if (heat)
      page_->addScale(map.top, map.title);
    else if (keyed)
      page_->addLegend(scenes_->legend(style_));
    return page_->image();
  }

  // ---- On the way from one expression to another ----

  Result<Image> strips() {
    const Result<std::vector<Motion>> motions = makeMotions();
    if (!motions) return std::unexpected(motions.error());
    const auto rows = static_cast<Index>(motions->size());
    if (auto ok = layOut({a_.frames, rows, true, false}, {384, 480}); !ok)
      return std::unexpected(ok.error());
    auto points = shown(motions->front().from());
    const auto end = shown(motions->front().to());
    if (!points || !end) return std::unexpected((points ? end : points).error());
    std::ranges::copy(*end, std::back_inserter(*points));
    const Camera camera = frameCamera(*points, views_.front(), page_->panel());
    const auto boxes = makeBoxes(camera, motions->front());
    if (!boxes) return std::unexpected(boxes.error());
    for (Index row = 0; row < rows; ++row)
      for (Index k = 0; k < a_.frames; ++k)
        if (auto ok = frame((*motions)[row], camera, *boxes, k, row); !ok)
          return std::unexpected(ok.error());
    return page_->image();
  }

  Result<std::vector<Motion>> makeMotions() const {
    const Result<Weights> from = parseWeights(rig_, a_.from), to = parseWeights(rig_, *a_.to);
    if (!from) return std::unexpected(from.error());
    if (!to) return std::unexpected(to.error());
    std::vector<Motion> motions;
    for (const std::string& name : a_.laws.empty() ? std::vector<std::string>{"newton"} : a_.laws) {
      const Result<TimeLaw> law = timeLawFromName(name);
      if (!law) return std::unexpected(law.error());
      Result<Motion> motion = Motion::make(*from, *to, *law, 1);
      if (!motion) return std::unexpected(motion.error());
      motions.push_back(std::move(*motion));
    }
    return motions;
  }

  Result<void> frame(const Motion& motion, const Camera& camera,
                     const std::vector<PictureBox>& boxes, Index column, Index row) {
    const double time = static_cast<double>(column) / (a_.frames - 1);
    Weights weights(motion.size());
    motion.at(time, weights);
    following_.apply(weights);
    const Result<Studio> studio = Studio::make(scenes_->scene(weights, style_));
    if (!studio) return std::unexpected(studio.error());
    Result<Image> image = studio->shoot(camera, page_->panel());
    if (!image) return std::unexpected(image.error());
    drawBoxes(*image, boxes);
    page_->place(column, row, *image,
                 fmt::format("{}: {:.0f} % of the time, {:.0f} % of the way", nameOf(motion.law()),
                             100 * time, 100 * progress(motion.law(), time).position));
    bar_.show("rendering", static_cast<double>(++done_) / pictures_);
    return {};
  }

  Result<std::vector<PictureBox>> makeBoxes(const Camera& camera, const Motion& motion) const {
    std::vector<PictureBox> boxes;
    for (const std::string& text : a_.boxes) {
      const Result<PictureBox> box = makeBox(text, camera, motion);
      if (!box) return std::unexpected(box.error());
      boxes.push_back(*box);
    }
    return boxes;
  }

  /// Given in numbers, or round what some targets move in either expression.
  Result<PictureBox> makeBox(const std::string& text, const Camera& camera,
                             const Motion& motion) const {
    if (text.find(',') != text.npos) return parseBox(text);
    const Result<std::vector<Index>> region = scenes_->region(text);
    if (!region) return std::unexpected(region.error());
    std::vector<Vec3> places;
    for (const auto weights : {motion.from(), motion.to()}) {
      const std::vector<Vec3> all = scenes_->points(weights);
      for (const Index v : *region) places.push_back(all[v]);
    }
    return boxAround(places, camera, page_->panel());
  }

  const RenderArguments& a_;
  const Rig& rig_;
  const Following& following_;
  Style style_;
  std::vector<View> views_;
  ProgressBar bar_;
  std::optional<Page> page_;
  std::optional<FaceScenes> scenes_;
  int pictures_ = 1, done_ = 0;
};

Result<int> runRender(const RenderArguments& a) {
  const Result<Style> style = styleFromName(a.style);
  if (!style) return std::unexpected(style.error());
  const Result<std::vector<View>> views = parseViews(a.views);
  if (!views) return std::unexpected(views.error());
  if (a.to && isHeat(*style))
    return fail(
        fmt::format("The style {} shows a single expression; leave --to out, or choose another "
                    "style.",
                    a.style));
  if (isHeat(*style) && a.compare.empty() && !a.following.any())
    return fail(
        fmt::format("The style {} needs meshes to compare with; give --compare NEUTRAL "
                    "[TARGET...].",
                    a.style));
  if (a.to && views->size() > 1)
    return fail("Pictures on the way to an expression have one view; give a single one.");
  std::vector<std::string> inputs = a.compare;
  inputs.push_back(a.face);
  if (auto ok = checkOutput(a.output, inputs, {".png"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  if (!a.compare.empty() && a.following.any())
    return fail("Meshes know neither arcs nor eyes; leave --compare out, or the others.");
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Following> following = follow(a.following, *rig);
  if (!following) return std::unexpected(following.error());
  const Result<Image> image = Renderer(a, *rig, *following, *style, *views).make();
  if (!image) return std::unexpected(image.error());
  const Result<std::string> png = encodePng(*image);
  if (!png) return std::unexpected(png.error());
  if (auto written = writeFile(a.output, *png); !written) return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} × {} pixels, {} bytes\n", a.output, image->width, image->height,
               png->size());
  return 0;
}

}  // namespace

Command addRender(CLI::App& tool) {
  return makeCommand(tool, "render", "Make a picture of a face (.png)", runRender);
}

}  // namespace sweepface::cli
