#include "plants/turtle.hpp"

#include <fmt/format.h>

#include <cmath>

namespace wold {

namespace {

/// The turtle's frame, in double precision: a word has many small turns.
struct Frame {
  DVec3 heading{0, 0, 1};
  DVec3 left{-1, 0, 0};
  DVec3 up{0, -1, 0};

  void turn_left(double angle) { rotate(heading, left, angle); }
  void pitch_down(double angle) { rotate(heading, up, -angle); }
  void roll_left(double angle) { rotate(left, up, -angle); }

  void level() {
    const DVec3 horizontal = glm::cross(DVec3(0, 0, 1), heading);
    const double length = glm::length(horizontal);
    if (length < 1e-9) return;
    left = horizontal / length;
    up = glm::cross(heading, left);
  }

  /// Turns the heading towards `target` (unit) by e |H × T| times `weight`.
  void bend(const DVec3& target, double e) {
    const DVec3 axis = glm::cross(heading, target);
    const double sine = glm::length(axis);
    if (sine < 1e-9 || e == 0) return;
    const double angle = e * sine;
    const DVec3 unit = axis / sine;
    heading = glm::normalize(rotated(heading, unit, angle));
    left = rotated(left, unit, angle);
    left = glm::normalize(left - glm::dot(left, heading) * heading);
    up = glm::cross(heading, left);
  }

 private:
  static void rotate(DVec3& from, DVec3& to, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const DVec3 a = c * from + s * to;
    to = c * to - s * from;
    from = a;
  }
  /// Rodrigues' rotation.
  static DVec3 rotated(const DVec3& v, const DVec3& axis, double angle) {
    const double c = std::cos(angle);
    return c * v + std::sin(angle) * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
  }
};

struct State {
  DVec3 position{0};
  Frame frame;
  double radius = 0;
  double bending = 0;
  int colour = 0;
  int axis = -1;       ///< that this point lies on; -1: none
  int node = 0;        ///< there
  bool begins = true;  ///< the next F begins an axis
};

class Turtle {
 public:
  explicit Turtle(const TurtleSettings& settings) : settings_(settings) {
    state_.radius = settings.radius;
    state_.bending = settings.bending;
  }

  Skeleton read(const Word& word) {
    for (place_ = 0; place_ < word.modules.size(); ++place_) {
      const Module& m = word.modules[place_];
      parameters_ = word.parameters(m);
      for (const double x : parameters_)
        if (!std::isfinite(x)) fail(m, "has a parameter that is not a finite number");
      if (m.symbol == '%') {
        skip_branch(word);
      } else {
        obey(m);
      }
    }
    if (!stack_.empty()) fail_word("'[' is never closed");
    if (!open_polygons_.empty()) fail_word("'{' is never closed");
    return std::move(skeleton_);
  }

 private:
  double parameter(double otherwise) const {
    return parameters_.empty() ? otherwise : parameters_[0];
  }
  double angle() const { return radians(parameter(settings_.angle)); }

  [[noreturn]] void fail(const Module& m, const std::string& what) const {
    throw Error(ErrorKind::input, fmt::format("module {} of the word, '{}', {}", place_ + 1,
                                              symbol_text(m.symbol), what));
  }
  [[noreturn]] static void fail_word(const std::string& what) {
    throw Error(ErrorKind::input, what + " in the derived word");
  }

  void obey(const Module& m) {
    switch (m.symbol) {
      case 'F': forward(true, true); break;
      case 'G': forward(true, false); break;
      case 'f': forward(false, true); break;
      case '+': state_.frame.turn_left(angle()); break;
      case '-': state_.frame.turn_left(-angle()); break;
      case '&': state_.frame.pitch_down(angle()); break;
      case '^': state_.frame.pitch_down(-angle()); break;
      case '\\': state_.frame.roll_left(angle()); break;
      case '/': state_.frame.roll_left(-angle()); break;
      case '|': state_.frame.turn_left(pi_d); break;
      case '$': state_.frame.level(); break;
      case '!': state_.radius = parameter(state_.radius * settings_.radius_factor); break;
      case '\'': state_.colour = static_cast<int>(parameter(state_.colour + 1)); break;
      case extension_symbol + 't': state_.bending = parameter(0); break;
      case '[': push(); break;
      case ']': pop(m); break;
      case '{': open_polygons_.push_back({state_.colour, {}}); break;
      case '.': vertex(m); break;
      case '}': close_polygon(m); break;
      default:
        if (m.symbol >= organ_symbol && m.symbol < extension_symbol) organ(m);
    }
  }

  void push() {
    stack_.push_back(state_);
    state_.begins = true;
  }

  void pop(const Module& m) {
    if (stack_.empty()) fail(m, "has no '[' before it");
    state_ = stack_.back();
    stack_.pop_back();
  }

  void skip_branch(const Word& word) {
    int depth = 0;
    for (; place_ + 1 < word.modules.size(); ++place_) {
      const Symbol next = word.modules[place_ + 1].symbol;
      if (next == ']' && depth == 0) return;
      depth += next == '[' ? 1 : (next == ']' ? -1 : 0);
    }
  }

  void forward(bool draws, bool records) {
    const double length = parameter(settings_.step);
    const DVec3 target = state_.position + length * state_.frame.heading;
    if (!open_polygons_.empty()) {
      if (records) open_polygons_.back().vertices.emplace_back(target);
    } else if (draws) {
      segment(target);
    } else {
      state_.begins = true;
      state_.axis = -1;
    }
    state_.position = target;
    if (draws) {
      const double scale = settings_.tropism_per_metre ? length : 1;
      state_.frame.bend(glm::normalize(DVec3(settings_.tropism)), state_.bending * scale);
    }
  }

  Skeleton::Axis& axis_of_state() { return skeleton_.axes[static_cast<std::size_t>(state_.axis)]; }

  void segment(const DVec3& target) {
    const auto radius = static_cast<float>(state_.radius);
    const bool recoloured = state_.axis >= 0 && axis_of_state().colour != state_.colour;
    if (state_.begins || recoloured) {
      const Skeleton::Node start{Vec3(state_.position), radius};
      skeleton_.axes.push_back({state_.axis, state_.node, state_.colour, {start}});
      state_.axis = static_cast<int>(std::ssize(skeleton_.axes)) - 1;
      state_.node = 0;
      state_.begins = false;
    }
    auto& nodes = axis_of_state().nodes;
    nodes.push_back({Vec3(target), radius});
    state_.node = static_cast<int>(std::ssize(nodes)) - 1;
  }

  void vertex(const Module& m) {
    if (open_polygons_.empty()) fail(m, "is outside '{' and '}'");
    open_polygons_.back().vertices.emplace_back(state_.position);
  }

  void close_polygon(const Module& m) {
    if (open_polygons_.empty()) fail(m, "has no '{' before it");
    if (open_polygons_.back().vertices.size() >= 3)
      skeleton_.polygons.push_back(std::move(open_polygons_.back()));
    open_polygons_.pop_back();
  }

  void organ(const Module& m) {
    skeleton_.organs.push_back({static_cast<char>(m.symbol - organ_symbol), Vec3(state_.position),
                                Vec3(state_.frame.heading), Vec3(state_.frame.up),
                                static_cast<float>(parameter(1))});
  }

  const TurtleSettings& settings_;
  Skeleton skeleton_;
  State state_;
  std::vector<State> stack_;
  std::vector<Skeleton::Polygon> open_polygons_;
  std::span<const double> parameters_;
  std::size_t place_ = 0;
};

}  // namespace

Description<TurtleSettings> describe(const TurtleSettings&) {
  return Description<TurtleSettings>("turtle", "How a word is drawn.")
      .add("angle", &TurtleSettings::angle, {.unit = "degrees", .min = -360, .max = 360},
           "Turn of + - & ^ \\ / without an argument.")
      .add("step", &TurtleSettings::step, {.unit = "m", .min = 0, .max = 1e6},
           "Length of F, f and G without an argument.")
      .add("radius", &TurtleSettings::radius, {.unit = "m", .min = 0, .max = 1e4},
           "Radius of the stem at its foot.")
      .add("radius_factor", &TurtleSettings::radius_factor, {.min = 0, .max = 10},
           "What ! without an argument multiplies the radius by.")
      .add("tropism", &TurtleSettings::tropism, {.min = -1, .max = 1},
           "Direction towards which branches bend.")
      .add("bending", &TurtleSettings::bending, {.min = -100, .max = 100},
           "Turn towards the tropism after each F, in radians, for a branch at right angles to it.")
      .add("bending_per_metre", &TurtleSettings::tropism_per_metre,
           "Whether bending is per metre of F rather than per F.");
}

Skeleton draw(const Word& word, const TurtleSettings& settings) {
  return Turtle(settings).read(word);
}

}  // namespace wold
