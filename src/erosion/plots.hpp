#pragma once
// Pictures of an analysis, 800 high and up to 1200 wide, as a paper would show them:
//
//   hillshade.png    shaded ground in the colours of its heights, with rivers and lakes
//   drainage.png     basins by colour, rivers as wide as their order
//   slope_area.png   slope against upstream area along channels, with the fit of the concavity
//   spectrum.png     power against wave number, with the fit
//   hypsometry.png   share of the area above each height

#include <string>
#include <vector>

#include "erosion/plot_canvas.hpp"
#include "erosion/realism.hpp"

namespace wold {

struct Plot {
  std::string name;  ///< "hillshade"
  Image image;       ///< R, G, B as displayed
};

std::vector<Plot> plots(const Analysis& analysis);

Image hillshade_plot(const Analysis& analysis);
Image drainage_plot(const Analysis& analysis);
Image slope_area_plot(const Analysis& analysis);
Image spectrum_plot(const Analysis& analysis);
Image hypsometry_plot(const Analysis& analysis);

/// Writes them as PNG into a folder, which is made if need be; returns their paths. Where no font
/// was found they have no text: plots_have_text(). Throws Error(io).
std::vector<std::string> write_plots(const Analysis& analysis, const std::string& folder);

}  // namespace wold
