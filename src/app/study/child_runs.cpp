#include "app/study/child_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <thread>

#include "app/command_line.hpp"
#include "app/launch.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/resolved_case.hpp"
#include "app/run/run_quantities.hpp"
#include "app/run/stop_request.hpp"
#include "config/read_case.hpp"
#include "core/build_info.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "record/findings.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

nlohmann::json summary_in(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  auto j = nlohmann::json::parse(text_of(file), nullptr, false);
  if (!j.is_object()) throw InputError(fmt::format("{} cannot be read\n   = help: remove it", file.string()));
  return j;
}

/// Exit code and verdict of a finished run.
ChildResult told_by(const fs::path& folder) {
  const auto j = summary_in(folder);
  return {j.value("exit", 0), false, j.value("verdict", "unknown"), ""};
}

bool is_done(const ChildRun& run) {
  return has_quantities(run.folder) && is_of_case(run.folder, run.resolved) &&
         summary_in(run.folder).value("version", "") == build_info::full_version;
}

std::vector<std::string> words_of(const ChildRun& run) {
  const bool goes_on = is_of_case(run.folder, run.resolved) && !fs::exists(run.folder / "summary.json") &&
                       !checkpoints_of(run.folder).empty();
  std::vector<std::string> words{"resume", run.folder.string(), "--plain"};
  if (!goes_on) words = {"run", run.case_file.string(), "-o", run.folder.string(), "--force", "--plain"};
  if (run.threads > 0) words.insert(words.end(), {"-j", std::to_string(run.threads)});
  for (const std::string& change : run.overrides)
    if (!goes_on) words.insert(words.end(), {"--set", change});
  return words;
}

}  // namespace

void share_work(std::size_t items, int jobs, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto labour = [&] {
    for (std::size_t k = next++; k < items && !stop_requested(); k = next++) try {
        task(k);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = items;
      }
  };
  const auto processors = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t workers = std::min(items, jobs > 0 ? static_cast<std::size_t>(jobs) : processors);
  std::vector<std::jthread> team;
  for (std::size_t k = 1; k < workers; ++k) team.emplace_back(labour);
  labour();
  team.clear();  // joins
  if (failure) std::rethrow_exception(failure);
}

ChildRun checked_run(const fs::path& case_file, const std::vector<std::string>& overrides,
                     const fs::path& folder) {
  LoadedCase loaded = load_case(case_file.string(), overrides);
  if (!loaded.found.has_errors()) check_logic(loaded);
  if (loaded.too_large) throw EnvironmentError(loaded.found.text());
  loaded.found.throw_if_errors();
  return {case_file, folder, overrides, resolved_text(loaded), 1};
}

bool cut_short(const std::vector<ChildResult>& results) {
  return stop_requested() && std::ranges::any_of(results, [](const ChildResult& r) {
           return !r.begun() || r.exit == exit_stopped;
         });
}

std::string told_stopped(const std::vector<ChildResult>& results, const std::string& how) {
  std::size_t done = 0, stopped = 0, failed = 0;
  for (const ChildResult& r : results)
    if (r.begun()) ++(r.problem.empty() ? done : r.exit == exit_stopped ? stopped : failed);
  return fmt::format(
      "stopped as asked: of {} runs {} are done, {} stopped with a checkpoint, {}{} were not begun; {}\n",
      results.size(), done, stopped, failed > 0 ? fmt::format("{} failed, ", failed) : "",
      results.size() - done - stopped - failed, how);
}

bool is_of_case(const fs::path& folder, const std::string& resolved) {
  return text_of(folder / "case.resolved.toml") == resolved;
}

ChildResult run_or_reuse(const ChildRun& run) {
  const fs::path log = run.folder.string() + ".log";
  if (is_done(run)) {
    ChildResult before = told_by(run.folder);
    before.reused = true;
    return before;
  }
  if (stop_requested()) return {};
  int code = exit_environment;
  try {
    code = run_child(words_of(run), log);
  } catch (const EnvironmentError& e) {  // killed, or without room for its log
    return {code, false, "failed", e.what()};
  }
  if (has_results(code)) return told_by(run.folder);
  return {code, false, code == exit_stopped ? "stopped" : "failed", why_no_results(code, log)};
}

std::string why_no_results(int code, const fs::path& log) {
  std::istringstream lines(text_of(log));
  std::string first;
  for (std::string line; first.empty() && std::getline(lines, line);)
    if (line.find("error: ") != std::string::npos) first = ": " + line;
  return fmt::format("exit code {}{}, see {}", code, first, log.string());
}

void check_named(const std::vector<std::string>& quantities, const LoadedCase& loaded, const char* option) {
  const config::Case& c = loaded.contents;
  config::Diagnostics found;
  std::string all;
  std::vector<config::Expectation> named;
  Quantities known = known_quantities(c);
  known.folder = loaded.folder;
  for (const std::string& q : quantities) {
    all += q + '\n';
    config::Expectation e;
    e.quantity = q;
    e.is_flag = known.flags.contains(q);
    e.place = {option, static_cast<int>(named.size()) + 1, 1, static_cast<int>(q.size())};
    named.push_back(e);
  }
  found.source(option, all);
  config::check_expected_names(named, c.bodies, c.gauges, found);
  if (!found.has_errors()) check_known(known, named, found);
  found.throw_if_errors();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
}

}  // namespace recoil::app
