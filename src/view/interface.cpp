#include "view/interface.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/error.hpp"

namespace wold {

namespace {

constexpr float letter_size = 15;  // pixels

// Where Debian, Fedora and Arch keep DejaVu Sans.
constexpr std::array font_files{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                "/usr/share/fonts/TTF/DejaVuSans.ttf"};

// Latin with its extensions, dashes and quotes, arrows, mathematical signs, shapes and dice.
constexpr std::array<ImWchar, 19> letters{0x20,   0x24F,  0x370,  0x3FF,  0x2010, 0x2044, 0x2070,
                                          0x209F, 0x2190, 0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF,
                                          0x2600, 0x27BF, 0x2A2F, 0x2A2F, 0};

void load_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  for (const char* file : font_files) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    if (io.Fonts->AddFontFromFileTTF(file, letter_size * scale, &config, letters.data()) != nullptr)
      return;
  }
  ImFontConfig config;
  config.SizePixels = 13 * scale;
  io.Fonts->AddFontDefault(&config);
}

ImVec4 color(const Vec4& c, float alpha = 1) {
  return {c.x, c.y, c.z, c.w * alpha};
}
ImVec4 grey(float value, float alpha = 1) {
  return {value, value * 1.04F, value * 1.07F, alpha};  // a little cold, as a sky in the evening
}

void set_shapes(ImGuiStyle& style) {
  style.WindowRounding = 6;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 5;
  style.GrabRounding = 3;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 1;
  style.FrameBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowPadding = {12, 10};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {3, 2};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 7;
  style.WindowTitleAlign = {0, 0.5F};
}

void set_colors(ImGuiStyle& style) {
  const auto set = [&](ImGuiCol which, const ImVec4& value) { style.Colors[which] = value; };
  const Vec4& accent = palette::accent;
  set(ImGuiCol_Text, color(palette::text));
  set(ImGuiCol_TextDisabled, color(palette::quiet));
  set(ImGuiCol_WindowBg, color(palette::panel));
  set(ImGuiCol_ChildBg, {0, 0, 0, 0});
  set(ImGuiCol_PopupBg, grey(0.10F, 0.98F));
  set(ImGuiCol_Border, grey(0.9F, 0.10F));
  set(ImGuiCol_FrameBg, grey(0.9F, 0.075F));
  set(ImGuiCol_FrameBgHovered, grey(0.9F, 0.13F));
  set(ImGuiCol_FrameBgActive, grey(0.9F, 0.17F));
  set(ImGuiCol_TitleBg, grey(0.07F));
  set(ImGuiCol_TitleBgActive, grey(0.07F));
  set(ImGuiCol_ScrollbarBg, {0, 0, 0, 0});
  set(ImGuiCol_ScrollbarGrab, grey(0.9F, 0.16F));
  set(ImGuiCol_ScrollbarGrabHovered, grey(0.9F, 0.26F));
  set(ImGuiCol_ScrollbarGrabActive, grey(0.9F, 0.36F));
  set(ImGuiCol_CheckMark, color(accent));
  set(ImGuiCol_SliderGrab, color(accent, 0.62F));
  set(ImGuiCol_SliderGrabActive, color(accent));
  set(ImGuiCol_Button, grey(0.9F, 0.09F));
  set(ImGuiCol_ButtonHovered, grey(0.9F, 0.18F));
  set(ImGuiCol_ButtonActive, color(accent, 0.45F));
  set(ImGuiCol_Header, grey(0.9F, 0.06F));
  set(ImGuiCol_HeaderHovered, grey(0.9F, 0.13F));
  set(ImGuiCol_HeaderActive, grey(0.9F, 0.18F));
  set(ImGuiCol_Separator, grey(0.9F, 0.10F));
  set(ImGuiCol_ResizeGrip, grey(0.9F, 0.08F));
  set(ImGuiCol_ResizeGripHovered, color(accent, 0.5F));
  set(ImGuiCol_ResizeGripActive, color(accent, 0.8F));
  set(ImGuiCol_PlotHistogram, color(accent));
  set(ImGuiCol_TextSelectedBg, color(accent, 0.35F));
  set(ImGuiCol_NavHighlight, color(accent, 0.8F));
}

}  // namespace

Interface::Interface(float scale, GLFWwindow* window)
    : scale_(std::clamp(scale, 0.5F, 5.0F)), window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // a viewer leaves no files behind
  ImGui::StyleColorsDark();
  set_shapes(ImGui::GetStyle());
  set_colors(ImGui::GetStyle());
  ImGui::GetStyle().ScaleAllSizes(scale_);
  load_font(scale_);
  if (window_ != nullptr) ImGui_ImplGlfw_InitForOpenGL(window_, true);
  if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
    throw Error(ErrorKind::limit, "Dear ImGui cannot draw with this OpenGL driver");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::begin(IVec2 size, double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(std::max(size.x, 1)),
                      static_cast<float>(std::max(size.y, 1))};
    io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  }
  ImGui::NewFrame();
}

void Interface::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wants_mouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}
bool Interface::wants_keys() const {
  return ImGui::GetIO().WantTextInput;
}

void Interface::ignore_mouse(bool ignore) {
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags = ignore ? io.ConfigFlags | ImGuiConfigFlags_NoMouse
                          : io.ConfigFlags & ~ImGuiConfigFlags_NoMouse;
}

}  // namespace wold
