#include "config/section/time.hpp"

#include "config/declare/reading.hpp"

namespace recoil::config {

void TimeChoice::check(const TableReading& reading) const {
  if (reading.has("fixed-dt") && reading.has("cfl"))
    reading.refuse("fixed-dt", "'fixed-dt' and 'cfl' exclude each other", "remove one of them");
}

}  // namespace recoil::config
