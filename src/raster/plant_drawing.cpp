#include "raster/plant_drawing.hpp"

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double4.hpp>

#include "base/hash.hpp"
#include "gpu/context.hpp"

namespace wold {

namespace {

constexpr int material_unit = 0;
constexpr std::size_t texels_per_material = 5;
// Shadow maps are fine enough for leaves up to here.
constexpr Vec2 crown_light_range{35, 55};  // m

GpuProgram plant_program(bool depth_only) {
  const ShaderDialect dialect = gpu_info().dialect;
  std::vector<ShaderDefine> defines;
  if (depth_only) defines.push_back({"DEPTH_ONLY"});
  return {assemble_shader("raster/plant.vert.glsl", dialect, defines),
          assemble_shader(depth_only ? "raster/plant_depth.frag.glsl" : "raster/plant.frag.glsl",
                          dialect, defines)};
}

/// The rows that "raster/plant_material.glsl" reads.
std::vector<float> material_texels(const std::vector<const SurfaceMaterial*>& materials) {
  std::vector<float> texels;
  const auto put = [&](Vec3 v, float w) {
    for (const float x : {v.x, v.y, v.z, w}) texels.push_back(x);
  };
  for (const SurfaceMaterial* material : materials) {
    const Material& m = material->settings();
    const auto seed = static_cast<std::uint32_t>(hash_text(m.name));
    put(m.color1, m.feature_size);
    put(m.color2, m.contrast);
    put(m.transmission, m.stretch);
    put({m.variation, material->tint_amount(), static_cast<float>(seed >> 16U)},
        static_cast<float>(seed & 0xffffU));
    put(Vec3(m.roughness, 0, 0), 0);
  }
  return texels;
}

void vertex_attributes(const GpuVertices& vertices, const GpuBuffer& corners) {
  const auto add = [&](int location, int components, unsigned type, bool normalized, bool integer,
                       std::size_t offset) {
    vertices.attribute(corners, {.location = location,
                                 .components = components,
                                 .type = type,
                                 .normalized = normalized,
                                 .integer = integer,
                                 .offset = offset,
                                 .stride = sizeof(PlantVertex)});
  };
  add(0, 3, GL_FLOAT, false, false, offsetof(PlantVertex, position));
  add(1, 1, GL_UNSIGNED_INT, false, true, offsetof(PlantVertex, identity));
  add(2, 4, GL_HALF_FLOAT, false, false, offsetof(PlantVertex, across));
  add(3, 4, GL_HALF_FLOAT, false, false, offsetof(PlantVertex, along));
  add(4, 4, GL_BYTE, true, false, offsetof(PlantVertex, normal));
  add(5, 4, GL_BYTE, true, false, offsetof(PlantVertex, light));
}

}  // namespace

void plant_attributes(const GpuVertices& vertices, const GpuBuffer& plants, std::size_t first) {
  const auto add = [&](int location, int components, bool integer, std::size_t offset) {
    vertices.attribute(plants, {.location = location,
                                .components = components,
                                .type = static_cast<unsigned>(integer ? GL_UNSIGNED_INT : GL_FLOAT),
                                .integer = integer,
                                .offset = first * sizeof(DrawnPlant) + offset,
                                .stride = sizeof(DrawnPlant),
                                .per_instance = true});
  };
  add(6, 4, false, offsetof(DrawnPlant, position));
  add(7, 4, false, offsetof(DrawnPlant, turn));
  add(8, 4, false, offsetof(DrawnPlant, share));
  add(9, 2, true, offsetof(DrawnPlant, bits));
  add(10, 3, false, offsetof(DrawnPlant, growth));
}

Mat4 from_eye(const DrawView& view) {
  // In double: far from the world's origin little is left of the difference in float.
  const glm::dmat4 m(view.view_projection);
  Mat4 out = view.view_projection;
  out[3] = Vec4(m * glm::dvec4(DVec3(view.eye), 1));
  return out;
}

PlantDrawing::PlantDrawing(const World& world, Progress& progress, const PlantDetail& detail)
    : detail_(detail),
      levels_(plant_levels(world, progress)),
      color_program_(plant_program(false)),
      depth_program_(plant_program(true)),
      drawn_(std::span<const std::byte>{}, true) {
  for (const PlantLevels& l : levels_) sizes_.push_back(plant_sizes(l));
  upload(world);
  make_cards(world, progress);
  set_plants(world.instances);
}

void PlantDrawing::upload(const World& world) {
  std::vector<const SurfaceMaterial*> materials;
  models_.resize(levels_.size());
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    ModelBuffers& m = models_[k];
    m.first_material = static_cast<int>(materials.size());
    for (const std::uint32_t index : levels_[k].materials)
      materials.push_back(&world.materials[index]);
    m.corners = GpuBuffer::of(std::span<const PlantVertex>(levels_[k].vertices));
    m.indices = GpuBuffer::of(std::span<const std::uint32_t>(levels_[k].indices));
    vertex_attributes(m.vertices, m.corners);
    m.vertices.indices(m.indices);
    // On the device now; the levels' numbers are what is needed of them here.
    levels_[k].vertices = {};
    levels_[k].indices = {};
  }
  if (materials.empty()) return;
  const std::vector<float> texels = material_texels(materials);
  materials_ = GpuTexture(static_cast<int>(texels_per_material), static_cast<int>(materials.size()),
                          {.format = PixelFormat::rgba32f, .filter = TextureFilter::nearest});
  materials_.upload(std::span<const float>(texels));
}

void PlantDrawing::set_plants(std::span<const ModelInstance> plants) {
  field_ = PlantField(plants, sizes_);
}

void PlantDrawing::set_near_plants(std::span<const ModelInstance> plants) {
  near_field_ = PlantField(plants, sizes_);
}

void PlantDrawing::draw_batch(const GpuProgram& program, const PlantBatch& batch) const {
  const ModelBuffers& model = models_[batch.model];
  const PlantLevels& levels = levels_[batch.model];
  const auto& list = batch.kind == PlantBatch::Kind::fine ? levels.fine : levels.coarse;
  const PlantLevel& level = list[batch.level];
  if (level.index_count == 0) return;
  program.set("first_material", model.first_material);
  program.set("crown_reach", sizes_[batch.model].radius);
  program.set("crown_extinction", levels.extinction);
  plant_attributes(model.vertices, drawn_, batch.first);
  model.vertices.bind();
  const std::size_t offset = level.first_index * sizeof(std::uint32_t);
  glDrawElementsInstanced(
      GL_TRIANGLES, static_cast<int>(level.index_count), GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(offset),  // NOLINT(performance-no-int-to-ptr)
      static_cast<int>(batch.count));
}

void PlantDrawing::draw(const DrawView& view, const SceneLight* light) {
  const std::array<const PlantField*, 2> fields{&field_, &near_field_};
  choice_ = choose_plants(fields, levels_, sizes_, view, detail_);
  if (choice_.plants.empty()) return;
  drawn_.assign(std::as_bytes(std::span(choice_.plants)));
  const bool depth_only = view.depth_only || light == nullptr;
  const GpuProgram& program = depth_only ? depth_program_ : color_program_;
  view.apply(program);
  if (!depth_only) light->apply(program);
  program.set("from_eye", from_eye(view));
  program.set("crown_light_range", crown_light_range);
  program.set("plant_materials", material_unit);
  materials_.bind(material_unit);
  for (const PlantBatch& batch : choice_.batches)
    if (batch.kind != PlantBatch::Kind::card) draw_batch(program, batch);
  draw_cards(view, light);
  gl::check("drawing plants");
}

void PlantDrawing::make_cards(const World& world, Progress& progress) {
  int trees = 0;
  for (PlantSizes& size : sizes_) {
    size.card = size.height >= detail_.small_height;
    trees += size.card ? 1 : 0;
  }
  if (trees == 0) return;
  const ProgressStage stage(progress, "picturing plants", trees, "models");
  cards_ = std::make_unique<PlantCards>(static_cast<int>(sizes_.size()));
  for (std::size_t k = 0; k < sizes_.size(); ++k) {
    if (!sizes_[k].card) continue;
    // As many leaves as show.
    const float share =
        std::min(1.0F, 40000.0F / static_cast<float>(levels_[k].coarse.front().index_count));
    DrawnPlant plant;
    plant.share = share;
    plant.texture = Vec2(0.5F);  // without a tint
    const std::array<DrawnPlant, 1> plants{plant};
    drawn_.assign(std::as_bytes(std::span(plants)));
    const PlantLevel& level = levels_[k].level(false, share);
    PlantBatch batch{PlantBatch::Kind::coarse, static_cast<std::uint32_t>(k)};
    batch.level = static_cast<std::uint32_t>(&level - levels_[k].coarse.data());
    batch.count = 1;
    cards_->picture(static_cast<int>(k), card_shape(levels_[k], world.materials),
                    [&](const GpuProgram& program) {
                      program.set("plant_materials", material_unit);
                      materials_.bind(material_unit);
                      draw_batch(program, batch);
                    });
    progress.advance();
  }
}

void PlantDrawing::draw_cards(const DrawView& view, const SceneLight* light) const {
  if (!cards_) return;
  for (const PlantBatch& batch : choice_.batches)
    if (batch.kind == PlantBatch::Kind::card)
      cards_->draw(static_cast<int>(batch.model), view, light, drawn_, batch);
}

}  // namespace wold
