#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace recoil::app {

/// How a run tells how far it is.
enum class Display {
  none,   // errors and the verdict only
  plain,  // one line each 10 s
  live    // a line that changes in place
};

/// Where a run is.
struct Progress {
  double time = 0, end = 0, dt = 0;  // s
  long step = 0;
  double cells = 0;  // with matter
};

/// Prints to the standard output at once. Where whoever read it has gone (a closed pipe, a terminal that hung
/// up), it goes nowhere from then on: what computes goes on, and its files have it all.
/// @returns whether it could be printed.
bool tell(const std::string& text);

/// Prints the messages of a run to the terminal and to run.log. On processes that are silent it does
/// nothing.
class Reporter {
 public:
  /// @param log file. @param goes_on adds to the log of before. @throws EnvironmentError where it cannot be
  /// written.
  Reporter(Display display, bool speaks, const std::filesystem::path& log, bool goes_on = false);
  ~Reporter();
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  /// One line, unless quiet.
  void say(const std::string& line);
  /// One line, also when quiet.
  void insist(const std::string& line);
  /// Where the run begins or goes on: what it takes is counted from here.
  void begin(double time, long step) { begun_at_ = time, first_step_ = step; }
  /// After every step; prints now and then.
  void progress(const Progress& now);
  /// Takes the live line away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void write(const std::string& line, bool to_terminal);
  void show(const std::string& text);

  Display display_;
  bool speaks_, line_shown_ = false;
  double begun_at_ = 0;  // s
  long first_step_ = 0;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> log_;
  Clock::time_point start_, next_, next_log_;
};

}  // namespace recoil::app
