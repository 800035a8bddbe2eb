#include "parallel/ordered_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace recoil {

namespace {

constexpr double lowest = -std::numeric_limits<double>::infinity();

}  // namespace

int OrderedSums::item(std::size_t sums, std::size_t maxima) {
  kinds_.push_back({sums, maxima, total_.size()});
  total_.resize(total_.size() + sums + maxima, 0);
  rest_.resize(total_.size());
  any_.push_back(0);
  clear();
  return static_cast<int>(kinds_.size()) - 1;
}

void OrderedSums::clear() {
  rows_.clear();
  values_.clear();
}

std::span<double> OrderedSums::add(int item, long order) {
  const Kind& kind = kinds_[item];
  const std::size_t begin = values_.size();
  rows_.push_back({order, item, begin});
  values_.resize(begin + kind.sums, 0.0);
  values_.resize(begin + kind.sums + kind.maxima, lowest);
  return {values_.data() + begin, kind.sums + kind.maxima};
}

void OrderedSums::take_in(const parallel::Bytes& bytes) {
  parallel::Unpacker reader(bytes);
  while (!reader.empty()) {
    const long order = reader.read<long>();
    const int item = reader.read<int>();
    const std::span<double> row = add(item, order);
    reader.read(row.data(), row.size());
  }
}

void OrderedSums::add_up() {
  const auto before = [](const Row& p, const Row& q) { return p.order < q.order; };
  if (!std::is_sorted(rows_.begin(), rows_.end(), before))
    std::stable_sort(rows_.begin(), rows_.end(), before);
  std::fill(rest_.begin(), rest_.end(), 0.0);
  std::fill(any_.begin(), any_.end(), 0);
  for (const Kind& k : kinds_) {
    std::fill_n(total_.begin() + static_cast<std::ptrdiff_t>(k.begin), k.sums, 0.0);
    std::fill_n(total_.begin() + static_cast<std::ptrdiff_t>(k.begin + k.sums), k.maxima, lowest);
  }
  for (const Row& row : rows_) {
    const Kind& kind = kinds_[row.item];
    any_[row.item] = 1;
    for (std::size_t c = 0; c < kind.sums; ++c) {
      double &sum = total_[kind.begin + c], &rest = rest_[kind.begin + c];
      const double x = values_[row.begin + c], next = sum + x;
      rest += std::abs(sum) >= std::abs(x) ? (sum - next) + x : (x - next) + sum;
      sum = next;
    }
    for (std::size_t c = kind.sums; c < kind.sums + kind.maxima; ++c)
      total_[kind.begin + c] = std::max(total_[kind.begin + c], values_[row.begin + c]);
  }
  for (std::size_t c = 0; c < total_.size(); ++c)
    if (std::isfinite(total_[c])) total_[c] += rest_[c];
}

void OrderedSums::reduce(const parallel::World& world) {
  if (world.size() > 1) {
    parallel::Bytes bytes;
    for (const Row& row : rows_) {
      const Kind& kind = kinds_[row.item];
      parallel::pack(bytes, row.order);
      parallel::pack(bytes, row.item);
      parallel::pack(bytes, values_.data() + row.begin, kind.sums + kind.maxima);
    }
    const auto all = world.gather(bytes);
    clear();
    for (const auto& one : all) take_in(one);
    if (world.rank() != 0) return;
  }
  add_up();
}

std::span<const double> OrderedSums::total(int item) const {
  const Kind& kind = kinds_[item];
  return {total_.data() + kind.begin, kind.sums + kind.maxima};
}

bool OrderedSums::any(int item) const { return any_[item] != 0; }

}  // namespace recoil
