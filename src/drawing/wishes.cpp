// What a drawing says about where the surface runs.
#include "drawing/wishes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "io/text.hpp"
#include "surface/inward.hpp"

namespace sweepface::drawing {

namespace {

class WishGatherer {
 public:
  WishGatherer(const Drawing& drawing, const Woven& woven, const Surface& surface,
               const std::vector<Offsets>& expressions)
      : d_(drawing), woven_(woven), w_(woven.wireframe), s_(surface), e_(expressions) {
    result_.wishes.places.resize(1 + expressions.size());
  }

  Result<DrawnWishes> gather() {
    for (Index n = 0; n < static_cast<Index>(w_.nodes.size()); ++n)
      if (w_.nodes[n].point < 0 && d_.nodes[n].at) wishNode(n);
    for (Index c = 0; c < static_cast<Index>(w_.arcs.size()); ++c)
      if (!d_.curves[c].points.empty())
        if (auto ok = wishPoints(c); !ok) return std::unexpected(ok.error());
    for (const Drawing::Control& control : d_.controls)
      if (auto ok = wishControls(control); !ok) return std::unexpected(ok.error());
    return std::move(result_);
  }

 private:
  void add(Index curve, std::vector<Term> sum, const Vec3& place,
           const Drawing::Control* control = nullptr) {
    result_.wishes.sums.push_back(std::move(sum));
    result_.wishes.places[0].push_back(place);
    result_.curves.push_back(curve);
    result_.controls.push_back(control);
  }
  void addOffset(std::size_t expression, const Vec3& offset) {
    result_.wishes.places[1 + expression].push_back(offset);
  }

  static std::vector<Term> termsOf(const auto& weights) {
    std::vector<Term> terms;
    for (std::size_t k = 0; k < weights.vectors.size(); ++k)
      if (weights.factors[k] != 0) terms.push_back({weights.vectors[k], weights.factors[k]});
    return terms;
  }

  void wishNode(Index n) {
    const HalfArc arm = s_.connectivity().stars[n].arms[0];
    const double end = arm & 1 ? w_.arcs[arcOf(arm)].edges : 0;
    add(arcOf(arm), termsOf(s_.arcWeights(arcOf(arm), end)), *d_.nodes[n].at);
    for (std::size_t k = 0; k < e_.size(); ++k) addOffset(k, e_[k].nodes[n].value_or(Vec3{}));
  }

  Result<void> wishPoints(Index c) {
    const auto line = polyline(c, fmt::format("curve '{}' is drawn by points", d_.curves[c].name));
    if (!line) return std::unexpected(line.error());
    const std::vector<double> at = parameters(*line, w_.arcs[c].edges);
    for (std::size_t k = 0; k < d_.curves[c].points.size(); ++k) {
      add(c, termsOf(s_.arcWeights(c, at[k + 1])), d_.curves[c].points[k]);
      for (std::size_t e = 0; e < e_.size(); ++e)
        addOffset(e, e_[e].curves[c] + (e_[e].points[c] ? (*e_[e].points[c])[k] : Vec3{}));
    }
    return {};
  }

  // The ends of a curve and the points between. `why` says in messages why their positions are
  // needed.
  Result<std::vector<Vec3>> polyline(Index c, const std::string& why) const {
    std::vector<Vec3> line;
    const Drawing::Curve& curve = d_.curves[c];
    for (const Index node : {w_.arcs[c].from, w_.arcs[c].to}) {
      const Drawing::Node& end = d_.nodes[node];
      const auto at = woven_.placeOf(d_, node);
      if (!at)
        return failAt(d_, end.place, fmt::format("node '{}' needs 'at', since {}", end.name, why));
      line.push_back(*at);
      if (line.size() == 1) line.insert(line.end(), curve.points.begin(), curve.points.end());
    }
    return line;
  }

  // The parameters of the points on a curve, by the length of the chords up to them.
  static std::vector<double> parameters(const std::vector<Vec3>& line, double edges) {
    std::vector<double> at{0};
    for (std::size_t k = 1; k < line.size(); ++k)
      at.push_back(at.back() + norm(line[k] - line[k - 1]));
    for (double& t : at) t = at.back() > 0 ? edges * std::min(1.0, t / at.back()) : 0;
    at.back() = edges;
    return at;
  }

  Result<void> wishControls(const Drawing::Control& control) {
    const auto refuse = [&](const std::string& what) { return failAt(d_, control.place, what); };
    const auto curve = woven_.curves.find(control.beside);
    if (curve == woven_.curves.end())
      return refuse(fmt::format("there is no curve '{}' to stand beside", control.beside));
    const auto patch = woven_.patches.find(control.in);
    if (patch == woven_.patches.end())
      return refuse(fmt::format("there is no patch '{}' to stand in", control.in));
    const Index c = curve->second, p = patch->second;
    const auto& patchOf = s_.connectivity().patchOf;
    const HalfArc h = patchOf[2 * c] == p ? 2 * c : 2 * c + 1;
    if (patchOf[h] != p)
      return refuse(
          fmt::format("curve '{}' does not bound patch '{}'; name a patch on either side of it",
                      control.beside, control.in));
    if (!controlled_.insert(h).second)
      return refuse(fmt::format("curve '{}' has control curves in patch '{}' already",
                                control.beside, control.in));
    if (w_.arcs[c].collapsed)
      return refuse(fmt::format("curve '{}' is one point; nothing runs beside it", control.beside));
    const auto line =
        polyline(c, fmt::format("control curves stand beside curve '{}'", control.beside));
    if (!line) return std::unexpected(line.error());
    if (control.second.size() != line->size() || control.third.size() != line->size())
      return refuse(
          fmt::format("the control curves beside '{}' need {} points each, one beside "
                      "each point of it with its ends, and have {} and {}",
                      control.beside, line->size(), control.second.size(), control.third.size()));
    const Inward way(s_, h);
    const auto spacing = spacingOf(control, *line, p, way);
    if (!spacing) return std::unexpected(spacing.error());
    addControls(control, c, h, way, *spacing, parameters(*line, w_.arcs[c].edges));
    return {};
  }

  Result<ControlSpacing> spacingOf(const Drawing::Control& control, const std::vector<Vec3>& line,
                                   Index patch, const Inward& way) const {
    if (control.spacing) return *control.spacing;
    double sum = 0;
    int lines = 0;
    for (const int s : {(way.side + 1) % 4, (way.side + 3) % 4}) {
      double length = 0;
      for (HalfArc h : w_.side(patch, s)) {
        const auto side = polyline(
            arcOf(h),
            fmt::format("the control curves beside '{}' have no 'spacing' and curve '{}' tells it",
                        control.beside, d_.curves[arcOf(h)].name));
        if (!side) return std::unexpected(side.error());
        for (std::size_t k = 1; k < side->size(); ++k) length += norm((*side)[k] - (*side)[k - 1]);
      }
      sum += length;
      lines += length > 0;
    }
    const auto spacing =
        spacingFromChords(line, control.second, control.third, sum / std::max(1, lines));
    if (spacing && spacing->u3 > 1)
      return failAt(d_, control.place,
                    fmt::format("the control curves beside '{}' stand up to {:.3g} times as far "
                                "away as their patch is wide; move them nearer or give their "
                                "'spacing'",
                                control.beside, spacing->u3));
    if (spacing) return spacing;
    return failAt(d_, control.place,
                  fmt::format("the control curves beside '{}': {}", control.beside,
                              io::withoutPeriod(spacing.error().message)));
  }

  // A control point lies on the parabola S + u S' + ½ u² S'' that leaves the boundary.
  void addControls(const Drawing::Control& control, Index c, HalfArc h, const Inward& way,
                   ControlSpacing spacing, const std::vector<double>& at) {
    const double edges = w_.arcs[c].edges;
    for (const bool third : {false, true}) {
      const double step = way.direction * way.edges * (third ? spacing.u3 : spacing.u2);
      const auto& points = third ? control.third : control.second;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Site site = s_.siteOnArc(h, h & 1 ? edges - at[k] : at[k]);
        std::vector<Term> sum = termsOf(s_.weights(site));
        for (int order = 1; order <= 2; ++order) {
          const double factor = order == 1 ? step : step * step / 2;
          for (Term t : termsOf(s_.weights(site, way.alongV ? 0 : order, way.alongV ? order : 0)))
            sum.push_back({t.vector, factor * t.factor});
        }
        add(c, std::move(sum), points[k], &control);
        for (std::size_t e = 0; e < e_.size(); ++e) addOffset(e, controlOffset(e, c, k, at));
      }
    }
  }

  // Control curves move with their boundary: with its points, and with its ends if those move.
  Vec3 controlOffset(std::size_t e, Index c, std::size_t k, const std::vector<double>& at) const {
    const bool inner = k > 0 && k + 1 < at.size();
    if (inner) return e_[e].curves[c] + (e_[e].points[c] ? (*e_[e].points[c])[k - 1] : Vec3{});
    return e_[e].nodes[k == 0 ? w_.arcs[c].from : w_.arcs[c].to].value_or(Vec3{});
  }

  const Drawing& d_;
  const Woven& woven_;
  const Wireframe& w_;
  const Surface& s_;
  const std::vector<Offsets>& e_;
  std::set<HalfArc> controlled_;
  DrawnWishes result_;
};

}  // namespace

Result<DrawnWishes> gatherWishes(const Drawing& drawing, const Woven& woven, const Surface& surface,
                                 const std::vector<Offsets>& expressions) {
  return WishGatherer(drawing, woven, surface, expressions).gather();
}

}  // namespace sweepface::drawing
