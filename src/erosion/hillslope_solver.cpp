#include "erosion/hillslope_solver.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"

namespace wold {

namespace {

/// Lines that are solved at once, one per lane.
constexpr int lanes = 16;

/// The factorised tridiagonal matrix 1 - a δ² of a line; ends closed or held.
template <class Real>
class LineMatrix {
 public:
  LineMatrix(int count, double a, bool held_first, bool held_last)
      : upper_(static_cast<std::size_t>(count)),
        inverse_(static_cast<std::size_t>(count)),
        lower_(static_cast<std::size_t>(count)) {
    double upper_before = 0;
    for (int i = 0; i < count; ++i) {
      const bool first = i == 0;
      const bool last = i == count - 1;
      const bool held = (first && held_first) || (last && held_last);
      const double to_lower = held || first ? 0 : a;
      const double to_upper = held || last ? 0 : a;
      const double pivot = 1 + to_lower + to_upper - to_lower * upper_before;
      const auto k = static_cast<std::size_t>(i);
      lower_[k] = static_cast<Real>(to_lower);
      inverse_[k] = static_cast<Real>(1 / pivot);
      upper_[k] = static_cast<Real>(upper_before = to_upper / pivot);
    }
  }

  /// Solves `width` lines at once; element k of all lines lies at data + k · stride.
  void solve(Real* data, std::ptrdiff_t stride, int width) const {
    const auto count = static_cast<int>(upper_.size());
    for (int k = 0; k < count; ++k) {
      Real* row = data + k * stride;
      const Real inverse = inverse_[static_cast<std::size_t>(k)];
      const Real lower = lower_[static_cast<std::size_t>(k)];
      const Real* before = k > 0 ? row - stride : row;
      for (int i = 0; i < width; ++i) row[i] = (row[i] + lower * before[i]) * inverse;
    }
    for (int k = count - 2; k >= 0; --k) {
      Real* row = data + k * stride;
      const Real upper = upper_[static_cast<std::size_t>(k)];
      const Real* after = row + stride;
      for (int i = 0; i < width; ++i) row[i] += upper * after[i];
    }
  }

 private:
  std::vector<Real> upper_;
  std::vector<Real> inverse_;
  std::vector<Real> lower_;
};

template <class Real>
void diffuse_rows(Grid<Real>& height, const LineMatrix<Real>& matrix, Progress& progress) {
  const int w = height.width();
  parallel_for(0, (height.height() + lanes - 1) / lanes, [&](int b) {
    const int first = b * lanes;
    const int count = std::min(lanes, height.height() - first);
    std::vector<Real> turned(static_cast<std::size_t>(w) * lanes, Real{0});
    for (int r = 0; r < count; ++r) {
      const Real* row = height.row(first + r).data();
      for (int i = 0; i < w; ++i)
        turned[static_cast<std::size_t>(i) * lanes + static_cast<std::size_t>(r)] = row[i];
    }
    matrix.solve(turned.data(), lanes, lanes);
    for (int r = 0; r < count; ++r) {
      Real* row = height.row(first + r).data();
      for (int i = 0; i < w; ++i)
        row[i] = turned[static_cast<std::size_t>(i) * lanes + static_cast<std::size_t>(r)];
    }
    progress.advance(0);
  });
}

template <class Real>
void diffuse_columns(Grid<Real>& height, const LineMatrix<Real>& matrix, Progress& progress) {
  constexpr int columns = 4 * lanes;
  const int w = height.width();
  parallel_for(0, (w + columns - 1) / columns, [&](int b) {
    const int first = b * columns;
    matrix.solve(&height(first, 0), w, std::min(columns, w - first));
    progress.advance(0);
  });
}

/// Heights on held sides.
template <class Real>
class Border {
 public:
  Border(const Grid<Real>& height, const Sides& held) : held_(held) {
    each(height.width(), height.height(), [&](int i, int j) { heights_.push_back(height(i, j)); });
  }
  void restore(Grid<Real>& height) const {
    auto next = heights_.begin();
    each(height.width(), height.height(), [&](int i, int j) { height(i, j) = *next++; });
  }

 private:
  template <class Visit>
  void each(int w, int h, const Visit& visit) const {
    for (int i = 0; i < w; ++i) {
      if (held_.south) visit(i, 0);
      if (held_.north) visit(i, h - 1);
    }
    for (int j = 0; j < h; ++j) {
      if (held_.west) visit(0, j);
      if (held_.east) visit(w - 1, j);
    }
  }

  Sides held_;
  std::vector<Real> heights_;
};

template <class Real>
void step(Grid<Real>& height, double a, const Sides& held, Progress& progress) {
  if (!(a > 0)) return;
  const Border<Real> border(height, held);
  diffuse_rows(height, LineMatrix<Real>(height.width(), a, held.west, held.east), progress);
  diffuse_columns(height, LineMatrix<Real>(height.height(), a, held.south, held.north), progress);
  border.restore(height);
}

}  // namespace

void diffuse(Grid<float>& height, double a, const Sides& held, Progress& progress) {
  step(height, a, held, progress);
}

void diffuse(Grid<double>& height, double a, const Sides& held, Progress& progress) {
  step(height, a, held, progress);
}

}  // namespace wold
