#pragma once

#include <optional>
#include <span>
#include <string>

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"
#include "codec/level_one.hpp"
#include "codec/reader.hpp"

namespace sweepface::codec {

/// A rig while its chunks are read, and what they have announced.
struct Decoding {
  std::size_t fileSize = 0;
  std::size_t memory = 0;                          ///< that may still be taken
  std::size_t stored = 0, targets = 0, loose = 0;  ///< vectors, targets and loose vertices
  std::size_t quads = 0;                           ///< of the grid at level 1
  Wireframe wireframe;                             ///< until the surface is made of it
  Connectivity connectivity;                       ///< of that, likewise
  Mirror mirror;                                   ///< of that
  std::optional<Lattice> lattice;
  std::optional<LevelOne> levelOne;
  bool targetsToCome = false;  ///< what they do is read later
  Rig* rig = nullptr;          ///< what is read goes there

  /// Whether so many more bytes may be taken; complains through `in` if not.
  bool afford(Reader& in, std::size_t count, std::size_t bytesEach);
  /// The same for so many vectors of every pose, of which a file may have no more than its size
  /// lets one expect.
  bool affordVectors(Reader& in, std::size_t eachPose, std::size_t bytesEach);
  /// Makes sure of room for as many targets and loose vertices as were announced.
  void affordTargets(Reader& in);
  /// Of the wireframe and its connectivity; says how many vectors it stores.
  void makeSurface(Reader& in);
  /// A name that is UTF-8; complains through `in`. That none comes twice is looked at in the end.
  void addTarget(Reader& in, std::string_view name);
};

/// How the chunks of a kind are read; the kinds of a version in the order of its registry.
struct ChunkHandler {
  void (*read)(Decoding&, Reader&);
  bool required = false, repeated = false;
  const char* instead = nullptr;  ///< the kind beside which it must not stand: it says the same
};
/// None: this program does not read the version (web/src/usual.cpp).
std::span<const ChunkHandler> version1();
std::span<const ChunkHandler> version2();

/// Chunks that hold things as they are; most are in both versions.
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
