// Conditions under which actions are enabled.
#pragma once
#include "viewer/state/app_state.h"

namespace etendue::viewer {

inline bool has_document(const AppState& state) { return state.has_document(); }

}  // namespace etendue::viewer
