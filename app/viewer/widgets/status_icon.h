// The verdict on a picture's health as one sign: its shape says it as well as its colour.
#pragma once
#include "viewer/state/app_state.h"

namespace etendue::viewer {

// Draws it as an item as high as a line of the present face.
void traffic_light(const Workbench& w, render::Verdict verdict);

}  // namespace etendue::viewer
