#include "gltf/fill.hpp"

#include <algorithm>
#include <cmath>

#include "io/single.hpp"
#include "parallel/parallel.hpp"

namespace sweepface::gltf {
namespace {

// How many targets are evaluated at once; more would only take more memory.
constexpr std::size_t batch = 16;

/// Converts from the space of the scene to what a run's accessors hold.
class Packer {
 public:
  Packer(const Affine& world, const Encoding& encoding, const std::vector<Index>& places)
      : world_(world), fromScene_(world.inverse()), encoding_(encoding), places_(places) {}

  const std::vector<Index>& places() const { return places_; }

  Column positions(const std::vector<Vec3>& points) {
    return packed([&](Index place) {
      const Vec3 p = fromScene_.point(points[place]);
      largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      return encoding_.quantized ? (p - encoding_.middle) * (1 / encoding_.half) : p;
    });
  }
  /// A difference that would be lost when added to a float as large as the mesh becomes 0.
  Column differences(const std::vector<Vec3>& vectors) const {
    const double least = io::kHalfDigit * largest_;
    return packed([&](Index place) {
      const Vec3 d = fromScene_.direction(vectors[place]);
      return norm(d) <= least ? Vec3{} : d * (1 / encoding_.half);
    });
  }
  Column normals(const std::vector<Vec3>& directions) const {
    const auto [type, normalized] = numbers();
    return pack(normalsOf(directions), type, normalized);
  }
  /// What must be added to the neutral's normals.
  Column normalDifferences(const std::vector<Vec3>& neutral,
                           const std::vector<Vec3>& differences) const {
    std::vector<Vec3> list = normalsOf(neutral);
    for (std::size_t v = 0; v < list.size(); ++v) {
      const Vec3 before = neutral[places_[v]], after = before + differences[places_[v]];
      const Vec3 change = normal(after) - list[v];
      list[v] = norm(change) <= io::kHalfDigit ? Vec3{} : change;
    }
    const auto isFraction = [](const Vec3& d) {
      return std::abs(d.x) <= 1 && std::abs(d.y) <= 1 && std::abs(d.z) <= 1;
    };
    // Normalised integers may not hold the change of a normal that turns by more than 60°.
    if (!encoding_.quantized || !std::ranges::all_of(list, isFraction)) return pack(list);
    return pack(list, Component::int16, true);
  }

 private:
  std::pair<Component, bool> numbers() const {
    return encoding_.quantized ? std::pair(Component::int16, true)
                               : std::pair(Component::float32, false);
  }
  template <typename Give>
  Column packed(Give give) const {
    std::vector<Vec3> list;
    list.reserve(places_.size());
    for (const Index place : places_) list.push_back(give(place));
    const auto [type, normalized] = numbers();
    Column column = pack(list, type, normalized);
    column.bounded = true;
    return column;
  }
  Vec3 normal(const Vec3& inScene) const { return normalized(world_.transposed(inScene)); }
  std::vector<Vec3> normalsOf(const std::vector<Vec3>& directions) const {
    std::vector<Vec3> list;
    list.reserve(places_.size());
    for (const Index place : places_) list.push_back(normal(directions[place]));
    return list;
  }

  const Affine& world_;
  Affine fromScene_;
  const Encoding& encoding_;
  const std::vector<Index>& places_;
  double largest_ = 0;  // largest coordinate of the neutral
};

class Filler {
 public:
  Filler(BoundScene& scene, const MorphShapes& shapes, const Places& places,
         const std::vector<Encoding>& encodings, bool morphNormals, Builder& builder, Slots& slots)
      : scene_(scene),
        shapes_(shapes),
        morphNormals_(morphNormals),
        builder_(builder),
        slots_(slots),
        accessors_(scene.document.list("accessors").size()),
        morphsOf_(scene.parts.targets.size()) {
    const Parts& parts = scene.parts;
    for (std::size_t r = 0; r < parts.runs.size(); ++r) {
      const std::size_t mesh = parts.runs[r].rigMesh;
      packers_.emplace_back(parts.meshes[mesh].world, encodings[mesh], places[r]);
      partsOfRun_.emplace_back();
    }
    for (const Part& part : parts.parts) partsOfRun_[part.run].push_back(part);
    for (std::size_t r = 0; r < parts.runs.size(); ++r) noteMorphs(r);
  }

  Result<void> fill() {
    for (std::size_t r = 0; r < packers_.size(); ++r) fillNeutral(r);
    const std::size_t count = scene_.parts.targets.size();
    for (std::size_t first = 0; first < count; first += batch)
      if (auto ok = fillTargets(first, std::min(first + batch, count)); !ok) return ok;
    return checkSize();
  }

 private:
  /// What one target does to one run.
  struct Morph {
    std::size_t run = 0, target = 0;  // `target` among the mesh's
    Column positions;
    std::optional<Column> normals;
  };

  Result<void> checkSize() const {
    if (builder_.size() < mostBytes) return {};
    return tooLargeForGlb();
  }

  static auto inTarget(std::size_t target) {
    return [target](Json& primitive) -> Json& { return primitive["targets"][target]; };
  }

  /// Gives the parts of a run the same values for an attribute: all of them, or those that have it.
  template <typename Holder>
  void set(std::size_t run, Holder holderOf, const char* attribute, bool all, const Column& column,
           Use use) {
    std::optional<std::size_t> filled;
    for (const Part& part : partsOfRun_[run]) {
      Json& holder = holderOf(primitiveOf(scene_.document, scene_.parts, part));
      if (!all && !find(holder, attribute)) continue;
      if (!filled) filled = slots_.put(findIndex(holder, attribute, accessors_), column, use);
      holder[attribute] = *filled;
    }
  }

  void fillNeutral(std::size_t run) {
    const auto attributes = [](Json& primitive) -> Json& { return primitive["attributes"]; };
    set(run, attributes, "POSITION", true, packers_[run].positions(shapes_.neutral().positions),
        Use::vertices);
    set(run, attributes, "NORMAL", morphNormals(run),
        packers_[run].normals(shapes_.neutral().normals), Use::vertices);
  }

  bool morphNormals(std::size_t run) const {
    return morphNormals_ && !scene_.parts.runs[run].targets.empty();
  }

  template <typename Holder>
  bool anyHas(std::size_t run, Holder holderOf, const char* attribute) {
    return std::ranges::any_of(partsOfRun_[run], [&](const Part& part) {
      return find(holderOf(primitiveOf(scene_.document, scene_.parts, part)), attribute) != nullptr;
    });
  }

  Result<void> fillTargets(std::size_t first, std::size_t end) {
    parallelFor(first, end, [&](std::size_t k) { evaluate(k, morphsOf_[k]); });
    for (std::size_t k = first; k < end; ++k) {
      for (const Morph& morph : morphsOf_[k]) write(morph);
      morphsOf_[k].clear();
    }
    return checkSize();
  }

  /// The targets that a run has, and whether they have normals there.
  void noteMorphs(std::size_t run) {
    const auto& targets = scene_.parts.meshes[scene_.parts.runs[run].rigMesh].targets;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      Morph& morph = morphsOf_[targets[t]].emplace_back();
      morph.run = run, morph.target = t;
      if (morphNormals(run) || anyHas(run, inTarget(t), "NORMAL")) morph.normals.emplace();
    }
  }

  void evaluate(std::size_t target, std::vector<Morph>& morphs) const {
    const bool normals = std::ranges::any_of(morphs, [](const Morph& m) { return !!m.normals; });
    MorphShape shape = shapes_.target(scene_.targets[target], normals);
    keepStill(target, shape);
    for (Morph& m : morphs) {
      m.positions = packers_[m.run].differences(shape.positions);
      if (m.normals)
        m.normals = packers_[m.run].normalDifferences(shapes_.neutral().normals, shape.normals);
    }
  }

  /// What a mesh without this target has in common with others stays where it is: the surface moves
  /// it by up to the tolerance, and there would be gaps.
  void keepStill(std::size_t target, MorphShape& shape) const {
    const auto has = [&](const Run& run) {
      const auto& own = scene_.parts.meshes[run.rigMesh].targets;
      return std::ranges::find(own, target) != own.end();
    };
    for (std::size_t r = 0; r < packers_.size(); ++r) {
      if (has(scene_.parts.runs[r])) continue;
      for (const Index place : packers_[r].places()) {
        shape.positions[place] = {};
        if (!shape.normals.empty()) shape.normals[place] = {};
      }
    }
  }

  void write(const Morph& morph) {
    const auto holder = inTarget(morph.target);
    // A target that had no positions because it did not move goes without, unless it moves now.
    const bool moves = morph.positions.bytes.find_first_not_of('\0') != std::string::npos;
    set(morph.run, holder, "POSITION", moves, morph.positions, Use::morphs);
    if (morph.normals)
      set(morph.run, holder, "NORMAL", morphNormals(morph.run), *morph.normals, Use::morphs);
  }

  BoundScene& scene_;
  const MorphShapes& shapes_;
  bool morphNormals_;
  Builder& builder_;
  Slots& slots_;
  std::size_t accessors_;                      // before any were added
  std::vector<Packer> packers_;                // [runs]
  std::vector<std::vector<Part>> partsOfRun_;  // [runs]
  std::vector<std::vector<Morph>> morphsOf_;   // [targets of the scene]
};

}  // namespace

Result<void> fill(BoundScene& scene, const MorphShapes& shapes, const Places& places,
                  const std::vector<Encoding>& encodings, bool morphNormals, Builder& builder,
                  Slots& slots) {
  return Filler(scene, shapes, places, encodings, morphNormals, builder, slots).fill();
}

}  // namespace sweepface::gltf
