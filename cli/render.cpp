#include "render.hpp"

#include <fmt/format.h>

#include "sweepface/io.hpp"

#include "command.hpp"
#include "output.hpp"

namespace sweepface::cli {

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
  addLod(app, a.lod,
         "Cut every edge of the source into N; by the size if not given, and finer with --close");
  app.add_option(
         "--compare", a.compare,
         "Show the meshes that it was made from beside it: the neutral, then expressions or "
         "folders of them")
      ->type_name("NEUTRAL [TARGET...]");
  addChosen(app, a.chosen)->needs("--compare");
  addSubdivide(app, a.subdivisions)->needs("--compare");
  CLI::Option* to = app.add_option("--to", a.to, "Show the way from one expression to this one")
                        ->type_name("NAME=W,...");
  app.add_option("--from", a.from, "Where it starts; the neutral if not given")
      ->needs(to)
      ->type_name("NAME=W,...");
  oneEachTime(app.add_option(
                  "--law", a.laws,
                  "How it moves: newton, brake, accelerate-brake, linear-force, linear; several, "
                  "separated by commas, stand one above the other; newton if not given"))
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
      ->check(notEmpty())
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

namespace {

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
  // Parsed before targets are added to the face's own.
  Result<Weights> weights = a.to ? weightsGiven("--to", *a.to, *rig)
                                 : weightsGiven("--weights", a.weights, *rig),
                  from = weightsGiven("--from", a.from, *rig);
  if (!weights || !from) return std::unexpected((weights ? from : weights).error());
  std::vector<Vec3> straight;
  if (isHeat(*style) && a.compare.empty()) {
    const Result<Limits> limits = limitsGiven(a.following, *rig);
    if (!limits) return std::unexpected(limits.error());
    Weights limited = *weights;
    limits->apply(limited);
    straight = sourceVertices(*rig, limited);
  }
  const Result<Following> following = follow(a.following, *rig, {*weights, *from});
  if (!following) return std::unexpected(following.error());
  for (Weights* w : {&*weights, &*from}) w->resize(rig->targets.size());
  const Rendering what{a, *rig, *following, *style, *views, std::move(straight)};
  const Result<Image> image =
      a.to ? drawStrips(what, *from, *weights) : drawExpression(what, *weights);
  if (!image) return std::unexpected(image.error());
  const Result<std::string> png = encodePng(*image);
  if (!png) return std::unexpected(png.error());
  if (auto written = writeFile(utf8Path(a.output), *png); !written)
    return std::unexpected(written.error());
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
