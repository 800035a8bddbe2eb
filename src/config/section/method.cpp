#include "config/section/method.hpp"

#include <fmt/format.h>

#include "config/declare/reading.hpp"

namespace recoil::config {

void Method::check(const TableReading& reading) const {
  if (reading.has("kappa") && scheme != "seed")
    reading.refuse("kappa", fmt::format("'kappa' has no meaning for scheme = \"{}\"", scheme),
                   "remove it, or use scheme = \"seed\": the other schemes close gaps without a tolerance");
  if (reading.has("stages") && scheme != "conservative")
    reading.refuse("stages", fmt::format("'stages' has no meaning for scheme = \"{}\"", scheme),
                   "remove it: the ghost-fluid schemes have the stages of their papers");
}

}  // namespace recoil::config
