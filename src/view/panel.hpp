#pragma once
// The panel of parameters: sliders, boxes and the rest, made from descriptions
// (base/parameters.hpp), with a filter, a way back to each parameter's value, undo and redo.
//
// Between Interface::begin and end: `draw`. What changed is told by it, so that the caller can do
// no more than a change asks for (`cost_of`).

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameters.hpp"
#include "scene/scene.hpp"

namespace wold {

/// A described object in the panel.
struct PanelSection {
  std::string name;   ///< as in scene files: "sky", "terrain.step.2"
  std::string title;  ///< "Sun and sky"
  std::shared_ptr<const ParameterSet> parameters;
  void* object = nullptr;
  std::shared_ptr<const void> usual;  ///< the values that "reset" goes back to
  bool open = false;                  ///< at first

  /// `value` and the copy of it that is made now as the usual values; `value` must outlive this.
  template <class T>
  static PanelSection of(std::string name, std::string title, T& value, bool open = false) {
    const ParameterSet set = describe(value);
    return {std::move(name), std::move(title),           std::make_shared<const ParameterSet>(set),
            &value,          std::make_shared<T>(value), open};
  }
};

/// The sections of a scene, in the order of use. They point into the scene, whose lists must not
/// change their lengths.
std::vector<PanelSection> panel_sections(Scene& scene);

/// What has to be made anew, from cheap to dear.
enum class ChangeCost {
  picture,  ///< exposure and tone map
  light,    ///< sun, sky, clouds
  ground,   ///< colours of the ground
  plants,   ///< plants and covers
  terrain,  ///< the ground itself, and all that stands on it
  shader,   ///< the landscape shader
  render    ///< nothing that is drawn: settings of the path tracer
};
ChangeCost cost_of(std::string_view section);

struct ParameterChange {
  std::string section;
  std::string parameter;
  Value before;
  Value after;
  bool finished = true;  ///< false while a slider is being dragged
};

/// What was done, to be undone.
class History {
 public:
  void add(ParameterChange change);
  /// The change that leads back (or forward again); nothing at the end.
  std::optional<ParameterChange> undo();
  std::optional<ParameterChange> redo();
  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < changes_.size(); }
  void clear();

 private:
  std::vector<ParameterChange> changes_;
  std::size_t done_ = 0;
};

class ParameterPanel {
 public:
  /// Draws the panel at the left border. While a slider is dragged its changes come with `finished`
  /// false; the last one, from the value before the drag, with `finished` true.
  std::vector<ParameterChange> draw(std::span<PanelSection> sections, std::string_view title);

  /// Both set the value in its section, and return what changed.
  std::optional<ParameterChange> undo(std::span<PanelSection> sections);
  std::optional<ParameterChange> redo(std::span<PanelSection> sections);
  /// The sections are those of another scene now.
  void forget();

  /// Pixels that it takes of the window's width, at most; 0 before it is drawn.
  float width() const { return width_; }

 private:
  using Changes = std::vector<ParameterChange>;
  void draw_section(PanelSection& section, Changes& changes);
  void draw_parameter(PanelSection& section, const Parameter& parameter, Changes& changes);
  void finish_drag(std::span<PanelSection> sections, Changes& changes);
  bool shown(const PanelSection& section, const Parameter& parameter) const;

  History history_;
  std::optional<ParameterChange> drag_;
  std::string filter_;
  std::string wrong_;  // why the text just typed is not allowed
  std::string wrong_parameter_;
  float width_ = 0;
};

}  // namespace wold
