// A fibre with a stack of 64 KiB, and the bytes that each function leaves of it.
#include <ucontext.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "every_function.h"

constexpr std::size_t kAllowed = 64 * 1024, kStack = 4 * kAllowed;  // more, to say how much too much it was
alignas(64) static unsigned char stack[kStack];
static ucontext_t host, fibre;
static const std::function<void()>* call;

static void enter() {
  (*call)();
}
static std::size_t used() {
  return stack + kStack - std::find_if(stack, stack + kStack, [](unsigned char byte) { return byte != 0xa5; });
}
static std::size_t run(const std::function<void()>& function) {
  std::memset(stack, 0xa5, kStack);
  call = &function;
  getcontext(&fibre);
  fibre.uc_stack.ss_sp = stack;
  fibre.uc_stack.ss_size = kStack;
  fibre.uc_link = &host;
  makecontext(&fibre, enter, 0);
  swapcontext(&host, &fibre);
  return used();
}

int main() {
  // Odd, so that there is a tail; and so large that outputs are written past the caches, which is the same for all.
  EveryFunction few(4099), many((std::size_t(1) << 20) + 64);
  const std::size_t nothing = run([] {});
  bool good = true;
  for (const vndf::Isa& isa : vndf::isas()) {
    if (vndf::set_isa(isa.name) != vndf::IsaError::none) continue;
    std::size_t most = 0;
    std::string worst;
    for (std::size_t i = 0; i < few.calls.size(); ++i) {
      std::size_t need = run(few.calls[i].run) - nothing;
      if (few.calls[i].name.find("pdf_normals") == 0) need = std::max(need, run(many.calls[i].run) - nothing);
      if (need > most) most = need, worst = few.calls[i].name;
    }
    std::printf("%s: at most %zu bytes of stack, by %s\n", isa.name, most, worst.c_str());
    good &= most <= kAllowed;
  }
  return good ? 0 : 1;
}
