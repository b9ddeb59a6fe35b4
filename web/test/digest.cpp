// The digests of a face (tests/codec/digest.hpp), natively or in WebAssembly; both must give the
// same for a file. Usage: digest FACE > digests; in WebAssembly, pass the bytes to `digest`, which
// returns the text.
#include "codec/digest.hpp"

#include "sweepface/codec.hpp"

namespace {

std::string digestsOfFile(std::string_view bytes) {
  const auto rig = sweepface::decode(bytes, "The face");
  return rig ? sweepface::testing::digestsOf(*rig) : rig.error().message;
}

}  // namespace

#ifdef __wasm__

extern "C" const char* digest(const char* bytes, std::size_t size) {
  static std::string text;
  text = digestsOfFile({bytes, size});
  return text.c_str();
}

#else

#include <cstdio>
#include <fstream>
#include <iterator>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::puts(digestsOfFile(bytes).c_str());
}

#endif
