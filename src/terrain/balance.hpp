#pragma once
// What an operator moved, summed up, so that nothing is lost unseen.
//
//   before + added - removed = after        up to rounding, relative to `moved`

#include <string>

namespace wold {

/// Sums of one quantity over the whole field, m³.
struct Balance {
  std::string quantity;   ///< "ground", "water", "snow"
  double before = 0;      ///< in the input
  double added = 0;       ///< uplift, rain, springs, snowfall
  double removed = 0;     ///< over the border, evaporated, dissolved and gone
  double after = 0;       ///< in the output, with what water still carries
  double moved = 0;       ///< taken up anywhere, each time it was: what errors are relative to
  std::string step = {};  ///< name or operator of the step; whoever runs steps sets it

  /// m³ that appeared (positive) or vanished.
  double error() const { return after - (before + added - removed); }
  /// The error relative to what moved; 0 where nothing did.
  double relative_error() const { return moved > 0 ? error() / moved : 0; }
};

}  // namespace wold
