#include "sky/sky.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "base/smoothstep.hpp"
#include "sky/preetham.hpp"
#include "sky/spectrum.hpp"
#include "sky/sunlight.hpp"

namespace wold {

namespace {

constexpr int columns = 512;
constexpr int quadrant = columns / 4;
constexpr int cell_rows = 256;         // half of them above the horizon
constexpr double sun_diameter = 0.53;  // degrees, for which sunlight is computed
constexpr float share_below = 0.1F;    // of the samples that luminance asks for below the horizon
// The paper's dome is nearly twice as bright as clear skies measure: with this factor it gives the
// 0.8 + 15.5 √sin(elevation) klx of the IES Lighting Handbook within 20 % at turbidity 2.5.
constexpr double measured_share = 0.55;
constexpr double haze_over_plain = 0.03;  // optical depth straight down: eye 300 m up, 10 km of air
constexpr double night_luminance = 1e-3;  // cd/m², stars and airglow, rather bright
constexpr DVec3 night_colour{0.55, 0.85, 3.8};  // luminance 1

// The table's coordinates need no trigonometry to look up. Around the compass, "diamond angle":
// along each quadrant y / (|x| + |y|), 0 to 1. Up and down, s with s² = |z| / (|z| + across).

double column_azimuth(int column) {  // radians from east to north, [0, 2π]
  const int turns = column / quadrant;
  const double t = static_cast<double>(column % quadrant) / quadrant;
  return turns * (0.5 * pi_d) + std::atan2(t, 1 - t);
}

double row_elevation(int row) {  // radians
  const double s = 2.0 * row / cell_rows - 1;
  return std::copysign(std::atan2(s * s, 1 - s * s), s);
}

double column_width(int column) {
  return column_azimuth(column + 1) - column_azimuth(column);
}

struct TablePlace {
  float column = 0;  // in [0, columns]
  float row = 0;     // in [0, cell_rows]
};

TablePlace place_of(Vec3 direction) {
  const float across = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const float steep = std::abs(direction.z) / (std::abs(direction.z) + across);
  const float s = std::copysign(std::sqrt(steep), direction.z);
  const float sum = std::max(std::abs(direction.x) + std::abs(direction.y), 1e-30F);
  const float t = direction.y / sum;
  const float turn = direction.x < 0 ? 2 - t : (t < 0 ? 4 + t : t);
  return {turn * quadrant, 0.5F * (s + 1) * cell_rows};
}

/// The part of a disc above the horizon; `x` its centre's elevation in radii.
double disc_above(double x) {
  if (x >= 1) return 1;
  if (x <= -1) return 0;
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi_d;
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
  const double night = night_luminance * smoothstep(0, 18, -sun_elevation);
  return measured_share * dusk_factor(sun_elevation) * dusk + night * night_colour;
}

Vec3 power(float base, Vec3 exponent) {
  return {std::pow(base, exponent.x), std::pow(base, exponent.y), std::pow(base, exponent.z)};
}

/// The element that a uniform number falls on, and how far along it, in [0, 1).
struct Choice {
  int index = 0;
  float along = 0;
};

/// `guide[g]`: the first element that may hold numbers from g / guide.size() up.
Choice choose(std::span<const float> cumulative, std::span<const std::uint16_t> guide, float u) {
  std::size_t index = guide[static_cast<std::size_t>(u * static_cast<float>(guide.size()))];
  while (cumulative[index] <= u && index + 1 < cumulative.size()) ++index;
  const float low = index > 0 ? cumulative[index - 1] : 0;
  const float width = cumulative[index] - low;
  const float along = width > 0 ? (u - low) / width : 0;
  return {static_cast<int>(index), std::clamp(along, 0.0F, 0x1.fffffep-1F)};
}

void fill_guide(std::span<const float> cumulative, std::span<std::uint16_t> guide) {
  std::size_t index = 0;
  for (std::size_t g = 0; g < guide.size(); ++g) {
    const float u = static_cast<float>(g) / static_cast<float>(guide.size());
    while (cumulative[index] <= u && index + 1 < cumulative.size()) ++index;
    guide[g] = static_cast<std::uint16_t>(index);
  }
}

Vec3 interpolated(const Grid<Vec3>& nodes, Vec3 direction) {
  const TablePlace place = place_of(direction);
  const int i = std::min(static_cast<int>(place.column), columns - 1);
  const int j = std::min(static_cast<int>(place.row), cell_rows - 1);
  const float x = place.column - static_cast<float>(i);
  const float y = place.row - static_cast<float>(j);
  const int next = i + 1 == columns ? 0 : i + 1;
  const Vec3 below = glm::mix(nodes(i, j), nodes(next, j), x);
  const Vec3 above = glm::mix(nodes(i, j + 1), nodes(next, j + 1), x);
  return glm::mix(below, above, y);
}

}  // namespace

Description<SkySettings> describe(const SkySettings&) {
  return Description<SkySettings>("sky", "Sun, sky and haze of one moment at one place.")
      .choice("model", &SkySettings::model, {"preetham"}, "How the colour of the sky is computed.")
      .add("place", &SkySettings::place, {.unit = "degrees", .min = -180, .max = 180},
           "Latitude (north positive) and longitude (east positive).")
      .add("time", &SkySettings::time, "Date and time, which place the sun.")
      .add("sun", &SkySettings::sun, {.unit = "degrees", .min = -360, .max = 360},
           "Where the sun stands, [elevation, azimuth from north by east]; empty: by place and "
           "time.")
      .add("turbidity", &SkySettings::turbidity, {.min = 1.9, .max = 10},
           "Haziness of the whole air: 2 very clear, 3 clear, 6 hazy.")
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
           "Height over which haze thins to 1/e.");
}

Sky::Sky(const SkySettings& settings) {
  if (settings.haze) haze_ = Haze(settings.visibility, settings.haze_height);
  set_sun(settings);
  fill_table(settings);
  fill_air();
  build_distribution();
}

void Sky::set_sun(const SkySettings& settings) {
  double azimuth = 0;
  if (settings.sun.empty()) {
    const SunPosition sun = sun_position(settings.time, {settings.place.x, settings.place.y});
    sun_elevation_ = 90 - sun.zenith;
    azimuth = sun.azimuth;
  } else {
    if (settings.sun.size() != 2 || !(std::abs(settings.sun[0]) <= 90))
      throw Error(ErrorKind::input,
                  "'sun' in 'sky' must be [elevation, azimuth] in degrees, with an elevation of "
                  "-90 to 90, or an empty list");
    sun_elevation_ = settings.sun[0];
    azimuth = settings.sun[1];
  }
  sun_direction_ = sky_direction(sun_elevation_, azimuth);
  sun_side_ = sky_direction(0, azimuth + 90);
  sun_up_ = glm::cross(sun_direction_, sun_side_);

  const double radius = 0.5 * radians(static_cast<double>(settings.sun_size));
  const auto solid_angle = [](double r) { return 4 * pi_d * std::pow(std::sin(r / 2), 2); };
  const double above = disc_above(radians(sun_elevation_) / radius);
  const DVec3 radiance = sun_disc_radiance(90 - sun_elevation_, settings.turbidity);
  const DVec3 irradiance = radiance * (solid_angle(0.5 * radians(sun_diameter)) * above *
                                       static_cast<double>(settings.sun_intensity));
  const DVec3 exponent = limb_darkening_exponent();
  limb_exponent_ = exponent;
  sun_irradiance_ = irradiance;
  sun_centre_radiance_ = irradiance * (0.5 * exponent + DVec3(1)) / solid_angle(radius);
  sun_chord_ = static_cast<float>(2 * std::sin(radius / 2));
  sun_pdf_ = static_cast<float>(1 / solid_angle(radius));
  sun_visible_ = luminance(irradiance) > 0;
}

void Sky::fill_table(const SkySettings& settings) {
  const PreethamSky day(settings.turbidity, radians(90 - sun_elevation_));
  const double intensity = settings.sky_intensity;
  nodes_ = Grid<Vec3>(columns, cell_rows + 1);
  row_sine_.resize(cell_rows + 1);
  column_azimuth_.resize(columns + 1);
  for (int i = 0; i <= columns; ++i)
    column_azimuth_[static_cast<std::size_t>(i)] = static_cast<float>(column_azimuth(i));
  for (int j = 0; j <= cell_rows; ++j)
    row_sine_[static_cast<std::size_t>(j)] = static_cast<float>(std::sin(row_elevation(j)));

  const auto fill_row = [&](int j) {
    const double elevation = row_elevation(j);
    for (int i = 0; i < columns; ++i) {
      const double azimuth = column_azimuth(i);
      const DVec3 direction(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      nodes_(i, j) = intensity * sky_at(day, sun_elevation_, direction.z,
                                        glm::dot(direction, DVec3(sun_direction_)));
    }
  };
  constexpr int horizon = cell_rows / 2;
  parallel_for(horizon, cell_rows + 1, fill_row);

  // ∫ L sin(e) dω; over a row of cells the integral of sin e · cos e de is that of sin² / 2.
  DVec3 irradiance(0);
  for (int j = horizon; j < cell_rows; ++j) {
    const double low = row_sine_[static_cast<std::size_t>(j)];
    const double high = row_sine_[static_cast<std::size_t>(j) + 1];
    DVec3 sum(0);
    for (int i = 0; i < columns; ++i) sum += column_width(i) * cell_mean(i, j);
    irradiance += sum * (0.5 * (high * high - low * low));
  }
  sky_irradiance_ = irradiance;

  const double sun_sine = std::max(0.0F, sun_direction_.z);
  const DVec3 plain = static_cast<double>(settings.ground_albedo) / pi_d *
                      (irradiance + sun_sine * DVec3(sun_irradiance_));
  parallel_for(0, horizon, [&](int j) {
    const double depth = haze_over_plain / -std::sin(row_elevation(j));
    for (int i = 0; i < columns; ++i)
      nodes_(i, j) = glm::mix(DVec3(nodes_(i, horizon)), plain, std::exp(-depth));
  });
}

void Sky::fill_air() {
  if (!haze_.enabled()) return;
  air_ = nodes_;
  constexpr int horizon = cell_rows / 2;
  parallel_for(0, cell_rows + 1, [&](int j) {
    const float sine = row_sine_[static_cast<std::size_t>(j)];
    const Vec3 upwards{std::sqrt(std::max(0.0F, 1 - sine * sine)), 0, sine};
    const Vec3 whole = haze_.transmittance(Vec3(0), upwards, INFINITY);
    for (int i = 0; i < columns; ++i)
      air_(i, j) =
          j <= horizon ? nodes_(i, horizon) : nodes_(i, j) / glm::max(Vec3(1) - whole, Vec3(1e-4F));
  });
}

DVec3 Sky::cell_mean(int i, int j) const {
  const int next = (i + 1) % columns;
  return 0.25 * (DVec3(nodes_(i, j)) + DVec3(nodes_(next, j)) + DVec3(nodes_(i, j + 1)) +
                 DVec3(nodes_(next, j + 1)));
}

void Sky::build_distribution() {
  cell_pdf_ = Grid<float>(columns, cell_rows);
  cells_cumulative_ = Grid<float>(columns, cell_rows);
  rows_cumulative_.resize(cell_rows);
  row_guide_.resize(cell_rows);
  cell_guide_ = Grid<std::uint16_t>(columns / 2, cell_rows);
  std::vector<double> row_weight(cell_rows);
  double total = 0;
  for (int j = 0; j < cell_rows; ++j) {
    const auto row = static_cast<std::size_t>(j);
    const double share = j < cell_rows / 2 ? share_below : 1;
    double sum = 0;
    for (int i = 0; i < columns; ++i) {
      const double density = share * luminance(cell_mean(i, j));
      cell_pdf_(i, j) = static_cast<float>(density);
      sum += density * column_width(i);
      cells_cumulative_(i, j) = static_cast<float>(sum);
    }
    row_weight[row] = sum * static_cast<double>(row_sine_[row + 1] - row_sine_[row]);
    total += row_weight[row];
    for (float& c : cells_cumulative_.row(j)) c = sum > 0 ? c / static_cast<float>(sum) : 0;
    cells_cumulative_(columns - 1, j) = 1;
    fill_guide(cells_cumulative_.row(j), cell_guide_.row(j));
  }
  double sum = 0;
  for (std::size_t j = 0; j < rows_cumulative_.size(); ++j) {
    sum += row_weight[j];
    rows_cumulative_[j] = total > 0 ? static_cast<float>(sum / total) : 0;
  }
  rows_cumulative_.back() = 1;
  fill_guide(rows_cumulative_, row_guide_);
  for (float& pdf : cell_pdf_.values()) pdf = total > 0 ? static_cast<float>(pdf / total) : 0;
}

Vec3 Sky::radiance(Vec3 direction) const {
  return interpolated(nodes_, direction);
}

SkySample Sky::sample_sky(Vec2 u) const {
  const Choice row = choose(rows_cumulative_, row_guide_, u.y);
  const Choice cell = choose(cells_cumulative_.row(row.index), cell_guide_.row(row.index), u.x);
  const auto j = static_cast<std::size_t>(row.index);
  const float sine = row_sine_[j] + row.along * (row_sine_[j + 1] - row_sine_[j]);
  const auto i = static_cast<std::size_t>(cell.index);
  const float azimuth =
      column_azimuth_[i] + cell.along * (column_azimuth_[i + 1] - column_azimuth_[i]);
  const float across = std::sqrt(std::max(0.0F, 1 - sine * sine));
  SkySample sample;
  sample.direction = {across * std::cos(azimuth), across * std::sin(azimuth), sine};
  sample.radiance = radiance(sample.direction);
  sample.pdf = cell_pdf_(cell.index, row.index);
  return sample;
}

float Sky::sky_pdf(Vec3 direction) const {
  const TablePlace place = place_of(direction);
  return cell_pdf_(std::min(static_cast<int>(place.column), columns - 1),
                   std::min(static_cast<int>(place.row), cell_rows - 1));
}

Vec3 Sky::sun_radiance(Vec3 direction) const {
  const Vec3 offset = direction - sun_direction_;
  const float r = glm::dot(offset, offset) / (sun_chord_ * sun_chord_);
  if (!sun_visible_ || r >= 1) return Vec3(0);
  const float mu = std::sqrt(1 - r);
  return sun_centre_radiance_ * power(mu, limb_exponent_);
}

SkySample Sky::sample_sun(Vec2 u) const {
  SkySample sample;
  sample.direction = sun_direction_;
  if (!sun_visible_) return sample;
  // The chord's square is uniform over a spherical cap.
  const float chord_2 = u.x * sun_chord_ * sun_chord_;
  const float across = std::sqrt(chord_2 * (1 - 0.25F * chord_2));
  const float turn = 2 * pi * u.y;
  sample.direction =
      glm::normalize((1 - 0.5F * chord_2) * sun_direction_ +
                     across * (std::cos(turn) * sun_side_ + std::sin(turn) * sun_up_));
  const float mu = std::sqrt(1 - u.x);
  sample.radiance = sun_centre_radiance_ * power(mu, limb_exponent_);
  sample.pdf = sun_pdf_;
  return sample;
}

float Sky::sun_pdf(Vec3 direction) const {
  const Vec3 offset = direction - sun_direction_;
  const bool inside = glm::dot(offset, offset) < sun_chord_ * sun_chord_;
  return sun_visible_ && inside ? sun_pdf_ : 0;
}

Vec3 Sky::through_haze(Vec3 surface_radiance, Vec3 origin, Vec3 direction, float distance) const {
  if (!haze_.enabled()) return surface_radiance;
  const Vec3 passed = haze_.transmittance(origin, direction, distance);
  const Vec3 air = interpolated(air_, direction);
  return surface_radiance * passed + air * (Vec3(1) - passed);
}

}  // namespace wold
