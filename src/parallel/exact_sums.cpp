#include "parallel/exact_sums.hpp"

#include <limits>

namespace recoil {

namespace {

constexpr double lowest = -std::numeric_limits<double>::infinity();

}  // namespace

int ExactSums::item(std::size_t sums, std::size_t maxima) {
  kinds_.push_back({sums, maxima, sums_.size(), maxima_.size(), total_.size()});
  sums_.resize(sums_.size() + sums);
  maxima_.resize(maxima_.size() + maxima, lowest);
  total_.resize(total_.size() + sums, 0);
  total_.resize(total_.size() + maxima, lowest);
  any_.push_back(0);
  return static_cast<int>(kinds_.size()) - 1;
}

void ExactSums::clear() {
  std::fill(sums_.begin(), sums_.end(), ExactSum{});
  std::fill(maxima_.begin(), maxima_.end(), lowest);
  std::fill(any_.begin(), any_.end(), 0);
}

SumRow ExactSums::add(int item) {
  const Kind& kind = kinds_[item];
  any_[item] = 1;
  return {{sums_.data() + kind.first_sum, kind.sums}, {maxima_.data() + kind.first_maximum, kind.maxima}};
}

/// The sums as digits, behind them how many ranks have lost each, then the flags of the items: one reduction.
void ExactSums::add_up(const parallel::World& world) {
  constexpr std::size_t each = ExactSum::digits + 1;
  numbers_.assign(sums_.size() * each, 0);
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const std::span<std::int64_t> own(numbers_.data() + k * each, each);
    if (sums_[k].is_lost())
      own[ExactSum::digits] = 1;
    else
      sums_[k].add_to(own.first<ExactSum::digits>());
  }
  numbers_.insert(numbers_.end(), any_.begin(), any_.end());
  world.sum(numbers_);
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const std::span<const std::int64_t> own(numbers_.data() + k * each, each);
    sums_[k] = own[ExactSum::digits] != 0 ? ExactSum::lost() : ExactSum::from(own.first<ExactSum::digits>());
  }
  std::copy(numbers_.end() - static_cast<std::ptrdiff_t>(any_.size()), numbers_.end(), any_.begin());
  world.max(maxima_);
}

void ExactSums::reduce(const parallel::World& world) {
  if (world.size() > 1) add_up(world);
  for (const Kind& kind : kinds_) {
    for (std::size_t k = 0; k < kind.sums; ++k) total_[kind.begin + k] = sums_[kind.first_sum + k].value();
    for (std::size_t k = 0; k < kind.maxima; ++k)
      total_[kind.begin + kind.sums + k] = maxima_[kind.first_maximum + k];
  }
}

std::span<const double> ExactSums::total(int item) const {
  const Kind& kind = kinds_[item];
  return {total_.data() + kind.begin, kind.sums + kind.maxima};
}

bool ExactSums::any(int item) const { return any_[item] != 0; }

}  // namespace recoil
