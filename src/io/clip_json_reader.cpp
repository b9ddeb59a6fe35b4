#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sweepface/clip.hpp"
#include "sweepface/weights.hpp"

#include "io/face_transform.hpp"
#include "io/json_text.hpp"

namespace sweepface {
namespace {

using Json = nlohmann::json;

const Json* member(const Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

class ClipJsonReader {
 public:
  ClipJsonReader(std::string_view name, double framesPerSecond)
      : name_(name), framesPerSecond_(framesPerSecond) {}

  Result<Clip> read(const Json& json) {
    if (member(json, "weightMat")) return readAudio2Face(json);
    const Json* frames = json.is_array() ? &json : member(json, "frames");
    if (frames && frames->is_array()) return readMediaPipe(*frames);
    if (member(json, "asset"))
      return failFile("is a .gltf, which leads to other files; give a .glb, which holds them");
    return failFile(
        "is neither of Audio2Face ('facsNames' and 'weightMat'), nor of MediaPipe (a list of "
        "frames with 'categories'), nor a timeline ('seconds' and 'events'); "
        "export it as one of them");
  }

 private:
  std::unexpected<Error> failFile(std::string_view what) const {
    return fail(fmt::format("{} {}.", name_, what));
  }
  void warn(std::string_view sentence) {
    clip_.warnings.push_back(fmt::format("{}: {}", name_, sentence));
  }

  // ---- Audio2Face: a matrix of frames × names ----

  Result<Clip> readAudio2Face(const Json& json) {
    const Json* fps = member(json, "exportFps");
    if (!fps || !fps->is_number() || !(fps->get<double>() > 0))
      return failFile("has no 'exportFps' greater than 0");
    const Json* names = member(json, "facsNames");
    if (!names || !names->is_array() || names->empty())
      return failFile("has no list 'facsNames' with names in it");
    std::set<std::string> seen;
    for (const Json& shape : *names) {
      if (!shape.is_string()) return failFile("has a value in 'facsNames' that is not a name");
      clip_.names.push_back(shape.get<std::string>());
      if (!seen.insert(clip_.names.back()).second)
        return failFile(fmt::format("names '{}' twice in 'facsNames'", clip_.names.back()));
    }
    const Json& rows = json["weightMat"];
    if (!rows.is_array() || rows.empty()) return failFile("has no frames in 'weightMat'");
    if (!isPlausibleTime(static_cast<double>(rows.size()) / fps->get<double>()))
      return failFile("has too low an 'exportFps' for its frames");
    if (const Json* told = member(json, "numFrames"); told && *told != rows.size())
      warn(fmt::format("'numFrames' is {}, but 'weightMat' has {} frames; was the file cut short?",
                       told->dump(), rows.size()));
    for (std::size_t f = 0; f < rows.size(); ++f) {
      clip_.times.push_back(static_cast<double>(f) / fps->get<double>());
      if (auto ok = readRow(rows[f], f); !ok) return std::unexpected(ok.error());
    }
    return std::move(clip_);
  }
  Result<void> readRow(const Json& row, std::size_t frame) {
    if (!row.is_array() || row.size() != clip_.names.size())
      return failFile(fmt::format("has not {} numbers in weightMat[{}], one for every name",
                                  clip_.names.size(), frame));
    for (const Json& weight : row) {
      if (!weight.is_number() || !isPlausibleWeight(weight.get<double>()))
        return failFile(fmt::format(
            "has a value that is not a number within ±1,000,000 in weightMat[{}]", frame));
      clip_.weights.push_back(weight.get<double>());
    }
    return {};
  }

  // ---- MediaPipe: every frame names its scores ----

  using Scores = std::map<std::string, double>;
  static constexpr std::array kHead{"HeadYaw", "HeadPitch", "HeadRoll"};

  Result<Clip> readMediaPipe(const Json& frames) {
    if (frames.empty()) return failFile("has no frames");
    std::vector<double> times;
    std::vector<Scores> scores(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const auto time = readTime(frames[f], f);
      if (!time) return std::unexpected(time.error());
      if (f > 0 && *time <= times.back())
        return failFile(fmt::format("has a time in frame {} that is not after the one before", f));
      times.push_back(*time);
      if (auto ok = readScores(frames[f], f, scores[f]); !ok) return std::unexpected(ok.error());
      if (!scores[f].empty()) readTransform(frames[f], scores[f]);
    }
    if (brokenTransforms_ > 0)
      warn(
          fmt::format("{} of {} frames have a transformation of the face that is no matrix of 4 × "
                      "4 numbers; the head stands there as in the frame before.",
                      brokenTransforms_, frames.size()));
    keepHeads(scores);
    checkUnit(times);
    return clipOf(times, scores);
  }

  /// Where a frame does not tell how the head turns, it stands as in the one before, or else as in
  /// the first that does.
  static void keepHeads(std::vector<Scores>& scores) {
    const auto tells = [](const Scores& frame) { return frame.contains(kHead[0]); };
    auto last = std::ranges::find_if(scores, tells);
    if (last == scores.end()) return;
    for (auto frame = scores.begin(); frame != scores.end(); ++frame) {
      if (tells(*frame))
        last = frame;
      else if (!frame->empty())
        for (const char* angle : kHead) (*frame)[angle] = last->at(angle);
    }
  }

  Result<double> readTime(const Json& frame, std::size_t f) const {
    const Json* time = nullptr;
    for (const char* key : {"timestampMs", "timestamp_ms", "timestamp"})
      if (!time) time = member(frame, key);
    const bool isCounted = !time && framesPerSecond_ > 0;
    if (!isCounted && (!time || !time->is_number()))
      return failFile(fmt::format(
          "has no 'timestampMs' in frame {}; add the milliseconds, or give the frames a second",
          f));
    const double seconds =
        isCounted ? static_cast<double>(f) / framesPerSecond_ : time->get<double>() / 1000;
    if (isPlausibleTime(seconds)) return seconds;
    return failFile(fmt::format("has a time in frame {} that is not within 300 years", f));
  }
  /// Warns of frame intervals that no camera has.
  void checkUnit(const std::vector<double>& times) {
    if (times.size() < 2) return;
    const double step =
        1000 * (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    if (step < 1 || step > 5000)
      warn(fmt::format("frames are {} ms apart; are the times milliseconds, as they should be?",
                       step > 1 ? fmt::format("{:.0f}", step) : fmt::format("{:.3g}", step)));
  }

  Result<Clip> clipOf(const std::vector<double>& times, const std::vector<Scores>& scores) {
    std::set<std::string_view> known{"_neutral"};
    for (const Scores& frame : scores)
      for (const auto& [shape, score] : frame)
        if (known.insert(shape).second) clip_.names.push_back(shape);
    if (clip_.names.empty()) return failFile("has no scores in its frames");
    // If each frame had names of its own, a few scores would become a great many weights.
    if (clip_.names.size() > kMostClipWeights / scores.size())
      return failFile(fmt::format(
          "has {} names in {} frames, more than a clip can hold; name the same ones in every frame",
          clip_.names.size(), scores.size()));
    // Frames without a face are left out, except at the ends: there they repeat their neighbours,
    // so that the other frames keep their times.
    const auto hasFace = [&](const Scores& frame) { return !frame.empty(); };
    const auto first =
        static_cast<std::size_t>(std::ranges::find_if(scores, hasFace) - scores.begin());
    std::size_t last = scores.size() - 1;
    while (!hasFace(scores[last])) --last;
    for (std::size_t f = 0; f < scores.size(); ++f)
      if (hasFace(scores[f]) || f == 0 || f + 1 == scores.size())
        append(times[f], scores[std::clamp(f, first, last)]);
    if (const auto lost = std::ranges::count_if(scores, std::not_fn(hasFace)); lost > 0)
      warn(fmt::format("{} of {} frames found no face; weights go on from the frames around them.",
                       lost, scores.size()));
    return std::move(clip_);
  }
  void append(double time, const Scores& frame) {
    clip_.times.push_back(time);
    for (const std::string& shape : clip_.names) {
      const auto found = frame.find(shape);
      clip_.weights.push_back(found == frame.end() ? 0 : found->second);
    }
  }

  Result<void> readScores(const Json& frame, std::size_t f, Scores& scores) const {
    const Json* categories = categoriesOf(frame);
    if (!categories || !categories->is_array())
      return failFile(fmt::format("has no 'categories' in frame {}", f));
    for (const Json& category : *categories) {
      const Json* shape = member(category, "categoryName");
      if (!shape) shape = member(category, "category_name");
      const Json* score = member(category, "score");
      if (!shape || !shape->is_string() || !score || !score->is_number())
        return failFile(
            fmt::format("has a category without 'categoryName' and 'score' in frame {}", f));
      if (!isPlausibleWeight(score->get<double>()))
        return failFile(fmt::format("has a score in frame {} that is not within ±1,000,000", f));
      scores[shape->get<std::string>()] = score->get<double>();
    }
    return {};
  }
  void readTransform(const Json& frame, Scores& scores) {
    const auto [angles, isBroken] = io::faceTransformOf(frame);
    brokenTransforms_ += isBroken;
    if (!angles) return;
    scores[kHead[0]] = angles->yaw;
    scores[kHead[1]] = angles->pitch;
    scores[kHead[2]] = angles->roll;
  }
  // The categories are beside the time, or belong to the first of the faces found: an object in
  // JavaScript, the list itself in Python. A frame without a face has none.
  static const Json* categoriesOf(const Json& frame) {
    static const Json none = Json::array();
    if (const Json* direct = member(frame, "categories")) return direct;
    for (const char* key : {"faceBlendshapes", "face_blendshapes"})
      if (const Json* faces = member(frame, key); faces && faces->is_array()) {
        if (faces->empty()) return &none;
        const Json& face = (*faces)[0];
        return face.is_array() ? &face : member(face, "categories");
      }
    return nullptr;
  }

  std::string_view name_;
  double framesPerSecond_;
  Clip clip_;
  std::size_t brokenTransforms_ = 0;  // frames
};

}  // namespace

Result<Clip> parseClipJson(std::string_view text, std::string_view name, double framesPerSecond) {
  if (auto ok = io::checkFrameRateIfGiven(framesPerSecond); !ok) return std::unexpected(ok.error());
  const auto json = io::parseJson(text, name);
  if (!json) return std::unexpected(json.error());
  return ClipJsonReader(name, framesPerSecond).read(*json);
}

}  // namespace sweepface
