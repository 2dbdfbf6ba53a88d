#pragma once

/// Whether the tests are built with the address sanitizer. Statistics take ten times as long with it
/// and show it nothing that fewer samples do not.
namespace boresight::reference {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool under_sanitizers = true;
#else
inline constexpr bool under_sanitizers = false;
#endif

}  // namespace boresight::reference
