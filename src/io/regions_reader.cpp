#include <algorithm>
#include <cmath>

#include "sweepface/region_file.hpp"

#include "codec/utf8.hpp"
#include "io/json_fields.hpp"
#include "io/json_text.hpp"

namespace sweepface {
namespace {

using Json = nlohmann::json;
using io::JsonFields;

Result<void> readTexts(const JsonFields& at, const char* key, std::vector<std::string>& list) {
  const auto found = at.json().find(key);
  if (found == at.json().end()) return {};
  if (!found->is_array()) return at.fail(fmt::format("has '{}' that are not a list", key));
  for (const Json& item : *found) {
    if (!item.is_string()) return at.fail(fmt::format("has '{}' that are not names", key));
    list.push_back(item.get<std::string>());
  }
  return {};
}

Result<void> readPoints(const JsonFields& at, const char* key, std::vector<Vec3>& list) {
  const auto found = at.json().find(key);
  if (found == at.json().end()) return {};
  const auto isPoint = [](const Json& p) {
    return p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() &&
           p[2].is_number();
  };
  if (!found->is_array()) return at.fail(fmt::format("has '{}' that are not a list", key));
  for (const Json& p : *found) {
    if (!isPoint(p)) return at.fail(fmt::format("has '{}' that are not like [[x, y, z]]", key));
    list.push_back({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
  }
  return {};
}

Result<void> readNodes(const JsonFields& at, std::vector<std::pair<std::string, double>>& list) {
  const auto found = at.json().find("nodes");
  if (found == at.json().end()) return {};
  if (!found->is_object()) return at.fail("has 'nodes' that are not an object of shares");
  for (const auto& [node, share] : found->items()) {
    if (!share.is_number()) return at.fail(fmt::format("has no share for node '{}'", node));
    list.emplace_back(node, share.get<double>());
  }
  return {};
}

Result<void> readBrush(const JsonFields& at, Brush& brush) {
  if (auto ok = readTexts(at, "parts", brush.parts); !ok) return ok;
  if (auto ok = readPoints(at, "points", brush.points); !ok) return ok;
  if (auto ok = readPoints(at, "line", brush.line); !ok) return ok;
  if (auto ok = readTexts(at, "curves", brush.curves); !ok) return ok;
  if (auto ok = readNodes(at, brush.nodes); !ok) return ok;
  if (brush.parts.empty() && brush.points.empty() && brush.line.empty() && brush.curves.empty() &&
      brush.nodes.empty())
    return at.fail("says nowhere where it is; name 'parts', 'points', 'line', 'curves' or 'nodes'");
  if (auto ok = at.number("whole", brush.whole); !ok) return ok;
  if (auto ok = at.number("fade", brush.fade); !ok) return ok;
  if (brush.whole < 0 || brush.fade < 0) return at.fail("has a distance below 0");
  std::string over = "surface";
  if (auto ok = at.text("over", over); !ok) return ok;
  if (over != "surface" && over != "space")
    return at.fail(fmt::format("is 'over' '{}', which is neither surface nor space", over));
  brush.alongSurface = over == "surface";
  return {};
}

Result<PaintedRegion> readRegion(const JsonFields& at) {
  if (auto ok = at.isObject({"name", "mass", "stiffness", "delay", "bands", "parts", "points",
                             "line", "curves", "nodes", "whole", "fade", "over"});
      !ok)
    return std::unexpected(ok.error());
  PaintedRegion region;
  double bands = 1;
  if (auto ok = at.text("name", region.name, true); !ok) return std::unexpected(ok.error());
  if (!codec::isUtf8(region.name)) return at.fail("has control characters in its 'name'");
  for (const auto& [key, value] : {std::pair{"mass", &region.matter.mass},
                                   {"stiffness", &region.matter.stiffness},
                                   {"delay", &region.matter.delay},
                                   {"bands", &bands}})
    if (auto ok = at.number(key, *value); !ok) return std::unexpected(ok.error());
  if (auto ok = check(region.matter); !ok) return at.pass(ok.error());
  if (!(bands >= 1 && bands <= kMostRegions && bands == std::floor(bands)))
    return at.fail(
        fmt::format("has 'bands' that are not a whole number from 1 to {}", kMostRegions));
  region.bands = static_cast<int>(bands);
  if (auto ok = readBrush(at, region.brush); !ok) return std::unexpected(ok.error());
  return region;
}

Result<void> addBands(const Rig& rig, const PaintedRegion& painted, std::vector<Region>& regions) {
  auto bands = paintBands(rig, painted.brush, painted.bands);
  if (!bands) return std::unexpected(bands.error());
  for (int k = 0; k < painted.bands; ++k) {
    Matter matter = painted.matter;
    matter.delay *= static_cast<double>(k) / (painted.bands - 1);
    regions.push_back({fmt::format("{}{}", painted.name, k + 1), matter, std::move((*bands)[k])});
  }
  return {};
}

Result<void> addRegion(const Rig& rig, const PaintedRegion& painted, std::vector<Region>& regions) {
  if (painted.bands > 1) return addBands(rig, painted, regions);
  auto shares = paint(rig, painted.brush);
  if (!shares) return std::unexpected(shares.error());
  regions.push_back({painted.name, painted.matter, std::move(*shares)});
  return {};
}

}  // namespace

Result<std::vector<PaintedRegion>> parseRegions(std::string_view text, std::string_view name) {
  const auto json = io::parseJson(text, name);
  if (!json) return std::unexpected(json.error());
  std::vector<PaintedRegion> regions;
  if (!json->is_object() || !json->contains("regions")) return regions;
  const Json& list = (*json)["regions"];
  if (!list.is_array()) return JsonFields(name, list, "'regions'").fail("are not a list");
  for (std::size_t k = 0; k < list.size(); ++k) {
    auto region = readRegion({name, list[k], fmt::format("regions[{}]", k)});
    if (!region) return std::unexpected(region.error());
    regions.push_back(std::move(*region));
  }
  return regions;
}

Result<std::vector<Region>> paintRegions(const Rig& rig,
                                         const std::vector<PaintedRegion>& painted) {
  std::size_t count = 0;
  for (const PaintedRegion& region : painted)
    count += static_cast<std::size_t>(std::max(1, region.bands));
  if (count > kMostRegions)
    return fail(
        fmt::format("A face has at most {} regions, with what is left of it.", kMostRegions));
  std::vector<Region> regions;
  for (const PaintedRegion& region : painted)
    if (auto ok = addRegion(rig, region, regions); !ok)
      return fail(fmt::format("Region '{}': {}", region.name, ok.error().message));
  return dividedFace(rig, std::move(regions));
}

}  // namespace sweepface
