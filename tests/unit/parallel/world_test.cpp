#include "parallel/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "parallel/pieces.hpp"
#include "parallel/post.hpp"
#include "parallel/traffic.hpp"
#include "session.hpp"

namespace recoil::parallel::world_test {
namespace {

Bytes bytes_of(int value, std::size_t n) {
  Bytes b;
  for (std::size_t k = 0; k < n; ++k) pack(b, value + static_cast<int>(k));
  return b;
}

TEST(Bytes, AreReadBackInTheirOrder) {
  Bytes bytes;
  const std::array<double, 3> values{1.5, -2, 1e300};
  pack(bytes, 'x');
  pack(bytes, values.data(), values.size());
  pack(bytes, std::int64_t{-7});
  Unpacker reader(bytes);
  EXPECT_EQ(reader.read<char>(), 'x');
  std::array<double, 3> back{};
  EXPECT_FALSE(reader.empty());
  reader.read(back.data(), back.size());
  EXPECT_EQ(back, values);
  EXPECT_EQ(reader.read<std::int64_t>(), -7);
  EXPECT_TRUE(reader.empty());
}

TEST(Bytes, ReadingNoneLeavesAnEmptyListAlone) {
  Bytes bytes;
  std::vector<double> none;
  pack(bytes, none.data(), none.size());
  pack(bytes, 'x');
  Unpacker reader(bytes);
  reader.read(none.data(), none.size());
  EXPECT_EQ(reader.read<char>(), 'x');
}

TEST(Bytes, AShortMessageIsAnError) {
  Bytes bytes;
  pack(bytes, 1.0F);
  Unpacker reader(bytes);
  EXPECT_THROW(reader.read<double>(), InternalError);
}

/// Makes messages go in pieces of so many bytes while it lives.
struct ShortPieces {
  explicit ShortPieces(std::uint64_t bytes) { longest_piece() = bytes; }
  ~ShortPieces() { longest_piece() = usual; }
  ShortPieces(const ShortPieces&) = delete;
  ShortPieces& operator=(const ShortPieces&) = delete;
  std::uint64_t usual = longest_piece();
};

TEST(Pieces, HoldEveryByteOnceAndAreShortEnoughForMpi) {
  const auto pieces_of = [](std::uint64_t n) {
    std::vector<std::pair<std::uint64_t, int>> all;
    for_each_piece(n, [&](std::uint64_t first, int count) { all.emplace_back(first, count); });
    return all;
  };
  using Pieces = std::vector<std::pair<std::uint64_t, int>>;
  EXPECT_TRUE(pieces_of(0).empty());
  EXPECT_EQ(pieces_of(7), (Pieces{{0, 7}}));
  const std::uint64_t gib = std::uint64_t{1} << 30U;
  EXPECT_EQ(pieces_of(gib), (Pieces{{0, 1 << 30}}));
  // more than an int counts
  EXPECT_EQ(pieces_of(3 * gib + 5), (Pieces{{0, 1 << 30}, {gib, 1 << 30}, {2 * gib, 1 << 30}, {3 * gib, 5}}));
  const ShortPieces pieces(4);
  EXPECT_EQ(pieces_of(8), (Pieces{{0, 4}, {4, 4}}));
  EXPECT_EQ(pieces_of(9), (Pieces{{0, 4}, {4, 4}, {8, 1}}));
}

TEST(World, OneProcess) {
  if (several_processes()) GTEST_SKIP();
  const World world;
  EXPECT_EQ(world.rank(), 0);
  EXPECT_EQ(world.size(), 1);
  EXPECT_EQ(world.min(3), 3);
  EXPECT_EQ(world.max(-3), -3);
  EXPECT_TRUE(world.any(true));
  EXPECT_FALSE(world.any(false));
  std::array<std::int64_t, 2> counts{5, -1};
  world.sum(counts);
  EXPECT_EQ(counts[0], 5);
  Bytes bytes = bytes_of(3, 4);
  world.broadcast(bytes);
  EXPECT_EQ(bytes, bytes_of(3, 4));
  EXPECT_EQ(world.gather(bytes), std::vector<Bytes>{bytes});
  EXPECT_TRUE(world.exchange({}, {}).empty());
}

/// Run by mpirun with several processes.
struct MpiWorld : testing::Test {
  void SetUp() override {
    if (!several_processes()) GTEST_SKIP() << "for mpirun";
    start_parallel();
  }
  World world;
};

TEST_F(MpiWorld, Reductions) {
  const int n = world.size(), r = world.rank();
  ASSERT_GT(n, 1);
  EXPECT_EQ(world.min(10.0 - r), 11.0 - n);
  EXPECT_EQ(world.max(r), n - 1);
  EXPECT_TRUE(world.any(r == n - 1));
  EXPECT_FALSE(world.any(false));
  std::array<std::int64_t, 2> counts{1, r};
  world.sum(counts);
  EXPECT_EQ(counts[0], n);
  EXPECT_EQ(counts[1], n * (n - 1) / 2);
}

TEST_F(MpiWorld, GatherAndBroadcast) {
  const int n = world.size(), r = world.rank();
  const auto all = world.gather(bytes_of(100 * r, static_cast<std::size_t>(r)));  // rank 0 sends nothing
  if (r == 0) {
    ASSERT_EQ(all.size(), static_cast<std::size_t>(n));
    for (int q = 0; q < n; ++q) EXPECT_EQ(all[q], bytes_of(100 * q, static_cast<std::size_t>(q)));
  } else {
    EXPECT_TRUE(all.empty());
  }
  Bytes bytes = r == 0 ? bytes_of(9, 5) : Bytes{};
  world.broadcast(bytes);
  EXPECT_EQ(bytes, bytes_of(9, 5));
}

/// Messages of all lengths from every process to every other one.
void check_messages(const World& world) {
  const int n = world.size(), r = world.rank();
  std::vector<Message> out;
  std::vector<int> from;
  for (int q = 0; q < n; ++q) {
    if (q == r) continue;
    out.push_back({q, bytes_of(10 * r + q, 1 + static_cast<std::size_t>(1000 * q))});
    from.push_back(q);
  }
  for (int round = 0; round < 3; ++round) {
    const auto in = world.exchange(out, from);
    ASSERT_EQ(in.size(), from.size());
    for (std::size_t k = 0; k < in.size(); ++k) {
      EXPECT_EQ(in[k].rank, from[k]);
      EXPECT_EQ(in[k].bytes, bytes_of(10 * from[k] + r, 1 + static_cast<std::size_t>(1000 * r)));
    }
  }
}

TEST_F(MpiWorld, EveryMessageArrivesWhereItShould) { check_messages(world); }

TEST_F(MpiWorld, LongMessagesGoInPieces) {
  const ShortPieces pieces(300);
  check_messages(world);
  const int n = world.size(), r = world.rank();
  const auto all = world.gather(bytes_of(r, static_cast<std::size_t>(150 * r)));
  for (std::size_t q = 0; q < all.size(); ++q) EXPECT_EQ(all[q], bytes_of(static_cast<int>(q), 150 * q));
  Bytes bytes = r == n - 1 ? Bytes{} : bytes_of(9, 500);
  world.broadcast(bytes);
  EXPECT_EQ(bytes, bytes_of(9, 500));
}

/// Several posted messages of all lengths arrive whole and in order, whole pieces and empty ones, too.
void check_posts(const World& world) {
  const int n = world.size(), r = world.rank();
  const std::vector<std::size_t> lengths{1, 75, 0, 500, 150, 3};
  for (int q = 0; q < n; ++q)
    for (std::size_t k = 0; q != r && k < lengths.size(); ++k)
      post(q, bytes_of(static_cast<int>(k) + 10 * r, lengths[k]));
  for (int q = n - 1; q >= 0; --q)
    for (std::size_t k = 0; q != r && k < lengths.size(); ++k)
      EXPECT_EQ(wait_for_posted(q), bytes_of(static_cast<int>(k) + 10 * q, lengths[k])) << k;
  wait_until_taken();
}

TEST_F(MpiWorld, PostedMessagesArriveInOrder) { check_posts(world); }

TEST_F(MpiWorld, LongPostedMessagesGoInPieces) {
  const ShortPieces pieces(300);  // bytes; 75 and 150 numbers are whole pieces
  check_posts(world);
}

TEST_F(MpiWorld, NothingIsTakenBeforeItIsPosted) {
  const int n = world.size(), r = world.rank();
  const int next = (r + 1) % n, last = (r + n - 1) % n;
  EXPECT_FALSE(take_posted(last).has_value());
  world.max(0.0);  // all have looked
  post(next, bytes_of(r, 7));
  std::optional<Bytes> found;
  while (!found) found = take_posted(last);
  EXPECT_EQ(*found, bytes_of(last, 7));
  EXPECT_FALSE(take_posted(last).has_value()) << "taken once";
  wait_until_taken();
}

TEST_F(MpiWorld, CountsWhatIsSent) {
  const Traffic before = traffic();
  const int n = world.size(), r = world.rank();
  std::vector<Message> out;
  if (r == 0) out.push_back({1, bytes_of(0, 25)});
  world.exchange(out, r == 1 ? std::vector<int>{0} : std::vector<int>{});
  world.max(1.0 * n);
  const Traffic sent = traffic() - before;
  EXPECT_EQ(sent.exchanges, r < 2 ? 1 : 0);
  EXPECT_EQ(sent.messages, r == 0 ? 1 : 0);
  EXPECT_EQ(sent.bytes, r == 0 ? 100 : 0);
  EXPECT_EQ(sent.reductions, 1);
}

}  // namespace
}  // namespace recoil::parallel::world_test
