#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace recoil::app {

/// The commands, their options, and which one is to be run. Help, completion and the reference page of the
/// commands follow from what is declared here.
struct Commands {
  CLI::App top{"Impact of solids: bodies collide, slide and separate.", "recoil"};
  RunOptions run;
  CheckOptions check;
  ValueOptions value;
  PlotOptions plot;
  MovieOptions movie;
  ReportOptions report;
  StudyOptions study;
  SweepOptions sweep;
  VerifyOptions verify;
  ResumeOptions resume;
  StatusOptions status;
  NewOptions fresh;
  std::string material, key, cited, shell;
  std::vector<std::string> materials;
  ImportOptions import_from;
  TableOptions table;
  HugoniotOptions hugoniot;
  MatchOptions match;
  bool markdown = false;
  std::function<int()> chosen;

  Commands();

 private:
  CLI::App* command(CLI::App& parent, const char* name, const char* doc, std::function<int()> action);
  void add_new();
  void add_run();
  void add_resume();
  void add_check();
  void add_value();
  void add_plot();
  void add_movie();
  void add_report();
  void add_study();
  void add_sweep();
  void add_verify();
  void add_material();
  void add_rest();
};

}  // namespace recoil::app
