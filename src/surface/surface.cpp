#include "sweepface/surface.hpp"

#include <algorithm>

#include "surface/basis_table.hpp"
#include "surface/jets.hpp"

namespace sweepface {

namespace {

// The bases a wireframe needs: of rails (T-nodes stand on them), of arcs, and of patches' sides.
std::vector<std::array<Index, 2>> basisKeys(const Wireframe& w, const Connectivity& c) {
  std::vector<std::array<Index, 2>> keys;
  for (const Arc& arc : w.arcs) keys.push_back({arc.ribbon, arc.edges});
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s)
      keys.push_back({w.arcs[arcOf(w.side(p, s)[0])].ribbon, w.sideEdges(p, s)});
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    if (c.kinds[n] != NodeKind::hanging) continue;
    for (HalfArc arm : c.stars[n].arms) {
      const HalfArc on = c.opposite(w, arm);
      if (on < 0) continue;
      keys.push_back({w.arcs[arcOf(arm)].ribbon, c.rails[arm].edges + c.rails[on].edges});
    }
  }
  return keys;
}

// Checks that each side has one ribbon, and so each rail, which lies on a side wherever it passes a
// T-node, and that the two sides along which a patch sweeps share theirs.
Result<void> checkRibbons(const Wireframe& w) {
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    const auto ribbon = [&](HalfArc h) { return w.arcs[arcOf(h)].ribbon; };
    for (int s = 0; s < 4; ++s)
      for (HalfArc h : w.side(p, s))
        if (ribbon(h) != ribbon(w.side(p, s)[0]))
          return fail("a side of patch ", p, " changes its ribbon half-way");
    if (ribbon(w.side(p, 0)[0]) != ribbon(w.side(p, 2)[0]))
      return fail("patch ", p, " sweeps along sides of two ribbons");
  }
  return {};
}

}  // namespace

Result<Surface> Surface::make(Wireframe wireframe, Connectivity connectivity,
                              std::vector<Index>* circle) {
  if (auto ok = checkRibbons(wireframe); !ok) return std::unexpected(ok.error());
  auto bases = BasisTable::make(wireframe.ribbons, basisKeys(wireframe, connectivity));
  if (!bases) return std::unexpected(bases.error());
  auto jets = buildJets(wireframe, connectivity, *bases, circle);
  if (!jets) return std::unexpected(jets.error());

  Surface surface;
  surface.wireframe_ = std::move(wireframe);
  surface.connectivity_ = std::move(connectivity);
  surface.bases_ = std::make_shared<const BasisTable>(std::move(*bases));
  surface.stored_ = std::move(jets->stored);
  surface.rowStart_ = std::move(jets->rowStart);
  surface.terms_ = std::move(jets->terms);
  surface.corners_ = std::move(jets->corners);
  surface.frame();
  return surface;
}

void Surface::frame() {
  const Wireframe& w = wireframe_;
  const auto basisOf = [&](HalfArc h, Index edges) {
    return bases_->find(w.arcs[arcOf(h)].ribbon, edges);
  };
  frames_.resize(w.patches.size());
  for (Index p = 0; p < patchCount(); ++p) {
    Frame& f = frames_[p];
    f.m = w.sideEdges(p, 0);
    f.n = w.sideEdges(p, 1);
    f.u = basisOf(w.side(p, 0)[0], f.m);
    f.v[0] = basisOf(w.side(p, 3)[0], f.n);
    f.v[1] = basisOf(w.side(p, 1)[0], f.n);
  }
  for (const Arc& arc : w.arcs) arcBases_.push_back(bases_->find(arc.ribbon, arc.edges));
}

std::span<const Term> Surface::derivation(Index vector) const {
  const Index row = vector - storedCount();
  return {terms_.data() + rowStart_[row], terms_.data() + rowStart_[row + 1]};
}

void Surface::settle(std::span<const Vec3> stored, std::span<Vec3> vectors) const {
  const Index count = storedCount();
  if (stored.data() != vectors.data()) std::copy_n(stored.begin(), count, vectors.begin());
  for (Index v = count; v < vectorCount(); ++v) {
    Vec3 sum;
    for (const Term& t : derivation(v)) sum += t.factor * vectors[t.vector];
    vectors[v] = sum;
  }
}

JetRef Surface::alongJet(HalfArc h, int i) const {
  const Index corner = connectivity_.cornerAt[h];
  if (corner >= 0) return corners_[9 * corner + 3 * i];
  const HalfArc after = connectivity_.next[twin(h)];
  return corners_[9 * connectivity_.cornerAt[after] + i];
}

namespace {

// Which of g₁…g₆ in u and v weight the jet of a corner, and how its axes (α, β) lie in (u, v).
struct CornerPlace {
  int u, v;          // 0: at u (v) = 0, 3: at the other end
  bool alphaIsU;     // α runs along u
  int signU, signV;  // +1 where the corner's axis points along +u (+v)
};
constexpr CornerPlace kCorners[4] = {
    {0, 0, true, 1, 1}, {3, 0, false, -1, 1}, {3, 3, true, -1, -1}, {0, 3, false, 1, -1}};

}  // namespace

Surface::PatchBasis Surface::patchBasis(Index patch) const {
  const Frame& f = frames_[patch];
  return {&(*bases_)[f.u], &(*bases_)[f.v[0]], &(*bases_)[f.v[1]]};
}

Surface::Weights Surface::weights(const Site& site, int du, int dv) const {
  const Frame& f = frames_[site.patch];
  const auto g0 = bases_->values(f.v[0], site.v, dv);
  return combine(site.patch, bases_->values(f.u, site.u, du), g0,
                 f.v[0] == f.v[1] ? g0 : bases_->values(f.v[1], site.v, dv));
}

Surface::Weights Surface::weights(const Site& site, const PatchBasis& basis, int du, int dv) const {
  const Frame& f = frames_[site.patch];
  const auto g0 = BasisTable::inEdges(*basis.v0, site.v, f.n, dv);
  return combine(site.patch, BasisTable::inEdges(*basis.u, site.u, f.m, du), g0,
                 basis.v0 == basis.v1 ? g0 : BasisTable::inEdges(*basis.v1, site.v, f.n, dv));
}

Surface::Weights Surface::combine(Index patch, const std::array<double, 6>& gu,
                                  const std::array<double, 6>& g0,
                                  const std::array<double, 6>& g1) const {
  Weights w;
  for (int corner = 0, k = 0; corner < 4; ++corner) {
    const CornerPlace& place = kCorners[corner];
    const auto& gv = place.u == 0 ? g0 : g1;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j, ++k) {
        const JetRef ref = cornerJet(patch, corner, place.alphaIsU ? i : j, place.alphaIsU ? j : i);
        const double sign = (i == 1 ? place.signU : 1) * (j == 1 ? place.signV : 1);
        w.vectors[k] = ref.vector;
        w.factors[k] = ref.sign * sign * gu[place.u + i] * gv[place.v + j];
      }
  }
  return w;
}

Vec3 Surface::evaluate(std::span<const Vec3> vectors, const Site& site, int du, int dv) const {
  const Weights w = weights(site, du, dv);
  Vec3 sum;
  for (int k = 0; k < 36; ++k) sum += w.factors[k] * vectors[w.vectors[k]];
  return sum;
}

Vec3 Surface::normal(std::span<const Vec3> vectors, const Site& site) const {
  const Vec3 u = evaluate(vectors, site, 1, 0), v = evaluate(vectors, site, 0, 1);
  const Vec3 n = cross(u, v);
  if (norm(n) > 1e-9 * norm(u) * norm(v) && norm(u) > 0 && norm(v) > 0) return normalized(n);
  const Site near = inside(site);
  return normalized(cross(evaluate(vectors, near, 1, 0), evaluate(vectors, near, 0, 1)));
}

Surface::ArcWeights Surface::arcWeights(Index arc, double t) const {
  const HalfArc forward = 2 * arc;
  const auto g = bases_->values(arcBases_[arc], t, 0);
  ArcWeights w;
  for (int i = 0; i < 3; ++i) {
    const JetRef a = alongJet(forward, i), b = alongJet(twin(forward), i);
    w.vectors[i] = a.vector;
    w.factors[i] = a.sign * g[i];
    w.vectors[3 + i] = b.vector;
    w.factors[3 + i] = b.sign * (i == 1 ? -1 : 1) * g[3 + i];
  }
  return w;
}

Vec3 Surface::pointOnArc(std::span<const Vec3> vectors, Index arc, double t) const {
  const ArcWeights w = arcWeights(arc, t);
  Vec3 sum;
  for (int k = 0; k < 6; ++k) sum += w.factors[k] * vectors[w.vectors[k]];
  return sum;
}

Site Surface::siteOnArc(HalfArc h, double t) const {
  const Index patch = connectivity_.patchOf[h];
  const double m = frames_[patch].m, n = frames_[patch].n;
  for (int s = 0; s < 4; ++s) {
    double before = 0;
    for (HalfArc g : wireframe_.side(patch, s)) {
      const double x = before + t;
      if (g == h) {
        if (s == 0) return {patch, x, 0};
        if (s == 1) return {patch, m, x};
        if (s == 2) return {patch, m - x, n};
        return {patch, 0, n - x};
      }
      before += wireframe_.arcs[arcOf(g)].edges;
    }
  }
  return {};
}

std::vector<Index> Surface::owners(Index stored) const {
  std::vector<char> moved(vectorCount(), 0);
  moved[stored] = 1;
  for (Index v = storedCount(); v < vectorCount(); ++v)
    for (const Term& t : derivation(v)) moved[v] |= moved[t.vector];
  std::vector<Index> patches;
  for (Index p = 0; p < patchCount(); ++p)
    if (std::any_of(corners_.begin() + 36 * p, corners_.begin() + 36 * (p + 1),
                    [&](const JetRef& ref) { return moved[ref.vector]; }))
      patches.push_back(p);
  return patches;
}

}  // namespace sweepface
