#include "gltf/binary.hpp"

#include <algorithm>
#include <functional>

#include "gltf/accessor.hpp"

namespace sweepface::gltf {
namespace {

constexpr std::size_t word = 4;  // nothing in a glTF needs a wider alignment

std::size_t aligned(std::size_t bytes) { return (bytes + word - 1) / word * word; }

/// Whether the keys inside this member are a file's own names: of attributes, or of user data.
bool holdsNames(std::string_view key) {
  return key == "attributes" || key == "targets" || key == "extras";
}

/// Calls `visit` with every "bufferView" in a JSON.
void eachReferenceIn(Json& json, const std::function<void(Json&)>& visit) {
  if (json.is_array())
    for (Json& entry : json) eachReferenceIn(entry, visit);
  if (!json.is_object()) return;
  for (auto& [key, value] : json.items()) {
    if (key == "bufferView") visit(value);
    if (!holdsNames(key)) eachReferenceIn(value, visit);
  }
}

/// The same for all of a glTF, except inside views and buffers, which keep no view alive.
void eachReference(Json& gltf, const std::function<void(Json&)>& visit) {
  for (auto& [key, value] : gltf.items())
    if (key != "bufferViews" && key != "buffers") eachReferenceIn(value, visit);
}

/// From `begin` up to `end`.
struct Range {
  std::size_t begin = 0, end = 0;
};

/// The union of ranges, packed together: each piece begins at a multiple of `unit`.
class Pieces {
 public:
  Pieces(std::vector<Range> ranges, std::size_t unit) {
    std::ranges::sort(ranges, {}, &Range::begin);
    for (const Range& range : ranges)
      if (!pieces_.empty() && range.begin <= pieces_.back().end)
        pieces_.back().end = std::max(pieces_.back().end, range.end);
      else
        pieces_.push_back(range);
    for (const Range& piece : pieces_) {
      starts_.push_back(size_);
      size_ += (piece.end - piece.begin + unit - 1) / unit * unit;
    }
  }

  const std::vector<Range>& pieces() const { return pieces_; }
  std::size_t size() const { return size_; }
  /// The new position of a place within one of the ranges.
  std::size_t moved(std::size_t place) const {
    const auto after = std::ranges::upper_bound(pieces_, place, {}, &Range::begin);
    const auto k = static_cast<std::size_t>(after - pieces_.begin()) - 1;
    return starts_[k] + place - pieces_[k].begin;
  }

 private:
  std::vector<Range> pieces_;
  std::vector<std::size_t> starts_;
  std::size_t size_ = 0;
};

/// Values of an accessor in a view; `holder` has their byteOffset.
struct ViewUse {
  Json* holder = nullptr;
  std::size_t offset = 0, count = 0, size = 0;
  bool strided = false;
};

/// A view of which only some bytes are needed, as rows as long as its stride: some rows and some
/// words of each are kept.
class PartlyUsed {
 public:
  PartlyUsed(std::string_view bytes, std::size_t stride, const std::vector<ViewUse>& uses)
      : bytes_(bytes), row_(stride ? stride : word), words_(row_ / word) {
    std::vector<Range> rows;
    for (const ViewUse& use : uses) rows.push_back(mark(use));
    rows_ = Pieces(std::move(rows), 1);
  }

  /// Whether a view is made of words; otherwise it stays as it is.
  static bool canShrink(std::size_t stride) { return stride % word == 0; }

  std::size_t stride() const { return wordsBefore(words_.size()) * word; }
  std::size_t place(std::size_t offset) const {
    const std::size_t phase = offset % row_;
    return rows_.moved(offset / row_) * stride() + wordsBefore(phase / word) * word + phase % word;
  }
  std::size_t size() const { return rows_.size() * stride(); }
  std::string bytes() const {
    std::string kept;
    for (const Range& range : rows_.pieces())
      for (std::size_t row = range.begin; row < range.end; ++row) appendRow(kept, row);
    return kept;
  }

 private:
  /// The rows of a use; marks its words.
  Range mark(const ViewUse& use) {
    const std::size_t first = use.offset / row_, phase = use.offset % row_;
    if (use.strided && phase + use.size <= row_) {
      std::fill(words_.begin() + static_cast<std::ptrdiff_t>(phase / word),
                words_.begin() + static_cast<std::ptrdiff_t>(aligned(phase + use.size) / word),
                true);
      return {first, first + use.count};
    }
    std::fill(words_.begin(), words_.end(), true);
    const std::size_t step = use.strided ? row_ : use.size;
    const std::size_t end = use.offset + (use.count - 1) * step + use.size;
    return {first, (end + row_ - 1) / row_};
  }

  std::size_t wordsBefore(std::size_t count) const {
    return static_cast<std::size_t>(
        std::count(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(count), true));
  }

  void appendRow(std::string& kept, std::size_t row) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      if (!words_[w]) continue;
      // The last row of a view may end early.
      const std::size_t at = std::min(row * row_ + w * word, bytes_.size());
      const std::string_view bytes = bytes_.substr(at, word);
      kept += bytes;
      kept.append(word - bytes.size(), '\0');
    }
  }

  std::string_view bytes_;
  std::size_t row_;
  std::vector<bool> words_;
  Pieces rows_{{}, 1};
};

class Gatherer {
 public:
  Gatherer(Document& document, const std::vector<bool>& touched)
      : document_(document),
        touched_(touched),
        views_(document.views.size()),
        uses_(document.views.size()),
        references_(document.views.size()) {}

  std::string run() {
    findReferences();
    chooseViews();
    copyWholeViews();
    copyPartlyUsed();
    rewriteViews();
    rewriteBuffers();
    return std::move(binary_);
  }

 private:
  enum class Fate { whole, partly, gone };
  struct View {
    Fate fate = Fate::gone;
    std::size_t offset = 0, length = 0, stride = 0;  // in the new buffer
  };

  std::optional<std::size_t> viewOf(const Json& reference) const {
    return asIndex(reference, views_.size());
  }

  void findReferences() {
    eachReference(document_.json, [&](Json& reference) {
      if (const auto view = viewOf(reference)) ++references_[*view];
    });
    Json* const accessors = find(document_.json, "accessors");
    for (std::size_t a = 0; accessors && a < accessors->size(); ++a)
      if (const auto accessor = accessorAt(document_, a)) addUses((*accessors)[a], *accessor);
  }

  void addUses(Json& json, const Accessor& a) {
    if (a.view) {
      const bool strided = document_.views[*a.view].stride != 0;
      uses_[*a.view].push_back({&json, a.offset, a.count, a.elementSize(), strided});
    }
    if (!a.sparse) return;
    const Accessor::Sparse& s = *a.sparse;
    uses_[s.indexView].push_back(
        {&json["sparse"]["indices"], s.indexOffset, s.count, sizeOf(s.indexType), false});
    uses_[s.valueView].push_back(
        {&json["sparse"]["values"], s.valueOffset, s.count, a.elementSize(), false});
  }

  void chooseViews() {
    std::size_t partly = 0, all = 0;
    for (const std::string& buffer : document_.buffers) all += buffer.size();
    const bool mayBeNamed = usesUnknownExtensions(document_.json);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (references_[v] == 0) {
        // Something unknown may still refer to it in its own way.
        if (mayBeNamed && !touched_[v]) views_[v].fate = Fate::whole;
        continue;
      }
      // Not if something unknown refers to it as well.
      const bool shrinks = touched_[v] && references_[v] == uses_[v].size() &&
                           PartlyUsed::canShrink(document_.views[v].stride);
      views_[v].fate = shrinks ? Fate::partly : Fate::whole;
      if (shrinks) partly += partlyUsed(v).size();
    }
    // Overlapping views would be copied again and again.
    if (partly <= all) return;
    for (View& view : views_)
      if (view.fate == Fate::partly) view.fate = Fate::whole;
  }

  PartlyUsed partlyUsed(std::size_t v) const {
    return {document_.bytesOf(v), document_.views[v].stride, uses_[v]};
  }

  /// Bytes that several views share are copied once.
  void copyWholeViews() {
    std::vector<std::vector<std::size_t>> inBuffer(document_.buffers.size());
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (views_[v].fate == Fate::whole) inBuffer[document_.views[v].buffer].push_back(v);
    for (std::size_t b = 0; b < inBuffer.size(); ++b) {
      std::vector<Range> ranges;
      for (std::size_t v : inBuffer[b]) {
        const BufferView& old = document_.views[v];
        ranges.push_back({old.offset / word * word, old.offset + old.length});
      }
      const Pieces pieces(std::move(ranges), word);
      for (std::size_t v : inBuffer[b]) {
        const BufferView& old = document_.views[v];
        views_[v] = {Fate::whole, binary_.size() + pieces.moved(old.offset), old.length,
                     old.stride};
      }
      for (const Range& piece : pieces.pieces()) {
        binary_.append(document_.buffers[b], piece.begin, piece.end - piece.begin);
        binary_.resize(aligned(binary_.size()), '\0');
      }
    }
  }

  void copyPartlyUsed() {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (views_[v].fate != Fate::partly) continue;
      const PartlyUsed view = partlyUsed(v);
      for (const ViewUse& use : uses_[v]) setOffset(*use.holder, view.place(use.offset));
      const std::size_t stride = document_.views[v].stride ? view.stride() : 0;
      views_[v] = {Fate::partly, binary_.size(), view.size(), stride};
      binary_ += view.bytes();
    }
  }

  static void setOffset(Json& holder, std::size_t offset) {
    if (offset == 0)
      holder.erase("byteOffset");
    else
      holder["byteOffset"] = offset;
  }

  void rewriteViews() {
    Json* const old = find(document_.json, "bufferViews");
    if (!old) return;
    const bool keepNumbers = usesUnknownExtensions(document_.json);
    Json kept = Json::array();
    std::vector<std::size_t> numbers(views_.size());
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (views_[v].fate == Fate::gone && !keepNumbers) continue;
      numbers[v] = kept.size();
      kept.push_back(views_[v].fate == Fate::gone ? placeholder()
                                                  : rewritten((*old)[v], views_[v]));
    }
    *old = std::move(kept);
    eachReference(document_.json, [&](Json& reference) {
      if (const auto view = viewOf(reference)) reference = numbers[*view];
    });
    if (old->empty()) document_.json.erase("bufferViews");
  }

  static Json rewritten(Json json, const View& view) {
    json["buffer"] = 0;
    setOffset(json, view.offset);
    json["byteLength"] = view.length;
    if (view.stride != 0) json["byteStride"] = view.stride;
    return json;
  }

  /// A view must have bytes, so there must be some in the buffer.
  Json placeholder() {
    if (binary_.empty()) binary_.resize(word, '\0');
    return {{"buffer", 0}, {"byteLength", 1}};
  }

  void rewriteBuffers() {
    Json* const buffers = find(document_.json, "buffers");
    if (!buffers) return;
    if (binary_.empty()) {
      document_.json.erase("buffers");
      return;
    }
    Json buffer = std::move((*buffers)[0]);
    buffer.erase("uri");
    buffer["byteLength"] = binary_.size();
    *buffers = Json::array({std::move(buffer)});
  }

  Document& document_;
  const std::vector<bool>& touched_;
  std::vector<View> views_;
  std::vector<std::vector<ViewUse>> uses_;
  std::vector<std::size_t> references_;
  std::string binary_;
};

}  // namespace

std::string gatherBinary(Document& document, const std::vector<bool>& touched) {
  return Gatherer(document, touched).run();
}

}  // namespace sweepface::gltf
