#pragma once

#include <cstddef>
#include <utility>

// The width, in doubles, of the widest registers that hot loops are compiled for: an option of the
// build, BORESIGHT_WIDEST_CLONE. Without effect where compiler or sanitizer do not get along with
// such clones.
#if !defined(__x86_64__) || !defined(__GNUC__) || defined(__clang__) || \
    defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#undef BORESIGHT_CLONE_LANES
#define BORESIGHT_CLONE_LANES 2
#elif !defined(BORESIGHT_CLONE_LANES)
#define BORESIGHT_CLONE_LANES 8
#endif

/// Before the definition of a function whose loops the compiler vectorises: it is compiled for
/// wider registers as well, and the processor's own are chosen when the program starts. The same
/// operations in the same order, so the same bits on every machine.
#if BORESIGHT_CLONE_LANES >= 8
#define BORESIGHT_VECTOR_CLONES [[gnu::target_clones("default", "avx2", "avx512f")]]
#elif BORESIGHT_CLONE_LANES >= 4
#define BORESIGHT_VECTOR_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define BORESIGHT_VECTOR_CLONES
#endif

namespace boresight::numerics {

/// How many doubles hot loops work on at once: 8 with AVX-512, 4 with AVX2, else 2.
std::size_t register_lanes();

/// While one is there, hot loops of all threads use registers of so many doubles at most: to show
/// that it makes no difference to their results. One at a time.
class NarrowRegisters {
 public:
  explicit NarrowRegisters(std::size_t max_lanes);
  ~NarrowRegisters();
  NarrowRegisters(const NarrowRegisters&) = delete;
  NarrowRegisters& operator=(const NarrowRegisters&) = delete;
};

#if BORESIGHT_CLONE_LANES >= 8
template <typename Kernel, typename... Arguments>
[[gnu::target("avx512f"), gnu::noinline]] auto run_on_eight_lanes(Arguments&&... arguments) {
  return Kernel::template run<8>(std::forward<Arguments>(arguments)...);
}
#endif
#if BORESIGHT_CLONE_LANES >= 4
template <typename Kernel, typename... Arguments>
[[gnu::target("avx2"), gnu::noinline]] auto run_on_four_lanes(Arguments&&... arguments) {
  return Kernel::template run<4>(std::forward<Arguments>(arguments)...);
}
#endif

/// Calls `Kernel::run<width>(arguments...)` compiled for the registers in use, `width` doubles
/// each. `run` is a static member that is always inlined; each lane must see the same operations
/// in the same order for every width, so that results have the same bits on every machine.
template <typename Kernel, typename... Arguments>
auto run_on_widest_lanes(Arguments&&... arguments) {
#if BORESIGHT_CLONE_LANES >= 4
  const std::size_t lanes = register_lanes();
#endif
#if BORESIGHT_CLONE_LANES >= 8
  if (lanes >= 8) return run_on_eight_lanes<Kernel>(std::forward<Arguments>(arguments)...);
#endif
#if BORESIGHT_CLONE_LANES >= 4
  if (lanes >= 4) return run_on_four_lanes<Kernel>(std::forward<Arguments>(arguments)...);
#endif
  return Kernel::template run<2>(std::forward<Arguments>(arguments)...);
}

}  // namespace boresight::numerics
