#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/check/count_text.hpp"
#include "app/check/estimate.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "app/launch.hpp"
#include "app/load_case.hpp"
#include "app/run/reporter.hpp"
#include "app/run/resolved_case.hpp"
#include "app/run/stop_request.hpp"
#include "app/study/child_runs.hpp"
#include "app/study/verify_table.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// What the cases of --quick may take together on one processor, by their estimates [s].
constexpr double quick_seconds = 140;

/// A case to verify.
struct Work {
  std::string name, title, resolved;
  fs::path file;
  double seconds = 0;  // estimated, on one processor
};

/// Their files: a folder of the same name where the user works is not meant.
std::vector<std::string> shipped_files() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder() / "cases", error))
    if (fs::exists(entry.path() / "case.toml") && fs::exists(entry.path() / "expected.toml"))
      names.push_back((entry.path() / "case.toml").string());
  std::sort(names.begin(), names.end());
  if (names.empty())
    throw EnvironmentError(
        fmt::format("there are no cases in {}\n   = help: RECOIL_DATA names the folder that holds them",
                    (data_folder() / "cases").string()));
  return names;
}

/// All mistakes before the first run.
Work work_of(const std::string& word, const std::vector<std::string>& overrides = {}) {
  LoadedCase loaded = load_case(word, overrides);
  if (!loaded.found.has_errors()) check_logic(loaded);
  loaded.found.throw_if_errors();
  const fs::path file = find_case_file(word);
  if (loaded.contents.expect.empty())
    throw InputError(
        fmt::format("{} has no expectations to verify\n   = help: write an "
                    "expected.toml beside it",
                    file.string()));
  const double seconds =
      estimate(loaded.contents, loaded.materials, fastest_at_start(loaded.contents, loaded.materials))
          .seconds;
  return {short_name(file), loaded.contents.title, resolved_text(loaded), file, seconds};
}

/// The cheapest ones, as many as fit.
std::vector<Work> cheapest(std::vector<Work> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Work& a, const Work& b) { return a.seconds < b.seconds; });
  double sum = 0;
  std::size_t n = 0;
  while (n < all.size() && sum + all[n].seconds <= quick_seconds) sum += all[n++].seconds;
  all.resize(n);
  std::sort(all.begin(), all.end(), [](const Work& a, const Work& b) { return a.name < b.name; });
  return all;
}

std::vector<Work> choose(const VerifyOptions& o) {
  if (o.quick && !o.cases.empty())
    throw InputError("--quick chooses the cases itself\n   = help: omit --quick, or the names of the cases");
  std::vector<Work> all;
  for (const std::string& word : o.cases.empty() ? shipped_files() : o.cases)
    all.push_back(work_of(word, o.overrides));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (all[i].name == all[j].name)
        throw InputError(
            fmt::format("two cases are called '{}': {} and {}\n   = help: verify them one after the other",
                        all[i].name, all[j].file.string(), all[i].file.string()));
  return o.quick ? cheapest(std::move(all)) : all;
}

/// Whether the folder holds a finished run of exactly this case.
bool is_done(const fs::path& folder, const Work& w) {
  return is_of_case(folder, w.resolved) && read_verified(folder).problem.empty();
}

VerifiedCase run_one(const Work& w, const fs::path& folder, const VerifyOptions& o) {
  const fs::path run = folder / w.name, log = folder / (w.name + ".log");
  int code = exit_finished;
  if (!o.reuse || !is_done(run, w)) {
    std::vector<std::string> words{"run",     w.file.string(), "-o", run.string(),
                                   "--force", "--plain",       "-j", "1"};
    for (const std::string& set : o.overrides) words.insert(words.end(), {"--set", set});
    code = run_child(words, log);
  }
  const bool done = has_results(code);
  VerifiedCase c = done ? read_verified(run) : VerifiedCase{};
  if (!done) c.problem = "the run ended with " + why_no_results(code, log), c.exit_code = code;
  c.name = w.name;
  c.title = w.title;
  return c;
}

/// Runs the cases, the dearest first, several at a time.
std::vector<VerifiedCase> run_all(const std::vector<Work>& work, const fs::path& folder,
                                  const VerifyOptions& o) {
  std::vector<std::size_t> order(work.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return work[a].seconds > work[b].seconds; });
  std::vector<VerifiedCase> results(work.size());
  std::size_t finished = 0;
  std::mutex speaking;
  share_work(order.size(), o.jobs, [&](std::size_t k) {
    VerifiedCase c;
    const Work& w = work[order[k]];
    try {
      c = run_one(w, folder, o);
    } catch (const std::exception& e) {
      c.name = w.name, c.title = w.title, c.problem = e.what(), c.exit_code = exit_environment;
    }
    const std::lock_guard lock(speaking);
    const std::string verdict = !c.problem.empty() ? c.problem
                                : c.failures() == 0
                                    ? fmt::format("all {} met", c.values.size())
                                    : fmt::format("{} of {} FAILED", c.failures(), c.values.size());
    tell(fmt::format("[{}/{}] {}: {}{}, {:.3g} s of processor time\n", ++finished, work.size(), c.name,
                     verdict, c.doubts.empty() ? "" : ", doubtful", c.cpu_s));
    results[order[k]] = std::move(c);
  });
  return results;
}

/// Each with its estimate; one that cannot be read or checked is named and does not hide the others.
int list_cases() {
  std::vector<Work> all;
  std::vector<std::pair<std::string, std::string>> unreadable;
  for (const std::string& file : shipped_files()) try {
      all.push_back(work_of(file));
    } catch (const InputError& e) {
      const std::string said = e.what();
      unreadable.emplace_back(short_name(file), said.substr(0, said.find('\n')));
    }
  const std::vector<Work> quick = cheapest(all);
  for (const Work& w : all) {
    const bool is_quick =
        std::any_of(quick.begin(), quick.end(), [&](const Work& q) { return q.name == w.name; });
    fmt::print("{:<5} {:8.3g} s  {:<28} {}\n", is_quick ? "quick" : "", w.seconds, w.name, w.title);
  }
  for (const auto& [name, said] : unreadable)
    fmt::print("{:<5} {:>8} s  {:<28} cannot be read: {}\n", "", "-", name, said);
  return unreadable.empty() ? exit_finished : exit_bad_input;
}

}  // namespace

int verify(const VerifyOptions& o) {
  if (o.list) return list_cases();
  const std::vector<Work> work = choose(o);
  const fs::path folder = o.folder.empty() ? fs::path("runs/verify") : fs::path(o.folder);
  make_folder(folder);
  watch_stop_signals();
  const std::vector<VerifiedCase> results = run_all(work, folder, o);
  const auto undone = std::ranges::count_if(
      results, [](const VerifiedCase& c) { return c.name.empty() || c.exit_code == exit_stopped; });
  if (stop_requested() && undone > 0) {
    const std::string told =
        fmt::format("stopped as asked: {} of {} cases are done, with --reuse they are not run again\n",
                    results.size() - static_cast<std::size_t>(undone), results.size());
    std::fputs(told.c_str(), stderr);
    return exit_stopped;
  }
  const std::string text = verify_markdown(results, o.overrides);
  write_atomically(folder / "verify.md", text);
  write_atomically(folder / "verify.csv", verify_csv(results));
  write_atomically(folder / "verify.json", verify_json(results));
  if (!o.write.empty()) write_atomically(o.write, text);
  tell(fmt::format("\n{}\n{}\n", text, (folder / "verify.md").string()));
  const VerifyCount n = count(results);
  tell(fmt::format("{}, {}, {} against references, {} failed\n", counted(n.cases, "case", "cases"),
                   counted(n.values, "check", "checks"), n.references, n.failures));
  for (const VerifiedCase& c : results)
    if (!has_results(c.exit_code)) return c.exit_code;
  return n.failures > 0 ? exit_expectation_failed : exit_finished;
}

}  // namespace recoil::app
