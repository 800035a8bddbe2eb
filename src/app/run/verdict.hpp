#pragma once

#include <string>

#include "app/run/reporter.hpp"
#include "record/summary.hpp"

namespace recoil::app {

/// The end of a run in a few lines: steps and time, balances, what was limited, expectations, and whether
/// it can be trusted.
void tell_verdict(Reporter& reporter, const Summary& summary);

/// Whether it can be trusted, why not, and what helps.
void tell_validity(Reporter& reporter, const Verdict& verdict);

/// A value in the unit of its expectation, "0.6994 us"; "none" where there is none.
std::string written(const CheckResult& result);

}  // namespace recoil::app
