// The module's allocator. Memory is a row of blocks, each with its own size and that of the one
// before, so that a freed block merges with its free neighbours (Knuth, The Art of Computer
// Programming 1, 2.5). Free blocks of about the same size are in a list. Small ones keep their
// size, so that most calls take a block from a list or put it back. Its code is a tenth of that of
// the C library's allocator.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

extern "C" unsigned char __heap_base;

namespace {

constexpr std::size_t kAlign = 16, kHead = 8, kLeast = 32, kPage = 65536, kMost = 0x7fff0000;

struct Block {
  std::size_t before;      // bytes of the block before this one; 0: this is the first
  std::size_t bytesBit;    // bytes of this block, plus 1 if it is in use
  Block *next, *previous;  // in its list, while it is free

  std::size_t bytes() const { return bytesBit & ~std::size_t(1); }
  bool used() const { return bytesBit & 1; }
  Block* at(std::ptrdiff_t distance) {
    return reinterpret_cast<Block*>(reinterpret_cast<char*>(this) + distance);
  }
  Block* behind() { return at(static_cast<std::ptrdiff_t>(bytes())); }
  Block* inFront() { return at(-static_cast<std::ptrdiff_t>(before)); }
};

// Lists by size: exact up to 512 bytes, then four for every power of two.
constexpr int kExact = 32, kLists = kExact + 4 * 23;
constexpr std::size_t kSmall = 256;
Block* lists[kLists];
std::uint64_t filled[2];            // a bit for each list that is not empty
Block* small[kSmall / kAlign + 1];  // freed blocks by size; they count as in use
Block* last = nullptr;              // marks the end of memory; in use and without bytes

int listOf(std::size_t bytes) {
  if (bytes < kAlign * kExact) return static_cast<int>(bytes / kAlign);
  const int log = std::bit_width(bytes) - 1;
  return kExact + 4 * (log - 9) + static_cast<int>(bytes >> (log - 2) & 3);
}

void keep(Block* block, std::size_t bytes) {
  block->bytesBit = bytes;
  block->behind()->before = bytes;
  const int list = listOf(bytes);
  filled[list / 64] |= std::uint64_t(1) << list % 64;
  Block*& first = lists[list];
  block->previous = nullptr;
  block->next = first;
  if (first) first->previous = block;
  first = block;
}

void takeOut(Block* block) {
  if (block->next) block->next->previous = block->previous;
  const int list = listOf(block->bytes());
  (block->previous ? block->previous->next : lists[list]) = block->next;
  if (!lists[list]) filled[list / 64] &= ~(std::uint64_t(1) << list % 64);
}

void release(Block* block) {
  std::size_t bytes = block->bytes();
  if (Block* const behind = block->behind(); !behind->used()) {
    takeOut(behind);
    bytes += behind->bytes();
  }
  if (block->before > 0 && !block->inFront()->used()) {
    block = block->inFront();
    takeOut(block);
    bytes += block->bytes();
  }
  keep(block, bytes);
}

bool grow(std::size_t bytes) {
  const std::size_t end = __builtin_wasm_memory_size(0) * kPage;
  const std::size_t pages = last ? (bytes + kPage) / kPage : bytes / kPage + 1;
  if (__builtin_wasm_memory_grow(0, pages) == SIZE_MAX) return false;
  const std::size_t newEnd = end + pages * kPage;
  if (!last) {  // blocks begin kHead before the aligned address that malloc returns
    const auto base = reinterpret_cast<std::size_t>(&__heap_base);
    last = reinterpret_cast<Block*>((base + kHead + kAlign - 1) / kAlign * kAlign + kHead);
    last->before = 0;
  }
  Block* const fresh = last;
  last = reinterpret_cast<Block*>(newEnd - kHead);
  last->bytesBit = 1;
  fresh->bytesBit = (newEnd - kHead - reinterpret_cast<std::size_t>(fresh)) | 1;
  last->before = fresh->bytes();
  release(fresh);
  return true;
}

Block* find(std::size_t bytes) {
  const int own = listOf(bytes);
  for (Block* block = lists[own]; block; block = block->next)
    if (block->bytes() >= bytes) return block;
  for (int k = own + 1; k < 128; k = (k / 64 + 1) * 64)  // any block of a later list will do
    if (const std::uint64_t left = filled[k / 64] >> k % 64)
      return lists[k + std::countr_zero(left)];
  return nullptr;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  if (size > kMost) return nullptr;
  const std::size_t wanted = (size + kHead + kAlign - 1) / kAlign * kAlign;
  const std::size_t bytes = wanted < kLeast ? kLeast : wanted;
  if (bytes <= kSmall)
    if (Block*& first = small[bytes / kAlign]) {
      Block* const block = first;
      first = block->next;
      return reinterpret_cast<char*>(block) + kHead;
    }
  Block* block = find(bytes);
  if (!block && grow(bytes)) block = find(bytes);
  if (!block) return nullptr;
  takeOut(block);
  const std::size_t rest = block->bytes() - bytes;
  if (rest >= kLeast) {
    block->bytesBit = bytes;
    Block* const behind = block->behind();
    behind->before = bytes;
    keep(behind, rest);
  }
  block->bytesBit |= 1;
  return reinterpret_cast<char*>(block) + kHead;
}

void free(void* memory) {
  if (!memory) return;
  auto* const block = reinterpret_cast<Block*>(static_cast<char*>(memory) - kHead);
  if (block->bytes() > kSmall) return release(block);
  Block*& first = small[block->bytes() / kAlign];
  block->next = first;
  first = block;
}

void* calloc(std::size_t count, std::size_t size) {
  if (size > 0 && count > kMost / size) return nullptr;
  void* const memory = malloc(count * size);
  return memory ? __builtin_memset(memory, 0, count * size) : nullptr;
}

void* realloc(void* memory, std::size_t size) {
  void* const moved = malloc(size);
  if (!memory || !moved) return moved;
  const std::size_t had =
      reinterpret_cast<Block*>(static_cast<char*>(memory) - kHead)->bytes() - kHead;
  __builtin_memcpy(moved, memory, had < size ? had : size);
  free(memory);
  return moved;
}

// One instruction each, instead of the C library's loops.
void* memcpy(void* to, const void* from, std::size_t size) {
  return __builtin_memcpy(to, from, size);
}
void* memmove(void* to, const void* from, std::size_t size) {
  return __builtin_memmove(to, from, size);
}
void* memset(void* to, int value, std::size_t size) { return __builtin_memset(to, value, size); }

}  // extern "C"
