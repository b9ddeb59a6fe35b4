/* A plugin that contains the library. */
#include <sweepface/sweepface.h>

const char* refusal_of_a_bad_file(void) {
  sweepface_rig* rig;
  return sweepface_rig_load("no face", 7, "bad.sweep", &rig) ? sweepface_message() : "";
}
