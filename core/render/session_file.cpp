#include "render/session_file.h"

#include <filesystem>

#include "base/file.h"

namespace etendue::render {

Result<void> write_session_file(const std::string& file, const Document& document) {
  std::error_code code;
  const auto folder = std::filesystem::absolute(file, code).parent_path();
  const std::string text = state_json(document, 0, folder.string()) + "\n";
  return write_file(file, text.data(), text.size());
}

Result<Document> read_session_file(const std::string& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  return document_from_state({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file);
}

}  // namespace etendue::render
