#include "gltf/chosen_meshes.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "gltf/nodes.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

constexpr const char* kExtension = "SWEEPFACE_face";

void choose(Json& gltf, const std::vector<bool>& isChosen) {
  Json list = Json::array();
  for (std::size_t m = 0; m < isChosen.size(); ++m)
    if (isChosen[m]) list.push_back(m);
  Json& extensions = gltf["extensions"];
  if (!extensions.is_object()) extensions = Json::object();
  extensions[kExtension] = {{"meshes", std::move(list)}};
}

bool isNamed(const Json& thing, std::string_view name) {
  const Json* const own = find(thing, "name");
  return own && own->is_string() && own->get_ref<const std::string&>() == name;
}

/// What can be chosen, for messages: the objects that show meshes, or else meshes.
std::string namesIn(const Document& document) {
  std::vector<std::string> names;
  const auto add = [&](const Json& thing) {
    if (const Json* const name = find(thing, "name"); name && name->is_string())
      names.push_back(io::inQuotes(name->get_ref<const std::string&>()));
  };
  for (const Json& node : document.list("nodes"))
    if (find(node, "mesh")) add(node);
  if (names.empty()) std::ranges::for_each(document.list("meshes"), add);
  if (!names.empty()) return "there are " + io::fewOf(names, 12);
  return fmt::format("its {} meshes have none, but numbers from 0", document.list("meshes").size());
}

/// The meshes that one name stands for; none if it is nothing's.
std::vector<std::size_t> named(const Document& document, const std::string& name) {
  const Json &meshes = document.list("meshes"), &nodes = document.list("nodes");
  std::vector<std::size_t> shown, own, roots;
  const auto meshOf = [&](std::size_t n) { return findIndex(nodes[n], "mesh", meshes.size()); };
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!isNamed(nodes[n], name)) continue;
    roots.push_back(n);
    if (const auto mesh = meshOf(n)) shown.push_back(*mesh);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m)
    if (isNamed(meshes[m], name)) own.push_back(m);
  if (!shown.empty()) return shown;
  if (!own.empty()) return own;
  const std::vector<bool> isBelow = nodesBelow(document, roots);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const auto mesh = meshOf(n); mesh && isBelow[n]) shown.push_back(*mesh);
  const auto number = io::toNumber<std::size_t>(name);
  if (shown.empty() && number && *number < meshes.size()) shown.push_back(*number);
  return shown;
}

}  // namespace

Result<std::vector<bool>> chosenMeshes(const Document& document) {
  const Json* const extensions = find(document.json, "extensions");
  const Json* const choice = extensions ? find(*extensions, kExtension) : nullptr;
  if (!choice) return {};
  std::vector<bool> isChosen(document.list("meshes").size());
  Members in(*choice, fmt::format("extension {}", kExtension));
  for (const Json& entry : in.array("meshes")) {
    const auto mesh = asIndex(entry, isChosen.size());
    if (!mesh) in.refuse(fmt::format("one of its meshes is none of the {}", isChosen.size()));
    if (!in.ok()) break;
    isChosen[*mesh] = true;
  }
  if (!in.ok()) return in.error();
  return isChosen;
}

Result<void> chooseByName(Document& document, std::span<const std::string> names) {
  std::vector<bool> isChosen(document.list("meshes").size());
  for (const std::string& name : names) {
    const std::vector<std::size_t> found = named(document, name);
    if (found.empty())
      return fail(fmt::format("no object with meshes and no mesh is named {}; {}.",
                              io::inQuotes(name), namesIn(document)));
    for (const std::size_t mesh : found) isChosen[mesh] = true;
  }
  choose(document.json, isChosen);
  return {};
}

std::vector<std::size_t> chooseShown(Document& document, std::span<const std::size_t> meshes) {
  const Json& nodes = document.list("nodes");
  const std::vector<bool> isShown = shownNodes(document);
  std::vector<bool> isInScene(document.list("meshes").size()), isChosen(isInScene.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const auto mesh = findIndex(nodes[n], "mesh", isInScene.size()); mesh && isShown[n])
      isInScene[*mesh] = true;
  std::vector<std::size_t> others;
  for (const std::size_t mesh : meshes)
    isInScene[mesh] ? void(isChosen[mesh] = true) : others.push_back(mesh);
  if (others.size() == meshes.size()) return {};
  if (!others.empty()) choose(document.json, isChosen);
  return others;
}

void forgetChoice(Json& gltf) {
  Json* const extensions = find(gltf, "extensions");
  if (!extensions || !extensions->is_object() || extensions->erase(kExtension) == 0) return;
  if (extensions->empty()) gltf.erase("extensions");
}

}  // namespace sweepface::gltf
