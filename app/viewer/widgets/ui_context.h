// What every widget needs: colours, fonts, input, and the registry of named items.
#pragma once
#include <string>

#include "base/result.h"
#include "spectrum/rgb.h"
#include "viewer/platform/input.h"
#include "viewer/platform/theme.h"
#include "viewer/script/item_registry.h"

namespace etendue::viewer {

// The text that was last validated in a text field. Validation may read a file, so it is not repeated in each frame.
struct ValidatedText {
  std::string parameter;
  std::string text;
  Result<void> result;
};

// The temperature that a colour was given, or that is nearest to it.
struct TemperatureCache {
  Rgb color{-1};
  double kelvin = 0;
};

// The angles that the user has entered for a rotation. Euler angles are not unique: 120 degrees about y could be shown
// as 60 degrees and two half turns. The entered angles are shown as long as the rotation is the one they stand for.
struct EnteredRotation {
  std::string parameter;
  Vec4 quaternion{0};
  Vec3 degrees{0};
};

struct UiContext {
  Theme theme;
  Fonts fonts;
  GlyphSet glyphs;          // of the names and messages that are shown
  float scale = 1;          // pixels per unit of the interface
  Input input;              // of this frame
  double pointer_rest = 0;  // seconds since the pointer last moved or a button was pressed
  std::string filter;       // lower case; only parameters that contain it are shown
  ItemRegistry items;
  ValidatedText validated_text;
  TemperatureCache temperature;
  EnteredRotation entered_rotation;
  std::string changed_by_press;  // the gesture of the parameter whose slider jumped at the last press of the button
};

}  // namespace etendue::viewer
