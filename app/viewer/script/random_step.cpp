// The random user: pointer and keyboard events at random, mostly at items on screen. Finds crashes; it checks no results.
#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "viewer/platform/platform.h"
#include "viewer/script/step.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr int kKeyEscape = 256;  // GLFW_KEY_ESCAPE, ...
constexpr int kKeyShift = 340;
constexpr int kKeyControl = 341;
constexpr int kKeyAlt = 342;
constexpr int kFramesAfterAction = 3;

// Keys that edit text or close popups.
constexpr std::array kEditingKeys{"ctrl+a", "ctrl+c", "ctrl+v", "ctrl+x", "tab",       "shift+tab",
                                  "enter",  "escape", "escape", "delete", "backspace", "left",
                                  "right",  "home",   "end",    "up",     "down"};
// Typed into whatever has the keyboard focus.
constexpr std::array kTexts{"0", "1", "-1", "0.5", "1e9", "nan", "cornell", "ES*L", "abc", "..", "%s%n", "\u00e9"};

struct RandomUser {
  uint64_t seed = 1;
  int actions = 0;
  std::vector<std::string> files;  // dropped on the window now and then
  std::string log;                 // file that receives each action; empty: none
};

class RandomStep final : public Step {
 public:
  explicit RandomStep(RandomUser user) : user_(std::move(user)), random_(user_.seed) {
    if (!user_.log.empty()) log_.open(user_.log);
  }

  StepStatus advance(AppState& state) override {
    state.quit = false;
    state.stays_open = true;
    if (!queue_.empty()) {
      for (Event& event : queue_.front()) state.platform.events().push(std::move(event));
      queue_.erase(queue_.begin());
      return {};
    }
    if (frames_left_-- > 0) return {};
    if (done_ >= user_.actions) {
      state.stays_open = false;
      return {.done = true};
    }
    ++done_;
    frames_left_ = kFramesAfterAction;
    // Nothing is written to a folder that was chosen at random.
    if (state.files.request && state.files.request->saves)
      press_key({.key = kKeyEscape}, "close the file dialog");
    else
      choose_action(state);
    return {};
  }

  double extra_seconds() const override { return 10.0 * user_.actions; }

 private:
  int below(size_t count) { return std::uniform_int_distribution<int>(0, static_cast<int>(count) - 1)(random_); }
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  void frame(std::vector<Event> events) { queue_.push_back(std::move(events)); }
  void note(const std::string& text) {
    if (log_) log_ << done_ << " " << text << std::endl;
  }

  static Event move(Vec2 position) { return {.type = Event::Type::move, .position = position}; }
  static Event button(Button which, bool down) { return {.type = Event::Type::button, .button = which, .down = down}; }
  static Event key(int code, bool down) { return {.type = Event::Type::key, .key = code, .down = down}; }

  void choose_action(AppState& state) {
    constexpr int kKinds = 12;
    switch (below(kKinds)) {
      case 0:
        return press_key(random_chord(state), "shortcut");
      case 1:
        return press_key(*parse_chord(kEditingKeys[static_cast<size_t>(below(kEditingKeys.size()))]), "key");
      case 2:
        return type(kTexts[static_cast<size_t>(below(kTexts.size()))]);
      case 3:
        return drag(random_position(state));
      case 4:
        return scroll(random_position(state));
      case 5:
        return drop();
      default:
        return click(random_position(state));
    }
  }

  Chord random_chord(const AppState& state) {
    const auto& actions = state.actions.all();
    const auto chords = actions[static_cast<size_t>(below(actions.size()))].chords();
    return chords.empty() ? Chord{.key = kKeyEscape} : chords.front();
  }

  // The centre of an item on screen, or any position.
  Vec2 random_position(const AppState& state) {
    constexpr float kItemShare = 0.75f;
    const auto& items = state.ui.items.placements();
    const Vec2 size(state.platform.size());
    if (items.empty() || between(0, 1) > kItemShare) return {between(0, size.x), between(0, size.y)};
    const auto item = std::next(items.begin(), below(items.size()));
    note("at " + item->first);
    return item->second.corner + item->second.size * 0.5f;
  }

  void press_key(const Chord& chord, const char* what) {
    note(what + (" " + label(chord)));
    std::vector<int> keys;
    if (chord.control) keys.push_back(kKeyControl);
    if (chord.shift) keys.push_back(kKeyShift);
    if (chord.alt) keys.push_back(kKeyAlt);
    keys.push_back(chord.key);
    for (const int code : keys) frame({key(code, true)});
    std::ranges::reverse(keys);
    for (const int code : keys) frame({key(code, false)});
  }

  void type(const char* text) {
    note(std::string("type ") + text);
    std::vector<Event> events;
    for (const char* c = text; *c; ++c)
      events.push_back({.type = Event::Type::text, .character = static_cast<unsigned char>(*c)});
    frame(std::move(events));
  }

  // One or two clicks of a button, sometimes with a modifier.
  void click(Vec2 position) {
    const int modifier = std::array{0, 0, 0, kKeyControl, kKeyShift}[static_cast<size_t>(below(5))];
    const Button which = std::array{Button::left, Button::left,  Button::left,
                                    Button::left, Button::right, Button::middle}[static_cast<size_t>(below(6))];
    const int count = below(4) == 0 ? 2 : 1;
    note(formatted("click %d times, button %d, key %d, at %.0f %.0f", count, static_cast<int>(which), modifier,
                   static_cast<double>(position.x), static_cast<double>(position.y)));
    frame({move(position)});
    if (modifier > 0) frame({key(modifier, true)});
    for (int i = 0; i < count; ++i) {
      frame({button(which, true)});
      frame({button(which, false)});
    }
    if (modifier > 0) frame({key(modifier, false)});
  }

  void drag(Vec2 from) {
    const Vec2 to = from + Vec2(between(-200, 200), between(-200, 200));
    const Button which =
        std::array{Button::left, Button::left, Button::middle, Button::right}[static_cast<size_t>(below(4))];
    note(formatted("drag with button %d", static_cast<int>(which)));
    frame({move(from)});
    frame({button(which, true)});
    for (const float share : {0.2f, 0.6f, 1.0f}) frame({move(glm::mix(from, to, share))});
    frame({button(which, false)});
  }

  void scroll(Vec2 position) {
    note("scroll");
    frame({move(position)});
    frame({{.type = Event::Type::scroll, .position = Vec2(0, between(-3, 3))}});
  }

  void drop() {
    if (user_.files.empty()) return;
    const std::string& file = user_.files[static_cast<size_t>(below(user_.files.size()))];
    note("drop " + file);
    frame({{.type = Event::Type::drop, .file = file}});
  }

  RandomUser user_;
  std::mt19937_64 random_;
  std::ofstream log_;
  std::vector<std::vector<Event>> queue_;  // events of the next frames
  int done_ = 0;
  int frames_left_ = 0;
};

}  // namespace

Result<std::unique_ptr<Step>> make_random_step(const std::string& action, const nlohmann::json& j) {
  if (action != "random") return std::unique_ptr<Step>();
  constexpr uint64_t kMostActions = 1'000'000'000;
  const nlohmann::json& actions = j.at("actions");
  if (!actions.is_number_unsigned() || actions.get<uint64_t>() > kMostActions)
    return usage_error("'actions' has to be an integer between 0 and 1000000000");
  if (j.contains("seed") && !j["seed"].is_number_unsigned())
    return usage_error("'seed' has to be an integer that is not negative");
  return std::unique_ptr<Step>(
      std::make_unique<RandomStep>(RandomUser{.seed = j.value("seed", uint64_t{1}),
                                              .actions = actions.get<int>(),
                                              .files = j.value("files", std::vector<std::string>()),
                                              .log = j.value("log", "")}));
}

}  // namespace etendue::viewer
