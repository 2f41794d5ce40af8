// Queues: structures of arrays whose capacity is fixed up front. Paths live in one of two path queues; what shading
// lets live is appended to the other, which is all the compaction there is.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scene.h"

namespace wavefront {

/// Items that a worker has under way, and that one call of the library takes.
constexpr std::uint32_t kCapacity = 4096, kBatch = 512;

/// What a column holds while nothing has been written there does not matter, so nothing is.
template <class T>
class Column {
 public:
  explicit Column(std::size_t size) : data_(new T[size]) {}
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* data() { return data_.get(); }

 private:
  std::unique_ptr<T[]> data_;
};

struct Columns3 {
  Column<float> x, y, z;
  explicit Columns3(std::size_t size) : x(size), y(size), z(size) {}
  Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  void add(std::size_t i, Vec3 v) { set(i, get(i) + v); }
};

struct Paths {
  std::uint32_t count = 0;
  Columns3 origin{kCapacity}, direction{kCapacity}, throughput{kCapacity};
  Column<float> pdf{kCapacity};                              // of the direction, by the BSDF
  Column<std::uint32_t> slot{kCapacity};                     // of the radiance
  Column<std::uint32_t> seed{kCapacity}, sample{kCapacity};  // of its random numbers
  Column<std::uint32_t> depth{kCapacity};
};
/// What the paths met, and in which order they are shaded.
struct Hits {
  Column<Primitive> primitive{kCapacity};
  Column<std::uint16_t> bin{kCapacity};
  Column<std::uint32_t> order{kCapacity};
};
struct ShadowRays {
  std::uint32_t count = 0;
  Columns3 origin{kCapacity}, direction{kCapacity}, radiance{kCapacity};
  Column<float> distance{kCapacity};
  Column<std::uint32_t> slot{kCapacity};
};

/// Bytes of all queues for one path under way, and of its radiance.
constexpr std::size_t kBytesPerPath = 2 * 14 * 4 + (4 + 2 + 4) + 11 * 4 + 12;

}  // namespace wavefront
