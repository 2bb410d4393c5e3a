#pragma once
// A two-dimensional array of values, row by row, and views of it.
// Sample (i, j): i counts columns (east), j counts rows (north). Row 0 is the southernmost; only
// src/image turns rows over, because picture files begin at the top.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace wold {

/// A view of a rectangle of values; does not own them. `GridView<const T>` is read-only.
template <class T>
class GridView {
 public:
  GridView() = default;
  GridView(T* data, int width, int height, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), stride_(stride) {}
  GridView(T* data, int width, int height) : GridView(data, width, height, width) {}

  /// A mutable view converts to a read-only one.
  operator GridView<const T>() const { return {data_, width_, height_, stride_}; }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0 || height_ == 0; }

  T& operator()(int i, int j) const {
    assert(i >= 0 && i < width_ && j >= 0 && j < height_);
    return data_[j * stride_ + i];
  }
  std::span<T> row(int j) const {
    assert(j >= 0 && j < height_);
    return {data_ + j * stride_, static_cast<std::size_t>(width_)};
  }
  /// The rectangle of the given size whose first sample is (i, j).
  GridView sub(int i, int j, int width, int height) const {
    assert(i >= 0 && j >= 0 && i + width <= width_ && j + height <= height_);
    return {data_ + j * stride_ + i, width, height, stride_};
  }
  /// The value at the nearest sample inside.
  T& clamped(int i, int j) const {
    return (*this)(std::clamp(i, 0, width_ - 1), std::clamp(j, 0, height_ - 1));
  }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// An owning grid; a value type.
template <class T>
class Grid {
 public:
  Grid() = default;
  Grid(int width, int height, const T& value = T{})
      : values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value),
        width_(width),
        height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  bool same_shape(const Grid& other) const {
    return width_ == other.width_ && height_ == other.height_;
  }

  T& operator()(int i, int j) { return view()(i, j); }
  const T& operator()(int i, int j) const { return view()(i, j); }
  std::span<T> row(int j) { return view().row(j); }
  std::span<const T> row(int j) const { return view().row(j); }
  const T& clamped(int i, int j) const { return view().clamped(i, j); }

  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }

  GridView<T> view() { return {values_.data(), width_, height_}; }
  GridView<const T> view() const { return {values_.data(), width_, height_}; }
  operator GridView<T>() { return view(); }
  operator GridView<const T>() const { return view(); }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  std::vector<T> values_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace wold
