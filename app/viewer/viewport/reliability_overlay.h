// Marks the tiles of the image whose error estimate is unreliable.
#pragma once

struct ImDrawList;

namespace etendue::render {
struct Reliability;
}

namespace etendue::viewer {

struct AppState;

void draw_reliability_overlay(const AppState& state, const render::Reliability& reliability, ImDrawList* draw);

}  // namespace etendue::viewer
