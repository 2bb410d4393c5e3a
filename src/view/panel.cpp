#include "view/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "view/interface.hpp"
#include "view/parameter_widgets.hpp"

namespace wold {

namespace {

ImVec4 color(const Vec4& c) {
  return {c.x, c.y, c.z, c.w};
}

bool contains(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

void tooltip(const Parameter& p, const std::string& usual) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
  ImGui::TextUnformatted(p.text.c_str());
  ImGui::PushStyleColor(ImGuiCol_Text, color(palette::quiet));
  ImGui::TextUnformatted(fmt::format("{}: {}", p.name, p.allowed()).c_str());
  ImGui::TextUnformatted(fmt::format("In the scene: {}", usual).c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::optional<ParameterChange> applied(std::optional<ParameterChange> change,
                                       std::span<PanelSection> sections) {
  if (!change) return change;
  for (PanelSection& section : sections)
    if (section.name == change->section) {
      section.parameters->assign(section.object, change->parameter, change->after);
      return change;
    }
  return {};
}

template <class T>
void add_each(std::vector<PanelSection>& list, const char* name, const char* what,
              std::vector<T>& items) {
  for (std::size_t k = 0; k < items.size(); ++k)
    list.push_back(PanelSection::of(fmt::format("{}.{}", name, k),
                                    fmt::format("{} {}", what, k + 1), items[k]));
}

void add_named(std::vector<PanelSection>& list, std::vector<SpeciesSettings>& items) {
  for (std::size_t k = 0; k < items.size(); ++k)
    list.push_back(PanelSection::of(fmt::format("species.{}", k),
                                    fmt::format("Species: {}", items[k].name), items[k]));
}

}  // namespace

std::vector<PanelSection> panel_sections(Scene& scene) {
  std::vector<PanelSection> list;
  list.push_back(PanelSection::of("sky", "Sun, sky and clouds", scene.sky, true));
  list.push_back(PanelSection::of("picture", "Exposure and tone", scene.picture));
  list.push_back(PanelSection::of("ground", "Colours of the ground", scene.ground));
  for (std::size_t k = 0; k < scene.steps.size(); ++k) {
    TerrainStep& step = scene.steps[k];
    const std::string title = fmt::format("Terrain {}: {}", k + 1, title_of(step.op));
    const auto usual = std::make_shared<Described>(step.parameters);
    list.push_back({fmt::format("terrain.step.{}", k), title,
                    std::make_shared<const ParameterSet>(step.parameters.parameters()),
                    step.parameters.data(), std::shared_ptr<const void>(usual, usual->data()),
                    false});
    list.push_back(PanelSection::of(fmt::format("terrain.step.{}.settings", k),
                                    fmt::format("{}, where and how much", title), step.settings));
  }
  list.push_back(PanelSection::of("terrain", "Size of the terrain", scene.terrain));
  list.push_back(PanelSection::of("surroundings", "Surroundings", scene.surroundings));
  list.push_back(PanelSection::of("water", "Water", scene.water));
  add_each(list, "cover", "Cover", scene.covers);
  add_named(list, scene.species);
  add_each(list, "scatter", "Scattered plants", scene.scatter);
  add_each(list, "grid", "Planted grid", scene.grids);
  list.push_back(PanelSection::of("render", "Path tracing", scene.render));
  return list;
}

ChangeCost cost_of(std::string_view section) {
  const std::string_view head = section.substr(0, section.find('.'));
  if (head == "picture") return ChangeCost::picture;
  if (head == "sky") return ChangeCost::light;
  if (head == "ground") return ChangeCost::ground;
  if (head == "render") return ChangeCost::render;
  if (head == "shader") return ChangeCost::shader;
  for (const std::string_view planted : {"species", "scatter", "grid", "cover", "material"})
    if (head == planted) return ChangeCost::plants;
  return ChangeCost::terrain;
}

void History::add(ParameterChange change) {
  changes_.resize(done_);
  changes_.push_back(std::move(change));
  ++done_;
}

std::optional<ParameterChange> History::undo() {
  if (!can_undo()) return {};
  ParameterChange back = changes_[--done_];
  std::swap(back.before, back.after);
  return back;
}

std::optional<ParameterChange> History::redo() {
  if (!can_redo()) return {};
  return changes_[done_++];
}

void History::clear() {
  changes_.clear();
  done_ = 0;
}

std::optional<ParameterChange> ParameterPanel::undo(std::span<PanelSection> sections) {
  return applied(history_.undo(), sections);
}
std::optional<ParameterChange> ParameterPanel::redo(std::span<PanelSection> sections) {
  return applied(history_.redo(), sections);
}

void ParameterPanel::forget() {
  history_.clear();
  drag_.reset();
  wrong_.clear();
}

bool ParameterPanel::shown(const PanelSection& section, const Parameter& p) const {
  return filter_.empty() || contains(title_of(p.name), filter_) || contains(p.name, filter_) ||
         contains(section.title, filter_);
}

std::vector<ParameterChange> ParameterPanel::draw(std::span<PanelSection> sections,
                                                  std::string_view title) {
  Changes changes;
  const float em = ImGui::GetFontSize();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float height = screen.y - 1.9F * em - 1.4F * em;
  ImGui::SetNextWindowPos({0.7F * em, 0.7F * em});
  ImGui::SetNextWindowSizeConstraints({15 * em, std::max(height, 1.0F)},
                                      {std::max(0.8F * screen.x, 15 * em), std::max(height, 1.0F)});
  ImGui::SetNextWindowSize({27 * em, height}, ImGuiCond_FirstUseEver);
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
  if (ImGui::Begin("##panel", nullptr, flags)) {
    width_ = ImGui::GetWindowWidth() + 0.7F * em;
    ImGui::TextUnformatted(title.data(), title.data() + title.size());
    const auto button = [&](const char* label, bool can, const char* what) {
      ImGui::BeginDisabled(!can);
      const bool clicked = ImGui::SmallButton(label);
      ImGui::EndDisabled();
      if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", what);
      return clicked;
    };
    ImGui::SameLine(ImGui::GetWindowWidth() - 4.6F * em);
    if (button("↶", history_.can_undo(), "Undo (Ctrl+Z)"))
      if (auto change = undo(sections)) changes.push_back(std::move(*change));
    ImGui::SameLine(0, 0.3F * em);
    if (button("↷", history_.can_redo(), "Do again (Ctrl+Y)"))
      if (auto change = redo(sections)) changes.push_back(std::move(*change));
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "Find a parameter", &filter_);
    ImGui::Spacing();
    if (ImGui::BeginChild("sections"))
      for (PanelSection& section : sections) draw_section(section, changes);
    ImGui::EndChild();
  }
  ImGui::End();
  finish_drag(sections, changes);
  return changes;
}

void ParameterPanel::draw_section(PanelSection& section, Changes& changes) {
  const ParameterSet& set = *section.parameters;
  if (std::none_of(set.parameters.begin(), set.parameters.end(),
                   [&](const Parameter& p) { return shown(section, p); }))
    return;
  ImGui::PushID(section.name.c_str());
  if (filter_.empty())
    ImGui::SetNextItemOpen(section.open, ImGuiCond_Once);
  else
    ImGui::SetNextItemOpen(true);
  const bool open = ImGui::CollapsingHeader(section.title.c_str());
  if (ImGui::IsItemHovered() && !set.text.empty()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
    ImGui::TextUnformatted(set.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  if (open && ImGui::BeginTable("parameters", 3, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.6F * ImGui::GetFontSize());
    for (const Parameter& p : set.parameters)
      if (shown(section, p)) draw_parameter(section, p, changes);
    ImGui::EndTable();
    ImGui::Spacing();
  }
  ImGui::PopID();
}

void ParameterPanel::draw_parameter(PanelSection& section, const Parameter& p, Changes& changes) {
  const Value before = p.get(section.object);
  const Value usual = p.get(section.usual.get());
  const bool differs = before != usual;
  ImGui::PushID(p.name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, color(differs ? palette::changed : palette::text));
  ImGui::TextUnformatted(title_of(p.name).c_str());
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) tooltip(p, to_text(usual));

  ImGui::TableNextColumn();
  ImGui::PushItemWidth(-1);
  std::optional<Value> after;
  const std::string place = section.name + "." + p.name;
  try {
    after = edit_parameter(p, before, usual);
    if (after) section.parameters->assign(section.object, p.name, *after);
    if (after && wrong_parameter_ == place) wrong_.clear();
  } catch (const Error& error) {
    after.reset();
    wrong_ = error.message();
    wrong_parameter_ = place;
  }
  ImGui::PopItemWidth();
  if (!wrong_.empty() && wrong_parameter_ == place) {
    ImGui::PushStyleColor(ImGuiCol_Text, {0.95F, 0.45F, 0.40F, 1});
    ImGui::TextWrapped("%s", wrong_.c_str());
    ImGui::PopStyleColor();
  }

  ImGui::TableNextColumn();
  if (differs) {
    if (ImGui::Button("↺", {ImGui::GetFrameHeight(), ImGui::GetFrameHeight()})) {
      p.set(section.object, usual);
      after = usual;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Back to %s", to_text(usual).c_str());
  }
  ImGui::PopID();

  if (!after || p.get(section.object) == before) return;
  ParameterChange change{section.name, p.name, before, p.get(section.object), false};
  if (!drag_) drag_ = change;
  changes.push_back(std::move(change));
}

void ParameterPanel::finish_drag(std::span<PanelSection> sections, Changes& changes) {
  if (!drag_ || ImGui::IsAnyItemActive()) return;
  for (const PanelSection& section : sections) {
    if (section.name != drag_->section) continue;
    drag_->after = section.parameters->find(drag_->parameter)->get(section.object);
    drag_->finished = true;
    // What ended in this very frame has been told of already, unfinished.
    std::erase_if(changes, [&](const ParameterChange& c) {
      return !c.finished && c.section == drag_->section && c.parameter == drag_->parameter;
    });
    if (drag_->before != drag_->after) history_.add(*drag_);
    changes.push_back(*drag_);
  }
  drag_.reset();
}

}  // namespace wold
