#include "render/film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace wold {
namespace {

PathSample surface(float radiance, float depth) {
  PathSample s;
  s.radiance = Vec3(radiance);
  s.albedo = Vec3(0.5F);
  s.normal = Vec3(0, 0, 1);
  s.depth = depth;
  s.cover = 1;
  return s;
}

PathSample sky(float radiance) {
  PathSample s;
  s.radiance = Vec3(radiance);
  return s;
}

TEST(Film, AveragesItsSamples) {
  Film film(3, 2);
  film.add(1, 0, surface(1000, 10));
  film.add(1, 0, surface(3000, 30));
  film.add(1, 0, sky(5000));
  film.add(1, 0, sky(7000));
  const Image image = film.image();
  EXPECT_FLOAT_EQ(image.at(1, 0, image.find("G")), 4000 / white_luminance);
  EXPECT_FLOAT_EQ(image.at(1, 0, image.find("A")), 0.5F);
  EXPECT_FLOAT_EQ(image.at(1, 0, image.find("albedo.R")), 0.25F);
  EXPECT_FLOAT_EQ(image.at(1, 0, image.find("normal.Z")), 0.5F);
  EXPECT_FLOAT_EQ(image.at(1, 0, image.find("depth.Z")), 20);
  EXPECT_EQ(image.at(1, 0, image.find("samples")), 4);
  EXPECT_EQ(film.total_samples(), 4U);
  EXPECT_EQ(film.least_samples(), 0U);
}

TEST(Film, PixelsWithoutSamplesAreBlackAndSkyIsInfinitelyFar) {
  Film film(2, 1);
  film.add(1, 0, sky(100));
  const Image image = film.image();
  EXPECT_EQ(image.at(0, 0, 0), 0);
  EXPECT_EQ(image.at(0, 0, image.find("samples")), 0);
  EXPECT_TRUE(std::isinf(image.at(0, 0, image.find("depth.Z"))));
  EXPECT_TRUE(std::isinf(image.at(1, 0, image.find("depth.Z"))));
}

TEST(Film, RejectsWhatIsNotFinite) {
  Film film(1, 1);
  film.add(0, 0, surface(1000, 10));
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (const float x : bad) {
    film.add(0, 0, sky(x));
    PathSample s = surface(1, 1);
    s.normal.y = x;
    film.add(0, 0, s);
    s = surface(1, x);
    film.add(0, 0, s);
  }
  EXPECT_EQ(film.rejected(), 9U);
  EXPECT_EQ(film.sample_count(0, 0), 1U);
  EXPECT_FLOAT_EQ(film.image().at(0, 0, 0), 1000 / white_luminance);
}

TEST(Film, RefusesWhatDoesNotFitInMemory) {
  try {
    const Film film(10000000, 10000000);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(error.message().find("10000000 x 10000000"), std::string::npos);
  }
}

}  // namespace
}  // namespace wold
