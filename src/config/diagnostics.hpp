#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace recoil::config {

/// Where something stands in a text. Lines and columns count from 1, columns and length in characters
/// (code points); line 0 means the file as a whole.
struct Place {
  std::string file;
  int line = 0, column = 0, length = 1;
};

struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  Place place;
  std::string message;
  std::string help;  // how to cure it; may be empty
};

/// Collects every mistake of the user's input, so that all of them are reported in one pass.
class Diagnostics {
 public:
  /// Remembers the content of a file, so that its lines can be shown below the messages.
  void source(std::string file, std::string text);

  void error(Place place, std::string message, std::string help = {});
  /// One that was thrown: its message and its cure, at a place.
  void error(Place place, const InputError& thrown);
  void warning(Place place, std::string message, std::string help = {});

  bool has_errors() const { return errors_ > 0; }
  int error_count() const { return errors_; }
  const std::vector<Diagnostic>& list() const { return list_; }

  /// All messages in the order of their places, each with its source line, a caret and its cure.
  std::string text() const;
  /// One message in the same form.
  std::string text(const Diagnostic& one) const;

  /// Gives up if there was an error. @throws InputError with text().
  void throw_if_errors() const;

 private:
  std::string_view line_of(const Place& place) const;

  std::map<std::string, std::string> sources_;
  std::vector<Diagnostic> list_;
  int errors_ = 0;
};

}  // namespace recoil::config
