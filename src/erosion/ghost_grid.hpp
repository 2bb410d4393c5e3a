#pragma once
// A grid with one ghost sample beyond every border, for loops that need neighbours everywhere.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wold {

template <class T>
class GhostGrid {
 public:
  GhostGrid() = default;
  GhostGrid(int width, int height, T value = T{})
      : width_(width),
        height_(height),
        pitch_((width + 2 * lead + 7) / 8 * 8),
        values_(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(height + 2), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  /// Sample 0 of row j, -1 <= j <= height; samples -1 to width may be used.
  T* row(int j) { return values_.data() + offset(j); }
  const T* row(int j) const { return values_.data() + offset(j); }

  /// Ghosts beside row j: the nearest value, or that of the opposite border.
  void fill_sides(int j, bool periodic) {
    T* r = row(j);
    r[-1] = r[periodic ? width_ - 1 : 0];
    r[width_] = r[periodic ? 0 : width_ - 1];
  }
  /// Ghost rows, after all rows have their ghosts beside them.
  void fill_ends(bool periodic) {
    copy_row(periodic ? height_ - 1 : 0, -1);
    copy_row(periodic ? 0 : height_ - 1, height_);
  }

 private:
  static constexpr int lead = 8;

  std::ptrdiff_t offset(int j) const { return static_cast<std::ptrdiff_t>(j + 1) * pitch_ + lead; }
  void copy_row(int from, int to) { std::copy(row(from) - 1, row(from) + width_ + 1, row(to) - 1); }

  int width_ = 0;
  int height_ = 0;
  int pitch_ = 0;
  std::vector<T> values_;
};

}  // namespace wold
