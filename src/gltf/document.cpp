#include "gltf/document.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

#include "gltf/bounds.hpp"
#include "gltf/fixed32.hpp"
#include "gltf/meshopt.hpp"
#include "gltf/resources.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

namespace fs = std::filesystem;

// ---- The container ----

constexpr std::string_view magic = "glTF";
constexpr std::uint32_t jsonChunk = 0x4E4F534A, binaryChunk = 0x004E4942;

struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;
  bool more = false;  ///< chunks that the format does not define
};

/// Splits a GLB into its chunks.
Result<Container> readContainer(std::string_view bytes) {
  const auto damaged = [](std::string_view what) {
    return fail(fmt::format("{}; copy the file again or export it again.", what));
  };
  if (bytes.size() < 20) return damaged("the file ends within its header");
  if (const std::uint32_t version = fixed32(bytes, 4); version != 2)
    return fail(fmt::format("it is a GLB of version {}, not 2; export it as glTF 2.0.", version));
  if (const std::uint32_t length = fixed32(bytes, 8); length != bytes.size())
    return damaged(fmt::format("its header says that it has {} bytes, but there are {}", length,
                               bytes.size()));
  Container container;
  std::size_t number = 0;
  for (std::size_t at = 12; at < bytes.size(); ++number) {
    if (bytes.size() - at < 8) return damaged("the file ends within the head of a chunk");
    const std::size_t size = fixed32(bytes, at);
    const std::uint32_t kind = fixed32(bytes, at + 4);
    if (size > bytes.size() - at - 8) return damaged("the file ends within a chunk");
    const std::string_view chunk = bytes.substr(at + 8, size);
    if (number == 0 && kind != jsonChunk) return damaged("its first chunk is not the JSON");
    if (number == 0)
      container.json = chunk;
    else if (number == 1 && kind == binaryChunk)
      container.binary = chunk;
    else
      container.more = true;
    at += 8 + size;
  }
  return container;
}

// ---- The asset ----

/// The lists of a glTF that are read.
constexpr std::array lists{"accessors", "animations", "buffers", "bufferViews",
                           "images",    "materials",  "meshes",  "nodes",
                           "scenes",    "skins",      "textures"};

Result<void> checkLists(const Json& json) {
  for (const char* key : lists) {
    const Json* const list = find(json, key);
    if (!list) continue;
    const bool objects = list->is_array() && std::ranges::all_of(*list, [](const Json& entry) {
                           return entry.is_object();
                         });
    if (!objects)
      return fail(fmt::format("'{}' is not a list of objects; export the file again.", key));
  }
  return {};
}

Result<void> checkVersion(const Json& json) {
  const Json* const asset = find(json, "asset");
  if (!asset) return fail("it has no 'asset', as every glTF has; export it as glTF 2.0.");
  Members in(*asset, "asset");
  const std::string_view version =
      in.has("minVersion") ? in.text("minVersion") : in.text("version");
  if (!in.ok()) return in.error();
  const bool known = in.has("minVersion") ? version == "2.0" : version.starts_with("2.");
  if (known) return {};
  return fail(fmt::format("it is of glTF version {}, not 2.0; export it as glTF 2.0.",
                          io::inQuotes(version)));
}

// ---- Extensions ----

Result<void> checkExtensions(const Json& json) {
  Members in(json, "the file");
  for (const Json& entry : in.array("extensionsRequired")) {
    if (!entry.is_string())
      return fail(
          "'extensionsRequired' is not a list of names; export the "
          "file again.");
    const std::string& name = entry.get_ref<const std::string&>();
    if (name == "KHR_draco_mesh_compression") return fail(std::string(dracoRefusal));
    if (!isHarmlessExtension(name))
      return fail(
          fmt::format("it requires the extension {}, which this program does not know; "
                      "export it without.",
                      io::inQuotes(name)));
  }
  if (!in.ok()) return in.error();
  return {};
}

// ---- Buffers and views ----

std::string placeOf(std::string_view thing, std::size_t index) {
  return fmt::format("{} {}", thing, index);
}

class Loader {
 public:
  Loader(Document& document, const Container& container, const fs::path& folder)
      : document_(document), container_(container), folder_(folder) {}

  Result<void> load() {
    const std::size_t buffers = document_.list("buffers").size();
    for (std::size_t b = 0; b < buffers; ++b)
      if (auto ok = loadBuffer(b); !ok) return ok;
    const std::size_t views = document_.list("bufferViews").size();
    for (std::size_t v = 0; v < views; ++v)
      if (auto ok = loadView(v); !ok) return ok;
    correctBounds(document_, rounded_);
    return {};
  }

 private:
  /// The length that a buffer states, and which of the document's buffers has its bytes.
  struct Told {
    std::size_t length = 0, place = 0;
  };

  Result<void> loadBuffer(std::size_t index) {
    Members in(document_.list("buffers")[index], placeOf("buffer", index));
    Told told{in.size("byteLength"), index};
    const std::string_view uri = in.text("uri");
    if (!in.ok()) return in.error();
    std::string& bytes = document_.buffers.emplace_back();
    if (in.has("uri")) {
      told.place = sources_.emplace(identityOf(uri, folder_), index).first->second;
      if (told.place == index)
        if (auto ok = fetchInto(bytes, uri); !ok)
          return fail(fmt::format("{}: {}", in.place(), ok.error().message));
    } else if (index == 0 && container_.binary) {
      bytes = container_.binary->substr(0, told.length);
    } else {
      told.length = 0;  // Nothing may lie in it: it stands in for what is compressed elsewhere.
    }
    const std::size_t size = document_.buffers[told.place].size();
    if (size < told.length) in.refuse(fmt::format("it has {} of its {} bytes", size, told.length));
    if (!in.ok()) return in.error();
    total_ += bytes.size();
    if (total_ > io::maxFileBytes)
      return fail("its buffers are larger than 2 GiB; export only the face.");
    told_.push_back(told);
    return {};
  }

  /// A file is read once, however many buffers name it, and completely, as their lengths may
  /// differ.
  Result<void> fetchInto(std::string& bytes, std::string_view uri) {
    auto fetched = fetch(uri, folder_);
    if (!fetched) return std::unexpected(fetched.error());
    bytes = std::move(fetched->bytes);
    document_.sourceBytes += bytes.size();
    return {};
  }

  Result<void> loadView(std::size_t index) {
    const Json& json = document_.list("bufferViews")[index];
    rounded_.push_back(false);
    if (meshoptOf(json)) return decompressView(index);
    Members in(json, placeOf("buffer view", index));
    BufferView view;
    view.buffer = in.index("buffer", told_.size(), "buffers");
    view.offset = in.size("byteOffset", 0);
    view.length = in.size("byteLength");
    view.stride = in.size("byteStride", 0);
    if (view.stride > 252) in.refuse("its byteStride is larger than 252");
    if (in.ok()) checkRange(in, view.buffer, view.offset, view.length);
    if (!in.ok()) return in.error();
    view.buffer = told_[view.buffer].place;
    document_.views.push_back(view);
    return {};
  }

  void checkRange(Members& in, std::size_t buffer, std::size_t offset, std::size_t length) {
    const std::size_t size = told_[buffer].length;
    if (length == 0) in.refuse("its byteLength is 0");
    if (offset > size || length > size - offset)
      in.refuse(fmt::format("it reaches beyond the {} bytes of buffer {}", size, buffer));
  }

  /// Decodes a view into a buffer of its own.
  Result<void> decompressView(std::size_t index) {
    const Json& json = document_.list("bufferViews")[index];
    Members in(*meshoptOf(json), placeOf("buffer view", index));
    const MeshoptStream stream = readMeshopt(in, told_.size());
    if (in.ok()) checkRange(in, stream.buffer, stream.offset, stream.length);
    if (!in.ok()) return in.error();
    // Compressed views that share no bytes have no more than all buffers together.
    compressed_ += stream.length;
    if (compressed_ > total_) in.refuse("its bytes are those of other compressed views");
    if (!in.ok()) return in.error();
    const std::string_view bytes = std::string_view(document_.buffers[told_[stream.buffer].place])
                                       .substr(stream.offset, stream.length);
    std::string elements = decodeMeshopt(in, stream, bytes);
    if (!in.ok()) return in.error();
    Members view(json, in.place());
    const std::size_t stride = view.size("byteStride", 0);
    if (view.ok() && stride != 0 && stride != stream.stride)
      view.refuse("its byteStride is not that of what is compressed");
    if (!view.ok()) return view.error();
    rounded_.back() = in.has("filter");
    pointTo(index, elements.size());
    document_.views.push_back({document_.buffers.size(), 0, elements.size(), stride});
    document_.buffers.push_back(std::move(elements));
    return {};
  }

  /// Makes a view that was compressed refer to the next buffer.
  void pointTo(std::size_t index, std::size_t length) {
    Json& json = document_.json["bufferViews"][index];
    json.erase("byteOffset");
    json["buffer"] = document_.buffers.size();
    json["byteLength"] = length;
    Json& extensions = json["extensions"];
    extensions.erase("EXT_meshopt_compression");
    extensions.erase("KHR_meshopt_compression");
    if (extensions.empty()) json.erase("extensions");
    document_.json["buffers"].push_back({{"byteLength", length}});
  }

  Document& document_;
  const Container& container_;
  const fs::path& folder_;
  std::size_t total_ = 0, compressed_ = 0;
  std::map<std::string, std::size_t> sources_;  // the first buffer of each file or data: URI
  std::vector<Told> told_;                      // [buffers]
  std::vector<bool> rounded_;                   // [views] by a filter
};

/// Removes an extension that nothing uses any longer from the lists of extensions and from buffers:
/// a placeholder for compressed data may come to hold some.
void forgetExtension(Json& json, std::string_view name) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    Json* const list = find(json, key);
    if (!list || !list->is_array()) continue;
    Json kept = Json::array();
    for (Json& entry : *list)
      if (entry != name) kept.push_back(std::move(entry));
    *list = std::move(kept);
    if (list->empty()) json.erase(key);
  }
  Json* const buffers = find(json, "buffers");
  for (std::size_t b = 0; buffers && b < buffers->size(); ++b) {
    Json* const extensions = find((*buffers)[b], "extensions");
    if (!extensions || !extensions->is_object()) continue;
    extensions->erase(std::string(name));
    if (extensions->empty()) (*buffers)[b].erase("extensions");
  }
}

}  // namespace

bool isHarmlessExtension(std::string_view name) {
  constexpr std::array prefixes{"KHR_materials_", "KHR_lights_",  "EXT_lights_",
                                "KHR_texture_",   "EXT_texture_", "MSFT_texture_",
                                "KHR_xmp",        "KHR_audio",    "VRMC_"};
  constexpr std::array names{"KHR_mesh_quantization",
                             "EXT_meshopt_compression",
                             "KHR_meshopt_compression",
                             "KHR_animation_pointer",
                             "KHR_node_visibility",
                             "EXT_mesh_gpu_instancing",
                             "MSFT_lod",
                             "VRM"};
  return std::ranges::any_of(prefixes, [&](auto prefix) { return name.starts_with(prefix); }) ||
         std::ranges::find(names, name) != names.end();
}

bool usesUnknownExtensions(const Json& gltf) {
  const Json* const used = find(gltf, "extensionsUsed");
  return used && std::ranges::any_of(*used, [](const Json& name) {
           return !name.is_string() || !isHarmlessExtension(name.get_ref<const std::string&>());
         });
}

std::size_t Document::addBuffer(std::string bytes) {
  const std::size_t size = bytes.size(), buffer = buffers.size();
  views.push_back({buffer, 0, size, 0});
  buffers.push_back(std::move(bytes));
  json["buffers"].push_back({{"byteLength", size}});
  json["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", size}});
  return views.size() - 1;
}

Result<Document> parseDocument(std::string_view bytes, const fs::path& folder) {
  if (bytes.size() > io::maxFileBytes)
    return fail("it is larger than 2 GiB; export only the face.");
  if (bytes.empty()) return fail("it is empty; export the file again.");
  Container container{bytes, {}, false};
  if (bytes.starts_with(magic)) {
    const auto read = readContainer(bytes);
    if (!read) return std::unexpected(read.error());
    container = *read;
  }
  while (container.json.ends_with('\0')) container.json.remove_suffix(1);  // a common fault

  Document document;
  auto json = parseJson(container.json);
  if (!json) return std::unexpected(json.error());
  document.json = std::move(*json);
  for (const auto check : {checkVersion, checkExtensions, checkLists})
    if (auto ok = check(document.json); !ok) return std::unexpected(ok.error());
  document.sourceBytes = bytes.size();
  if (auto ok = Loader(document, container, folder).load(); !ok) return std::unexpected(ok.error());
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    forgetExtension(document.json, name);
  if (container.more)
    document.warnings.push_back(
        "Chunks after the GLB's first two are of unknown kinds and are not "
        "carried over.");
  return document;
}

std::vector<std::string> materialNames(const Document& document) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  std::map<std::string, int> again;  // how often each name was wanted again
  for (const Json& material : document.list("materials")) {
    const Json* const own = find(material, "name");
    const bool isNamed = own && own->is_string() && !own->get_ref<const std::string&>().empty();
    const std::string wanted =
        isNamed ? own->get<std::string>() : fmt::format("material_{}", names.size());
    std::string name = wanted;
    while (!taken.insert(name).second) name = fmt::format("{} {}", wanted, ++again[wanted] + 1);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<bool> jointsOf(const Document& document) {
  std::vector<bool> isJoint(document.list("nodes").size());
  for (const Json& skin : document.list("skins"))
    for (const Json& joint : listOf(skin, "joints"))
      if (const auto node = asIndex(joint, isJoint.size())) isJoint[*node] = true;
  return isJoint;
}

std::string formatContainer(const Json& json, std::string_view binary) {
  // In names, bytes that are not UTF-8 are replaced.
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t padded = (binary.size() + 3) / 4 * 4;
  std::string bytes(magic);
  append32(bytes, 2);
  append32(bytes, 12 + 8 + text.size() + (padded > 0 ? 8 + padded : 0));
  append32(bytes, text.size());
  append32(bytes, jsonChunk);
  bytes += text;
  if (padded == 0) return bytes;
  append32(bytes, padded);
  append32(bytes, binaryChunk);
  bytes += binary;
  bytes.resize(bytes.size() + padded - binary.size(), '\0');
  return bytes;
}

}  // namespace sweepface::gltf
