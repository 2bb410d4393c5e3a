#include "realtime/fast_rings.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace wold {
namespace {

/// What a texture holds when strips are written into it: the place of each texel.
class Written {
 public:
  explicit Written(const RingSquares& squares) : squares_(squares) {
    texels_.resize(static_cast<std::size_t>(squares.levels()),
                   std::vector<IVec2>(static_cast<std::size_t>(squares.size() * squares.size()),
                                      IVec2(1 << 30)));
  }
  void write(const std::vector<RingStrip>& strips) {
    const int mask = squares_.size() - 1;
    for (const RingStrip& s : strips)
      for (const RingRect& r : squares_.rects(s))
        for (int j = 0; j < r.size.y; ++j)
          for (int i = 0; i < r.size.x; ++i) {
            const IVec2 texel = r.texel + IVec2(i, j);
            at(s.level, texel) =
                s.low + IVec2((texel.x - s.low.x) & mask, (texel.y - s.low.y) & mask);
          }
  }
  /// Whether the square of a level holds what stands in it.
  bool whole(int level) {
    const RingStrip all = squares_.whole(level);
    const int mask = squares_.size() - 1;
    for (int j = all.low.y; j < all.high.y; ++j)
      for (int i = all.low.x; i < all.high.x; ++i)
        if (at(level, {i & mask, j & mask}) != IVec2(i, j)) return false;
    return true;
  }

 private:
  IVec2& at(int level, IVec2 texel) {
    return texels_[static_cast<std::size_t>(level)]
                  [static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(squares_.size()) +
                   static_cast<std::size_t>(texel.x)];
  }
  const RingSquares& squares_;
  std::vector<std::vector<IVec2>> texels_;
};

TEST(RingSquares, StripsFillWhatIsNew) {
  RingSquares squares(32, 4, 2.0);
  Written written(squares);
  for (const DVec2 eye : {DVec2(0), DVec2(11, -3), DVec2(25, -3), DVec2(25, -40), DVec2(-31, 12),
                          DVec2(5000, -7000), DVec2(4990, -6988)}) {
    written.write(squares.move_to(eye));
    for (int level = 0; level < squares.levels(); ++level)
      EXPECT_TRUE(written.whole(level)) << eye.x << " " << level;
  }
}

TEST(RingSquares, LittleIsMadeAnewOnAShortWay) {
  RingSquares squares(64, 3, 1.0);
  squares.move_to({0, 0});
  EXPECT_TRUE(squares.move_to({RingSquares::slack, 0}).empty());
  const std::vector<RingStrip> strips = squares.move_to({RingSquares::slack + 1, 0});
  ASSERT_EQ(strips.size(), 1U);
  EXPECT_EQ(strips[0].level, 0);
  EXPECT_EQ(strips[0].high - strips[0].low, IVec2(RingSquares::slack + 1, 64));
}

TEST(RingSquares, HalvedRectsCoverTheStrip) {
  RingSquares squares(32, 1, 1.0);
  squares.move_to({0, 0});
  const std::vector<RingStrip> strips = squares.move_to({7, -9});
  for (int halvings = 0; halvings < 4; ++halvings) {
    const int size = squares.size() >> halvings;
    std::set<std::pair<int, int>> covered;
    for (const RingStrip& s : strips)
      for (const RingRect& r : squares.rects(s, halvings, 1)) {
        EXPECT_GE(r.texel.x, 0);
        EXPECT_LE(r.texel.x + r.size.x, size);
        EXPECT_LE(r.texel.y + r.size.y, size);
        for (int j = 0; j < r.size.y; ++j)
          for (int i = 0; i < r.size.x; ++i) covered.insert({r.texel.x + i, r.texel.y + j});
      }
    // The texel before each strip too: patches reach over its edge.
    for (const RingStrip& s : strips)
      for (int j = s.low.y - 1; j < s.high.y; ++j)
        for (int i = s.low.x - 1; i < s.high.x; ++i)
          EXPECT_TRUE(
              covered.contains({(i >> halvings) & (size - 1), (j >> halvings) & (size - 1)}));
  }
}

}  // namespace
}  // namespace wold
