#include "scene/same_scene.hpp"

#include <algorithm>

namespace wold {

namespace {

bool same_values(const ParameterSet& set, const void* a, const void* b) {
  return std::all_of(set.parameters.begin(), set.parameters.end(),
                     [&](const Parameter& p) { return p.get(a) == p.get(b); });
}

template <class T>
bool same(const T& a, const T& b) {
  return same_values(describe(a), &a, &b);
}

template <class T>
bool same_lists(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return same(x, y); });
}

bool reads_file(const TerrainStep& step) {
  const ParameterSet& set = step.parameters.parameters();
  return std::any_of(set.parameters.begin(), set.parameters.end(), [&](const Parameter& p) {
    return p.kind == ParameterKind::file &&
           !std::get<std::string>(p.get(step.parameters.data())).empty();
  });
}

bool same_step(const TerrainStep& a, const TerrainStep& b) {
  return a.op == b.op && same(a.settings, b.settings) &&
         same_values(a.parameters.parameters(), a.parameters.data(), b.parameters.data());
}

}  // namespace

bool same_land(const Scene& a, const Scene& b) {
  return a.folder == b.folder && a.header.seed == b.header.seed && same(a.terrain, b.terrain) &&
         same(a.surroundings, b.surroundings) &&
         std::none_of(a.steps.begin(), a.steps.end(), reads_file) &&
         std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(), same_step);
}

bool same_models(const Scene& a, const Scene& b) {
  return a.folder == b.folder && a.header.seed == b.header.seed &&
         same_lists(a.species, b.species) && same_lists(a.materials, b.materials);
}

bool same_sky(const Scene& a, const Scene& b) {
  return same(a.sky, b.sky);
}

bool same_but_sun(const SkySettings& a, SkySettings b) {
  b.place = a.place;
  b.time = a.time;
  b.sun = a.sun;
  return same(a, b);
}

}  // namespace wold
