// Opens the documents of consecutive states (document_from_state). A scene that stays the same is read only once, and
// documents share what is equal, so that their compilation is short.
#pragma once
#include <memory>
#include <string>

#include "render/document.h"

namespace etendue::render {

class StateOpener {
 public:
  StateOpener();
  ~StateOpener();

  // `source` is the origin of the state, for error messages and relative paths. A document that does not have the
  // settings of the state is an error.
  Result<Document> open(const std::string& state, const std::string& source);
  // Whether the last call has read a scene.
  bool is_reopened() const { return is_reopened_; }
  // The document of the scene without edits; there must have been a successful call.
  const Document& opened() const;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
  bool is_reopened_ = false;
};

}  // namespace etendue::render
