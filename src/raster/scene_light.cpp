#include "raster/scene_light.hpp"

namespace wold {

SceneLight::SceneLight(const Sky& sky) : sky_(&sky) {}

void SceneLight::apply(const GpuProgram& program) const {
  program.set("sun_direction", sky_->sun_direction());
  program.set("sun_irradiance", sky_->sun_irradiance());
  program.set("sky_irradiance", sky_->sky_irradiance());
}

}  // namespace wold
