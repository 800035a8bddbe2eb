#pragma once

#include <optional>
#include <string>
#include <vector>

namespace recoil::config {

/// A value that was written without its quotes.
struct Unquoted {
  std::string text;            // "5 km/s"
  std::string why;             // for the message
  int column = 0, length = 0;  // in the text as the user wrote it, characters
};

/// Puts the quotes that the user forgot, and remembers where, so that places stay those of the user's text.
class QuoteRepairs {
 public:
  /// Looks for an unquoted quantity or word at a place where the parser stopped, and quotes it in `text`.
  /// Columns are in `text`, in characters from 1. Nothing where there is none: `text` stays.
  std::optional<Unquoted> repair(std::string& text, int line, int column);

  /// The column that the user sees of a column of the repaired text.
  int original_column(int line, int column) const;

 private:
  struct Repair {
    int line, first, last;  // columns of the two quotes, in the text as repaired so far
  };
  std::vector<Repair> repairs_;
};

}  // namespace recoil::config
