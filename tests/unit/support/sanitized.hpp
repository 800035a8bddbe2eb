#pragma once

namespace recoil {

/// Whether the tests run with AddressSanitizer, some 25 times slower: fewer random rounds will do.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace recoil
