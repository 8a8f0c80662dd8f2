// The event queue gives each frame the events that Dear ImGui can tell apart, in their order.
#include <gtest/gtest.h>

#include "viewer/platform/input.h"

namespace etendue::event_queue_test {
namespace {

using viewer::Button;
using viewer::Event;
using viewer::EventQueue;
using viewer::Input;

constexpr int kEscape = 256, kControl = 341;  // key codes of GLFW

Event button(bool down) { return {.type = Event::Type::button, .button = Button::left, .down = down}; }
Event key(int code, bool down) { return {.type = Event::Type::key, .key = code, .down = down}; }
Event move(float x) { return {.type = Event::Type::move, .position = Vec2(x, 0)}; }

TEST(EventQueue, PressAndReleaseTakeTwoFrames) {
  EventQueue queue;
  for (const bool down : {true, false}) queue.push(button(down));
  Input input;
  EXPECT_TRUE(queue.take_frame(input));
  EXPECT_TRUE(input.buttons[0] && input.pressed[0]);
  EXPECT_TRUE(queue.take_frame(input));
  EXPECT_FALSE(input.buttons[0] || input.pressed[0]);
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, EscapeAfterAClickArrivesInTheNextFrame) {
  EventQueue queue;
  for (const bool down : {true, false}) queue.push(button(down));
  for (const bool down : {true, false}) queue.push(key(kEscape, down));
  Input input;
  queue.take_frame(input);
  queue.take_frame(input);
  EXPECT_FALSE(input.buttons[0]);
  EXPECT_FALSE(input.keys_pressed[kEscape]) << "the release of the button may open a menu that Escape closes";
  queue.take_frame(input);
  EXPECT_TRUE(input.keys_pressed[kEscape]);
}

TEST(EventQueue, AClickAfterEscapeArrivesInTheNextFrame) {
  EventQueue queue;
  queue.push(key(kEscape, true));
  queue.push(move(7));
  queue.push(button(true));
  Input input;
  queue.take_frame(input);
  EXPECT_TRUE(input.keys_pressed[kEscape]);
  EXPECT_FALSE(input.buttons[0]);
  queue.take_frame(input);
  EXPECT_TRUE(input.pressed[0]);
  EXPECT_FLOAT_EQ(input.mouse.x, 7);
}

// Dear ImGui ignores a press on a tab while the frame before had the pointer on another item.
TEST(EventQueue, APressAfterAMovementArrivesInTheNextFrame) {
  EventQueue queue;
  queue.push(move(3));
  queue.push(move(7));
  queue.push(button(true));
  queue.push(move(8));
  queue.push(button(false));
  Input input;
  queue.take_frame(input);
  EXPECT_FLOAT_EQ(input.mouse.x, 7);
  EXPECT_FALSE(input.buttons[0]);
  queue.take_frame(input);
  EXPECT_TRUE(input.pressed[0]);
  EXPECT_FLOAT_EQ(input.mouse.x, 7);
  queue.take_frame(input);
  EXPECT_FALSE(input.buttons[0]) << "a release needs no frame of its own after a movement";
  EXPECT_FLOAT_EQ(input.mouse.x, 8);
}

TEST(EventQueue, AClickKeepsItsModifierAndItsPosition) {
  EventQueue queue;
  queue.push(key(kControl, true));
  queue.push(move(3));
  queue.push(button(true));
  queue.push(key(kControl, false));
  queue.push(move(9));
  Input input;
  queue.take_frame(input);
  EXPECT_FALSE(input.pressed[0]);
  queue.take_frame(input);
  EXPECT_TRUE(input.pressed[0] && input.control());
  EXPECT_FLOAT_EQ(input.mouse.x, 3);
}

}  // namespace
}  // namespace etendue::event_queue_test
