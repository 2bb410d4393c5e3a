#pragma once
// The air of a planet and the sunlight in it, by ray marching.
//
//   L(x, ω) = T(x, x_d) L(x_d, ω) + ∫ T(x, x_t) [σs p(cos θ) E T_sun(x_t) + σs Ψ(x_t)] dt
//   T(a, b) = exp(-Σ σt ∫ ρ(h) ds)       over molecules, aerosol and ozone, per colour
//   ρ = e^(-h / H) of molecules and aerosol; ozone a tent of 30 km around 25 km
//
// σ in 1/m at height 0, H in m, E illuminance by the sun outside the air (lx), L in cd/m². The
// planet is a sphere and casts its shadow; the sun's disc sinks behind its edge gradually. Light
// goes straight (no refraction).
//
// Colours: the usual coefficients are those at 680, 550, 440 nm, taken as red, green and blue. With
// them dusk turns pink, for ozone hardly dims 680 nm but dims most what the eye sees as red. So the
// default are the coefficients that colours have, C_c being the part c of the linear Rec. 709
// colour of a spectrum and E_λ sunlight:
//
//   σ_c = C_c(E_λ σ(λ)) / C_c(E_λ)
//
// Exact for thin air; for air the whole spectrum gives the same within 4 % up to an air mass of 10.
//
// Molecules scatter by Rayleigh's phase function, aerosol by that of Cornette and Shanks and
// absorbs a part. Single scattering after Nishita, Sirai, Tadamura, Nakamae, "Display of the Earth
// taking into account atmospheric scattering", SIGGRAPH 1993. Ψ, what arrives from everywhere after
// two and more scatterings, is an input (sunlit_air.hpp computes it), as is the sunlight T_sun: a
// march with light steps, or a table.
//
// Slip mended: in the usual pseudo code the transmittance of the ray uses the *scattering*
// coefficient; here all transmittances use extinction. Steps grow with the square of their number,
// since the densest air is near the eye; within one the exponent is integrated as if height changed
// evenly, and the light that is scattered fades by the step's own extinction. So steps that are too
// long lose no energy.
//
// All functions are in float and plain, for the twins in GLSL. Places are (height, cosine to the
// zenith), never points: a difference of heights would drown in a planet's radius.

#include "base/parameters.hpp"
#include "base/vec.hpp"

namespace wold {

/// Scattering by molecules at height 0.
enum class AirCoefficients {
  rec709,   ///< 5.93, 11.81, 28.02 e-6 /m: colours of sunlight, see below
  popular,  ///< 5.8, 13.5, 33.1 e-6 /m at 680, 550, 440 nm (most programs since 2004)
  penndorf  ///< 4.91, 11.62, 28.99 e-6 /m there (Penndorf 1957, 15 °C), 14 to 18 % less
};

struct Atmosphere {
  AirCoefficients air = AirCoefficients::rec709;
  float air_height = 8000;         ///< m, H of molecules
  Vec3 aerosol_scattering{4e-6F};  ///< 1/m at height 0
  float aerosol_height = 1200;     ///< m, H of aerosol
  float aerosol_albedo = 0.9F;     ///< scattering / extinction: 1 / 1.11
  float aerosol_forward = 0.76F;   ///< g
  float ozone = 300;               ///< Dobson units
  float planet_radius = 6.36e6F;   ///< m
  float air_thickness = 1e5F;      ///< m, above which there is nothing
  Vec3 ground_albedo{0.2F};
};

/// What a user sets: aerosol follows from the visibility, the ground from its own parameter.
Description<Atmosphere> describe(const Atmosphere&);

/// Of red, green and blue, nm: those at which aerosol (λ^-1.3) has the coefficients of the colours.
DVec3 wavelengths(AirCoefficients set);
Vec3 air_scattering(AirCoefficients set);
/// The law behind Penndorf's, 1/m at 15 °C and 1013 hPa, λ in nm:
///   σ = 8π³ (n² - 1)² / (3 N λ⁴) · (6 + 3δ) / (6 - 7δ),  δ = 0.035, n by Edlén 1953
double rayleigh_scattering(double wavelength);
/// Absorption at the middle of the layer, 1/m. For 300 DU 0.650, 1.881, 0.085 e-6 at 680, 550,
/// 440 nm, as Bruneton 2017 and Hillaire 2020 have it; of colours 2.51, 1.78, 0 e-6, from the same
/// cross-sections (Serdyuchenko et al. 2014).
Vec3 ozone_absorption(const Atmosphere& atmosphere);

/// Metres of air of density 1 (or, of a density, its parts): molecules, aerosol, ozone.
using AirColumn = Vec3;

AirColumn air_density(const Atmosphere& atmosphere, float height);
/// τ, per colour.
Vec3 optical_depth(const Atmosphere& atmosphere, AirColumn column);

/// A ray in the air. Cosines: of the ray to the zenith and of the sun to the zenith, both where it
/// starts; of the ray to the sun.
struct AirRay {
  float height = 0;  ///< m
  float cosine = 1;
  float sun_cosine = 1;
  float to_sun = 1;
};

/// From a place in world coordinates (Z up, height 0 at z = 0).
AirRay air_ray(const Atmosphere& atmosphere, Vec3 origin, Vec3 direction, Vec3 sun_direction);

float height_after(const Atmosphere& atmosphere, float height, float cosine, float distance);
/// Of the sun to the zenith, `distance` along the ray.
float sun_cosine_after(const Atmosphere& atmosphere, const AirRay& ray, float distance);

/// Where a ray is in the air: from `begin` to `end`, m; `ground`: it ends on the planet. Nothing
/// between when it misses the air (begin = end).
struct AirSpan {
  float begin = 0;
  float end = 0;
  bool ground = false;
};
AirSpan span_in_air(const Atmosphere& atmosphere, float height, float cosine);

/// Where a ray is between two heights, at first, before it meets the ground; begin = end: nowhere.
AirSpan span_in_layer(const Atmosphere& atmosphere, float height, float cosine, float low,
                      float high);
/// To where the ray leaves the air, as if there were no ground; 0 when it misses the air.
float distance_to_space(const Atmosphere& atmosphere, float height, float cosine);

AirColumn air_column(const Atmosphere& atmosphere, float height, float cosine, float begin,
                     float end, int steps);
/// Between the ray's start and the place `distance` along it, at most to the end of the air.
Vec3 transmittance(const Atmosphere& atmosphere, float height, float cosine, float distance,
                   int steps);

/// Part of the sun's disc above the planet's edge, softly, in [0, 1].
float sun_above_edge(const Atmosphere& atmosphere, float height, float sun_cosine);
/// Of sunlight that comes from space to this height: 0 in the planet's shadow.
Vec3 sun_transmittance(const Atmosphere& atmosphere, float height, float sun_cosine, int steps);

/// What a stretch of air does to light: L = surface · transmittance + light.
struct AirLight {
  Vec3 transmittance{1};
  Vec3 light{0};
};

/// The light scattered towards the eye, by kind, not yet times the phase functions and E.
struct ScatteredSums {
  Vec3 transmittance{1};
  Vec3 by_air{0};
  Vec3 by_aerosol{0};
  Vec3 multiple{0};  ///< 1/sr
};
AirLight with_phases(const Atmosphere& atmosphere, const ScatteredSums& sums, float to_sun,
                     Vec3 sun_illuminance);

/// Light of the sun (part of E) and Ψ (per E) at a height and cosine of the sun.
struct LightInAir {
  Vec3 sun{0};
  Vec3 multiple{0};
};

/// Adds the stretch [begin, begin + length] of a ray to `sums`, all of it in the same light.
void add_stretch(const Atmosphere& atmosphere, AirColumn column, const LightInAir& light,
                 ScatteredSums& sums);

/// The march: `light_at(height, sun_cosine)` gives LightInAir. Ends at `distance`, the end of the
/// air or the ground, whichever is first.
template <class LightAt>
ScatteredSums march(const Atmosphere& atmosphere, const AirRay& ray, float distance, int steps,
                    const LightAt& light_at) {
  const AirSpan span = span_in_air(atmosphere, ray.height, ray.cosine);
  const float length = (distance < span.end ? distance : span.end) - span.begin;
  ScatteredSums sums;
  if (!(length > 0)) return sums;
  float from = span.begin;
  for (int k = 0; k < steps; ++k) {
    const float part = static_cast<float>(k + 1) / static_cast<float>(steps);
    const float to = span.begin + length * part * part;
    const float middle = 0.5F * (from + to);
    const AirColumn column = air_column(atmosphere, ray.height, ray.cosine, from, to, 1);
    add_stretch(atmosphere, column,
                light_at(height_after(atmosphere, ray.height, ray.cosine, middle),
                         sun_cosine_after(atmosphere, ray, middle)),
                sums);
    from = to;
  }
  return sums;
}

/// Light scattered once on the way to the eye, and the transmittance: sky and aerial perspective in
/// one.
AirLight single_scattering(const Atmosphere& atmosphere, const AirRay& ray, float distance,
                           Vec3 sun_illuminance, int steps, int light_steps);

}  // namespace wold
