#include "gltf/mix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sweepface::gltf {

Mix Mix::between(Index from, Index to, std::int64_t step, Index steps) {
  if (step == 0 || from == to) return at(from);
  if (step == steps) return at(to);
  if (from > to) return between(to, from, steps - step, steps);
  return {{from, to, to, from}, static_cast<double>(step) / steps, 0};
}

Mix Mix::within(const std::array<Index, 4>& c, std::int64_t i, Index m, std::int64_t j, Index n) {
  if (i >= 0 && i <= m && j == 0) return between(c[0], c[1], i, m);
  if (i >= 0 && i <= m && j == n) return between(c[3], c[2], i, m);
  if (j >= 0 && j <= n && i == 0) return between(c[0], c[3], j, n);
  if (j >= 0 && j <= n && i == m) return between(c[1], c[2], j, n);
  return {c, static_cast<double>(i) / m, static_cast<double>(j) / n};
}

namespace {

Mix held(const Mix& mix) {
  return {mix.corners, std::clamp(mix.u, 0.0, 1.0), std::clamp(mix.v, 0.0, 1.0)};
}

Index nearest(const Mix& mix) {
  return mix.corners[mix.u < 0.5 ? (mix.v < 0.5 ? 0 : 3) : (mix.v < 0.5 ? 1 : 2)];
}

/// A joint that moves a vertex, and its weight.
struct Influence {
  double joint = 0, weight = 0;
};

/// The influences of all vertices of a skinned mesh.
class Influences {
 public:
  /// [sets][4 × vertices] each.
  Influences(const std::vector<std::vector<double>>& joints,
             const std::vector<std::vector<double>>& weights)
      : joints_(joints), weights_(weights) {}

  std::vector<Influence> at(const Mix& mix) const {
    std::vector<Influence> sum;
    if (mix.isVertex()) {
      each(mix.corners[0], [&](Influence i) { sum.push_back(i); });
      return sum;
    }
    const std::array<double, 4> shares = held(mix).weights();
    for (int k = 0; k < 4; ++k)
      each(mix.corners[k], [&](Influence i) { add(sum, {i.joint, shares[k] * i.weight}); });
    return strongest(std::move(sum));
  }

 private:
  template <typename Do>
  void each(Index vertex, Do act) const {
    for (std::size_t set = 0; set < joints_.size(); ++set)
      for (std::size_t k = 4 * static_cast<std::size_t>(vertex), end = k + 4; k < end; ++k)
        act({joints_[set][k], weights_[set][k]});
  }

  static void add(std::vector<Influence>& sum, const Influence& more) {
    if (!(more.weight > 0)) return;
    const auto known = std::ranges::find(sum, more.joint, &Influence::joint);
    if (known == sum.end())
      sum.push_back(more);
    else
      known->weight += more.weight;
  }

  /// Keeps as many as there is room for and makes them sum to one.
  std::vector<Influence> strongest(std::vector<Influence> sum) const {
    std::ranges::sort(sum, [](const Influence& a, const Influence& b) {
      return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
    });
    sum.resize(4 * joints_.size());
    double total = 0;
    for (const Influence& i : sum) total += i.weight;
    for (Influence& i : sum) i.weight = total > 0 ? i.weight / total : 0;
    return sum;
  }

  const std::vector<std::vector<double>>& joints_;
  const std::vector<std::vector<double>>& weights_;
};

/// Rounds fractions to multiples of 1/`one` without changing their sum: those that lose most by
/// rounding down are rounded up.
void roundTogether(std::vector<Influence>& influences, double one) {
  std::vector<std::size_t> order(influences.size());
  std::iota(order.begin(), order.end(), 0);
  double left = 0;
  std::vector<double> lost;
  for (Influence& i : influences) {
    const double scaled = i.weight * one, down = std::floor(scaled);
    left += scaled - down;
    lost.push_back(scaled - down);
    i.weight = down;
  }
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return lost[a] != lost[b] ? lost[a] > lost[b] : a < b;
  });
  for (std::size_t k = 0; k < static_cast<std::size_t>(std::lround(left)); ++k)
    influences[order[k]].weight += 1;
  for (Influence& i : influences) {
    if (i.weight == 0) i.joint = 0;  // a joint that moves nothing should be joint 0
    i.weight /= one;
  }
}

/// What 1 is stored as in the coarsest of some attributes; 0 if all are floats.
double coarsest(const std::vector<Accessor>& attributes) {
  double one = 0;
  for (const Accessor& a : attributes) {
    const double own = a.type == Component::uint8 ? 255 : a.type == Component::uint16 ? 65535 : 0;
    if (own > 0) one = one > 0 ? std::min(one, own) : own;
  }
  return one;
}

Result<std::vector<std::vector<double>>> decodeAll(const Document& document,
                                                   const std::vector<Accessor>& accessors) {
  std::vector<std::vector<double>> all;
  for (const Accessor& accessor : accessors) {
    auto values = decode(document, accessor);
    if (!values) return std::unexpected(values.error());
    all.push_back(std::move(*values));
  }
  return all;
}

}  // namespace

Result<Column> mixed(const Document& document, const Accessor& attribute, Meaning meaning,
                     std::span<const Mix> places) {
  const auto values = decode(document, attribute);
  if (!values) return std::unexpected(values.error());
  const std::size_t width = attribute.components();
  const bool isTexcoord = meaning == Meaning::texcoord;
  const bool isCategory =
      !isTexcoord && attribute.type != Component::float32 && !attribute.normalized;
  std::vector<double> result;
  result.reserve(places.size() * width);
  for (const Mix& mix : places) {
    const std::array<double, 4> shares = (isTexcoord ? mix : held(mix)).weights();
    for (std::size_t c = 0; c < width; ++c) {
      const auto value = [&](Index vertex) {
        return (*values)[static_cast<std::size_t>(vertex) * width + c];
      };
      if (isCategory || mix.isVertex()) {
        result.push_back(value(nearest(mix)));
        continue;
      }
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += shares[k] * value(mix.corners[k]);
      result.push_back(sum);
    }
  }
  Column column = pack(result, width, attribute.type, attribute.normalized);
  // Integers end at their type's bounds: by rounding, or beyond a quad.
  if (attribute.type != Component::float32) column.sound = true;
  return column;
}

Result<SkinColumns> mixedSkin(const Document& document, const SkinAttributes& attributes,
                              std::span<const Mix> places) {
  const auto joints = decodeAll(document, attributes.joints);
  if (!joints) return std::unexpected(joints.error());
  const auto weights = decodeAll(document, attributes.weights);
  if (!weights) return std::unexpected(weights.error());
  const Influences influences(*joints, *weights);
  const std::size_t sets = attributes.joints.size();
  const double one = coarsest(attributes.weights);

  std::vector<std::vector<double>> outJoints(sets), outWeights(sets);
  for (const Mix& mix : places) {
    std::vector<Influence> here = influences.at(mix);
    if (one > 0 && !mix.isVertex()) roundTogether(here, one);
    for (std::size_t k = 0; k < here.size(); ++k) {
      outJoints[k / 4].push_back(here[k].joint);
      outWeights[k / 4].push_back(here[k].weight);
    }
  }
  SkinColumns columns;
  for (std::size_t s = 0; s < sets; ++s) {
    const Accessor& w = attributes.weights[s];
    columns.joints.push_back(pack(outJoints[s], 4, attributes.joints[s].type));
    columns.weights.push_back(pack(outWeights[s], 4, w.type, w.normalized));
  }
  return columns;
}

}  // namespace sweepface::gltf
