// The registry of figures and the arrangement of their parts.
#include "figures/figure.h"

#include <gtest/gtest.h>

#include <set>

#include "figures/composition.h"

namespace etendue::figures {
namespace {

// The numbers of figures in each chapter of the book.
constexpr int kFigures[] = {0, 15, 68, 17, 75, 13, 44, 19, 22, 50, 14};

TEST(Figures, EachFigureOfTheBookIsMadeOrHasAReason) {
  std::set<std::string> numbers;
  for (const Figure& figure : figures()) EXPECT_TRUE(numbers.insert(figure.number).second) << figure.number;
  for (const NotMade& figure : not_made()) EXPECT_TRUE(numbers.insert(figure.number).second) << figure.number;
  for (int chapter = 1; chapter <= 10; ++chapter)
    for (int i = 1; i <= kFigures[chapter]; ++i)
      EXPECT_TRUE(numbers.contains(std::to_string(chapter) + "." + std::to_string(i))) << chapter << "." << i;
}

TEST(Figures, AreFoundByTheirNumbers) {
  for (const Figure& figure : figures()) EXPECT_EQ(find_figure(figure.number), &figure);
  EXPECT_EQ(find_figure("5.1"), nullptr);
  ASSERT_NE(find_not_made("5.1"), nullptr);
  EXPECT_EQ(find_not_made("7.4"), nullptr);
}

TEST(Figures, TitlesAreNoSentencesAndNotesAre) {
  for (const Figure& figure : figures()) {
    const std::string title = figure.title, note = figure.note;
    EXPECT_FALSE(title.empty());
    EXPECT_NE(title.back(), '.') << figure.number;
    EXPECT_TRUE(note.empty() || note.back() == '.') << figure.number;
  }
}

Part uniform_part(const std::string& caption, int width, int height, uint8_t value) {
  return {caption, Picture{width, height, std::vector<uint8_t>(static_cast<size_t>(3 * width * height), value)}};
}

TEST(Composition, PlacesPicturesSideBySide) {
  const Composition all = composed({uniform_part("a", 40, 30, 10), uniform_part("b", 40, 30, 200)}, 0);
  ASSERT_EQ(all.pictures.size(), 2u);
  EXPECT_EQ(all.pictures[0].y, all.pictures[1].y);
  EXPECT_GE(all.pictures[1].x, all.pictures[0].x + 40);
  const Picture picture = rasterized(all);
  const auto at = [&](int x, int y) { return picture.pixels[static_cast<size_t>(3 * (y * picture.width + x))]; };
  EXPECT_EQ(at(all.pictures[0].x + 20, all.pictures[0].y + 15), 10);
  EXPECT_EQ(at(all.pictures[1].x + 20, all.pictures[1].y + 15), 200);
}

TEST(Composition, StartsNewRowsAfterTheColumns) {
  const Composition all =
      composed({uniform_part("a", 40, 30, 0), uniform_part("b", 40, 30, 0), uniform_part("c", 40, 30, 0)}, 2);
  ASSERT_EQ(all.pictures.size(), 3u);
  EXPECT_EQ(all.pictures[2].x, all.pictures[0].x);
  EXPECT_GE(all.pictures[2].y, all.pictures[0].y + 30);
}

TEST(Composition, SvgContainsPictures) {
  const std::string svg = to_svg(composed({uniform_part("caption", 8, 8, 7)}, 0, "Heading"));
  EXPECT_NE(svg.find("data:image/png;base64,"), std::string::npos);
  EXPECT_NE(svg.find("caption"), std::string::npos);
  EXPECT_NE(svg.find("Heading"), std::string::npos);
  EXPECT_TRUE(svg.find("</svg>") != std::string::npos);
}

TEST(Thumbnail, KeepsTheMean) {
  Picture picture{64, 32, {}};
  for (int i = 0; i < 64 * 32; ++i) picture.pixels.insert(picture.pixels.end(), 3, i % 2 == 0 ? 0 : 200);
  const Picture small = thumbnail(picture, 16);
  EXPECT_EQ(small.width, 16);
  EXPECT_EQ(small.height, 8);
  for (const uint8_t value : small.pixels) EXPECT_EQ(value, 100);
}

}  // namespace
}  // namespace etendue::figures
