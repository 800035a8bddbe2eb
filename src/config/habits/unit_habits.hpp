#pragma once

#include <string_view>

namespace recoil::config {

/// The unit that is meant by a short form which udunits would read as something else: "mps" as
/// milli-pico-seconds, "kph" as kilo-phot. Empty: it is none.
std::string_view meant_by(std::string_view unit);

/// What to write in place of "C" or "F", the units of charge and capacitance, where a temperature is meant.
/// Empty: it is neither.
std::string_view degrees_of(std::string_view unit);

}  // namespace recoil::config
