// Any text as a quantity: it is one, finite, or its problem is named.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "config/units.hpp"
#include "core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace recoil;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* unit : std::array{"m/s", "Pa", "1", "K"}) {
    const config::Quantity q = config::parse_quantity(text, unit, "key");
    require(!q.ok() || std::isfinite(q.value), "a quantity is finite");
  }
  const config::Quantity any = config::parse_any_quantity(text, "key");
  require(!any.ok() || std::isfinite(any.value), "a quantity of any dimension is finite");
  return 0;
}
