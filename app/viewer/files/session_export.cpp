#include "viewer/files/session_export.h"

#include "render/session_file.h"

namespace etendue::viewer {

void SessionExport::write(const std::string& file, const render::Document& document, uint64_t revision) {
  const auto work = [file, document, revision]() -> Result<SavedSession> {
    if (auto written = render::write_session_file(file, document); !written) return written.error();
    return SavedSession{.file = file, .document = document, .revision = revision};
  };
  task_.start(work, wake_);
}

}  // namespace etendue::viewer
