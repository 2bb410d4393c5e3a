#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "mesh/edit.hpp"
#include "mesh/obj_syntax.hpp"

namespace wold::mesh_edit {

namespace {

/// Calls the visitor for all statements that define or use positions and normals:
/// `position(words)`, `normal(words)` with three words each, `corner(corner)`, `end_face()`.
template <class Visitor>
void scan(std::string_view bytes, const std::string& file, Visitor&& visitor) {
  ObjLines lines(bytes, file);
  std::array<std::size_t, 3> counts{};  // positions, texture coordinates, normals
  while (lines.next()) {
    std::string_view line = lines.line();
    const std::string_view keyword = ObjLines::take_word(line);
    if (keyword == "v" || keyword == "vn") {
      std::array<std::string_view, 3> words;
      for (std::size_t k = 0; k < 3; ++k) {
        words[k] = ObjLines::take_word(line);
        if (words[k].empty()) lines.fail(fmt::format("3 numbers are expected here, found {}", k));
      }
      ++counts[keyword == "v" ? 0 : 2];
      if (keyword == "v")
        visitor.position(lines, words);
      else
        visitor.normal(lines, words);
    } else if (keyword == "vt") {
      ++counts[1];
    } else if (keyword == "f") {
      int corners = 0;
      for (auto word = ObjLines::take_word(line); !word.empty(); word = ObjLines::take_word(line)) {
        visitor.corner(lines.corner(word, counts));
        ++corners;
      }
      if (corners < 3)
        lines.fail(fmt::format("a face has at least 3 corners, this one has {}", corners));
      visitor.end_face();
    }
  }
}

DVec3 vector_of(const ObjLines& lines, const std::array<std::string_view, 3>& words) {
  return {lines.number<double>(words[0]), lines.number<double>(words[1]),
          lines.number<double>(words[2])};
}

/// Numbers the different pairs of position and normal in the order of their first use.
class PointList {
 public:
  /// The index of the corner's point, or `no_point`.
  std::uint32_t operator()(const ObjLines::Corner& corner) {
    const int normal = corner.index[2];
    if (normal < 0) return no_point;
    const auto position = static_cast<std::size_t>(corner.index[0]);
    if (position >= first_.size()) first_.resize(std::max(position + 1, 2 * first_.size()));
    First& first = first_[position];
    if (first.normal < 0) first = {normal, count_++};
    if (first.normal == normal) return first.point;
    const auto [place, is_new] = others_.emplace(std::pair(corner.index[0], normal), count_);
    if (is_new) ++count_;
    return place->second;
  }

 private:
  /// Of one position, the normal seen first: mostly there is no other.
  struct First {
    int normal = -1;
    std::uint32_t point = 0;
  };

  std::vector<First> first_;
  std::map<std::pair<int, int>, std::uint32_t> others_;
  std::uint32_t count_ = 0;
};

class Reader {
 public:
  void position(const ObjLines& lines, const std::array<std::string_view, 3>& words) {
    content_.positions.push_back(vector_of(lines, words));
  }
  void normal(const ObjLines& lines, const std::array<std::string_view, 3>& words) {
    normals_.emplace_back(vector_of(lines, words));
  }
  void corner(const ObjLines::Corner& corner) {
    const auto position = static_cast<std::uint32_t>(corner.index[0]);
    const std::uint32_t point = points_(corner);
    if (point == content_.points.size())
      content_.points.push_back({position, normals_[static_cast<std::size_t>(corner.index[2])],
                                 static_cast<std::uint32_t>(corner.index[2])});
    triangle_ = count_ == 0 ? UVec3(position) : UVec3(triangle_.x, triangle_.z, position);
    triangle_points_ =
        count_ == 0 ? UVec3(point) : UVec3(triangle_points_.x, triangle_points_.z, point);
    if (++count_ < 3) return;
    content_.triangles.push_back(triangle_);
    content_.triangle_points.push_back(triangle_points_);
  }
  void end_face() { count_ = 0; }

  Content finish() && {
    if (content_.points.empty()) content_.triangle_points = {};
    return std::move(content_);
  }

 private:
  Content content_;
  std::vector<Vec3> normals_;
  PointList points_;
  UVec3 triangle_{0};
  UVec3 triangle_points_{0};
  int count_ = 0;
};

/// The normals of the file to be written: each of the file that was read, and behind it those that
/// it has become besides.
struct NormalPlan {
  struct Normal {
    std::string first;                ///< empty: as it was
    std::vector<std::string> others;  ///< lines to follow it
  };
  std::vector<Normal> normals;
  std::vector<std::uint32_t> number;  ///< of each point's normal, from 1, as written
  bool split = false;
};

std::string normal_text(const Vec3& n) {
  return fmt::format("{:.6f} {:.6f} {:.6f}", n.x, n.y, n.z);
}

/// How many points each normal has, and whether one of them keeps it.
struct NormalUse {
  std::uint32_t points = 0;
  bool kept = false;
};

std::vector<NormalUse> uses_of(const Edit& edit) {
  std::vector<NormalUse> uses;
  for (std::size_t k = 0; k < edit.turned.size(); ++k) {
    const std::size_t n = edit.before.points[k].number;
    if (n >= uses.size()) uses.resize(std::max(n + 1, 2 * uses.size()));
    ++uses[n].points;
    uses[n].kept = uses[n].kept || edit.turned[k] == 0;
  }
  return uses;
}

/// The number that each normal begins with in the file to be written, from 1.
std::vector<std::uint32_t> numbers_of(const std::vector<NormalPlan::Normal>& normals) {
  std::vector<std::uint32_t> numbers;
  std::uint32_t next = 1;
  for (const NormalPlan::Normal& normal : normals) {
    numbers.push_back(next);
    next += 1 + static_cast<std::uint32_t>(normal.others.size());
  }
  return numbers;
}

NormalPlan plan_of(const Edit& edit) {
  const std::vector<NormalUse> uses = uses_of(edit);
  NormalPlan plan;
  plan.normals.resize(uses.size());
  plan.number.resize(edit.turned.size());
  // For normals with several points: by number and text, 0 for the first, then the others.
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> places;
  for (std::size_t k = 0; k < edit.turned.size(); ++k) {
    if (edit.turned[k] == 0) continue;
    const std::uint32_t n = edit.before.points[k].number;
    NormalPlan::Normal& normal = plan.normals[n];
    std::string text = normal_text(edit.normals[k]);
    if (uses[n].points == 1) {
      normal.first = std::move(text);
      continue;
    }
    const auto [place, is_new] = places.emplace(std::pair(n, text), 0);
    if (is_new && !uses[n].kept && normal.first.empty()) {
      normal.first = std::move(text);
    } else if (is_new) {
      normal.others.push_back(std::move(text));
      place->second = static_cast<std::uint32_t>(normal.others.size());
      plan.split = true;
    }
    plan.number[k] = place->second;
  }
  const std::vector<std::uint32_t> numbers = numbers_of(plan.normals);
  for (std::size_t k = 0; k < plan.number.size(); ++k)
    plan.number[k] += numbers[edit.before.points[k].number];
  return plan;
}

class Writer {
 public:
  Writer(std::string_view bytes, const Edit& edit, const NormalPlan& plan)
      : edit_(edit),
        plan_(plan),
        patch_(bytes),
        line_end_(bytes.find("\r\n") < bytes.find('\n') ? "\r\n" : "\n") {}

  void position(const ObjLines&, const std::array<std::string_view, 3>& words) {
    const std::size_t k = position_++;
    for (int c = 0; c < 3; ++c)
      if (edit_.positions[k][c] != edit_.before.positions[k][c])
        patch_.replace(words[static_cast<std::size_t>(c)], number_text(edit_.positions[k][c]));
  }
  void normal(const ObjLines&, const std::array<std::string_view, 3>& words) {
    if (normal_ >= plan_.normals.size()) return;  // used by no face
    const NormalPlan::Normal& normal = plan_.normals[normal_++];
    const char* begin = words[0].data();
    const std::string_view numbers(
        begin, static_cast<std::size_t>(words[2].data() + words[2].size() - begin));
    if (normal.first.empty() && normal.others.empty()) return;
    std::string text = normal.first.empty() ? std::string(numbers) : normal.first;
    for (const std::string& other : normal.others) text += line_end_ + "vn " + other;
    patch_.replace(numbers, text);
  }
  void corner(const ObjLines::Corner& corner) {
    if (!plan_.split) return;
    const std::uint32_t point = points_(corner);
    if (point != no_point) patch_.replace(corner.normal, std::to_string(plan_.number[point]));
  }
  void end_face() {}

  std::string finish() && { return std::move(patch_).finish(); }

 private:
  const Edit& edit_;
  const NormalPlan& plan_;
  Patch patch_;
  PointList points_;
  std::string line_end_;
  std::size_t position_ = 0;
  std::size_t normal_ = 0;
};

}  // namespace

Content obj_content(std::string_view bytes, const std::string& file) {
  Reader reader;
  scan(bytes, file, reader);
  return std::move(reader).finish();
}

std::string edited_obj(std::string_view bytes, const std::string& file, const Edit& edit) {
  const NormalPlan plan = plan_of(edit);
  Writer writer(bytes, edit, plan);
  scan(bytes, file, writer);
  return std::move(writer).finish();
}

}  // namespace wold::mesh_edit
