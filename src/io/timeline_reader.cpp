#include <cmath>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

#include "sweepface/timeline.hpp"
#include "sweepface/weights.hpp"

#include "io/drive_numbers.hpp"
#include "io/json_fields.hpp"
#include "io/json_text.hpp"
#include "io/text.hpp"

namespace sweepface {
namespace {

using Json = nlohmann::json;

class TimelineReader {
 public:
  TimelineReader(std::string_view name, const Json& json) : name_(name), json_(json) {}

  Result<Timeline> read() {
    const io::JsonFields file = fields(json_, "the file");
    if (auto ok = file.isObject({"seconds", "loops", "poses", "events", "regions"}); !ok)
      return std::unexpected(ok.error());
    Timeline timeline;
    double loops = 1;
    if (auto ok = file.number("seconds", timeline.seconds, true); !ok)
      return std::unexpected(ok.error());
    if (auto ok = file.number("loops", loops); !ok) return std::unexpected(ok.error());
    if (!(timeline.seconds > 0)) return failAt("'seconds'", "must be greater than 0");
    if (!(loops >= 1 && loops <= 10'000 && loops == std::floor(loops)))
      return failAt("'loops'", "must be a whole number from 1 to 10000");
    timeline.loops = static_cast<int>(loops);
    const auto events = json_.find("events");
    if (events == json_.end() || !events->is_array() || events->empty())
      return failAt("'events'", "must be a list of at least one event");
    if (const auto regions = json_.find("regions"); regions != json_.end() && !regions->is_array())
      return failAt("'regions'", "are not a list");
    if (auto ok = readPoses(); !ok) return std::unexpected(ok.error());
    const double end = timeline.seconds * loops * (1 + 1e-9);  // 0.1 + 0.2 is more than 0.3
    std::multimap<double, TimelineEvent> inOrder;  // keeps the order of simultaneous events
    for (std::size_t k = 0; k < events->size(); ++k) {
      const std::string place = fmt::format("events[{}]", k);
      auto event = readEvent((*events)[k], place);
      if (!event) return std::unexpected(event.error());
      if (event->time > timeline.seconds) return failAt(place, "is later than 'seconds'");
      if (event->time + event->drive.delay > end)
        return failAt(place, "has a 'delay' that leads beyond the end, so that it never plays");
      inOrder.emplace(event->time, std::move(*event));
    }
    for (auto& [time, event] : inOrder) timeline.events.push_back(std::move(event));
    return timeline;
  }

 private:
  io::JsonFields fields(const Json& object, std::string place) const {
    return {name_, object, std::move(place)};
  }
  std::unexpected<Error> failAt(std::string_view place, std::string_view what) const {
    return fields(json_, {}).failAt(place, what);
  }

  using Goals = std::vector<std::pair<std::string, double>>;

  Result<void> readPoses() {
    const auto poses = json_.find("poses");
    if (poses == json_.end()) return {};
    if (!poses->is_object()) return failAt("'poses'", "are not an object");
    for (const auto& [name, weights] : poses->items()) {
      const std::string place = fmt::format("pose '{}'", name);
      if (!weights.is_object()) return failAt(place, "is not an object of weights");
      if (auto ok = readWeights(weights, place, poses_[name]); !ok) return ok;
    }
    return {};
  }

  Result<TimelineEvent> readEvent(const Json& json, const std::string& place) {
    const io::JsonFields at = fields(json, place);
    if (auto ok = at.isObject({"at", "to", "only", "drive", "seconds", "turn", "frequency",
                               "damping", "restitution", "delay", "region"});
        !ok)
      return std::unexpected(ok.error());
    TimelineEvent event;
    std::string drive(nameOf(event.drive.kind));
    if (auto ok = at.text("drive", drive); !ok) return std::unexpected(ok.error());
    if (auto ok = at.text("region", event.region); !ok) return std::unexpected(ok.error());
    const Result<Drive> named = driveFromName(drive);
    if (!named) return at.pass(named.error());
    event.drive = *named;
    if (auto ok = at.number("at", event.time, true); !ok) return std::unexpected(ok.error());
    const auto numbers = io::numbersOf(event.drive);
    for (const auto& [key, value] : numbers)
      if (auto ok = at.number(key, *value); !ok) return std::unexpected(ok.error());
    for (const auto& [key, value] : numbers)
      if (json.contains(key) && !io::takes(event.drive.kind, key))
        return failAt(place,
                      fmt::format("has a '{}', which the drive '{}' has no use for; leave it "
                                  "out, or name another drive",
                                  key, drive));
    if (event.time < 0) return failAt(place, "is before 0");
    // A drive that could not even start from rest is refused here, where its place is known.
    if (const auto path = trajectoryOf(event.drive, {}, 1); !path || event.drive.delay < 0)
      return failAt(place, path ? "has a negative 'delay'"
                                : "cannot be: " + io::withoutPeriod(path.error().message));
    event.others = json.contains("only");
    if (event.others == json.contains("to"))
      return failAt(place, "needs one of 'to' and 'only', the weights to go to");
    if (auto ok = readGoals(json[event.others ? "only" : "to"], place, event.goals); !ok)
      return std::unexpected(ok.error());
    goals_ += event.goals.size();
    if (goals_ > kMostGoals)
      return failAt(place,
                    "is beyond the 8,000,000 goals of a timeline, those of poses counted for each "
                    "event; send off fewer weights, or cut it");
    return event;
  }

  /// Reads weights by name, or the name of a pose that has them.
  Result<void> readGoals(const Json& json, const std::string& place, Goals& goals) const {
    if (json.is_object()) return readWeights(json, place, goals);
    if (!json.is_string()) return failAt(place, "goes neither to weights nor to a pose");
    const auto name = json.get<std::string>();
    const auto pose = poses_.find(name);
    if (pose == poses_.end())
      return failAt(place, fmt::format("goes to a pose '{}' that 'poses' does not have", name));
    goals = pose->second;
    return {};
  }

  Result<void> readWeights(const Json& json, const std::string& place, Goals& goals) const {
    for (const auto& [name, weight] : json.items()) {
      if (!weight.is_number() || !isPlausibleWeight(weight.get<double>()))
        return failAt(
            place, fmt::format("has a weight '{}' that is not a number within ±1,000,000", name));
      goals.emplace_back(name, weight.get<double>());
    }
    return {};
  }

  static constexpr std::size_t kMostGoals = 8'000'000;

  std::string_view name_;
  const Json& json_;
  std::map<std::string, Goals> poses_;
  std::size_t goals_ = 0;
};

}  // namespace

bool isTimeline(std::string_view text) {
  constexpr std::string_view key = "\"events\"";
  int depth = 0;
  bool found = false;
  io::scanJson(text, [&](std::size_t at) {
    const char c = text[at];
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth != 1 || !text.substr(at).starts_with(key)) return true;
    // The same word may be the value of another key.
    const std::size_t after = text.find_first_not_of(" \t\r\n", at + key.size());
    found = after != std::string_view::npos && text[after] == ':';
    return !found;
  });
  return found;
}

Result<Timeline> parseTimeline(std::string_view text, std::string_view name) {
  const auto json = io::parseJson(text, name);
  if (!json) return std::unexpected(json.error());
  return TimelineReader(name, *json).read();
}

}  // namespace sweepface
