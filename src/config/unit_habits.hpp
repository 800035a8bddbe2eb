#pragma once

#include <string_view>

namespace recoil::config {

/// The unit that is meant by a short form which udunits would read as something else: "mps" as
/// milli-pico-seconds, "kph" as kilo-phot. Empty: it is none.
std::string_view meant_by(std::string_view unit);

}  // namespace recoil::config
