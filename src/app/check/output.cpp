#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "app/check/checks.hpp"
#include "app/data_folder.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "record/field_dump.hpp"
#include "record/findings.hpp"

namespace recoil::app {

namespace {

using config::Node;

/// The texts of a key that holds one or a list of them.
std::vector<const Node*> texts_of(const LoadedCase& loaded, const char* dotted) {
  std::vector<const Node*> all;
  const Node* node = loaded.document.find(dotted);
  if (node && node->is_text()) all.push_back(node);
  if (node && node->is_array())
    for (const Node& child : node->children) all.push_back(&child);
  return all;
}

void check_variables(LoadedCase& loaded) {
  std::vector<std::string> known;
  for (const FieldVariable& v : field_variables()) known.emplace_back(v.name);
  for (const Node* wanted : texts_of(loaded, "output.fields.variables")) {
    if (std::find(known.begin(), known.end(), wanted->text) != known.end()) continue;
    const std::string near = did_you_mean(wanted->text, known);
    loaded.found.error(wanted->place, fmt::format("there is no field '{}'", wanted->text),
                       !near.empty() ? near : fmt::format("there are: {}", fmt::join(known, ", ")));
  }
}

/// Whether the end of the run comes from the command line, which may end it early.
bool is_cut_short(const LoadedCase& loaded) {
  const Node* end = loaded.document.find("time.end");
  return end && end->place.file != loaded.contents.file;
}

/// A run that the command line ends early shall not stumble over the intervals of its file.
void check_interval(LoadedCase& loaded, const std::string& path, double every) {
  const config::Case& c = loaded.contents;
  if (!(every > c.time.end)) return;
  const std::string message = fmt::format("'every' = {:.4g} us lies beyond the end of the run at {:.4g} us",
                                          every * 1e6, c.time.end * 1e6);
  const config::Place place = place_of(loaded, path, {c.file});
  if (is_cut_short(loaded))
    loaded.found.warning(place, message, "only the first and the last are written");
  else
    loaded.found.error(place, message,
                       fmt::format("every = \"{:.2g} us\" gives 100", c.time.end / 100 * 1e6));
}

void check_intervals(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  check_interval(loaded, "output.fields.every", c.output.fields.every);
  check_interval(loaded, "output.history.every", c.output.history.every);
  check_interval(loaded, "output.checkpoint.every", c.output.checkpoint.every);
  for (const config::Gauge& g : c.gauges)
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.every; })
            check_interval(loaded, "gauge." + g.name + ".every", kind.every);
        },
        g.kind);
}

/// Times that a run does not reach are never met.
void check_expected_times(LoadedCase& loaded) {
  const double end = loaded.contents.time.end;
  if (is_cut_short(loaded)) return;
  for (const config::Expectation& e : loaded.contents.expect) {
    if (e.is_flag || e.at_most || config::dimension_name(e.unit) != "time") continue;
    if (const double earliest = e.at_least ? e.value : e.value - e.tolerance; earliest > end)
      loaded.found.warning(e.place,
                           fmt::format("'{}' cannot be met: the run ends at {:.4g} us, before {:.4g} us",
                                       e.quantity, end * 1e6, earliest * 1e6),
                           "let time.end be later");
  }
}

/// The keys of the library's bibliography: "@article{zhu1995,".
std::vector<std::string> known_sources() {
  std::vector<std::string> keys;
  std::ifstream file(materials_folder() / "references.bib");
  for (std::string line; std::getline(file, line);) {
    const std::size_t brace = line.find('{');
    if (line.starts_with('@') && brace != std::string::npos)
      keys.push_back(line.substr(brace + 1, line.find(',', brace) - brace - 1));
  }
  return keys;
}

/// No error: a case may cite what the library does not.
void check_sources(LoadedCase& loaded) {
  const std::vector<std::string> known = known_sources();
  for (const Node* cited : texts_of(loaded, "cite")) {
    if (known.empty() || std::find(known.begin(), known.end(), cited->text) != known.end()) continue;
    const std::string near = did_you_mean(cited->text, known);
    loaded.found.warning(cited->place,
                         fmt::format("the source '{}' is not in materials/references.bib", cited->text),
                         !near.empty() ? near : fmt::format("there are: {}", fmt::join(known, ", ")));
  }
}

}  // namespace

void check_expectations(LoadedCase& loaded) {
  Quantities known = known_quantities(loaded.contents);
  known.folder = loaded.folder;  // where the curves lie that they compare with
  check_known(known, loaded.contents.expect, loaded.found);
  if (!loaded.found.has_errors()) check_expected_times(loaded);
}

void check_output(LoadedCase& loaded) {
  check_variables(loaded);
  check_intervals(loaded);
  check_sources(loaded);
  check_expectations(loaded);
}

}  // namespace recoil::app
