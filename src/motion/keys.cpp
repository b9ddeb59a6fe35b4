// Each piece extends as far as a cubic with free slopes at its ends stays near the clip (this
// greedy choice is optimal if any part of a good piece is itself good). The slopes are fitted by
// least squares over the samples of the piece, as in P. J. Schneider, "An Algorithm for
// Automatically Fitting Digitized Curves", Graphics Gems, 1990.
#include "sweepface/keys.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {
namespace {

/// The four cubic Hermite polynomials at s ∈ [0, 1]: for the values at both ends, and for the
/// slopes there, multiplied by the length of the piece.
struct Hermite {
  double start, startSlope, end, endSlope;
  explicit Hermite(double s)
      : start((1 + 2 * s) * (1 - s) * (1 - s)),
        startSlope(s * (1 - s) * (1 - s)),
        end(s * s * (3 - 2 * s)),
        endSlope(s * s * (s - 1)) {}
};

/// Samples of a clip per frame.
constexpr std::size_t kParts = 4;
constexpr double shareOf(std::size_t part) { return static_cast<double>(part) / kParts; }

class KeyFinder {
 public:
  KeyFinder(const Clip& clip, double tolerance)
      : clip_(clip), count_(clip.names.size()), tolerance_(tolerance), slopes_(2 * count_) {
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t f = 1; f < clip.times.size(); ++f)
        if (weight(f, k) != weight(0, k)) {
          moving_.push_back(k);
          break;
        }
  }

  CubicKeys find() {
    keys_.names = clip_.names;
    const std::size_t frames = clip_.times.size();
    if (frames == 0) return keys_;
    addKey(0);
    for (std::size_t from = 0; from + 1 < frames;) {
      const std::size_t to = farthest(from);
      fit(from, to);
      std::ranges::copy(std::span(slopes_).first(count_), keys_.out.end() - width());
      addKey(to);
      std::ranges::copy(std::span(slopes_).last(count_), keys_.in.end() - width());
      from = to;
    }
    return keys_;
  }

 private:
  std::ptrdiff_t width() const { return static_cast<std::ptrdiff_t>(count_); }
  double weight(std::size_t frame, std::size_t k) const {
    return clip_.weights[frame * count_ + k];
  }

  void addKey(std::size_t frame) {
    keys_.times.push_back(clip_.times[frame]);
    const auto row = clip_.weights.begin() + static_cast<std::ptrdiff_t>(frame * count_);
    keys_.values.insert(keys_.values.end(), row, row + width());
    keys_.in.resize(keys_.values.size(), 0.0);
    keys_.out.resize(keys_.values.size(), 0.0);
  }

  /// The last frame that one piece can reach, found by doubling strides and then by bisection.
  std::size_t farthest(std::size_t from) {
    const std::size_t last = clip_.times.size() - 1;
    std::size_t good = from + 1, stride = 2;
    std::size_t bad = last + 1;
    while (good < last) {
      const std::size_t next = std::min(last, good + stride);
      if (!fit(from, next)) {
        bad = next;
        break;
      }
      good = next, stride *= 2;
    }
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (fit(from, middle) ? good : bad) = middle;
    }
    return good;
  }

  /// Fits the slopes of a piece and returns whether it is near enough.
  bool fit(std::size_t from, std::size_t to) {
    prepare(from, to);
    for (const std::size_t k : moving_)
      if (!fitWeight(from, to, k)) return false;
    return true;
  }

  /// Computes what all weights of a piece share: the cubics at its frames and between them.
  void prepare(std::size_t from, std::size_t to) {
    const double start = clip_.times[from];
    length_ = clip_.times[to] - start;
    places_.clear();
    aa_ = ab_ = bb_ = 0;
    for (std::size_t f = from; f < to; ++f)
      for (std::size_t part = 0; part < kParts; ++part) {
        const double time = std::lerp(clip_.times[f], clip_.times[f + 1], shareOf(part));
        const Hermite h = places_.emplace_back((time - start) / length_);
        aa_ += h.startSlope * h.startSlope;
        ab_ += h.startSlope * h.endSlope;
        bb_ += h.endSlope * h.endSlope;
      }
  }

  double sample(std::size_t from, std::size_t place, std::size_t k) const {
    const std::size_t frame = from + place / kParts;
    return std::lerp(weight(frame, k), weight(frame + 1, k), shareOf(place % kParts));
  }

  bool fitWeight(std::size_t from, std::size_t to, std::size_t k) {
    const double p = weight(from, k), q = weight(to, k);
    double a = q - p, b = q - p;  // a straight line between neighbouring frames
    if (to > from + 1) {
      double x = 0, y = 0;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const Hermite& h = places_[i];
        const double left = sample(from, i, k) - h.start * p - h.end * q;
        x += h.startSlope * left, y += h.endSlope * left;
      }
      const double determinant = aa_ * bb_ - ab_ * ab_;
      a = (x * bb_ - y * ab_) / determinant, b = (y * aa_ - x * ab_) / determinant;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const Hermite& h = places_[i];
        const double found = h.start * p + h.end * q + h.startSlope * a + h.endSlope * b;
        if (!(std::abs(found - sample(from, i, k)) <= tolerance_)) return false;
      }
    }
    slopes_[k] = a / length_, slopes_[count_ + k] = b / length_;
    return true;
  }

  const Clip& clip_;
  std::size_t count_;
  double tolerance_, length_ = 1;
  std::vector<double> slopes_;       // [2 × N] of the last fit, per second
  std::vector<std::size_t> moving_;  // weights that change; the others have no slope anywhere
  std::vector<Hermite> places_;
  double aa_ = 0, ab_ = 0, bb_ = 0;  // the normal equations
  CubicKeys keys_;
};

}  // namespace

void CubicKeys::at(double time, std::span<double> weights) const noexcept {
  const std::size_t n = names.size(), count = std::min(n, weights.size());
  if (times.empty()) {
    std::ranges::fill(weights.first(count), 0.0);
    return;
  }
  const auto after =
      static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (after == 0 || after == times.size()) {
    const std::size_t row = after == 0 ? 0 : times.size() - 1;
    std::ranges::copy(std::span(values).subspan(row * n, count), weights.begin());
    return;
  }
  const double length = times[after] - times[after - 1];
  const Hermite h((time - times[after - 1]) / length);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = (after - 1) * n + k, to = after * n + k;
    weights[k] = h.start * values[from] + h.end * values[to] +
                 length * (h.startSlope * out[from] + h.endSlope * in[to]);
  }
}

CubicKeys fewestKeys(const Clip& clip, double tolerance) {
  return KeyFinder(clip, tolerance).find();
}

}  // namespace sweepface
