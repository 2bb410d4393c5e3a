#pragma once
// The landscape of a scene as a file that others run.

#include <string>

#include "realtime/landscape.hpp"

namespace wold {

enum class ShaderTarget {
  shadertoy,  ///< one tab: mainImage, with iResolution, iTime and iMouse
  glsl,       ///< a fragment shader of OpenGL 3.3 with the same uniforms
  html        ///< a page by itself
};

/// Throws Error(usage) for a height map to a target other than html, which alone can carry one.
std::string export_shader(const Landscape& landscape, ShaderTarget target);

/// What shadertoy would get, also of a landscape with maps, which it expects in the samplers of
/// LandTextures.
std::string landscape_tab(const Landscape& landscape);

/// The page around a landscape (export_page.cpp).
std::string landscape_page(const Landscape& landscape);

}  // namespace wold
