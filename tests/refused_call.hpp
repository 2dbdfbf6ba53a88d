#pragma once

#include <functional>

namespace boresight::reference {

// A call that is expected to throw. GoogleMock compiles a dozen functions for each type of value it
// matches, and each lambda is a type of its own: this is one type for all.
using Call = std::function<void()>;

}  // namespace boresight::reference
