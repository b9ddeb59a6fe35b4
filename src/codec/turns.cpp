#include "codec/turns.hpp"

#include <cmath>

namespace sweepface::codec {
namespace {

constexpr std::size_t kLeastBytes = 1 + 3 * sizeof(float);

Vec3 rounded(const Vec3& v) {
  const auto one = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {one(v.x), one(v.y), one(v.z)};
}

void writeVector(Writer& out, const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) out.f32(static_cast<float>(x));
}

Vec3 readVector(Reader& in) {
  Vec3 v;
  v.x = in.f32(), v.y = in.f32(), v.z = in.f32();
  return v;
}

bool isAxis(const Vec3& axis) { return std::abs(norm(axis) - 1) < 1e-5; }

}  // namespace

std::vector<Turn> storedTurns(const Rig& rig) {
  std::vector<Turn> turns;
  Index next = 0;
  for (const Turn& turn : rig.turns) {
    const Turn held{turn.target, rounded(turn.pivot), rounded(turn.axis)};
    if (held.target < next || held.target >= static_cast<Index>(rig.targets.size())) continue;
    if (!isFinite(held.pivot) || !(held.axis == Vec3{} || isAxis(held.axis))) continue;
    turns.push_back(held);
    next = held.target + 1;
  }
  return turns;
}

void writeTurns(Writer& out, const std::vector<Turn>& turns) {
  out.number(turns.size());
  Index next = 0;
  for (const Turn& turn : turns) {
    const bool isBall = turn.axis == Vec3{};
    out.number(2 * static_cast<std::uint64_t>(turn.target - next) + (isBall ? 1 : 0));
    next = turn.target + 1;
    writeVector(out, turn.pivot);
    if (!isBall) writeVector(out, turn.axis);
  }
}

std::vector<Turn> readTurns(Reader& in, std::size_t targets) {
  std::vector<Turn> turns(in.count(kLeastBytes, "turns"));
  std::size_t next = 0;
  for (Turn& turn : turns) {
    const std::size_t code = in.size();
    const std::size_t target = next + code / 2;
    if (target >= targets) in.refuse("a turn is of a target that there is not");
    if (!in.ok()) return {};
    turn.target = static_cast<Index>(target);
    turn.pivot = readVector(in);
    if (code % 2 == 0) {
      turn.axis = readVector(in);
      if (!isAxis(turn.axis)) in.refuse("the axis of a turn is not of length 1");
    }
    next = target + 1;
  }
  return turns;
}

}  // namespace sweepface::codec
