// Steps that act like a user: clicks, drags, keys, and values of widgets. All of them use the event queue or the widget
// of a name.
#include <imgui.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "render/document.h"
#include "viewer/platform/platform.h"
#include "viewer/script/name_aliases.h"
#include "viewer/script/step.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/unicode.h"

namespace etendue::viewer {
namespace {

constexpr int kSearchFrames = 12;  // in which an item may be scrolled into view
constexpr const char* kNotOnScreen = "there is no item of this name on screen; see etendue list widgets";

// Requests a value from the widget of a parameter.
class SetStep final : public Step {
 public:
  SetStep(std::string name, std::string value) : name_(std::move(name)), value_(std::move(value)) {}

  StepStatus advance(AppState& state) override {
    ItemRegistry& items = state.ui.items;
    if (frame_++ == 0) {
      if (!reveal(state)) return impossible("there is no parameter of this name; see etendue list widgets");
      items.request(name_, value_);
      return {};
    }
    if (answered_) return {.done = reaction_.advance()};
    if (const auto error = items.take_answer()) {
      answered_ = error->empty();
      return {.error = *error};
    }
    if (frame_ <= kSearchFrames) return {};
    items.cancel_request();
    const auto value = render::get(state.document(), name_);
    return impossible(value ? "its widget is not on screen: another integrator, sampler or object is selected"
                            : value.error().message);
  }

 private:
  bool reveal(AppState& state) const {
    if (name_.starts_with("files.")) return state.files.request.has_value();
    if (name_.starts_with("preferences.")) return state.interface.preferences_open = true;
    if (name_ == "layout.filter" || name_ == "layout.bottom-filter" || name_ == "timeline.fps")
      return state.interface.visible = true;
    if (!state.panels.reveal_parameter(state, name_)) return false;
    state.interface.visible = true;
    return true;
  }

  std::string name_;
  std::string value_;
  int frame_ = 0;
  bool answered_ = false;
  FrameDelay reaction_{1};
};

// Whether a press at this position would be the second click of a double click. Steps wait until it is not.
bool completes_double_click(Button button, Vec2 position) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto b = static_cast<size_t>(button);
  const Vec2 movement = position - Vec2(io.MouseClickedPos[b].x, io.MouseClickedPos[b].y);
  return ImGui::GetTime() - io.MouseClickedTime[b] <= static_cast<double>(io.MouseDoubleClickTime) &&
         glm::length(movement) <= io.MouseDoubleClickMaxDist;
}

// Moves the pointer, presses a button, moves in steps, and releases the button. A click if both positions are equal.
class DragStep final : public Step {
 public:
  DragStep(Vec2 from, Vec2 to, Button button) : from_(from), to_(to), button_(button) {}

  StepStatus advance(AppState& state) override {
    EventQueue& events = state.platform.events();
    constexpr int kPress = 2;
    constexpr int kFirstMove = 4;
    constexpr int kMoves = 8;
    const bool is_click = from_ == to_;
    const int release = is_click ? kFirstMove : kFirstMove + kMoves + 1;
    if (frame_ == 0) events.push({.type = Event::Type::move, .position = from_});
    if (frame_ == kPress) {
      if (completes_double_click(button_, from_)) return {};
      events.push({.type = Event::Type::button, .button = button_, .down = true});
    }
    if (frame_ >= kFirstMove && frame_ < kFirstMove + kMoves && !is_click) {
      const float share = static_cast<float>(frame_ - kFirstMove + 1) / kMoves;
      events.push({.type = Event::Type::move, .position = glm::mix(from_, to_, share)});
    }
    if (frame_ == release) events.push({.type = Event::Type::button, .button = button_, .down = false});
    return {.done = frame_++ > release + 2};
  }

 private:
  Vec2 from_;
  Vec2 to_;
  Button button_;
  int frame_ = 0;
};

Vec2 centre_of(const Placement& placement) { return placement.corner + placement.size * 0.5f; }

// Clicks an item that is on screen; otherwise runs the action of that name.
class ClickStep final : public Step {
 public:
  ClickStep(const std::string& item, Button button) : item_(current_name(item)), button_(button) {}

  StepStatus advance(AppState& state) override {
    if (click_) return click_->advance(state);
    // The action may have brought its own button on screen, which is not clicked then.
    if (ran_) return {.done = reaction_.advance()};
    const Placement* placement = state.ui.items.find(item_);
    const Action* action = state.actions.find(item_);
    if (action && !action->is_enabled(state)) return impossible("it is disabled");
    if (placement) {
      state.ui.items.scroll_to("");
      click_.emplace(centre_of(*placement), centre_of(*placement), button_);
      return click_->advance(state);
    }
    if (action) {
      action->run(state);
      ran_ = true;
      return {};
    }
    state.interface.visible = true;
    state.ui.items.scroll_to(item_);
    return ++frame_ <= kSearchFrames ? StepStatus{} : impossible(kNotOnScreen);
  }

 private:
  std::string item_;
  Button button_;
  std::optional<DragStep> click_;
  int frame_ = 0;
  bool ran_ = false;
  FrameDelay reaction_{2};
};

// A drag that starts at the centre of an item.
class ItemDragStep final : public Step {
 public:
  ItemDragStep(const std::string& item, Vec2 movement) : item_(current_name(item)), movement_(movement) {}

  StepStatus advance(AppState& state) override {
    if (!drag_) {
      const Placement* placement = state.ui.items.find(item_);
      if (!placement) {
        state.ui.items.scroll_to(item_);
        return ++frame_ <= kSearchFrames ? StepStatus{} : impossible(kNotOnScreen);
      }
      state.ui.items.scroll_to("");
      const Vec2 from = centre_of(*placement);
      drag_.emplace(from, from + movement_, Button::left);
    }
    return drag_->advance(state);
  }

 private:
  std::string item_;
  Vec2 movement_;
  std::optional<DragStep> drag_;
  int frame_ = 0;
};

// Two clicks at the centre of an item in quick succession.
class DoubleClickStep final : public Step {
 public:
  explicit DoubleClickStep(const std::string& item) : item_(current_name(item)) {}

  StepStatus advance(AppState& state) override {
    EventQueue& events = state.platform.events();
    if (frame_ == 0) {
      const Placement* placement = state.ui.items.find(item_);
      if (!placement) {
        state.ui.items.scroll_to(item_);
        return ++search_frame_ <= kSearchFrames ? StepStatus{} : impossible(kNotOnScreen);
      }
      state.ui.items.scroll_to("");
      position_ = centre_of(*placement);
      events.push({.type = Event::Type::move, .position = position_});
    }
    if (frame_ == kFirstPress && completes_double_click(Button::left, position_)) return {};
    for (const int press : {kFirstPress, kFirstPress + 2}) {
      if (frame_ == press) events.push({.type = Event::Type::button, .button = Button::left, .down = true});
      if (frame_ == press + 1) events.push({.type = Event::Type::button, .button = Button::left, .down = false});
    }
    return {.done = frame_++ > kFirstPress + 5};
  }

 private:
  static constexpr int kFirstPress = 2;
  std::string item_;
  Vec2 position_{0};
  int frame_ = 0;
  int search_frame_ = 0;
};

class ScrollStep final : public Step {
 public:
  ScrollStep(Vec2 position, float notches) : position_(position), notches_(notches) {}

  StepStatus advance(AppState& state) override {
    EventQueue& events = state.platform.events();
    if (frame_ == 0) events.push({.type = Event::Type::move, .position = position_});
    if (frame_ == 2) events.push({.type = Event::Type::scroll, .position = Vec2(0, notches_)});
    return {.done = frame_++ > 4};
  }

 private:
  Vec2 position_;
  float notches_;
  int frame_ = 0;
};

// Presses and releases a key with its modifiers.
class KeyStep final : public Step {
 public:
  explicit KeyStep(Chord chord) : chord_(chord) {}

  StepStatus advance(AppState& state) override {
    EventQueue& events = state.platform.events();
    if (frame_ == 0) {
      push_modifiers(events, true);
      events.push({.type = Event::Type::key, .key = chord_.key, .down = true});
      push_character(events);
    }
    if (frame_ == 2) {
      events.push({.type = Event::Type::key, .key = chord_.key, .down = false});
      push_modifiers(events, false);
    }
    return {.done = frame_++ > 4};
  }

 private:
  void push_modifiers(EventQueue& events, bool down) const {
    constexpr int kShift = 340;  // GLFW_KEY_LEFT_SHIFT, ...
    constexpr int kControl = 341;
    constexpr int kAlt = 342;
    const auto push = [&](int key) { events.push({.type = Event::Type::key, .key = key, .down = down}); };
    if (chord_.control) push(kControl);
    if (chord_.shift) push(kShift);
    if (chord_.alt) push(kAlt);
  }

  // Text fields read characters, not keys.
  void push_character(EventQueue& events) const {
    const bool printable = chord_.key >= 32 && chord_.key < 127 && !chord_.control && !chord_.alt;
    if (!printable || !ImGui::GetIO().WantTextInput) return;
    const int character = chord_.shift ? chord_.key : std::tolower(chord_.key);
    events.push({.type = Event::Type::text, .character = static_cast<unsigned>(character)});
  }

  Chord chord_;
  int frame_ = 0;
};

// Presses a key without releasing it, or releases it.
class KeyStateStep final : public Step {
 public:
  KeyStateStep(int key, bool down) : key_(key), down_(down) {}

  StepStatus advance(AppState& state) override {
    if (frame_ == 0) state.platform.events().push({.type = Event::Type::key, .key = key_, .down = down_});
    return {.done = frame_++ > 1};
  }

 private:
  int key_;
  bool down_;
  int frame_ = 0;
};

// Types a text into the field that has the keyboard focus.
class TypeStep final : public Step {
 public:
  explicit TypeStep(std::string text) : text_(std::move(text)) {}

  StepStatus advance(AppState& state) override {
    if (frame_ == 0)
      for (std::string_view rest = text_; !rest.empty();)
        state.platform.events().push({.type = Event::Type::text, .character = take_character(rest)});
    return {.done = frame_++ > 2};
  }

 private:
  std::string text_;
  int frame_ = 0;
};

// Clicks in the image and expects that an object is selected.
class PickStep final : public Step {
 public:
  explicit PickStep(Vec2 position) : position_(position), click_(position, position, Button::left) {}

  StepStatus advance(AppState& state) override {
    if (!state.viewport.image.contains(position_)) return impossible("the position is outside of the image");
    const StepStatus status = click_.advance(state);
    if (status.done && state.selection.node < 0) return impossible("there is no object at this position");
    return status;
  }

 private:
  Vec2 position_;
  DragStep click_;
};

// Clicks at a fraction of the width and height of the image, wherever the image is.
class ImageClickStep final : public Step {
 public:
  ImageClickStep(Vec2 fraction, Button button) : fraction_(fraction), button_(button) {}

  StepStatus advance(AppState& state) override {
    if (!click_) {
      const Placement& image = state.viewport.image;
      const Vec2 position = image.corner + fraction_ * image.size;
      if (!state.viewport.visible_image().contains(position)) return impossible("this part of the image is not visible");
      click_.emplace(position, position, button_);
    }
    return click_->advance(state);
  }

 private:
  Vec2 fraction_;
  Button button_;
  std::optional<DragStep> click_;
};

// Another step while a modifier key is held.
class HoldingStep final : public Step {
 public:
  HoldingStep(int key, std::unique_ptr<Step> step) : key_(key), step_(std::move(step)) {}

  StepStatus advance(AppState& state) override {
    if (frame_++ == 0) push(state, true);
    if (done_) return {.done = reaction_.advance()};
    StepStatus status = step_->advance(state);
    if (!status.done && status.error.empty()) return status;
    push(state, false);
    done_ = true;
    return {.error = std::move(status.error)};
  }

 private:
  void push(AppState& state, bool down) const {
    state.platform.events().push({.type = Event::Type::key, .key = key_, .down = down});
  }

  int key_;
  std::unique_ptr<Step> step_;
  int frame_ = 0;
  bool done_ = false;
  FrameDelay reaction_{2};
};

Vec2 point_of(const nlohmann::json& j) { return {j.at(0).get<float>(), j.at(1).get<float>()}; }

Button button_of(const nlohmann::json& j) {
  const std::string name = j.value("button", "left");
  if (name == "right") return Button::right;
  return name == "middle" ? Button::middle : Button::left;
}

std::string value_text(const nlohmann::json& j) { return j.is_string() ? j.get<std::string>() : j.dump(); }

}  // namespace

Result<std::unique_ptr<Step>> make_input_step(const std::string& action, const nlohmann::json& j) {
  if (j.contains("holding")) {
    constexpr int kShift = 340, kControl = 341;  // GLFW_KEY_LEFT_SHIFT, ...
    const std::string modifier = j["holding"].get<std::string>();
    if (modifier != "ctrl" && modifier != "shift") return usage_error("'holding' is ctrl or shift");
    nlohmann::json rest = j;
    rest.erase("holding");
    auto step = make_input_step(action, rest);
    if (!step || !*step) return step;
    return std::unique_ptr<Step>(
        std::make_unique<HoldingStep>(modifier == "ctrl" ? kControl : kShift, std::move(*step)));
  }
  const auto result = [](auto step) { return std::unique_ptr<Step>(std::move(step)); };
  const auto text = [&](const char* member) { return j.at(member).get<std::string>(); };
  if (action == "set") return result(std::make_unique<SetStep>(text("name"), value_text(j.at("value"))));
  if (action == "click" && j.value("double", false)) return result(std::make_unique<DoubleClickStep>(text("item")));
  if (action == "click" && j.contains("image"))
    return result(std::make_unique<ImageClickStep>(point_of(j["image"]), button_of(j)));
  if (action == "click") return result(std::make_unique<ClickStep>(text("item"), button_of(j)));
  if (action == "drag" && j.contains("item"))
    return result(std::make_unique<ItemDragStep>(text("item"), point_of(j.at("by"))));
  if (action == "drag")
    return result(std::make_unique<DragStep>(point_of(j.at("from")), point_of(j.at("to")), button_of(j)));
  if (action == "scroll") return result(std::make_unique<ScrollStep>(point_of(j.at("at")), j.at("by").get<float>()));
  if (action == "type") return result(std::make_unique<TypeStep>(text("text")));
  if (action == "pick") return result(std::make_unique<PickStep>(point_of(j.at("at"))));
  if (action == "key") {
    const auto chord = parse_chord(text("key"));
    if (!chord) return chord.error();
    if (j.contains("down")) return result(std::make_unique<KeyStateStep>(chord->key, j["down"].get<bool>()));
    return result(std::make_unique<KeyStep>(*chord));
  }
  return std::unique_ptr<Step>();
}

}  // namespace etendue::viewer
