#include "view/traced_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "image/io.hpp"
#include "view/interface.hpp"

namespace wold {

namespace {

ImTextureID id_of(const GpuTexture& texture) {
  // Dear ImGui's renderer for OpenGL takes the texture's name for a pointer.
  return reinterpret_cast<ImTextureID>(  // NOLINT(performance-no-int-to-ptr)
      static_cast<std::uintptr_t>(texture.id()));
}

}  // namespace

void TracedPanel::set(const Image& image, const ToneMapping& mapping, float stops) {
  const Image display = display_image(image, at_exposure(mapping, stops));
  std::vector<std::uint8_t> texels;
  texels.reserve(4 * static_cast<std::size_t>(display.width) *
                 static_cast<std::size_t>(display.height));
  for (int y = 0; y < display.height; ++y)
    for (int x = 0; x < display.width; ++x) {
      for (int c = 0; c < 3; ++c)
        texels.push_back(static_cast<std::uint8_t>(quantised(display.at(x, y, c), 255)));
      texels.push_back(255);
    }
  if (!texture_ || texture_.width() != display.width || texture_.height() != display.height)
    texture_ = GpuTexture(display.width, display.height, {.format = PixelFormat::rgba8});
  texture_.upload(texels);
}

bool TracedPanel::draw(const std::string& status, double done) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float wide = std::max(160.0F, 0.42F * window.x);
  ImGui::SetNextWindowPos({window.x - 12, 12}, ImGuiCond_Appearing, {1, 0});
  ImGui::SetNextWindowSize({wide, 0}, ImGuiCond_Appearing);
  bool open = true;
  if (ImGui::Begin("Path traced", &open, ImGuiWindowFlags_NoSavedSettings)) {
    if (texture_) {
      const float width = ImGui::GetContentRegionAvail().x;
      const float height =
          width * static_cast<float>(texture_.height()) / static_cast<float>(texture_.width());
      ImGui::Image(id_of(texture_), {width, height});
    }
    if (done < 1) ImGui::ProgressBar(static_cast<float>(done), {-1, 4}, "");
    ImGui::TextUnformatted(status.c_str());
  }
  ImGui::End();
  return open;
}

}  // namespace wold
