#include "app/sweep/sweep_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "app/run/reporter.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// A number for sorting: that of the value in a range, or its position in a list.
double rank_of(const SweptKey& key, const std::string& value) {
  if (key.is_range) return config::parse_any_quantity(value, key.key).value;
  return static_cast<double>(std::ranges::find(key.values, value) - key.values.begin());
}

}  // namespace

SweepRuns::SweepRuns(fs::path case_file, fs::path folder, SweepQuestion question, int jobs)
    : case_file_(std::move(case_file)),
      folder_(std::move(folder)),
      question_(std::move(question)),
      jobs_(jobs),
      case_folder_(case_file_.parent_path()) {}

std::size_t SweepRuns::add(const std::vector<SweptKey>& keys, const std::vector<std::string>& values) {
  std::vector<std::string> changes;
  for (std::size_t k = 0; k < keys.size(); ++k) changes.push_back(keys[k].key + "=" + values[k]);
  std::string name = folder_name(changes);
  while (!names_.insert(name).second) name += '_';  // values that differ in signs only
  runs_.push_back(checked_run(case_file_, changes, folder_ / name));
  values_.push_back(values);
  results_.emplace_back();
  numbers_.emplace_back();
  return runs_.size() - 1;
}

bool SweepRuns::compute() {
  const std::size_t begin = computed_;
  computed_ = runs_.size();
  share_work(computed_ - begin, jobs_, [&](std::size_t k) { compute_one(begin + k, computed_); });
  return !cut_short(results_);
}

std::string SweepRuns::told_stopped() const {
  return app::told_stopped(results_, "the same command goes on");
}

void SweepRuns::compute_one(std::size_t n, std::size_t of) {
  ChildResult result = run_or_reuse(runs_[n]);
  const std::lock_guard lock(speaking_);
  results_[n] = std::move(result);
  const ChildResult& r = results_[n];
  if (!r.begun()) return;
  if (r.problem.empty())
    take(n);
  else
    worst_ = r.exit;
  tell(fmt::format("[{}/{}] {}: {}{}{}\n", ++told_, of, runs_[n].folder.filename().string(), r.verdict,
                   r.reused ? ", finished before" : "", r.problem.empty() ? "" : ", " + r.problem));
}

void SweepRuns::take(std::size_t n) {
  const RunQuantities run = read_quantities(runs_[n].folder, case_folder_);
  if (columns_.empty()) choose_columns(run);
  for (const SweepColumn& c : columns_) numbers_[n].push_back(number(run, c));
  if (!question_.condition.quantity.empty() && question_.condition.holds(run)) holds_.insert(n);
}

void SweepRuns::choose_columns(const RunQuantities& run) {
  std::vector<std::string> names = question_.quantities;
  if (const std::string& asked = question_.condition.quantity; !asked.empty())
    names.insert(names.begin(), asked);
  if (names.empty()) names = peaks_of_gauges(run);
  shown_.resize(names.size());
  std::iota(shown_.begin(), shown_.end(), std::size_t{0});
  if (question_.quantities.empty())
    for (const auto& more : {extremes_of_gauges(run), run.names})
      names.insert(names.end(), more.begin(), more.end());
  for (const std::string& name : names)
    if (std::ranges::find(columns_, name, &SweepColumn::quantity) == columns_.end())
      columns_.push_back({name, unit_of(run.found, name)});
}

double SweepRuns::number(const RunQuantities& run, const SweepColumn& column) const {
  double value = nothing;
  try {
    value = value_of(run, column.quantity);
  } catch (const InputError&) {
    // Of those that nobody asked for a run may lack one: a gauge that another value of a key has taken away.
    if (!question_.quantities.empty() || column.quantity == question_.condition.quantity) throw;
  }
  const bool plain = column.unit.empty() || column.unit == "1";
  return plain ? value : config::in_unit(value, column.unit);
}

std::size_t SweepRuns::reused() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(results_, [](const ChildResult& r) { return r.reused; }));
}

SweepTable SweepRuns::table(std::string title, std::vector<SweptKey> keys) const {
  std::vector<std::size_t> order(computed_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t n) {
    std::vector<double> ranks;
    for (std::size_t k = 0; k < keys.size(); ++k) ranks.push_back(rank_of(keys[k], values_[n][k]));
    return ranks;
  };
  if (!question_.condition.quantity.empty())  // runs were added as the search went on
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  SweepTable table{std::move(title), std::move(keys), columns_, {}};
  for (const std::size_t n : order) {
    std::vector<double> numbers = numbers_[n];
    numbers.resize(columns_.size(), nothing);
    table.rows.push_back(
        {values_[n], runs_[n].folder.filename().string(), results_[n].verdict, std::move(numbers)});
  }
  return table;
}

}  // namespace recoil::app
