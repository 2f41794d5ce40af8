// The public functions sample_disk.
#include "dispatch.h"

namespace vndf {

#define VNDF_ISA(name, supported)     \
  namespace name {                    \
  extern const DiskTable sample_disk; \
  }
#include "isa_rows.h"

static const DiskTable& table() noexcept {
#define VNDF_ISA(name, supported) &name::sample_disk,
  static constexpr const DiskTable* kRows[] = {
#include "isa_rows.h"
  };
  return *kRows[active_row()];
}

void sample_disk(DiskMap map, std::size_t count, const Columns2& u, const Out2& t) noexcept {
  expect_written(count, t.x, t.y);
  expect_given(count, u);
  FloatMode exact;
  of(table().maps, map)(count, u, t);
}

}  // namespace vndf
