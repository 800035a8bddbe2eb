#include "config/diagnostics.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "config/text_faults.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"

namespace recoil::config {

namespace {

constexpr std::size_t widest_excerpt = 200, before_column = 80;  // characters of a line that are shown

/// A line for people, and where its `column` has gone: of a long one only what is around it.
struct Excerpt {
  std::string text;
  int column = 1;
};

Excerpt excerpt_of(std::string_view line, int column) {
  const std::vector<std::string> all = printable_characters(line);
  const std::size_t at = std::min(static_cast<std::size_t>(column - 1), all.size());
  const bool cut = all.size() > widest_excerpt;
  const std::size_t first = cut ? std::min(at - std::min(at, before_column), all.size() - widest_excerpt) : 0;
  const std::size_t last = cut ? first + widest_excerpt : all.size();
  Excerpt e{first > 0 ? "\u2026" : "", column - static_cast<int>(first) + (first > 0 ? 1 : 0)};
  for (std::size_t k = first; k < last; ++k) e.text += all[k];
  if (last < all.size()) e.text += "\u2026";
  return e;
}

/// Blanks and carets under `line`. Tabs are kept, so that the caret stands right whatever their width.
std::string carets(std::string_view line, int column, int length) {
  std::string out;
  int at = 1;
  for (const char c : line) {
    if (!starts_character(c)) continue;
    if (at >= column + length) break;
    out += at >= column ? '^' : c == '\t' ? '\t' : ' ';
    ++at;
  }
  if (at <= column) out += std::string(static_cast<std::size_t>(column - at), ' ') + '^';
  return out;
}

/// A mistake that is met several times (a material that several bodies use) is listed once.
void add_once(std::vector<Diagnostic>& list, Diagnostic one) {
  const auto key = [](const Diagnostic& d) {
    return std::tie(d.severity, d.place.file, d.place.line, d.place.column, d.message);
  };
  if (std::ranges::none_of(list, [&](const Diagnostic& d) { return key(d) == key(one); }))
    list.push_back(std::move(one));
}

}  // namespace

void Diagnostics::source(std::string file, std::string text) {
  sources_.insert_or_assign(std::move(file), std::move(text));
}

void Diagnostics::error(Place place, std::string message, std::string help) {
  add_once(list_, {Diagnostic::Severity::error, std::move(place), std::move(message), std::move(help)});
  ++errors_;
}

void Diagnostics::error(Place place, const InputError& thrown) {
  const std::string text = thrown.what(), head = "error: ", help = "\n   = help: ";
  const std::size_t begin = text.starts_with(head) ? head.size() : 0, end = text.find(help, begin);
  error(std::move(place), text.substr(begin, end - begin),
        end == std::string::npos ? "" : text.substr(end + help.size()));
}

void Diagnostics::warning(Place place, std::string message, std::string help) {
  add_once(list_, {Diagnostic::Severity::warning, std::move(place), std::move(message), std::move(help)});
}

std::string_view Diagnostics::line_of(const Place& place) const {
  const auto found = sources_.find(place.file);
  return found == sources_.end() || place.line < 1 ? std::string_view()
                                                   : config::line_of(found->second, place.line);
}

std::string Diagnostics::text(const Diagnostic& one) const {
  std::string out = one.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
  out += one.message + '\n';
  const Place& p = one.place;
  if (!p.file.empty()) {
    out += "  --> " + p.file;
    if (p.line > 0) out += ':' + std::to_string(p.line) + ':' + std::to_string(p.column);
    out += '\n';
  }
  if (const std::string_view line = line_of(p); !line.empty()) {
    const Excerpt shown = excerpt_of(line, std::max(p.column, 1));
    out += "   | " + shown.text + '\n';
    out += "   | " + carets(shown.text, shown.column, std::max(p.length, 1)) + '\n';
  }
  if (!one.help.empty()) out += "   = help: " + one.help + '\n';
  return out;
}

std::string Diagnostics::text() const {
  std::vector<const Diagnostic*> ordered;
  for (const Diagnostic& one : list_) ordered.push_back(&one);
  std::stable_sort(ordered.begin(), ordered.end(), [](const Diagnostic* a, const Diagnostic* b) {
    const Place &p = a->place, &q = b->place;
    return std::tie(p.file, p.line, p.column) < std::tie(q.file, q.line, q.column);
  });
  std::string out;
  for (const Diagnostic* one : ordered) {
    if (!out.empty()) out += '\n';
    out += text(*one);
  }
  return out;
}

void Diagnostics::throw_if_errors() const {
  if (has_errors()) throw InputError(text());
}

}  // namespace recoil::config
