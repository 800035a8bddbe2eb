#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace recoil {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that turn `a`
/// into `b`, where no piece is edited twice (optimal string alignment; Damerau 1964). Upper and lower case
/// are equal.
inline int edit_distance(std::string_view a, std::string_view b) {
  const auto low = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = low(a[i - 1]) == low(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && low(a[i - 1]) == low(b[j - 2]) && low(a[i - 2]) == low(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[n];
}

/// edit_distance() between a word and the start of a longer candidate, of which the rest may be missing.
inline int distance_to_start(std::string_view word, std::string_view candidate) {
  int least = edit_distance(word, candidate);
  for (std::size_t n = word.empty() ? 0 : word.size() - 1; n <= word.size() + 1; ++n)
    least = std::min(least, edit_distance(word, candidate.substr(0, n)));
  return least;
}

/// Up to `count` of the candidates that `word` may have been meant as, the nearest first: those within a
/// third of the word's length, those that contain it, and those whose start is almost as near. Of equally
/// near ones those that look alike come first.
inline std::vector<std::string> nearest(std::string_view word, std::span<const std::string> candidates,
                                        std::size_t count = 3) {
  struct Found {
    int distance, unlike;
    const std::string* name;
  };
  std::vector<Found> found;
  const int reach = std::max(1, static_cast<int>(word.size()) / 3);
  for (const std::string& c : candidates) {
    const std::size_t at = word.size() >= 3 ? c.find(word) : std::string::npos;
    const bool other_start = word.empty() || c.empty() || word[0] != c[0];
    int d = edit_distance(word, c);
    if (word.size() >= 3 && c.size() > word.size() + 1) d = std::min(d, distance_to_start(word, c) + 1);
    if (at != std::string::npos) d = std::min(d, at == 0 ? 1 : reach);
    if (d <= reach) found.push_back({d, 2 * other_start + (word.size() != c.size()), &c});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& p, const Found& q) {
    return p.distance != q.distance ? p.distance < q.distance : p.unlike < q.unlike;
  });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(count, found.size()); ++i) names.push_back(*found[i].name);
  return names;
}

/// The best of nearest(), or an empty string.
inline std::string closest(std::string_view word, std::span<const std::string> candidates) {
  const std::vector<std::string> names = nearest(word, candidates, 1);
  return names.empty() ? std::string() : names.front();
}

/// "did you mean 'a'?" or "did you mean 'a' or 'b'?"; empty where nothing is near.
inline std::string did_you_mean(std::string_view word, std::span<const std::string> candidates,
                                std::size_t count = 1) {
  const std::vector<std::string> names = nearest(word, candidates, count);
  if (names.empty()) return {};
  std::string out = "did you mean '" + names.front() + "'";
  for (std::size_t i = 1; i < names.size(); ++i) {
    out += i + 1 < names.size() ? ", '" : " or '";
    out += names[i] + "'";
  }
  return out + "?";
}

}  // namespace recoil
