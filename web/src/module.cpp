// When memory runs out the module traps, and the caller gets a WebAssembly RuntimeError. The
// standard library would print a message first, and so link printf.
#include <__verbose_abort>
#include <cstdlib>
#include <new>

namespace {

void* allocate(std::size_t size) {
  void* memory = std::malloc(size ? size : 1);
  if (!memory) __builtin_trap();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

void std::__libcpp_verbose_abort(const char*, ...) { __builtin_trap(); }

// The module's only thread never ends, so nothing is destroyed at its end.
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }
