#pragma once
// How densely candidates must fall so that what finds room has the wished density.
//
// Plants are set by random sequential adsorption (Widom 1966; in computer graphics "dart throwing",
// Cook 1986): candidates fall at random places in random order, larger kinds first, and one stays
// if its disc touches none that stays already. Kind i then reaches the density κ_i · a_i, κ_i the
// density of candidates and a_i the mean chance to find room, which depends on all kinds. This plan
// finds κ by trial on a patch of some thousand plants: κ_i ← λ_i / a_i(κ), until it settles. The
// same for 1/4, 1/2 and 3/4 of the density, for places where fewer are wished.
//
// Equal discs jam at 54.7 % of the area; what cannot be reached is reached as far as
// `most_candidates` per wished plant go.

#include <array>
#include <span>
#include <vector>

namespace wold {

struct DiscKind {
  float radius = 0;       ///< m
  int size_class = 0;     ///< as DiscField wants it
  double wished = 0;      ///< plants per m²
  double reached = 0;     ///< plants per m², where everything suits
  double candidates = 0;  ///< per m²
  /// Candidates per plant at 0, 1/4, 1/2, 3/4 and all of the wished density, against the last.
  std::array<double, 5> crowding{};

  /// The share of the candidates to use for a part of the wished density.
  double share_for(double part) const;
};

struct SpacingPlan {
  std::vector<DiscKind> kinds;
  std::vector<float> class_radius;  ///< largest of each class, m
  double candidates = 0;            ///< per m², all kinds together

  double reached() const;
};

inline constexpr double most_candidates = 30;  ///< per wished plant
inline constexpr double jamming_coverage = 0.547;

/// From the radius (m, > 0) and density (per m²) of each kind.
SpacingPlan plan_spacing(std::span<const float> radius, std::span<const double> density);

/// The distance that discs of one size may keep at the most at a density per m², m.
double jamming_distance(double density);

}  // namespace wold
