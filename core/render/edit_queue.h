// The versions of the document that callers submit to a session, until the session's thread takes them.
//
// Only the newest version waits; it replaces the one before. The queue is not synchronised: the session locks.
#pragma once
#include <cstdint>
#include <optional>

#include "render/clock.h"
#include "render/document.h"
#include "render/resume_point.h"

namespace etendue::render {

struct Edit {
  Document document;
  std::optional<ResumePoint> start;
  uint64_t version = 0;
  Clock::time_point submitted;
  bool restarts = true;  // the samples so far do not apply to this version
};

class EditQueue {
 public:
  bool empty() const { return !pending_; }
  uint64_t last_version() const { return last_version_; }

  // Returns the version that the document received.
  uint64_t submit(const Document& document, std::optional<ResumePoint> start);
  // Submits the newest document once more, to be sampled from the beginning. False if there is none.
  bool resubmit();
  // The waiting edit; there must be one.
  Edit take();

 private:
  std::optional<Edit> pending_;
  std::optional<Document> latest_;
  uint64_t last_version_ = 0;
};

}  // namespace etendue::render
