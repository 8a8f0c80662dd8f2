#include "viewer/files/file_edits.h"

namespace etendue::viewer {

void FileEdits::start(Work work) {
  queue_.push_back(std::move(work));
  start_next();
}

void FileEdits::start_next() {
  if (task_.running() || queue_.empty()) return;
  task_.start(std::move(queue_.front()), wake_);
  queue_.pop_front();
}

void FileEdits::cancel() {
  queue_.clear();
  task_.abandon();
}

std::optional<Result<FileEdits::Edit>> FileEdits::take_result() {
  auto result = task_.take_result();
  if (result) start_next();
  return result;
}

}  // namespace etendue::viewer
