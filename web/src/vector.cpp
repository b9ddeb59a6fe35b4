// The part of vectors that is the same for all types.
#include <vector>

namespace sweepface::compact {

void Bytes::reserve(std::size_t bytes) {
  if (bytes <= static_cast<std::size_t>(end - first)) return;
  const std::size_t held = count();
  first = static_cast<char*>(std::realloc(first, bytes));
  if (!first) __builtin_trap();
  last = first + held;
  end = first + bytes;
}

const void* Bytes::prepare(std::size_t bytes, const void* value) {
  const auto at = static_cast<std::size_t>(static_cast<const char*>(value) - first);
  const std::size_t held = count();
  if (held + bytes > static_cast<std::size_t>(end - first))
    reserve(std::max(held + bytes, 2 * held));
  return at < held ? first + at : value;
}

char* Bytes::open(const char* at, std::size_t bytes) {
  const auto before = static_cast<std::size_t>(at - first);
  prepare(bytes, nullptr);
  char* const gap = first + before;
  if (last != gap) std::memmove(gap + bytes, gap, static_cast<std::size_t>(last - gap));
  last += bytes;
  return gap;
}

void Bytes::close(char* from, const char* to) {
  std::memmove(from, to, static_cast<std::size_t>(last - to));
  last -= to - from;
}

void Bytes::grow(std::size_t bytes) {
  const std::size_t more = bytes - count();
  prepare(more, nullptr);
  std::memset(last, 0, more);
  last += more;
}

void Bytes::fill(const void* value, std::size_t size, std::size_t bytes) {
  if (bytes == 0) return;
  const void* const from = prepare(bytes, value);
  char* const start = last;
  std::memcpy(start, from, size);
  for (std::size_t done = size; done < bytes; done *= 2)
    std::memcpy(start + done, start, std::min(done, bytes - done));
  last += bytes;
}

}  // namespace sweepface::compact
