// Two plugins, loaded as hosts do that let plugins see each other: what one sets stays its own.
#include <dlfcn.h>

#include <cstdio>
#include <cstring>

#include <vndf/vndf.h>

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
  find<void (*)()>(a, "use_scalar")();
  const char* after = find<Ask>(b, "isa")();
  const char* best = "";
  for (const vndf::Isa& isa : vndf::isas())
    if (isa.supported) best = isa.name;
  std::printf("of %s, a constructor got %s, and the other plugin has %s\n", best, early, after);
  return std::strcmp(early, best) || std::strcmp(after, best);
}
