#include <fmt/format.h>

#include "app/check/checks.hpp"
#include "app/check/estimate.hpp"
#include "app/run/stepping.hpp"

namespace recoil::app {

namespace {

/// Steps that no machine gets through: at a thousand a second a day has some 1e8.
constexpr double most_steps = 1e9;

}  // namespace

void check_steps(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const double fastest = fastest_at_start(c, loaded.materials);
  if (!(fastest > 0)) return;
  const double crossing = c.mesh.finest / fastest;
  const double step = c.time.fixed_dt.value_or(c.time.cfl * crossing);
  if (step > largest_stable_cfl(stepping_of(c).stages) * crossing)
    loaded.found.warning(
        place_of(loaded, "time.fixed-dt", {c.file}),
        fmt::format("a step of {:.4g} ns is unstable: the fastest wave crosses a cell in {:.3g} ns",
                    step * 1e9, crossing * 1e9),
        fmt::format("at most 'fixed-dt' = {:.3g} ns, and less where shocks make sound faster; "
                    "without it the step follows the state",
                    0.9 * crossing * 1e9));
  const double steps = c.time.end / step;
  if (steps > most_steps)
    loaded.found.warning(
        place_of(loaded, "time.end", {c.file}),
        fmt::format("the run would take {:.2g} steps of {:.3g} ns", steps, step * 1e9),
        "is the unit right? An impact is over after some transits of sound through the bodies");
}

}  // namespace recoil::app
