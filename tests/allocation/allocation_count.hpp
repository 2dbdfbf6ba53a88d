#pragma once

namespace boresight::reference {

/// How often this program's own code, the libraries linked into it and the headers they use have
/// asked for memory so far: malloc and its kin and operator new, counted through the linker's
/// --wrap.
long allocation_count();

/// Allocations while `work` runs.
template <typename Work>
long allocations_of(const Work& work) {
  const long before = allocation_count();
  work();
  return allocation_count() - before;
}

}  // namespace boresight::reference
