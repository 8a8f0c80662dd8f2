// Session files: the state of a document as a text file, without an image.
//
// A session file (.etendue) contains the JSON text of `state_json`. It refers to the scene file relative to its own
// folder if the scene is in that folder or below, otherwise by an absolute path.
#pragma once
#include <string>

#include "render/document.h"

namespace etendue::render {

inline constexpr const char* kSessionExtension = ".etendue";

// Replaces the file atomically.
Result<void> write_session_file(const std::string& file, const Document& document);

// Opens the scene of a session and applies its settings.
Result<Document> read_session_file(const std::string& file);

}  // namespace etendue::render
