// Edits that wait for files: they are made in their order, and not after another document was opened.
#include "viewer/files/file_edits.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

namespace etendue::file_edits_test {
namespace {

using viewer::FileEdits;

// Lets a thread wait until it is opened.
class Gate {
 public:
  void open() {
    {
      const std::lock_guard lock(mutex_);
      is_open_ = true;
    }
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_ = false;
};

FileEdits::Work work(Gate& gate, const std::string& message) {
  return [&gate, message]() -> Result<FileEdits::Edit> {
    gate.pass();
    return input_error(message);
  };
}

std::string next_message(FileEdits& edits) {
  while (true)
    if (const auto result = edits.take_result()) return result->error().message;
}

TEST(FileEdits, KeepTheirOrder) {
  Gate slow, quick;
  FileEdits edits([] {});
  edits.start(work(slow, "first"));
  edits.start(work(quick, "second"));
  quick.open();
  EXPECT_FALSE(edits.take_result());
  EXPECT_TRUE(edits.is_busy());
  slow.open();
  EXPECT_EQ(next_message(edits), "first");
  EXPECT_EQ(next_message(edits), "second");
  EXPECT_FALSE(edits.is_busy());
}

TEST(FileEdits, CancelledOnesAreNotMade) {
  Gate gate;
  FileEdits edits([] {});
  edits.start(work(gate, "first"));
  edits.start(work(gate, "second"));
  edits.cancel();
  EXPECT_FALSE(edits.is_busy());
  edits.start(work(gate, "third"));
  gate.open();
  EXPECT_EQ(next_message(edits), "third");
  EXPECT_FALSE(edits.is_busy());
}

}  // namespace
}  // namespace etendue::file_edits_test
