// Icons for the reliability of an error estimate and for checks. Shape and colour both show the status.
#pragma once

namespace etendue::render {
enum class Verdict;
}

namespace etendue::viewer {

struct UiContext;

enum class Status { unknown, good, doubtful, bad };

// Draws an icon as an item of the height of a text line.
void status_icon(const UiContext& ui, Status status);

Status status_of(render::Verdict verdict);
// "reliable", "uncertain", "unreliable" or "unknown".
const char* reliability_label(render::Verdict verdict);

}  // namespace etendue::viewer
