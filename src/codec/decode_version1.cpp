#include "codec/blocks.hpp"
#include "codec/decoding.hpp"
#include "codec/limits.hpp"
#include "codec/wire_version1.hpp"

namespace sweepface::codec {

namespace {

void readHead(Decoding& d, Reader& in) {
  d.rig->tolerance = in.f64();
  if (d.rig->tolerance < 0) in.refuse("the tolerance is negative");
  d.stored = in.size();
  d.targets = in.size();
  d.loose = in.size();
  d.affordTargets(in);
}

void readWire(Decoding& d, Reader& in) { d.wireframe = readWireframe(in); }

void readCreases(Decoding& d, Reader& in) {
  const auto arcs = static_cast<Index>(d.wireframe.arcs.size());
  Index last = -1;
  for (std::size_t count = in.count(1, "creases"); count > 0 && in.ok(); --count) {
    const Index arc = in.step(last, last + std::int64_t{1}, arcs, "crease");
    if (in.ok()) d.wireframe.arcs[last = arc].crease = true;
  }
}

void readShapes(Decoding& d, Reader& in) {
  const std::size_t count = in.size();
  if (count / 8 > in.left()) in.refuse("there are more ribbons than the chunk can hold");
  if (!in.ok() || !d.afford(in, count, kBytesARibbon)) return;
  d.wireframe.ribbons.resize(count);
  const std::vector<char> chosen = readMask(in, count);
  for (std::size_t r = 0; r < count && in.ok(); ++r)
    if (chosen[r]) d.wireframe.ribbons[r] = {in.f64(), in.f64(), in.f64()};
  if (!in.ok()) return;
  const std::size_t announced = d.stored;
  if (!d.afford(in, d.wireframe.patches.size(), kBytesAPatch)) return;
  auto connectivity = Connectivity::make(d.wireframe);
  if (!connectivity)
    return in.refuseWith({"the wireframe is unsound: ", connectivity.error().message});
  d.connectivity = std::move(*connectivity);
  d.makeSurface(in);
  for (std::size_t pose = 0; pose <= d.targets && in.ok(); ++pose)
    d.afford(in, d.stored, kBytesAVector);
  if (in.ok() && d.stored != announced)
    in.refuseWith({"the wireframe stores ", d.stored, " vectors and the file ", announced});
}

void readNeutral(Decoding& d, Reader& in) {
  d.rig->neutral = readVectors<Vec3>(in, d.stored, Precision::single);
}

void readTarget(Decoding& d, Reader& in) {
  if (d.rig->targets.size() == d.targets) return in.refuse("there are more targets than announced");
  d.addTarget(in, in.text());
  Target& target = d.rig->targets.back();
  target.difference = readVectors<Vec3>(in, d.stored, Precision::single);
  target.looseDifference = readVectors<Vec3>(in, d.loose, Precision::exact);
}

}  // namespace

std::span<const ChunkHandler> version1() {
  static constexpr ChunkHandler kReaders[] = {{readHead, true},    {readWire, true},
                                              {readCreases},       {readShapes, true},
                                              {readNeutral, true}, {readTarget, false, true},
                                              {readLoose},         {readSourceOrder},
                                              {readPolygons},      {readTexcoords},
                                              {readQuadCorners},   {readScene},
                                              {readThingNames},    {readEnd}};
  return kReaders;
}

}  // namespace sweepface::codec
