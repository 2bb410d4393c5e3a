#pragma once
// The sky as a light: sun, sky and haze of one moment at one place.
//
// All light is photometric: linear Rec. 709 whose 0.2126 R + 0.7152 G + 0.0722 B is luminance in
// cd/m² (radiance) or illuminance in lx (irradiance). A clear noon: sky about 3000 to 10 000 cd/m²,
// sun about 1.6e9 cd/m², 100 klx at right angles.
//
// The sky is held as a table over azimuth and elevation (finest at the horizon) and looked up
// bilinearly; the same table gives the density for sampling. Directions below the horizon show an
// endless hazy plain: the horizon's colour, giving way to sunlit ground further down.
//
// Preetham's sky (preetham.hpp) keeps its colours and distribution but is 0.55 times as bright, as
// measured clear skies are (IES), and dims further as the sun sinks below 10°, through twilight as
// measured down to a dark blue night; `sky_intensity` changes it.
//
// The model "atmosphere" marches through the air of a round planet (atmosphere.hpp) from
// `eye_height`, with all orders of scattering; its aerosol is that of `visibility` and
// `haze_height`, and the same air lies between surfaces. It has no fitted brightness.
//
// Clouds, of either model, are in the table with the sky; for the camera they are marched ray by
// ray. They cast no shadows on the land, but a sun behind a cloud (from the middle of the world)
// shines on nothing.

#include <cstdint>
#include <memory>
#include <vector>

#include "base/grid.hpp"
#include "base/parameters.hpp"
#include "base/value.hpp"
#include "base/vec.hpp"
#include "sky/atmosphere.hpp"
#include "sky/clouds.hpp"
#include "sky/haze.hpp"
#include "sky/sun_position.hpp"

namespace wold {

enum class SkyModel { preetham, atmosphere };

struct SkySettings {
  SkyModel model = SkyModel::preetham;
  DVec2 place{49.2, 16.6};  ///< degrees, latitude and longitude
  DateTime time{2026, 6, 21, 16, 30, 0, 120};
  std::vector<double> sun;  ///< [elevation, azimuth], degrees; empty: by time
  float turbidity = 2.5F;
  float ground_albedo = 0.2F;
  float sun_size = 0.53F;  ///< degrees across
  float sky_intensity = 1;
  float sun_intensity = 1;
  bool haze = true;
  float visibility = 40000;  ///< m
  float haze_height = 1200;  ///< m, over which haze thins to 1/e
  float eye_height = 300;    ///< m
  Atmosphere atmosphere;     ///< without aerosol and ground, which follow from the above
  Clouds clouds{.coverage = 0};
};

Description<SkySettings> describe(const SkySettings&);

/// Throws as the constructor of Sky does, without its work.
void check_sky(const SkySettings& settings);

class AirView;

/// What a shader needs to see the sky as class Sky does; points into the Sky it came from. Tables
/// have the coordinates of sky_table.hpp.
struct SkyParts {
  const Grid<Vec3>* radiance = nullptr;       ///< cd/m², clouds among it
  const Grid<Vec3>* behind_clouds = nullptr;  ///< the same without clouds
  const Grid<Vec3>* air = nullptr;            ///< J of haze.hpp; nullptr without haze or preetham
  const Haze* haze = nullptr;
  const AirView* air_view = nullptr;   ///< of model "atmosphere"
  const CloudLayer* clouds = nullptr;  ///< nullptr where there are none
  Atmosphere planet;                   ///< the clouds' and the air's
  Vec3 sun_on_clouds{0};               ///< lx
  Vec3 sky_on_clouds{0};               ///< cd/m²
  Vec3 sun_centre{0};                  ///< cd/m², outside clouds
  Vec3 limb_exponent{0};
  float sun_chord = 0;  ///< between unit vectors to the centre and the limb
};

/// A direction to light, what comes from there, and the density per steradian with which it was
/// chosen; 0 when there is no light to choose.
struct SkySample {
  Vec3 direction{0, 0, 1};
  Vec3 radiance{0};
  float pdf = 0;
};

class Sky {
 public:
  /// Throws Error(input) when `sun` has neither 0 nor 2 numbers or an elevation beyond ±90°.
  explicit Sky(const SkySettings& settings = {});

  /// The sky without the sun's disc, cd/m². Any unit vector.
  Vec3 radiance(Vec3 direction) const;
  /// What the camera sees where no surface is: sky, sun and clouds, these with more detail than
  /// `radiance` has. `u` in [0, 1) is random.
  Vec3 seen(Vec3 origin, Vec3 direction, float u) const;
  /// Chosen by luminance; directions below the horizon are chosen more seldom than their
  /// luminance asks for.
  SkySample sample_sky(Vec2 u) const;
  float sky_pdf(Vec3 direction) const;
  /// Of a horizontal surface by the sky above it, without the sun, lx.
  Vec3 sky_irradiance() const { return sky_irradiance_; }

  /// Unit vector towards the centre of the sun; may point below the horizon.
  Vec3 sun_direction() const { return sun_direction_; }
  /// Whether the sun gives any light: some of its disc is above the horizon.
  bool sun_visible() const { return sun_visible_; }
  /// The disc with limb darkening, cd/m²; zero outside it.
  Vec3 sun_radiance(Vec3 direction) const;
  /// Uniform over the disc; pdf 0 when the sun is not visible.
  SkySample sample_sun(Vec2 u) const;
  float sun_pdf(Vec3 direction) const;
  /// Of a surface at right angles to the sun, lx.
  Vec3 sun_irradiance() const { return sun_irradiance_; }

  SkyParts parts() const;

  /// Whether there is air to see between surfaces.
  bool has_air() const { return haze_.enabled(); }
  /// What `distance` metres of air from `origin` along the unit vector `direction` take and give.
  AirLight air_light(Vec3 origin, Vec3 direction, float distance) const;
  /// What the eye at `origin` sees of a surface `distance` metres away along the unit vector
  /// `direction`, whose own radiance is `surface_radiance`.
  Vec3 through_haze(Vec3 surface_radiance, Vec3 origin, Vec3 direction, float distance) const;

 private:
  void set_sun(const SkySettings& settings);
  void set_sun_light(const SkySettings& settings);
  void fill_table(const SkySettings& settings);
  void fill_preetham(const SkySettings& settings);
  void fill_atmosphere(const SkySettings& settings);
  DVec3 irradiance_of_nodes() const;
  DVec3 node_direction(int i, int j) const;
  void fill_air();
  void add_clouds(const SkySettings& settings);
  Vec3 behind_clouds(Vec3 light, Vec3 origin, Vec3 direction, float u, CloudSteps steps) const;
  void build_distribution();
  DVec3 cell_mean(int i, int j) const;

  Vec3 sun_direction_{0, 0, 1};
  Vec3 sun_side_{1, 0, 0};  // with sun_up_, an orthonormal frame around the sun
  Vec3 sun_up_{0, 1, 0};
  double sun_elevation_ = 90;  // degrees
  Vec3 sun_centre_radiance_{0};
  Vec3 sun_irradiance_{0};
  Vec3 limb_exponent_{0};
  float sun_chord_ = 0;  // 2 sin(radius / 2): distance between unit vectors to centre and limb
  float sun_pdf_ = 0;    // 1/sr
  bool sun_visible_ = false;

  // Nodes in columns by azimuth and rows by elevation; a cell lies between four nodes.
  Grid<Vec3> nodes_;                      // cd/m²
  std::vector<float> column_azimuth_;     // radians from east to north
  std::vector<float> row_sine_;           // of the elevation of each row of nodes
  std::vector<float> rows_cumulative_;    // probability of the rows of cells up to and with this
  Grid<float> cells_cumulative_;          // the same of the cells of one row
  Grid<float> cell_pdf_;                  // 1/sr
  std::vector<std::uint16_t> row_guide_;  // where to begin to search in rows_cumulative_
  Grid<std::uint16_t> cell_guide_;        // and in each row of cells_cumulative_
  Grid<Vec3> air_;                        // J of haze.hpp at the nodes, cd/m²
  Vec3 sky_irradiance_{0};
  Haze haze_;
  std::shared_ptr<const AirView> view_;  // of the model "atmosphere"
  Grid<Vec3> clear_;                     // the nodes without clouds, when there are any
  std::shared_ptr<const CloudLayer> clouds_;
  Atmosphere planet_;
  Vec3 sun_on_clouds_{0};  // lx
  Vec3 sky_on_clouds_{0};  // mean radiance around them, cd/m²
  float sunlit_ = 1;       // part of the sun's light that clouds let through to the land
};

}  // namespace wold
