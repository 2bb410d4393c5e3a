#include "forest/species.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace wold {
namespace {

SpeciesSettings of_file(const char* name, Range height, int models) {
  SpeciesSettings settings;
  settings.name = name;
  settings.plant = {std::string(WOLD_SOURCE_DIR "/plants/") + name + ".lsys"};
  settings.height = height;
  settings.models = models;
  settings.detail = 0.3F;
  return settings;
}

TEST(Species, GrowsModelsOverItsRangeOfHeights) {
  const std::vector<SpeciesSettings> settings{of_file("fern", {0.5F, 0.9F}, 2),
                                              of_file("honda", {4, 6}, 3)};
  Progress progress;
  const std::vector<Species> species = grow_species(settings, 7, progress);
  ASSERT_EQ(species.size(), 2U);
  for (const Species& s : species) {
    ASSERT_EQ(s.models.size(), static_cast<std::size_t>(s.settings.models));
    for (int k = 0; k < s.settings.models; ++k) {
      const TriangleMesh& model = s.models[static_cast<std::size_t>(k)];
      EXPECT_FALSE(model.triangles.empty());
      const float height = model_height(s.settings, k);
      EXPECT_TRUE(s.settings.height.contains(height));
      EXPECT_NEAR(model.bounds().high.z, height, 0.02F * height);
    }
  }
  EXPECT_NEAR(model_height(settings[1], 1), 5, 1e-5F);
}

TEST(Species, SameBitsForAnyNumberOfThreads) {
  const std::vector<SpeciesSettings> settings{of_file("fern", {0.5F, 0.9F}, 3)};
  std::vector<Vec3> reference;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    Progress progress;
    const auto species = grow_species(settings, 7, progress);
    const std::vector<Vec3>& positions = species[0].models[2].positions;
    if (threads == 1) reference = positions;
    EXPECT_TRUE(positions == reference);
  }
}

TEST(Species, RadiusFollowsTheHeightUnlessGiven) {
  SpeciesSettings settings;
  settings.height = {8, 12};
  EXPECT_NEAR(settings.exclusion_radius(), 1.2F, 1e-5F);
  settings.radius = 3;
  EXPECT_EQ(settings.exclusion_radius(), 3);
}

std::string error_of(std::vector<SpeciesSettings> settings) {
  Progress progress;
  try {
    grow_species(settings, 1, progress);
  } catch (const Error& error) {
    return error.message();
  }
  return "no error";
}

TEST(Species, ErrorsNameTheSpecies) {
  const SpeciesSettings fern = of_file("fern", {0.5F, 0.9F}, 1);
  SpeciesSettings nameless = fern;
  nameless.name.clear();
  EXPECT_EQ(error_of({fern, nameless}), "species 2 has no name");
  SpeciesSettings fileless = fern;
  fileless.plant.path.clear();
  EXPECT_EQ(error_of({fileless}), "species 'fern' has no plant file");
  EXPECT_EQ(error_of({fern, fern}), "two species are called 'fern'");
  SpeciesSettings lost = fern;
  lost.plant.path = "no such file.lsys";
  EXPECT_NE(error_of({lost}).find("no such file.lsys"), std::string::npos);
}

TEST(Species, StopsWhenCancelled) {
  Progress progress;
  progress.cancel();
  const std::vector<SpeciesSettings> settings{of_file("fern", {0.5F, 0.9F}, 3)};
  EXPECT_THROW(grow_species(settings, 1, progress), Error);
}

}  // namespace
}  // namespace wold
