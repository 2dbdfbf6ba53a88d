#include <algorithm>
#include <atomic>

#include <boresight/numerics/vector_clones.hpp>

namespace boresight::numerics {
namespace {

constexpr std::size_t widest_clone = BORESIGHT_CLONE_LANES;

std::size_t lanes_of_processor() {
#if BORESIGHT_CLONE_LANES >= 4
  if (__builtin_cpu_supports("avx512f")) return 8;
  if (__builtin_cpu_supports("avx2")) return 4;
#endif
  return 2;
}

std::atomic<std::size_t>& max_lanes_allowed() {
  static std::atomic<std::size_t> lanes = widest_clone;
  return lanes;
}

}  // namespace

std::size_t register_lanes() {
  static const std::size_t lanes = lanes_of_processor();
  return std::min(lanes, max_lanes_allowed().load(std::memory_order_relaxed));
}

NarrowRegisters::NarrowRegisters(std::size_t max_lanes) {
  max_lanes_allowed() = std::min(widest_clone, max_lanes);
}

NarrowRegisters::~NarrowRegisters() {
  max_lanes_allowed() = widest_clone;
}

}  // namespace boresight::numerics
