// Runs the timed kernels; prints their speeds, what these are of the speed of an interior block, where the
// time of a step goes, and what a cell takes. `--benchmark_out=FILE` keeps all of it as JSON.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "sample.hpp"

namespace {

using Run = benchmark::BenchmarkReporter::Run;
using recoil::bench::rate_name;

double counter(const Run& run, const std::string& name) {
  const auto at = run.counters.find(name);
  return at == run.counters.end() ? 0 : at->second.value;
}

/// "2d" of "step/2d/disc-planar".
std::string dimension_of(const std::string& name) {
  const auto from = name.find('/') + 1;
  return name.substr(from, name.find('/', from) - from);
}

class Tables : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.error_occurred) {
        std::printf("%-30s %s\n", run.run_name.function_name.c_str(), run.error_message.c_str());
        failed_ = true;
      } else if (run.run_type == Run::RT_Iteration) {
        std::printf("%-30s %10.3f %s\n", run.run_name.function_name.c_str(), run.GetAdjustedCPUTime(),
                    benchmark::GetTimeUnitString(run.time_unit));
        runs_.push_back(run);
      }
      std::fflush(stdout);
    }
  }

  void print() const {
    print_rates();
    print_steps();
  }
  bool failed() const { return failed_; }

 private:
  void print_rates() const {
    std::printf("\n%-30s %14s %10s %9s %12s\n", "", rate_name, "cells", "cut", "of interior");
    for (const Run& run : runs_) {
      const std::string& name = run.run_name.function_name;
      std::printf("%-30s %14.3f %10.0f %9.0f", name.c_str(), counter(run, rate_name), counter(run, "cells"),
                  counter(run, "cut-cells"));
      const Run* interior = find("block/" + dimension_of(name) + "/interior");
      if (interior) std::printf(" %12.3f", counter(run, rate_name) / counter(*interior, rate_name));
      std::printf("\n");
    }
  }

  /// One column for each step.
  void print_steps() const {
    std::vector<const Run*> steps;
    for (const Run& run : runs_)
      if (run.counters.count("bytes/cell") != 0) steps.push_back(&run);
    if (steps.empty()) return;
    std::printf("\n%-18s", "");
    for (const Run* run : steps) std::printf(" %28s", run->run_name.function_name.c_str());
    for (const auto& [name, value] : steps.front()->counters) {
      if (name == rate_name || name == "cells" || name == "cut-cells") continue;
      std::printf("\n%-18s", name.c_str());
      for (const Run* run : steps) std::printf(" %28.1f", counter(*run, name));
    }
    std::printf("\n");
  }

  const Run* find(const std::string& name) const {
    for (const Run& run : runs_)
      if (run.run_name.function_name == name) return &run;
    return nullptr;
  }

  std::vector<Run> runs_;
  bool failed_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const recoil::parallel::Session session;
  recoil::bench::add_block_updates();
  recoil::bench::add_steps();
  Tables tables;
  try {
    benchmark::RunSpecifiedBenchmarks(&tables);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  tables.print();
  return tables.failed() ? 1 : 0;
}
