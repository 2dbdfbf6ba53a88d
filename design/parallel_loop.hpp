#pragma once

#include <cstddef>
#include <functional>

namespace boresight::design {

/// Calls `work` once for each index below `count`, on up to `threads` threads (at least one, this
/// one included). The first exception stops the loop and comes out of here.
void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work);

}  // namespace boresight::design
