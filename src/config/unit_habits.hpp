#pragma once

#include <string_view>

namespace recoil::config {

/// The unit that is meant by a short form which udunits would read as something else: "mps" as
/// milli-pico-seconds, "kph" as kilo-phot. Empty: it is none.
std::string_view meant_by(std::string_view unit);

/// Whether two units are the same but for capital letters.
bool differs_in_capitals(std::string_view a, std::string_view b);

}  // namespace recoil::config
