#pragma once

/// Whether this is the build with sanitizers, which takes five to ten times as long: a case may do
/// there with less data what it does with more in the release build, but takes the same paths.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
