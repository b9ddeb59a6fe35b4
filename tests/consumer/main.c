/* A small program in C that uses an installed Sweepface: it knows its version and refuses an empty file. */
#include <string.h>
#include <sweepface/sweepface.h>

int main(void) {
  sweepface_rig* rig = NULL;
  const sweepface_status status = sweepface_rig_load("", 0, "nothing", &rig);
  return sweepface_version() == SWEEPFACE_VERSION_MAJOR * 10000 + SWEEPFACE_VERSION_MINOR * 100 +
                                    SWEEPFACE_VERSION_PATCH &&
                 status == SWEEPFACE_BAD_DATA && !rig && strstr(sweepface_message(), "nothing")
             ? 0
             : 1;
}
