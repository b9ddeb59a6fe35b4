/* A program that loads, uses and unloads a plugin, as if to reload it after a rebuild. Each has its own copy of the
   library, and the program exports its copy. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include <sweepface/sweepface.h>

int main(void) {
  void* plugin = dlopen(PLUGIN, RTLD_NOW | RTLD_LOCAL);
  if (!plugin) return fprintf(stderr, "%s\n", dlerror()), 1;
  const char* (*refusal)(void) = (const char* (*)(void))dlsym(plugin, "refusal_of_a_bad_file");
  if (!refusal || !strstr(refusal(), "bad.sweep")) return fprintf(stderr, "The plugin does not play.\n"), 1;
  if (*sweepface_message()) return fprintf(stderr, "The plugin plays with the program's library.\n"), 1;
  dlclose(plugin);
  if (dlopen(PLUGIN, RTLD_NOW | RTLD_NOLOAD)) return fprintf(stderr, "The plugin stays loaded.\n"), 1;
  return 0;
}
