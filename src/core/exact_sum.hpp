#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace recoil {

/// A sum of doubles without rounding: its value, rounded once at the end, has the same bits in whatever order
/// the terms were added. It is a whole number of 2^-160 in 256 bits (R. Hallberg and A. Adcroft, Parallel
/// Computing 40 (2014) 140): what a term has below 2^-160 = 7e-49 is cut off. A term or a sum from 2^95 =
/// 4e28 on, or one that is not finite, makes the value NaN from then on.
class ExactSum {
 public:
  static constexpr std::size_t digits = 8;  // of 32 bits each, the last one with the sign

  ExactSum& operator+=(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int exponent = static_cast<int>(bits >> 52 & 0x7ffU);
    if (exponent == 0) return *this;  // 0, or below 2^-1022
    if (exponent > largest_exponent) return *this = lost();
    const std::uint64_t mantissa = (bits & fraction) | hidden_bit;
    const int shift = exponent - lowest_exponent;
    if (shift <= -64) return *this;
    if (shift < 0) return add(mantissa >> -shift, 0, 0, x < 0);
    const int bit = shift % 64;
    return add(mantissa << bit, bit == 0 ? 0 : mantissa >> (64 - bit), static_cast<std::size_t>(shift / 64),
               x < 0);
  }
  ExactSum& operator-=(double x) { return *this += -x; }
  ExactSum& operator+=(const ExactSum& b) {
    if (is_lost() || b.is_lost()) return *this = lost();
    const bool was = negative(), other = b.negative();
    bool carry = false;
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] = with_carry(words_[w], b.words_[w], carry);
    return was == other && negative() != was ? *this = lost() : *this;
  }
  ExactSum& operator-=(const ExactSum& b) {
    ExactSum opposite = b;
    if (!b.is_lost()) opposite.change_sign();
    return *this += opposite;
  }

  /// The double that is nearest to the sum; of two that are equally near the even one.
  double value() const {
    if (is_lost()) return std::numeric_limits<double>::quiet_NaN();
    ExactSum size = *this;
    if (negative()) size.change_sign();
    std::size_t top = words_.size() - 1;
    while (top > 0 && size.words_[top] == 0) --top;
    if (size.words_[top] == 0) return 0;
    const int free = std::countl_zero(size.words_[top]);
    std::uint64_t leading = size.words_[top] << free, rest = 0;
    if (top > 0) {
      const std::uint64_t next = size.words_[top - 1];
      if (free > 0) leading |= next >> (64 - free);
      rest = free > 0 ? next << free : next;
    }
    for (std::size_t w = 0; w + 1 < top; ++w) rest |= size.words_[w];
    if (rest != 0) leading |= 1;  // decides a tie
    const double x = std::ldexp(static_cast<double>(leading), 64 * static_cast<int>(top) - free - bits_below);
    return negative() ? -x : x;
  }
  /// Whether nothing, or nothing but zeros and what cancels exactly, has been added.
  bool is_zero() const { return words_ == std::array<std::uint64_t, 4>{}; }
  bool is_lost() const { return words_[3] == sign && (words_[0] | words_[1] | words_[2]) == 0; }

  /// Adds the sum to digits, which do not carry: the digits of so many as 2^31 sums may be added up one by
  /// one.
  void add_to(std::span<std::int64_t, digits> to) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      const std::uint64_t high = words_[w] >> 32;
      to[2 * w] += static_cast<std::int64_t>(words_[w] & low_half);
      to[2 * w + 1] += w + 1 < words_.size() ? static_cast<std::int64_t>(high)
                                             : static_cast<std::int64_t>(static_cast<std::int32_t>(high));
    }
  }
  /// The sum of such digits.
  static ExactSum from(std::span<const std::int64_t, digits> from) {
    ExactSum sum;
    std::int64_t carry = 0;
    for (std::size_t d = 0; d < digits; ++d) {
      const std::int64_t all = from[d] + carry;
      const auto digit = static_cast<std::uint64_t>(all) & low_half;
      carry = all >> 32;
      sum.words_[d / 2] |= digit << (d % 2 == 0 ? 0 : 32);
      if (d + 1 == digits && carry != (sum.negative() ? -1 : 0)) return lost();
    }
    return sum;
  }
  static ExactSum lost() {
    ExactSum sum;
    sum.words_[3] = sign;
    return sum;
  }

 private:
  static constexpr int bits_below = 160;  // of the value's point
  // Exponents as a double keeps them: of a mantissa whose last bit stands for 2^-160, and of 2^94.
  static constexpr int lowest_exponent = 1023 + 52 - bits_below, largest_exponent = 1023 + 94;
  static constexpr std::uint64_t hidden_bit = std::uint64_t{1} << 52, fraction = hidden_bit - 1,
                                 sign = std::uint64_t{1} << 63, low_half = 0xffffffffU;

  bool negative() const { return (words_[3] & sign) != 0; }
  static std::uint64_t with_carry(std::uint64_t a, std::uint64_t b, bool& carry) {
    std::uint64_t sum = 0, all = 0;
    const bool first = __builtin_add_overflow(a, b, &sum);
    const bool second = __builtin_add_overflow(sum, std::uint64_t{carry}, &all);
    carry = first || second;
    return all;
  }
  static std::uint64_t with_borrow(std::uint64_t a, std::uint64_t b, bool& borrow) {
    std::uint64_t difference = 0, all = 0;
    const bool first = __builtin_sub_overflow(a, b, &difference);
    const bool second = __builtin_sub_overflow(difference, std::uint64_t{borrow}, &all);
    borrow = first || second;
    return all;
  }
  void change_sign() {
    bool carry = true;
    for (std::uint64_t& w : words_) w = with_carry(~w, 0, carry);
  }
  /// Adds or takes away a number of 128 bits that begins at a word.
  ExactSum& add(std::uint64_t low, std::uint64_t high, std::size_t word, bool take_away) {
    if (is_lost()) return *this;
    const bool was = negative();
    const auto combine = take_away ? with_borrow : with_carry;
    bool carry = false;
    words_[word] = combine(words_[word], low, carry);
    if (word + 1 < words_.size()) words_[word + 1] = combine(words_[word + 1], high, carry);
    for (std::size_t w = word + 2; carry && w < words_.size(); ++w) words_[w] = combine(words_[w], 0, carry);
    return was == take_away && negative() != was ? *this = lost() : *this;
  }

  std::array<std::uint64_t, 4> words_{};  // two's complement, from the lowest on
};

}  // namespace recoil
