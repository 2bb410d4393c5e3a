#include "sky/sky.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/smoothstep.hpp"
#include "sky/air_view.hpp"
#include "sky/preetham.hpp"
#include "sky/sky_table.hpp"
#include "sky/spectrum.hpp"
#include "sky/sunlight.hpp"

namespace wold {

using namespace sky_table;

namespace {

constexpr double sun_diameter = 0.53;  // degrees, for which sunlight is computed
// The paper's dome is nearly twice as bright as clear skies measure: with this factor it gives the
// 0.8 + 15.5 √sin(elevation) klx of the IES Lighting Handbook within 20 % at turbidity 2.5.
constexpr double measured_share = 0.55;
constexpr double haze_over_plain = 0.03;  // optical depth straight down: eye 300 m up, 10 km of air
constexpr float farthest_cloud = 1.2e5F;  // m
constexpr double night_luminance = 1e-3;  // cd/m², stars and airglow, rather bright
constexpr DVec3 night_colour{0.55, 0.85, 3.8};  // luminance 1

/// The part of a disc above the horizon; `x` its centre's elevation in radii.
double disc_above(double x) {
  if (x >= 1) return 1;
  if (x <= -1) return 0;
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi_d;
}

double solid_angle(double radius) {
  return 4 * pi_d * std::pow(std::sin(radius / 2), 2);
}

/// On a surface at right angles to the sun, lx.
DVec3 sun_by_turbidity(const SkySettings& settings, double elevation) {
  const double above = disc_above(radians(elevation) / (0.5 * radians(double{settings.sun_size})));
  return sun_disc_radiance(90 - elevation, settings.turbidity) *
         (solid_angle(0.5 * radians(sun_diameter)) * above);
}

DVec3 sun_in_space() {
  return sun_disc_radiance(0, 0) * solid_angle(0.5 * radians(sun_diameter));
}

struct SunPlace {
  double elevation = 0;  // degrees
  double azimuth = 0;
};

SunPlace sun_place(const SkySettings& settings) {
  if (settings.sun.empty()) {
    const SunPosition sun = sun_position(settings.time, {settings.place.x, settings.place.y});
    return {90 - sun.zenith, sun.azimuth};
  }
  if (settings.sun.size() != 2 || !(std::abs(settings.sun[0]) <= 90))
    throw Error(ErrorKind::input,
                "'sun' in 'sky' must be [elevation, azimuth] in degrees, with an elevation of "
                "-90 to 90, or an empty list");
  return {settings.sun[0], settings.sun[1]};
}

Atmosphere atmosphere_of(const SkySettings& settings) {
  Atmosphere a = settings.atmosphere;
  a.aerosol_scattering =
      aerosol_extinction(settings.visibility, wavelengths(a.air)) * a.aerosol_albedo;
  a.aerosol_height = settings.haze_height;
  a.ground_albedo = Vec3(settings.ground_albedo);
  return a;
}

DVec3 sun_through_atmosphere(const SkySettings& settings, float height, float sine) {
  constexpr int steps = 128;
  return sun_in_space() * DVec3(sun_transmittance(atmosphere_of(settings), height, sine, steps));
}

DVec3 night_sky(double sun_elevation) {
  return night_luminance * smoothstep(0, 18, -sun_elevation) * night_colour;
}

/// How much darker than the model the sky is, whose fit knows no sun below 10°: brings illuminance
/// to the 600 lx of sunset and the 3.4 lx of the end of civil twilight (sun at -6°).
double dusk_factor(double sun_elevation) {
  constexpr double at_sunset = 0.96;  // powers of ten
  constexpr double per_degree = 0.375;
  if (sun_elevation >= 10) return 1;
  const double low = 1 - sun_elevation / 10;
  const double powers =
      sun_elevation > 0 ? at_sunset * low * low : at_sunset - per_degree * sun_elevation;
  return std::pow(10.0, -powers);
}

/// A clear sky that darkens when the sun is below the horizon.
DVec3 sky_at(const PreethamSky& day, double sun_elevation, double sine, double sun_cosine) {
  const double gamma = std::acos(std::clamp(sun_cosine, -1.0, 1.0));
  const DVec3 by_day = day.radiance(std::max(sine, 0.0), gamma);
  const double blue = smoothstep(0, 9, -sun_elevation);
  const DVec3 dusk = by_day + blue * (luminance(by_day) * night_colour - by_day);
  return measured_share * dusk_factor(sun_elevation) * dusk + night_sky(sun_elevation);
}

}  // namespace

Description<SkySettings> describe(const SkySettings&) {
  return Description<SkySettings>("sky", "Sun, sky and haze of one moment at one place.")
      .choice("model", &SkySettings::model, {"preetham", "atmosphere"},
              "How the sky is computed: a fit to clear days, or light in the air of a planet.")
      .add("place", &SkySettings::place, {.unit = "degrees", .min = -180, .max = 180},
           "Latitude (north positive) and longitude (east positive).")
      .add("time", &SkySettings::time, "Date and time, which place the sun.")
      .add("sun", &SkySettings::sun, {.unit = "degrees", .min = -360, .max = 360},
           "Where the sun stands, [elevation, azimuth from north by east]; empty: by place and "
           "time.")
      .add("turbidity", &SkySettings::turbidity, {.min = 1.9, .max = 10},
           "Of model preetham, haziness of the whole air: 2 very clear, 3 clear, 6 hazy.")
      .add("ground_albedo", &SkySettings::ground_albedo, {.min = 0, .max = 1},
           "Brightness of the endless plain beyond the terrain.")
      .add("sun_size", &SkySettings::sun_size, {.unit = "degrees", .min = 0.05, .max = 20},
           "Diameter of the sun; a larger one gives softer shadows and the same light.")
      .add("sky_intensity", &SkySettings::sky_intensity, {.min = 0, .max = 1000},
           "Factor on the light of the sky.")
      .add("sun_intensity", &SkySettings::sun_intensity, {.min = 0, .max = 1000},
           "Factor on the light of the sun.")
      .add("haze", &SkySettings::haze, "Whether the distance fades into haze.")
      .add("visibility", &SkySettings::visibility, {.unit = "m", .min = 10, .max = 1e6},
           "Distance at which dark things vanish in the haze, at height 0.")
      .add("haze_height", &SkySettings::haze_height, {.unit = "m", .min = 1, .max = 1e5},
           "Height over which haze thins to 1/e.")
      .add("eye_height", &SkySettings::eye_height, {.unit = "m", .min = 0, .max = 1e8},
           "Of model atmosphere, the height from which the sky is seen; beyond 100 km from space.")
      .include(&SkySettings::atmosphere)
      .include(&SkySettings::clouds);
}

void check_sky(const SkySettings& settings) {
  sun_place(settings);
  if (settings.haze) Haze(settings.visibility, settings.haze_height);
}

Sky::Sky(const SkySettings& settings) {
  if (settings.haze) haze_ = Haze(settings.visibility, settings.haze_height);
  set_sun(settings);
  set_sun_light(settings);
  fill_table(settings);
  if (settings.clouds.coverage > 0) add_clouds(settings);
  build_distribution();
}

void Sky::set_sun(const SkySettings& settings) {
  const SunPlace sun = sun_place(settings);
  sun_elevation_ = sun.elevation;
  sun_direction_ = sky_direction(sun.elevation, sun.azimuth);
  sun_side_ = sky_direction(0, sun.azimuth + 90);
  sun_up_ = glm::cross(sun_direction_, sun_side_);
}

void Sky::set_sun_light(const SkySettings& settings) {
  const double radius = 0.5 * radians(static_cast<double>(settings.sun_size));
  const DVec3 irradiance =
      static_cast<double>(settings.sun_intensity) *
      (settings.model == SkyModel::atmosphere
           ? sun_through_atmosphere(settings, settings.eye_height, sun_direction_.z)
           : sun_by_turbidity(settings, sun_elevation_));
  const DVec3 exponent = limb_darkening_exponent();
  limb_exponent_ = exponent;
  sun_irradiance_ = irradiance;
  sun_centre_radiance_ = irradiance * (0.5 * exponent + DVec3(1)) / solid_angle(radius);
  sun_chord_ = static_cast<float>(2 * std::sin(radius / 2));
  sun_pdf_ = static_cast<float>(1 / solid_angle(radius));
  sun_visible_ = luminance(irradiance) > 0;
}

void Sky::fill_table(const SkySettings& settings) {
  planet_ = atmosphere_of(settings);
  nodes_ = Grid<Vec3>(columns, cell_rows + 1);
  row_sine_.resize(cell_rows + 1);
  column_azimuth_.resize(columns + 1);
  for (int i = 0; i <= columns; ++i)
    column_azimuth_[static_cast<std::size_t>(i)] = static_cast<float>(column_azimuth(i));
  for (int j = 0; j <= cell_rows; ++j)
    row_sine_[static_cast<std::size_t>(j)] = static_cast<float>(std::sin(row_elevation(j)));
  if (settings.model == SkyModel::atmosphere)
    fill_atmosphere(settings);
  else
    fill_preetham(settings);
}

DVec3 Sky::node_direction(int i, int j) const {
  const double elevation = row_elevation(j);
  const double azimuth = column_azimuth(i);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// ∫ L sin(e) dω; over a row of cells the integral of sin e · cos e de is that of sin² / 2.
DVec3 Sky::irradiance_of_nodes() const {
  DVec3 irradiance(0);
  for (int j = horizon; j < cell_rows; ++j) {
    const double low = row_sine_[static_cast<std::size_t>(j)];
    const double high = row_sine_[static_cast<std::size_t>(j) + 1];
    DVec3 sum(0);
    for (int i = 0; i < columns; ++i) sum += column_width(i) * cell_mean(i, j);
    irradiance += sum * (0.5 * (high * high - low * low));
  }
  return irradiance;
}

void Sky::fill_preetham(const SkySettings& settings) {
  const PreethamSky day(settings.turbidity, radians(90 - sun_elevation_));
  const double intensity = settings.sky_intensity;
  parallel_for(horizon, cell_rows + 1, [&](int j) {
    for (int i = 0; i < columns; ++i) {
      const DVec3 direction = node_direction(i, j);
      nodes_(i, j) = intensity * sky_at(day, sun_elevation_, direction.z,
                                        glm::dot(direction, DVec3(sun_direction_)));
    }
  });
  const DVec3 irradiance = irradiance_of_nodes();
  sky_irradiance_ = irradiance;

  const double sun_sine = std::max(0.0F, sun_direction_.z);
  const DVec3 plain = static_cast<double>(settings.ground_albedo) / pi_d *
                      (irradiance + sun_sine * DVec3(sun_irradiance_));
  parallel_for(0, horizon, [&](int j) {
    const double depth = haze_over_plain / -std::sin(row_elevation(j));
    for (int i = 0; i < columns; ++i)
      nodes_(i, j) = glm::mix(DVec3(nodes_(i, horizon)), plain, std::exp(-depth));
  });
  fill_air();
}

void Sky::fill_atmosphere(const SkySettings& settings) {
  const float intensity = settings.sky_intensity;
  view_ = std::make_shared<const AirView>(atmosphere_of(settings), sun_direction_,
                                          intensity * Vec3(sun_in_space()), settings.eye_height);
  const Vec3 night = intensity * Vec3(night_sky(sun_elevation_));
  parallel_for(0, cell_rows + 1, [&](int j) {
    const std::vector<AirView::Seen> around = view_->around(row_elevation(j));
    for (int i = 0; i < columns; ++i)
      nodes_(i, j) = view_->sky(around, Vec3(node_direction(i, j))) + night;
  });
  sky_irradiance_ = irradiance_of_nodes();
}

void Sky::fill_air() {
  if (!haze_.enabled()) return;
  air_ = nodes_;
  parallel_for(0, cell_rows + 1, [&](int j) {
    const float sine = row_sine_[static_cast<std::size_t>(j)];
    const Vec3 upwards{std::sqrt(std::max(0.0F, 1 - sine * sine)), 0, sine};
    const Vec3 whole = haze_.transmittance(Vec3(0), upwards, INFINITY);
    for (int i = 0; i < columns; ++i)
      air_(i, j) =
          j <= horizon ? nodes_(i, horizon) : nodes_(i, j) / glm::max(Vec3(1) - whole, Vec3(1e-4F));
  });
}

void Sky::add_clouds(const SkySettings& settings) {
  constexpr CloudSteps steps{32, 6};
  const Clouds& c = settings.clouds;
  clouds_ = std::make_shared<const CloudLayer>(c);
  // The sky from above, sunlit ground from below.
  const Vec3 on_ground = sky_irradiance_ + std::max(0.0F, sun_direction_.z) * sun_irradiance_;
  sky_on_clouds_ = (sky_irradiance_ + settings.ground_albedo * on_ground) / (2 * pi);
  sun_on_clouds_ = sun_irradiance_;
  if (view_)
    sun_on_clouds_ =
        static_cast<double>(settings.sun_intensity) *
        sun_through_atmosphere(settings, c.height + 0.5F * c.thickness, sun_direction_.z);

  const Vec3 eye{0, 0, settings.eye_height};
  clear_ = nodes_;
  parallel_for(horizon, cell_rows + 1, [&](int j) {
    for (int i = 0; i < columns; ++i)
      nodes_(i, j) = behind_clouds(clear_(i, j), eye, Vec3(node_direction(i, j)), 0.5F, steps);
  });
  sky_irradiance_ = irradiance_of_nodes();
  sunlit_ = clouds_->transmittance(planet_, DVec2(0),
                                   air_ray(planet_, eye, sun_direction_, sun_direction_),
                                   sun_direction_, INFINITY, 4 * steps.along);
  sun_irradiance_ *= sunlit_;
  sun_centre_radiance_ *= sunlit_;
  sun_visible_ = sun_visible_ && sunlit_ > 1e-4F;
}

Vec3 Sky::behind_clouds(Vec3 light, Vec3 origin, Vec3 direction, float u, CloudSteps steps) const {
  const AirRay ray = air_ray(planet_, origin, direction, sun_direction_);
  const Clouds& c = clouds_->clouds();
  const AirSpan span =
      span_in_layer(planet_, ray.height, ray.cosine, c.height, c.height + c.thickness);
  if (!(span.end > span.begin)) return light;
  const CloudLight clouds =
      clouds_->seen(planet_, DVec2(origin.x, origin.y), ray, direction, sun_direction_,
                    farthest_cloud, sun_on_clouds_, sky_on_clouds_, u, steps);
  const AirLight air = air_light(origin, direction, span.begin);
  return light * clouds.transmittance + clouds.light * air.transmittance +
         air.light * (1 - clouds.transmittance);
}

Vec3 Sky::seen(Vec3 origin, Vec3 direction, float u) const {
  if (!clouds_) return radiance(direction) + sun_radiance(direction);
  const Vec3 light = interpolated(clear_, direction) + sun_radiance(direction) / sunlit_;
  constexpr CloudSteps steps{24, 4};  // many rays share a pixel
  return behind_clouds(light, origin, direction, u, steps);
}

SkyParts Sky::parts() const {
  SkyParts parts;
  parts.radiance = &nodes_;
  parts.behind_clouds = clouds_ ? &clear_ : &nodes_;
  parts.air = air_.empty() ? nullptr : &air_;
  parts.haze = &haze_;
  parts.air_view = view_.get();
  parts.clouds = clouds_.get();
  parts.planet = planet_;
  parts.sun_on_clouds = sun_on_clouds_;
  parts.sky_on_clouds = sky_on_clouds_;
  parts.sun_centre = sun_centre_radiance_ / std::max(sunlit_, 1e-6F);
  parts.limb_exponent = limb_exponent_;
  parts.sun_chord = sun_chord_;
  return parts;
}

DVec3 Sky::cell_mean(int i, int j) const {
  const int next = (i + 1) % columns;
  return 0.25 * (DVec3(nodes_(i, j)) + DVec3(nodes_(next, j)) + DVec3(nodes_(i, j + 1)) +
                 DVec3(nodes_(next, j + 1)));
}

Vec3 Sky::radiance(Vec3 direction) const {
  return interpolated(nodes_, direction);
}

AirLight Sky::air_light(Vec3 origin, Vec3 direction, float distance) const {
  if (!haze_.enabled()) return {};
  if (view_) return view_->between(origin, direction, distance);
  const Vec3 passed = haze_.transmittance(origin, direction, distance);
  return {passed, interpolated(air_, direction) * (Vec3(1) - passed)};
}

Vec3 Sky::through_haze(Vec3 surface_radiance, Vec3 origin, Vec3 direction, float distance) const {
  const AirLight air = air_light(origin, direction, distance);
  return surface_radiance * air.transmittance + air.light;
}

}  // namespace wold
