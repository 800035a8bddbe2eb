#include "picture/png.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil {
namespace {

TEST(Png, RoundTripKeepsEveryPixel) {
  const ScratchFolder folder;
  Image image = make_image(37, 21, {255, 255, 255});
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i)
      image.set(i, j,
                {static_cast<unsigned char>(7 * i), static_cast<unsigned char>(12 * j),
                 static_cast<unsigned char>(i * j)});
  write_png(folder / "a.png", image);
  const Image back = read_png(folder / "a.png");
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST(Png, OtherFilesAreRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(read_png(folder / "none.png"), InputError);
  std::ofstream(folder / "text.png") << "not a picture";
  EXPECT_THROW(read_png(folder / "text.png"), InputError);
  std::string bytes = encode_png(make_image(50, 50, {1, 2, 3}));
  bytes.resize(bytes.size() / 2);
  EXPECT_THROW(decode_png(bytes), InputError);
}

TEST(Png, SizesAreChecked) {
  EXPECT_THROW(make_image(0, 5, {}), InternalError);
  EXPECT_THROW(make_image(5, 1 << 20, {}), InternalError);
}

}  // namespace
}  // namespace recoil
