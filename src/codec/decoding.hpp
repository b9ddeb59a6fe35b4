#pragma once

#include <optional>
#include <span>
#include <string>

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"
#include "codec/level_one.hpp"
#include "codec/reader.hpp"

namespace sweepface::codec {

/// State while the chunks of a rig are read, and what they have announced so far.
struct Decoding {
  std::size_t fileSize = 0;
  std::size_t memory = 0;                          ///< bytes that may still be allocated
  std::size_t stored = 0, targets = 0, loose = 0;  ///< vectors, targets and loose vertices
  std::size_t quads = 0;                           ///< of the grid at level 1
  Wireframe wireframe;                             ///< until the surface is made from it
  Connectivity connectivity;                       ///< of the wireframe, likewise
  Mirror mirror;                                   ///< of the wireframe
  std::optional<Lattice> lattice;
  std::optional<LevelOne> levelOne;
  bool targetsToCome = false;  ///< their vectors are read later
  Rig* rig = nullptr;          ///< receives what is read

  /// Takes count * bytesEach bytes from `memory`. Refuses through `in` and returns false if too few
  /// are left.
  bool afford(Reader& in, std::size_t count, std::size_t bytesEach);
  /// The same for `eachPose` vectors in every pose. Also refuses more vectors than the size of the
  /// file allows.
  bool affordVectors(Reader& in, std::size_t eachPose, std::size_t bytesEach);
  /// Takes memory for the announced targets and loose vertices.
  void affordTargets(Reader& in);
  /// Makes the surface from the wireframe and its connectivity, and sets `stored`.
  void makeSurface(Reader& in);
  /// Adds a target. Refuses through `in` a name that is empty or not UTF-8; duplicates are checked
  /// at the end.
  void addTarget(Reader& in, std::string_view name);
};

/// How a kind of chunk is read. Handlers come in the order of their version's registry.
struct ChunkHandler {
  void (*read)(Decoding&, Reader&);
  bool required = false, repeated = false;
  const char* instead = nullptr;  ///< a kind that holds the same data; a file must not have both
};
/// Empty if this program does not read the version (web/src/usual.cpp).
std::span<const ChunkHandler> version1();
std::span<const ChunkHandler> version2();

/// Chunks that store data verbatim; most occur in both versions.
void readExact(Decoding& d, Reader& in);
void readDrift(Decoding& d, Reader& in);
void readLoose(Decoding& d, Reader& in);
void readSourceOrder(Decoding& d, Reader& in);
void readPolygons(Decoding& d, Reader& in);
void readTexcoords(Decoding& d, Reader& in);
void readQuadCorners(Decoding& d, Reader& in);
void readScene(Decoding& d, Reader& in);
void readThingNames(Decoding& d, Reader& in);

void readEnd(Decoding& d, Reader& in);

}  // namespace sweepface::codec
