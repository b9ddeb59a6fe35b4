#include "capi/message.hpp"

#include <cstring>

namespace sweepface::capi {

namespace {
// Not a std::string: its destructor would keep a plugin loaded for as long as the thread lives.
constinit thread_local char lastMessage[2048] = "";

bool isWithinCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }
}  // namespace

sweepface_status refuse(sweepface_status status, std::string_view message) {
  std::size_t length = message.size();
  if (length >= sizeof lastMessage)
    for (length = sizeof lastMessage - 1; length > 0 && isWithinCharacter(message[length]);)
      --length;
  std::memcpy(lastMessage, message.data(), length);
  lastMessage[length] = '\0';
  return status;
}

sweepface_status refuseCallWith(std::initializer_list<TextPart> parts) {
  return refuse(joined(parts));
}

sweepface_status noSuch(const char* what, std::size_t index, std::size_t count) {
  return refuse("There is no ", what, " ", index, "; there are ", count, ", counted from 0.");
}

sweepface_status statusOf(Result<void> result) {
  return result ? SWEEPFACE_OK : refuse(result.error().message);
}

}  // namespace sweepface::capi

uint32_t sweepface_version(void) {
  return SWEEPFACE_VERSION_MAJOR * 10000 + SWEEPFACE_VERSION_MINOR * 100 + SWEEPFACE_VERSION_PATCH;
}

const char* sweepface_message(void) { return sweepface::capi::lastMessage; }
