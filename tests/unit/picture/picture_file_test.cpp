#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"
#include "picture/canvas.hpp"
#include "picture/field_picture.hpp"
#include "picture/line_chart.hpp"

namespace recoil::picture_file_test {
namespace {

Canvas chart() {
  LineChart chart;
  chart.title = "Rear surface";
  chart.x_title = "time [us]";
  chart.series = {{"a", {0, 1, 2}, {0, 50, 100}, {}}, {"b", {0, 1, 2}, {0, 30, 60}, {}}};
  return line_chart(chart);
}

TEST(PictureFile, SuffixNamesTheFormat) {
  EXPECT_EQ(picture_format("a/b.png"), PictureFormat::png);
  EXPECT_EQ(picture_format("b.SVG"), PictureFormat::svg);
  EXPECT_EQ(picture_format("b.x.pdf"), PictureFormat::pdf);
  for (const char* file : {"b.jpg", "b", "png", ".png", "b.png/c"}) {
    try {
      picture_format(file);
      ADD_FAILURE() << file;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(".png, .svg or .pdf"), std::string::npos);
    }
  }
}

TEST(PictureFile, EachFormatBeginsAsItShould) {
  const ScratchFolder folder;
  for (const auto& [name, begin] : {std::pair("a.png", "\x89PNG"), {"a.svg", "<?xml"}, {"a.pdf", "%PDF-"}}) {
    write_picture(folder / name, chart());
    std::ifstream file(folder / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(bytes.starts_with(begin)) << name;
    EXPECT_GT(bytes.size(), 5000U) << name;
  }
}

TEST(PictureFile, SameDrawingGivesTheSameBytesWithoutADate) {
  for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf}) {
    const std::string bytes = encoded(chart(), format);
    EXPECT_TRUE(bytes == encoded(chart(), format)) << static_cast<int>(format);
    EXPECT_EQ(bytes.find("CreationDate"), std::string::npos);
  }
}

TEST(PictureFile, SameFieldGivesTheSameBytes) {
  FieldPicture p;
  p.nx = 3, p.ny = 2, p.dx = p.dy = 1;
  p.values = {0, 1, 2, 3, 4, 5};
  for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf})
    EXPECT_TRUE(encoded(field_picture(p), format) == encoded(field_picture(p), format))
        << static_cast<int>(format);
  EXPECT_NE(encoded(field_picture(p), PictureFormat::svg).find("<image id=\"image"), std::string::npos);
}

TEST(PictureFile, VectorFormatsHoldLinesAndTextAndNoPixels) {
  const std::string svg = encoded(chart(), PictureFormat::svg), pdf = encoded(chart(), PictureFormat::pdf);
  EXPECT_EQ(svg.find("<image"), std::string::npos);
  EXPECT_NE(svg.find("<path"), std::string::npos);
  EXPECT_EQ(pdf.find("/Subtype /Image"), std::string::npos);
  EXPECT_NE(pdf.find("/FontName"), std::string::npos);
}

TEST(PictureFile, SizesAreChecked) {
  EXPECT_THROW(Canvas(0, 5, {}), InternalError);
  EXPECT_THROW(Canvas(5, 1 << 20, {}), InternalError);
}

}  // namespace
}  // namespace recoil::picture_file_test
