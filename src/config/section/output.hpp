#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"

namespace recoil::config {

struct FieldOutput {
  double every = 0;                    // s; 0: none but first and last
  std::vector<std::string> variables;  // names of fields to write

  static constexpr const char* doc = "Pictures of the whole domain.";
  static Entries<FieldOutput> keys() {
    return {every_key(&FieldOutput::every, "time between two pictures; 0: only the first and the last"),
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

struct Output {
  FieldOutput fields;
  HistoryOutput history;

  static constexpr const char* doc = "What is written, and how often.";
  static Entries<Output> keys();
};

}  // namespace recoil::config
