// Two plugins, loaded as hosts do that let plugins see each other: what one sets stays its own.
#include <dlfcn.h>

#include <cstdio>
#include <cstring>

template <class Function>
static Function find(void* plugin, const char* name) {
  return reinterpret_cast<Function>(dlsym(plugin, name));
}

int main(int, char** argv) {
  void* a = dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL);
  void* b = dlopen(argv[2], RTLD_NOW | RTLD_GLOBAL);
  if (!a || !b) return std::puts(dlerror()), 2;
  using Ask = const char* (*)();
  const char* early = find<Ask>(a, "early_isa")();
  const char* before = find<Ask>(b, "isa")();
  find<void (*)()>(a, "use_scalar")();
  const char* after = find<Ask>(b, "isa")();
  std::printf("a constructor got %s; the other plugin has %s and then %s\n", early, before, after);
  return std::strcmp(early, before) || std::strcmp(before, after);
}
