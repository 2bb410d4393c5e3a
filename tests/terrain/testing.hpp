#pragma once
// What the tests of terrain share.

#include <cmath>
#include <functional>
#include <string>

#include "../base/testing.hpp"
#include "terrain/operators.hpp"
#include "terrain/steps.hpp"

namespace wold::testing_terrain {

/// A field with heights from a function of the place.
inline Heightfield field_of(int width, int height, double cell, DVec2 origin,
                            const std::function<double(DVec2)>& height_at_place) {
  Heightfield field{Grid<float>(width, height), origin, cell};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      field.height(i, j) = static_cast<float>(height_at_place(origin + cell * DVec2(i, j)));
  return field;
}

/// Runs one operator alone on a field.
template <class Work, class T>
auto run(Work work, const Heightfield& input, const T& parameters, std::uint64_t seed = 1) {
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{seed, {input.origin, input.size()}, {}, none, progress};
  return work(input, parameters, context);
}

inline float largest_difference(const Grid<float>& a, const Grid<float>& b) {
  EXPECT_TRUE(a.same_shape(b));
  float largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(a.values()[k] - b.values()[k]));
  return largest;
}

/// What the function complains of.
template <class Function>
std::string error_text(const Function& function, ErrorKind kind = ErrorKind::input) {
  return testing_base::error_of(function, kind);
}

using testing_base::TemporaryFolder;

/// A list of steps being written.
class Steps {
 public:
  Steps& add(const std::string& op,
             std::initializer_list<std::pair<const char*, Value>> values = {}) {
    list_.push_back(make_step(operators_, op, {"scene.toml", static_cast<int>(list_.size()) + 1}));
    for (const auto& [name, value] : values) assign(list_.back(), name, value);
    return *this;
  }

  TerrainResult evaluate(const TerrainSettings& settings, std::uint64_t seed = 42,
                         const std::filesystem::path& folder = {}) const {
    Progress progress;
    return wold::evaluate(settings, list_, operators_, seed, folder, progress);
  }
  TerrainResult evaluate(const TerrainSettings& settings, const TerrainWindow& window,
                         std::uint64_t seed = 42) const {
    Progress progress;
    return wold::evaluate(settings, window, list_, operators_, seed, {}, progress);
  }

  const std::vector<TerrainStep>& list() const { return list_; }
  const OperatorList& operators() const { return operators_; }

 private:
  OperatorList operators_ = terrain_operators();
  std::vector<TerrainStep> list_;
};

}  // namespace wold::testing_terrain
