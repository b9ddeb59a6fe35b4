#include "gltf/deflate.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <zlib.h>

#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

constexpr std::size_t pieceBytes = std::size_t{1} << 16;

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};
struct EndDeflate {
  void operator()(z_stream* stream) const { deflateEnd(stream); }
};

/// Calls zlib piece by piece until it returns something other than Z_OK or there are more than
/// `most` bytes.
template <typename Step>
int runPieces(z_stream& stream, std::string_view in, std::string& out, std::size_t most,
              Step step) {
  int said = Z_OK;
  while (said == Z_OK && out.size() <= most) {
    const std::size_t given = std::min<std::size_t>(in.size(), std::numeric_limits<uInt>::max());
    // zlib only reads through this pointer.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    stream.avail_in = static_cast<uInt>(given);
    const std::size_t before = out.size();
    out.resize(before + pieceBytes);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(pieceBytes);
    said = step(given == in.size());
    in.remove_prefix(given - stream.avail_in);
    out.resize(before + pieceBytes - stream.avail_out);
  }
  return said == Z_STREAM_END && !in.empty() ? Z_DATA_ERROR : said;
}

}  // namespace

std::string deflated(std::string_view bytes) {
  z_stream stream{};
  std::string out;
  if (deflateInit(&stream, Z_BEST_COMPRESSION) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndDeflate> owned(&stream);
  runPieces(stream, bytes, out, std::numeric_limits<std::size_t>::max(),
            [&](bool last) { return deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH); });
  return out;
}

Result<std::string> inflated(std::string_view bytes) {
  z_stream stream{};
  std::string out;
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndInflate> owned(&stream);
  const auto most = static_cast<std::size_t>(
      std::min<std::uint64_t>(io::maxFileBytes, mostInflated(bytes.size())));
  const int said =
      runPieces(stream, bytes, out, most, [&](bool) { return inflate(&stream, Z_NO_FLUSH); });
  if (out.size() > most) return fail("it holds far more than its size can mean");
  if (said != Z_STREAM_END) return fail("it is damaged");
  return out;
}

}  // namespace sweepface::gltf
