// A shared object that carries a library of its own. Its constructor asks for the set before libgcc's own constructor.
#include <vndf/vndf.h>

static const char* early = "not asked";
__attribute__((constructor(101))) static void ask() {
  early = vndf::active_isa();
}

extern "C" __attribute__((visibility("default"))) const char* early_isa() {
  return early;
}
extern "C" __attribute__((visibility("default"))) const char* isa() {
  return vndf::active_isa();
}
extern "C" __attribute__((visibility("default"))) void use_scalar() {
  (void)vndf::set_isa("scalar");
}
