#include "raster/plant_cards.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "gpu/context.hpp"
#include "raster/plant_drawing.hpp"

namespace wold {

namespace {

constexpr int azimuths = 8;
constexpr std::array<float, 2> elevations{0.08F, 0.75F};  // radians
constexpr int tiles = 4;                                  // across a layer: 16 pictures
constexpr int tile_size = 128;                            // texels
constexpr int drawn_size = 256;                           // pixels
constexpr int mip_levels = 6;
constexpr int first_unit = 1;

GpuProgram program_of(const char* vertex, const char* fragment, bool depth_only = false) {
  const ShaderDialect dialect = gpu_info().dialect;
  std::vector<ShaderDefine> defines;
  if (depth_only) defines.push_back({"DEPTH_ONLY"});
  return {assemble_shader(vertex, dialect, defines), assemble_shader(fragment, dialect, defines)};
}

float half_height(const CardShape& s, float elevation) {
  return 0.5F * (s.high - s.low) * std::cos(elevation) + s.radius * std::sin(elevation);
}

/// The view of one picture: a box about the model.
DrawView picture_view(const CardShape& s, int k) {
  const float azimuth = 2 * pi * static_cast<float>(k % azimuths) / azimuths;
  const float elevation = elevations[static_cast<std::size_t>(k / azimuths)];
  const Vec3 towards(std::cos(elevation) * std::cos(azimuth),
                     std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Vec3 right(-std::sin(azimuth), std::cos(azimuth), 0);
  const Vec3 up = glm::cross(towards, right);
  const Vec3 middle(0, 0, 0.5F * (s.low + s.high));
  const float depth = s.radius + s.high - s.low;
  DrawView view;
  const auto row = [&](int r, Vec3 axis, float scale, float shift) {
    for (int c = 0; c < 3; ++c) view.view_projection[c][r] = axis[c] * scale;
    view.view_projection[3][r] = shift - glm::dot(axis, middle) * scale;
  };
  row(0, right, 1 / s.radius, 0);
  row(1, up, 1 / half_height(s, elevation), 0);
  row(2, towards, 0.5F / depth, 0.5F);
  view.eye = middle + 100 * depth * towards;
  view.pixel_angle = 2 * s.radius / drawn_size / (100 * depth);
  return view;
}

/// A square of texels, each of three times four values that are multiplied by coverage, which is
/// value 3.
struct Tile {
  int size = 0;
  std::vector<std::array<float, 12>> texels;

  std::array<float, 12>& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                  static_cast<std::size_t>(x)];
  }
};

Tile halved(Tile& fine) {
  Tile t{fine.size / 2, {}};
  t.texels.resize(static_cast<std::size_t>(t.size) * static_cast<std::size_t>(t.size));
  for (int y = 0; y < t.size; ++y)
    for (int x = 0; x < t.size; ++x)
      for (std::size_t c = 0; c < 12; ++c)
        t.at(x, y)[c] = 0.25F * (fine.at(2 * x, 2 * y)[c] + fine.at(2 * x + 1, 2 * y)[c] +
                                 fine.at(2 * x, 2 * y + 1)[c] + fine.at(2 * x + 1, 2 * y + 1)[c]);
  return t;
}

/// The texels of a level of all tiles, as bytes of the three textures.
struct Sheet {
  int size = 0;
  std::array<std::vector<std::uint8_t>, 3> bytes;
};

void put_tile(Sheet& sheet, int k, const Tile& tile) {
  const int x0 = (k % tiles) * tile.size;
  const int y0 = (k / tiles) * tile.size;
  for (int y = 0; y < tile.size; ++y)
    for (int x = 0; x < tile.size; ++x) {
      const std::array<float, 12>& v =
          tile.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.size) +
                      static_cast<std::size_t>(x)];
      const float weight = std::max(v[3], 1e-6F);
      const auto at = 4 * (static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(sheet.size) +
                           static_cast<std::size_t>(x0 + x));
      for (std::size_t c = 0; c < 12; ++c) {
        float value = c == 3 ? v[3] : v[c] / weight;
        if (c < 3) value = std::sqrt(std::max(value, 0.0F));
        sheet.bytes[c / 4][at + c % 4] =
            static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
      }
    }
}

/// What is bare has the colours of what is around, for filtering: coarse levels first, so that
/// finer ones can take theirs from them.
void fill_bare(std::vector<Tile>& chain) {
  for (std::size_t l = chain.size() - 1; l-- > 0;) {
    Tile& fine = chain[l];
    Tile& coarse = chain[l + 1];
    for (int y = 0; y < fine.size; ++y)
      for (int x = 0; x < fine.size; ++x) {
        std::array<float, 12>& v = fine.at(x, y);
        const std::array<float, 12>& c = coarse.at(x / 2, y / 2);
        if (v[3] > 0) continue;
        const float weight = std::max(c[3], 1e-6F);
        for (std::size_t i = 0; i < 12; ++i) v[i] = c[i] / weight * 1e-6F;
      }
  }
}

}  // namespace

CardShape card_shape(const PlantLevels& levels, const std::vector<SurfaceMaterial>& materials) {
  CardShape s;
  const Vec3 far = glm::max(glm::abs(levels.low), glm::abs(levels.high));
  s.radius = 1.02F * std::max({far.x, far.y, 1e-3F});
  const float margin = 0.02F * (levels.high.z - levels.low.z);
  s.low = levels.low.z - margin;
  s.high = levels.high.z + margin;
  for (const std::uint32_t index : levels.materials) {
    const Material& m = materials[index].settings();
    s.tint = std::max(s.tint, materials[index].tint_amount());
    if (m.transmission == Vec3(0) || s.transmission != Vec3(0)) continue;
    s.roughness = m.roughness;
    s.transmission = m.transmission / glm::max(0.5F * (m.color1 + m.color2), Vec3(1e-3F));
  }
  return s;
}

PlantCards::PlantCards(int models)
    : picture_program_(program_of("raster/plant.vert.glsl", "raster/plant_picture.frag.glsl")),
      color_program_(program_of("raster/plant_card.vert.glsl", "raster/plant_card.frag.glsl")),
      depth_program_(
          program_of("raster/plant_card.vert.glsl", "raster/plant_card.frag.glsl", true)),
      shapes_(static_cast<std::size_t>(models)) {
  const std::array formats{PixelFormat::rgba16f, PixelFormat::rgba8, PixelFormat::rgba8};
  target_ = GpuTarget(tiles * drawn_size, tiles * drawn_size, formats, true);
  const TextureSettings settings{.format = PixelFormat::rgba8,
                                 .filter = TextureFilter::mipmap,
                                 .layers = models,
                                 .levels = mip_levels};
  for (GpuTexture* texture : {&albedo_, &normal_, &light_})
    *texture = GpuTexture(tiles * tile_size, tiles * tile_size, settings);
  const std::array<Vec2, 4> square{Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1), Vec2(1, 1)};
  corners_ = GpuBuffer::of(std::span<const Vec2>(square));
  vertices_.attribute(corners_, {.location = 0, .components = 2, .stride = sizeof(Vec2)});
}

void PlantCards::picture(int model, const CardShape& shape,
                         const std::function<void(const GpuProgram&)>& draw) {
  shapes_[static_cast<std::size_t>(model)] = shape;
  target_.bind();
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  use_reversed_depth();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (int k = 0; k < tiles * tiles; ++k) {
    const DrawView view = picture_view(shape, k);
    glViewport((k % tiles) * drawn_size, (k / tiles) * drawn_size, drawn_size, drawn_size);
    view.apply(picture_program_);
    picture_program_.set("from_eye", from_eye(view));
    draw(picture_program_);
  }
  std::array<std::vector<float>, 3> drawn;
  for (int c = 0; c < 3; ++c) drawn[static_cast<std::size_t>(c)] = target_.read(c);
  std::array<Sheet, mip_levels> sheets;
  for (int l = 0; l < mip_levels; ++l) {
    Sheet& s = sheets[static_cast<std::size_t>(l)];
    s.size = (tiles * tile_size) >> l;
    for (auto& bytes : s.bytes) bytes.resize(4 * static_cast<std::size_t>(s.size) * s.size);
  }
  parallel_for(0, tiles * tiles, [&](int k) {
    Tile full{drawn_size, {}};
    full.texels.resize(static_cast<std::size_t>(drawn_size) * drawn_size);
    for (int y = 0; y < drawn_size; ++y)
      for (int x = 0; x < drawn_size; ++x) {
        const auto at = 4 * (static_cast<std::size_t>((k / tiles) * drawn_size + y) *
                                 static_cast<std::size_t>(tiles * drawn_size) +
                             static_cast<std::size_t>((k % tiles) * drawn_size + x));
        const float covered = drawn[0][at + 3];
        for (std::size_t c = 0; c < 12; ++c)
          full.at(x, y)[c] = c == 3 ? covered : covered * drawn[c / 4][at + c % 4];
      }
    std::vector<Tile> chain{halved(full)};
    while (chain.back().size > 1) chain.push_back(halved(chain.back()));
    fill_bare(chain);
    for (std::size_t l = 0; l < mip_levels; ++l) put_tile(sheets[l], k, chain[l]);
  });
  for (int l = 0; l < mip_levels; ++l) {
    const Sheet& s = sheets[static_cast<std::size_t>(l)];
    albedo_.upload(std::span<const std::uint8_t>(s.bytes[0]), model, l);
    normal_.upload(std::span<const std::uint8_t>(s.bytes[1]), model, l);
    light_.upload(std::span<const std::uint8_t>(s.bytes[2]), model, l);
  }
}

void PlantCards::draw(int model, const DrawView& view, const SceneLight* light,
                      const GpuBuffer& plants, const PlantBatch& batch) const {
  const CardShape& shape = shapes_[static_cast<std::size_t>(model)];
  const bool depth_only = view.depth_only || light == nullptr;
  const GpuProgram& program = depth_only ? depth_program_ : color_program_;
  view.apply(program);
  if (!depth_only) light->apply(program);
  program.set("from_eye", from_eye(view));
  // Where all rays are parallel, the row of depth tells their direction.
  const Mat4& m = view.view_projection;
  const bool parallel = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0;
  program.set("towards_viewer",
              parallel ? Vec4(glm::normalize(Vec3(m[0][2], m[1][2], m[2][2])), 1) : Vec4(0));
  program.set("card_shape", Vec4(shape.radius, shape.low, shape.high, shape.tint));
  program.set("card_transmission", shape.transmission);
  program.set("card_roughness", shape.roughness);
  program.set("card_layer", model);
  program.set("card_frame", light != nullptr ? static_cast<float>(light->frame() % 1024) : 0.0F);
  program.set("crown_reach", shape.radius);
  const std::array<std::pair<const char*, const GpuTexture*>, 3> textures{
      {{"card_albedo", &albedo_}, {"card_normal", &normal_}, {"card_light", &light_}}};
  for (std::size_t k = 0; k < textures.size(); ++k) {
    program.set(textures[k].first, first_unit + static_cast<int>(k));
    textures[k].second->bind(first_unit + static_cast<int>(k));
  }
  plant_attributes(vertices_, plants, batch.first);
  vertices_.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<int>(batch.count));
}

}  // namespace wold
