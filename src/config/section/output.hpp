#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct FieldOutput {
  double every = 0;                    // s; 0: none but first and last
  std::vector<std::string> variables;  // names of fields to write

  static constexpr const char* doc = "Fields of the whole domain, for pictures and ParaView.";
  static Entries<FieldOutput> keys() {
    return {every_key(&FieldOutput::every, "time between two field files; 0: only the first and the last"),
            {.name = "variables",
             .member = &FieldOutput::variables,
             .doc = "which fields; without it all",
             .example = R"(["pressure", "velocity", "plastic-strain"])"}};
  }
};

struct HistoryOutput {
  double every = 0;  // s; 0: every step

  static constexpr const char* doc = "Sums over each body, in history.csv.";
  static Entries<HistoryOutput> keys() {
    return {every_key(&HistoryOutput::every, "time between two lines; 0: every step")};
  }
};

struct CheckpointOutput {
  double every = 0;       // s of simulated time; 0: not by it
  double every_wall = 0;  // s of wall time; 0: not by it
  int keep = 2;

  static constexpr const char* doc = "Files from which `recoil resume` goes on exactly, in checkpoints/.";
  static Entries<CheckpointOutput> keys() {
    return {
        every_key(&CheckpointOutput::every,
                  "simulated time between two checkpoints; 0: only by every-wall and when a run is stopped"),
        {.name = "every-wall",
         .member = &CheckpointOutput::every_wall,
         .unit = "s",
         .least = 0,
         .doc = "wall time between two checkpoints; 0: only by every and when a run is stopped",
         .example = R"("10 min")"},
        {.name = "keep",
         .member = &CheckpointOutput::keep,
         .least = 1,
         .most = 1000,
         .doc = "how many of them are kept, the newest ones",
         .example = "2"}};
  }
};

struct Output {
  FieldOutput fields;
  HistoryOutput history;
  CheckpointOutput checkpoint;
  bool report = true;

  static constexpr const char* doc = "What is written, and how often.";
  static Entries<Output> keys();
};

}  // namespace recoil::config
