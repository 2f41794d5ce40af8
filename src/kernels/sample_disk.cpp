// sample_disk for one instruction set.
#include "../kernel_tables.h"
#include "kernel.h"
#include "warps.h"

namespace {

template <class Warp>
struct Disk {
  static constexpr int kVectors = kVectorsOfPairs;

  InColumns2 u;
  OutColumn t1, t2;

  template <class Function>
  VNDF_INLINE void inputs(Function f) {
    u.each(f);
  }
  template <class Function>
  VNDF_INLINE void outputs(Function f) {
    f(t1), f(t2);
  }
  VNDF_INLINE void prepare(std::size_t) const {}

  template <class F, class Place>
  VNDF_INLINE void at(Place i) const {
    auto t = cartesian(Warp::disk_point(u.load<F>(i)));
    t1.store(i, t.x);
    t2.store(i, t.y);
  }
};

template <class Warp>
void sample(std::size_t count, const vndf::Columns2& u, const vndf::Out2& t) noexcept {
  Disk<Warp> kernel{u, t.x, t.y};
  run(count, kernel);
}

}  // namespace

namespace vndf::VNDF_SET {

extern const DiskTable sample_disk;
constexpr DiskTable sample_disk = {{::sample<lanes::Polar>, ::sample<lanes::Concentric>}};

}  // namespace vndf::VNDF_SET
