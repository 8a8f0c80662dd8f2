#include "viewer/platform/imgui_host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace etendue::viewer {
namespace {

constexpr std::pair<ImGuiKey, int> kKeyMap[] = {
    {ImGuiKey_Tab, GLFW_KEY_TAB},
    {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
    {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
    {ImGuiKey_UpArrow, GLFW_KEY_UP},
    {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
    {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
    {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
    {ImGuiKey_Home, GLFW_KEY_HOME},
    {ImGuiKey_End, GLFW_KEY_END},
    {ImGuiKey_Insert, GLFW_KEY_INSERT},
    {ImGuiKey_Delete, GLFW_KEY_DELETE},
    {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
    {ImGuiKey_Space, GLFW_KEY_SPACE},
    {ImGuiKey_Enter, GLFW_KEY_ENTER},
    {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
    {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
    {ImGuiKey_A, GLFW_KEY_A},
    {ImGuiKey_C, GLFW_KEY_C},
    {ImGuiKey_V, GLFW_KEY_V},
    {ImGuiKey_X, GLFW_KEY_X},
    {ImGuiKey_Y, GLFW_KEY_Y},
    {ImGuiKey_Z, GLFW_KEY_Z},
};

constexpr float kDoubleClickTime = 0.3f;  // seconds

const char* get_clipboard(void* platform) {
  static std::string text;  // Dear ImGui reads it after this call returns
  text = static_cast<Platform*>(platform)->clipboard();
  return text.c_str();
}

void set_clipboard(void* platform, const char* text) { static_cast<Platform*>(platform)->set_clipboard(text); }

Cursor cursor_for(ImGuiMouseCursor cursor) {
  switch (cursor) {
    case ImGuiMouseCursor_TextInput:
      return Cursor::text;
    case ImGuiMouseCursor_ResizeEW:
      return Cursor::resize_horizontal;
    case ImGuiMouseCursor_ResizeNS:
      return Cursor::resize_vertical;
    case ImGuiMouseCursor_Hand:
      return Cursor::hand;
    default:
      return Cursor::arrow;
  }
}

}  // namespace

ImguiHost::ImguiHost(Platform& platform) : platform_(platform) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.Fonts->Flags |= ImFontAtlasFlags_NoBakedLines;  // they need the linear filtering that set_font_filter turns off
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.ClipboardUserData = &platform;
  io.GetClipboardTextFn = get_clipboard;
  io.SetClipboardTextFn = set_clipboard;
  io.ConfigInputTextCursorBlink = platform.has_display();
  for (const auto& [key, code] : kKeyMap) io.KeyMap[key] = code;
}

ImguiHost::~ImguiHost() {
  if (started_) ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

Result<void> ImguiHost::start() {
  started_ = ImGui_ImplOpenGL3_Init("#version 330 core");
  if (!started_) return usage_error("view: the interface cannot load OpenGL; install libgl1");
  return {};
}

void ImguiHost::begin_frame(const Input& input, float seconds) {
  ImGuiIO& io = ImGui::GetIO();
  const Vec2i size = platform_.size();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  // Each press and release takes a frame of its own, so slow frames stretch a double click. Scripts count frames: their
  // clock advances little in a slow frame, and the time of a double click is constant.
  constexpr float kFramesOfDoubleClick = 3;
  constexpr float kMaxFrame = 0.2f;
  constexpr float kMaxScriptFrame = 0.05f;
  const bool is_scripted = !platform_.has_display();
  const float stretch = is_scripted ? 0 : kFramesOfDoubleClick * std::min(seconds, kMaxFrame);
  io.MouseDoubleClickTime = kDoubleClickTime + stretch;
  io.DeltaTime = std::max(is_scripted ? std::min(seconds, kMaxScriptFrame) : seconds, 1e-4f);
  io.MousePos = input.mouse.x < -1e5f ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(input.mouse.x, input.mouse.y);
  for (size_t b = 0; b < input.buttons.size(); ++b) io.MouseDown[b] = input.buttons[b];
  io.MouseWheel = input.wheel;
  for (size_t k = 0; k < static_cast<size_t>(kKeys); ++k) io.KeysDown[k] = input.keys[k];
  // Tab leads from one text field to the next. Otherwise it is a shortcut and must not activate a text field.
  if (!io.WantTextInput) io.KeysDown[GLFW_KEY_TAB] = false;
  io.KeyCtrl = input.control();
  io.KeyShift = input.shift();
  io.KeyAlt = input.alt();
  for (const unsigned c : input.text) io.AddInputCharacter(c);
  ImGui_ImplOpenGL3_NewFrame();
  upload_changed_fonts();
  set_font_filter();
  ImGui::NewFrame();
}

void ImguiHost::upload_changed_fonts() {
  if (ImGui::GetIO().Fonts->IsBuilt()) return;
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  filtered_ = 0;
}

// Glyphs are aligned to whole pixels, so linear filtering has no effect but takes a quarter of the time in software
// OpenGL.
void ImguiHost::set_font_filter() {
  const auto texture = static_cast<GLuint>(reinterpret_cast<uintptr_t>(ImGui::GetIO().Fonts->TexID));
  if (texture == filtered_) return;
  const Gl& gl = platform_.gl();
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  filtered_ = texture;
}

void ImguiHost::end_frame() {
  ImGui::Render();
  platform_.set_cursor(cursor_for(ImGui::GetMouseCursor()));
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace etendue::viewer
