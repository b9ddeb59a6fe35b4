#include "sweepface/regions.hpp"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

static_assert(kMostRegions == SWEEPFACE_MOST_REGIONS);

namespace {

std::string text(const char* from) { return from ? from : ""; }

std::vector<std::string> texts(const char* const* from, std::size_t count) {
  std::vector<std::string> found;
  for (std::size_t k = 0; k < count; ++k) found.push_back(text(from[k]));
  return found;
}

std::vector<Vec3> places(const double* from, std::size_t count) {
  std::vector<Vec3> found;
  for (std::size_t k = 0; k < count; ++k)
    found.push_back({from[3 * k], from[3 * k + 1], from[3 * k + 2]});
  return found;
}

bool hasItsLists(const sweepface_brush& brush) {
  return (brush.parts || !brush.part_count) && (brush.points || !brush.point_count) &&
         (brush.line || !brush.line_count) && (brush.curves || !brush.curve_count) &&
         ((brush.nodes && brush.node_shares) || !brush.node_count);
}

Brush brushOf(const sweepface_brush& given) {
  Brush brush;
  brush.parts = texts(given.parts, given.part_count);
  brush.points = places(given.points, given.point_count);
  brush.line = places(given.line, given.line_count);
  brush.curves = texts(given.curves, given.curve_count);
  const std::vector<std::string> nodes = texts(given.nodes, given.node_count);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    brush.nodes.emplace_back(nodes[k], given.node_shares[k]);
  brush.whole = given.whole;
  brush.fade = given.fade;
  brush.alongSurface = !given.through_space;
  return brush;
}

Result<std::vector<std::vector<double>>> paintAll(const Rig& rig, const Brush& brush,
                                                  std::uint32_t bands) {
  if (bands > 1) return paintBands(rig, brush, static_cast<int>(bands));
  auto shares = paint(rig, brush);
  if (!shares) return std::unexpected(std::move(shares.error()));
  return std::vector<std::vector<double>>{std::move(*shares)};
}

}  // namespace

Division capi::divisionOf(const Rig& rig, const std::vector<Region>& regions) {
  return {namesOf(regions), influencesOf(rig.surface, regions), mattersOf(regions)};
}

void capi::divide(sweepface_rig& rig, Division division) {
  if (rig.following.eyes) rig.following.eyes->keepWhole(division.influences);
  rig.division = std::make_shared<const Division>(std::move(division));
}

uint32_t sweepface_rig_node_count(const sweepface_rig* rig) {
  return rig ? static_cast<uint32_t>(rig->rig->surface.wireframe().nodes.size()) : 0;
}

sweepface_status sweepface_rig_paint(const sweepface_rig* rig, const sweepface_brush* brush,
                                     uint32_t bands, double* shares, size_t count) {
  if (!rig || !brush || !shares)
    return refuse("Painting a region needs a rig, a brush and a place for the shares.");
  if (!hasItsLists(*brush)) return refuse("A list of the brush is missing whose length is not 0.");
  if (bands > kMostRegions) return refuse("A face has at most ", kMostRegions, " regions.");
  const std::size_t nodes = sweepface_rig_node_count(rig), all = std::max(1U, bands) * nodes;
  if (count < all) return refuse("There is room for ", count, " shares; there are ", all, ".");
  const auto painted = paintAll(*rig->rig, brushOf(*brush), bands);
  if (!painted) return refuse(painted.error().message);
  for (const std::vector<double>& band : *painted) shares = std::ranges::copy(band, shares).out;
  return SWEEPFACE_OK;
}

sweepface_status sweepface_rig_divide(sweepface_rig* rig, const char* const* names,
                                      const double* shares, size_t count) {
  if (!rig || (count > 0 && (!names || !shares)))
    return refuse("Dividing a face needs a rig, and names and shares of its regions.");
  if (count > kMostRegions) return refuse("A face has at most ", kMostRegions, " regions.");
  if (count == 0) {
    rig->division = std::make_shared<Division>();
    return SWEEPFACE_OK;
  }
  const std::size_t nodes = sweepface_rig_node_count(rig);
  std::vector<Region> painted;
  for (size_t r = 0; r < count; ++r)
    painted.push_back({text(names[r]), {}, {shares + r * nodes, shares + (r + 1) * nodes}});
  const auto regions = dividedFace(*rig->rig, std::move(painted));
  if (!regions) return refuse(regions.error().message);
  divide(*rig, divisionOf(*rig->rig, *regions));
  return SWEEPFACE_OK;
}

uint32_t sweepface_rig_region_count(const sweepface_rig* rig) {
  return rig ? static_cast<uint32_t>(rig->division->count()) : 0;
}

const char* sweepface_rig_region_name(const sweepface_rig* rig, uint32_t region) {
  if (!rig || region >= rig->division->names.size()) return nullptr;
  return rig->division->names[region].c_str();
}

uint32_t sweepface_mesh_region_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->division->count()) : 0;
}
