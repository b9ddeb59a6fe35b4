#include "sweepface/drawing.hpp"

#include "mesh_properties.hpp"

// Reads a wireframe text, which must stay the same when written and read again. Builds it if it is
// small: the result must be finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sweepface;
  using fuzzing::require;
  const auto drawing = parseDrawing(fuzzing::asText(data, size), "input.json");
  if (!drawing) {
    const std::string& message = drawing.error().message;
    require(message.starts_with("input.json") && fuzzing::isSentence(message));
    return 0;
  }
  const std::string text = formatDrawing(*drawing);
  const auto again = parseDrawing(text, "again.json");
  require(again.has_value() && formatDrawing(*again) == text);
  long edges = 0;
  for (const auto& curve : drawing->curves) edges += curve.edges;
  constexpr std::size_t kFew = 20;
  if (drawing->curves.size() > kFew || edges > 100) return 0;
  const auto built = build(*drawing), builtAgain = build(*again);
  require(built.has_value() == builtAgain.has_value());
  if (!built) return 0;
  require(builtAgain->rig.neutral == built->rig.neutral &&
          builtAgain->rig.targets == built->rig.targets);
  for (const Vec3& v : built->rig.neutral) require(isFinite(v));
  for (const Target& target : built->rig.targets)
    for (const Vec3& v : target.difference) require(isFinite(v));
  return 0;
}
