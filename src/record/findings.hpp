#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "format/run_units.hpp"
#include "record/balance/budget.hpp"
#include "record/events.hpp"
#include "record/fragment_table.hpp"
#include "record/quantities.hpp"
#include "record/summary.hpp"

namespace recoil {

/// All numbers and flags that an expectation can name, from its last sums, balances and events; gauges are
/// added by the caller.
///   body.NAME.  mass, kinetic, internal, energy, volume, plastic-strain, failed-mass, and by AXIS momentum,
///   velocity, position, lowest, highest body.total. mass, kinetic, internal, energy, and by AXIS momentum
///   budget.NAME.mass|momentum|energy; floor.NAME; run.steps
///   contact.A-B.made|opens|separates|lasts|recloses|reopens|restitution in either order of the names;
///   event.KIND; failure.BODY.time and by AXIS, of the first failure of a body's matter
/// With one axis only, vectors also go by their name without it.
template <int Dim>
Quantities find_quantities(const Totals<Dim>& totals, const std::vector<std::string>& names,
                           const std::vector<bool>& rigid, const RunUnits& units,
                           const std::vector<Drift>& budgets, const EventWatch& events,
                           const std::vector<std::pair<std::string, std::int64_t>>& floors, long steps);

/// fragments.BODY.pieces, .rubble-mass, and of the heaviest pieces, N from 1 to 3, fragments.BODY.N.mass and
/// by AXIS .velocity, NaN where there are not so many.
void add_fragments(Quantities& quantities, const std::vector<BodyFragments>& fragments,
                   const RunUnits& units);

/// The events of a run in which nothing has happened.
EventWatch without_events(const std::vector<std::string>& names, config::Geometry geometry);

/// All that a run of this case will be able to tell: the names with their units, and records without entries.
Quantities known_quantities(const config::Case& c);

/// The main columns of all gauges in short.
std::vector<GaugeSummary> summarise(const std::vector<TimeSeries>& gauges);

/// Reports expectations that name something that a run cannot give, or compare it with a value of another
/// dimension, before time is spent on it.
/// @param quantities those of the run so far, or known_quantities().
void check_known(const Quantities& quantities, const std::vector<config::Expectation>& expect,
                 config::Diagnostics& out);
/// The same. @throws InputError naming file and line.
void check_known(const Quantities& quantities, const std::vector<config::Expectation>& expect);

}  // namespace recoil
