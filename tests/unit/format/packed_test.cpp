#include "format/packed.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace recoil::packed_test {
namespace {

/// The bytes behind a text of the 64 characters, by its definition.
std::string bytes_of(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bits, bytes;
  for (const char c : text)
    for (int b = 5; c != '=' && b >= 0; --b) bits += (digits.find(c) >> b & 1U) != 0 ? '1' : '0';
  for (std::size_t k = 0; k + 8 <= bits.size(); k += 8)
    bytes += static_cast<char>(std::stoi(bits.substr(k, 8), nullptr, 2));
  return bytes;
}

std::string inflated(const std::string& bytes, std::size_t most) {
  std::string out(most, '\0');
  uLongf size = most;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  out.resize(size);
  return out;
}

std::vector<std::int64_t> integers_of(const std::string& text, std::size_t most) {
  std::vector<std::int64_t> values;
  std::int64_t before = 0;
  std::uint64_t sum = 0;
  int shift = 0;
  for (const char c : inflated(bytes_of(text), most)) {
    sum |= static_cast<std::uint64_t>(c & 127) << shift;
    shift += 7;
    if ((static_cast<unsigned char>(c) & 128U) != 0) continue;
    before +=
        (sum & 1U) != 0 ? -static_cast<std::int64_t>((sum + 1) / 2) : static_cast<std::int64_t>(sum / 2);
    values.push_back(before);
    sum = 0, shift = 0;
  }
  return values;
}

TEST(Packed, TextsOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Packed, IntegersComeBack) {
  constexpr auto least = std::numeric_limits<std::int32_t>::min(),
                 most = std::numeric_limits<std::int32_t>::max();
  const std::vector<std::int32_t> values{0, 1, -1, 63, 64, -64, -65, 8191, 8192, least, most, least, 0};
  const std::vector<std::int64_t> same(values.begin(), values.end());
  EXPECT_EQ(integers_of(packed_integers(values), 1000), same);
  EXPECT_TRUE(integers_of(packed_integers({}), 10).empty());
}

TEST(Packed, EvenFieldsTakeLittleSpace) {
  const std::vector<std::int32_t> even(100000, 1234);
  EXPECT_LT(packed_integers(even).size(), 400U);
}

TEST(Packed, FloatsComeBack) {
  const std::vector<float> values{0, -1.5F, 3e30F, std::numeric_limits<float>::infinity()};
  const std::string bytes = inflated(bytes_of(packed_floats(values)), 100);
  ASSERT_EQ(bytes.size(), 4 * values.size());
  EXPECT_EQ(bytes.substr(4, 4), std::string("\x00\x00\xc0\xbf", 4));
}

}  // namespace
}  // namespace recoil::packed_test
