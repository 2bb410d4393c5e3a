#pragma once
// Where the sun stands, seen from a place on Earth at a moment.
//
// `sun_position` follows Meeus, "Astronomical Algorithms", 2nd ed. 1998: apparent longitude of the
// sun (chapter 25 with the larger terms of VSOP87, nutation and aberration), true obliquity (22),
// apparent sidereal time (12), then the correction for parallax (40) and for refraction (16.4,
// Saemundsson, scaled by pressure and temperature). Within 0.002° of NREL SPA (Reda, Andreas 2004)
// for the years 1900 to 2100.
//
// `sun_position_preetham` is the short formula of Preetham, Shirley, Smits, "A practical analytic
// model for daylight", SIGGRAPH 1999, appendix 6, within about a degree; files of other programs
// that use it need the sun where it puts it.
//
// Azimuth counts from north clockwise (east 90°). Angles in degrees.

#include "base/value.hpp"
#include "base/vec.hpp"

namespace wold {

struct Observer {
  double latitude = 0;      ///< degrees, north positive
  double longitude = 0;     ///< degrees, east positive
  double elevation = 0;     ///< m above the sea
  double pressure = 1010;   ///< hPa, for refraction
  double temperature = 10;  ///< °C, for refraction
};

struct SunPosition {
  double zenith = 0;          ///< degrees from straight up, as seen: with refraction
  double azimuth = 0;         ///< degrees from north, clockwise, in [0, 360)
  double true_elevation = 0;  ///< degrees above the horizon without refraction
};

SunPosition sun_position(const DateTime& time, const Observer& observer);

/// `time_of_day` in hours of zone time; `standard_meridian` in degrees, east positive; `julian_day`
/// is the day of the year, 1 to 365. Has no refraction.
SunPosition sun_position_preetham(double latitude, double longitude, double standard_meridian,
                                  int julian_day, double time_of_day);

/// Unit vector towards a place in the sky: X east, Y north, Z up.
Vec3 sky_direction(double elevation, double azimuth);

}  // namespace wold
