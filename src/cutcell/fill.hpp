#pragma once

namespace recoil {

/// Least part of a whole cell that a fragment must fill to take part in fits, and to stand in stencils
/// itself.
inline constexpr double donor_fill = 0.3, regular_fill = 0.5;

}  // namespace recoil
