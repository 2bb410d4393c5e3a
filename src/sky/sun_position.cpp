#include "sky/sun_position.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace wold {

namespace {

double wrapped(double degrees_any) {
  const double turn = std::fmod(degrees_any, 360.0);
  return turn < 0 ? turn + 360.0 : turn;
}

/// Days since noon of 1 January 4713 BC, of universal time (Meeus 7.1, Gregorian calendar).
double julian_date(const DateTime& time) {
  const bool winter = time.month <= 2;
  const int year = time.year - (winter ? 1 : 0);
  const int month = time.month + (winter ? 12 : 0);
  const double century = std::floor(year / 100.0);
  const double day = time.day + (time.hour * 60.0 + time.minute - time.offset_minutes) / 1440.0 +
                     time.second / 86400.0;
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + 2.0 -
         century + std::floor(century / 4) - 1524.5;
}

/// Terrestrial minus universal time, s: parabola of Morrison and Stephenson 2004. Some seconds off
/// in our time, which moves the sun by 0.0005°.
double delta_t(double julian) {
  const double u = ((julian - 2451545.0) / 365.25 + 2000.0 - 1820.0) / 100.0;
  return std::max(0.0, -20.0 + 32.0 * u * u);
}

/// As seen from the centre of the Earth; radians, R in astronomical units.
struct Equatorial {
  double right_ascension = 0;
  double declination = 0;
  double distance = 1;
  double sidereal_nutation = 0;  ///< equation of the equinoxes
};

/// a · cos(b + c τ), τ in Julian millennia.
struct Term {
  double amplitude, phase, frequency;
};
double sum_of(std::span<const Term> terms, double tau) {
  double sum = 0;
  for (const Term& term : terms)
    sum += term.amplitude * std::cos(term.phase + term.frequency * tau);
  return sum;
}

/// Heliocentric longitude of the Earth, radians: the terms of VSOP87 (Bretagnon, Francou 1988;
/// Meeus, appendix III) above 0.0003°. Amplitudes in 1e-8 radians.
double earth_longitude(double tau) {
  static constexpr Term constant[] = {{175347046, 0, 0},           {3341656, 4.6692568, 6283.07585},
                                      {34894, 4.6261, 12566.1517}, {3497, 2.7441, 5753.3849},
                                      {3418, 2.8289, 3.5231},      {3136, 3.6277, 77713.7715},
                                      {2676, 4.4181, 7860.4194},   {2343, 6.1352, 3930.2097},
                                      {1324, 0.7425, 11506.7698},  {1273, 2.0371, 529.691},
                                      {1199, 1.1096, 1577.3435},   {990, 5.233, 5884.927},
                                      {902, 2.045, 26.298},        {857, 3.508, 398.149},
                                      {780, 1.179, 5223.694},      {753, 2.533, 5507.553},
                                      {505, 4.583, 18849.228}};
  static constexpr Term linear[] = {
      {628331966747.0, 0, 0}, {206059, 2.678235, 6283.07585}, {4303, 2.6351, 12566.1517}};
  static constexpr Term square[] = {{52919, 0, 0}, {8720, 1.0721, 6283.0758}};
  return 1e-8 * (sum_of(constant, tau) + tau * (sum_of(linear, tau) + tau * sum_of(square, tau)));
}

Equatorial apparent_sun(double t) {
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = radians(357.52911 + t * (35999.05029 - t * 0.0001537));
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double node = radians(125.04452 - t * 1934.136261);
  const double sun_2 = radians(2 * mean_longitude);
  const double moon_2 = radians(2 * (218.3165 + t * 481267.8813));
  // Nutation, Meeus chapter 22, in arc seconds.
  const double in_longitude = -17.20 * std::sin(node) - 1.32 * std::sin(sun_2) -
                              0.23 * std::sin(moon_2) + 0.21 * std::sin(2 * node);
  const double in_obliquity = 9.20 * std::cos(node) + 0.57 * std::cos(sun_2) +
                              0.10 * std::cos(moon_2) - 0.09 * std::cos(2 * node);
  const double mean_obliquity =
      84381.448 - t * (46.8150 + t * (0.00059 - t * 0.001813));  // arc seconds
  const double obliquity = radians((mean_obliquity + in_obliquity) / 3600);

  Equatorial sun;
  const double true_anomaly =
      anomaly + 2 * eccentricity * std::sin(anomaly) +
      1.25 * eccentricity * eccentricity * std::sin(2 * anomaly);  // enough for the distance
  sun.distance =
      1.000001018 * (1 - eccentricity * eccentricity) / (1 + eccentricity * std::cos(true_anomaly));
  const double aberration = 20.4898 / sun.distance;  // arc seconds
  const double longitude =
      earth_longitude(t / 10) + pi_d + radians((in_longitude - aberration) / 3600);
  sun.right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  sun.declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  sun.sidereal_nutation = radians(in_longitude / 3600) * std::cos(obliquity);
  return sun;
}

/// Lift of the sun by the air, degrees, from the elevation without it.
double refraction(double elevation, const Observer& observer) {
  constexpr double lowest = -0.8333;  // the upper limb at the horizon: lower down nobody sees it
  if (elevation < lowest) return 0;
  const double arc_minutes = 1.02 / std::tan(radians(elevation + 10.3 / (elevation + 5.11)));
  return observer.pressure / 1010 * 283 / (273 + observer.temperature) * arc_minutes / 60;
}

}  // namespace

SunPosition sun_position(const DateTime& time, const Observer& observer) {
  const double universal = julian_date(time);
  const double days = universal - 2451545.0;
  const Equatorial sun = apparent_sun((days + delta_t(universal) / 86400) / 36525);

  const double ut = days / 36525;
  const double sidereal =
      radians(wrapped(280.46061837 + 360.98564736629 * days + ut * ut * 0.000387933)) +
      sun.sidereal_nutation;
  const double hour_angle = sidereal + radians(observer.longitude) - sun.right_ascension;

  // Parallax (Meeus 40.2, 40.3), with the observer on the ellipsoid (chapter 11).
  const double latitude = radians(observer.latitude);
  const double parallax = std::sin(radians(8.794 / 3600 / sun.distance));
  const double reduced = std::atan2(0.99664719 * std::sin(latitude), std::cos(latitude));
  const double height = observer.elevation / 6378140;
  const double polar = 0.99664719 * std::sin(reduced) + height * std::sin(latitude);
  const double axial = std::cos(reduced) + height * std::cos(latitude);
  const double across = std::cos(sun.declination) - axial * parallax * std::cos(hour_angle);
  const double shift = std::atan2(-axial * parallax * std::sin(hour_angle), across);
  const double declination =
      std::atan2((std::sin(sun.declination) - polar * parallax) * std::cos(shift), across);
  const double hour = hour_angle - shift;

  const double east = -std::cos(declination) * std::sin(hour);
  const double north = std::sin(declination) * std::cos(latitude) -
                       std::cos(declination) * std::cos(hour) * std::sin(latitude);
  const double up = std::sin(declination) * std::sin(latitude) +
                    std::cos(declination) * std::cos(hour) * std::cos(latitude);
  SunPosition position;
  position.true_elevation = degrees(std::atan2(up, std::hypot(east, north)));
  position.zenith = 90 - position.true_elevation - refraction(position.true_elevation, observer);
  position.azimuth = wrapped(degrees(std::atan2(east, north)));
  return position;
}

SunPosition sun_position_preetham(double latitude, double longitude, double standard_meridian,
                                  int julian_day, double time_of_day) {
  const double j = julian_day;
  const double solar_time = time_of_day + 0.170 * std::sin(4 * pi_d * (j - 80) / 373) -
                            0.129 * std::sin(2 * pi_d * (j - 8) / 355) +
                            (longitude - standard_meridian) / 15;
  const double declination = 0.4093 * std::sin(2 * pi_d * (j - 81) / 368);
  const double hour = pi_d * solar_time / 12;
  const double l = radians(latitude);
  const double elevation = std::asin(std::clamp(
      std::sin(l) * std::sin(declination) - std::cos(l) * std::cos(declination) * std::cos(hour),
      -1.0, 1.0));
  const double from_south = std::atan2(
      -std::cos(declination) * std::sin(hour),
      -std::cos(l) * std::sin(declination) - std::sin(l) * std::cos(declination) * std::cos(hour));
  SunPosition position;
  position.true_elevation = degrees(elevation);
  position.zenith = 90 - position.true_elevation;
  position.azimuth = wrapped(180 + degrees(from_south));
  return position;
}

Vec3 sky_direction(double elevation, double azimuth) {
  const double e = radians(elevation);
  const double a = radians(azimuth);
  return {static_cast<float>(std::cos(e) * std::sin(a)),
          static_cast<float>(std::cos(e) * std::cos(a)), static_cast<float>(std::sin(e))};
}

}  // namespace wold
