#include "viewer/files/edit_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "render/session_file.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kMinInterval = std::chrono::milliseconds(500);
constexpr const char* kLockExtension = ".lock";

// Opens and locks a file. Returns -1 if that fails or another process holds the lock.
int lock_file(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  close(descriptor);
  return -1;
}

bool is_in_use(const fs::path& journal) {
  fs::path file = journal;
  file.replace_extension(kLockExtension);
  const int descriptor = lock_file(file);
  if (descriptor < 0) return true;
  close(descriptor);
  return false;
}

// The scene of a state; empty if the file is damaged.
std::string scene_of(const fs::path& journal) {
  const auto bytes = read_file(journal);
  if (!bytes) return "";
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  const auto state = nlohmann::json::parse(text, text + bytes->size(), nullptr, false);
  return state.is_object() && state.contains("scene") && state["scene"].is_string() ? state["scene"] : "";
}

}  // namespace

EditJournal::EditJournal(const fs::path& folder) : folder_(folder) {
  if (folder.empty()) return;
  std::error_code code;
  fs::create_directories(folder, code);
  const std::string name = std::to_string(std::time(nullptr)) + "-" + std::to_string(getpid());
  file_ = folder / (name + render::kSessionExtension);
  lock_file_ = folder / (name + kLockExtension);
  lock_ = lock_file(lock_file_);
}

EditJournal::~EditJournal() {
  if (lock_ < 0) return;
  task_.reset();  // waits for the thread
  std::error_code code;
  fs::remove(file_, code);
  fs::remove(lock_file_, code);
  close(lock_);
}

void EditJournal::update(const Editor& editor) {
  if (lock_ < 0 || editor.empty()) return;
  if (const auto written = task_->take_result()) {
    const bool failed = !*written;
    if (failed && !has_failed_) problem_ = written->error().message;
    has_failed_ = failed;
  }
  if (task_->running()) return;
  if (!editor.has_unsaved_changes()) {
    std::error_code code;
    if (written_revision_ > 0) fs::remove(file_, code);
    written_revision_ = 0;
    return;
  }
  const auto now = Clock::now();
  if (editor.revision() == written_revision_ || now - last_write_ < kMinInterval) return;
  written_revision_ = editor.revision();
  last_write_ = now;
  // A failed write is repeated after the next change.
  task_->start([file = file_.string(), document = editor.document()] { return write_session_file(file, document); },
               [] {});
}

std::vector<LostSession> EditJournal::lost_sessions() const {
  std::vector<LostSession> list;
  if (lock_ < 0) return list;
  std::error_code code;
  for (fs::directory_iterator entry(folder_, code); !code && entry != fs::directory_iterator(); entry.increment(code)) {
    const fs::path file = entry->path();
    struct stat status {};
    if (file == file_ || file.extension() != render::kSessionExtension || stat(file.c_str(), &status) != 0 ||
        is_in_use(file))
      continue;
    LostSession session{.file = file, .scene = scene_of(file), .last_edit = date_text(status.st_mtime)};
    if (session.scene.empty())
      discard(file);
    else
      list.push_back(std::move(session));
  }
  std::ranges::sort(list, std::greater(), &LostSession::last_edit);
  return list;
}

void EditJournal::adopt(const fs::path& lost) {
  std::error_code code;
  fs::rename(lost, file_, code);
  discard(lost);
}

void EditJournal::discard(const fs::path& lost) {
  std::error_code code;
  fs::remove(lost, code);
  fs::path lock = lost;
  fs::remove(lock.replace_extension(kLockExtension), code);
}

}  // namespace etendue::viewer
