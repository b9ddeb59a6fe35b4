/* Shared by the programs beside this file. PROGRAM is the name of the one that includes it. */
#include <stdio.h>
#include <stdlib.h>

#include "sweepface/sweepface.h"

static int fail(const char* message) {
  fprintf(stderr, PROGRAM ": %s\n", message);
  return EXIT_FAILURE;
}

static int refused(void) { return fail(sweepface_message()); }

/* The bytes of a file; the caller frees them. NULL if it cannot be read. */
static char* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  if (!file) return NULL;
  char* bytes = NULL;
  *size = 0;
  for (size_t room = 1 << 16; !feof(file) && !ferror(file); room *= 2) {
    char* more = realloc(bytes, room);
    if (!more) break;
    bytes = more;
    *size += fread(bytes + *size, 1, room - *size, file);
  }
  if (!feof(file)) {
    free(bytes);
    bytes = NULL;
  }
  fclose(file);
  return bytes;
}
