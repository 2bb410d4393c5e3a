// How class Sky chooses directions, and the disc of its sun.

#include <algorithm>
#include <cmath>
#include <span>

#include "sky/sky.hpp"
#include "sky/sky_table.hpp"
#include "sky/spectrum.hpp"

namespace wold {

using namespace sky_table;

namespace {

constexpr float share_below = 0.1F;  // of the samples that luminance asks for below the horizon

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

}  // namespace

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
  const Place place = place_of(direction);
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

}  // namespace wold
