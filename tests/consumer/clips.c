/* A small program in C that uses an installed Sweepface: without a rig no clip is read. */
#include <string.h>
#include <sweepface/sweepface_clips.h>

int main(void) {
  sweepface_clip* clip = NULL;
  const sweepface_status status = sweepface_clip_read(NULL, "", 0, "take.csv", NULL, &clip);
  return status == SWEEPFACE_BAD_ARGUMENT && !clip && strstr(sweepface_message(), "rig") ? 0 : 1;
}
