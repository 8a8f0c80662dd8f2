// Small images of scenes and image files, made in the background one after the other.
//
// Images are reduced; scenes and sessions are rendered with a few samples.
#pragma once
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "viewer/tasks/background_task.h"
#include "viewer/widgets/thumbnail_image.h"

namespace etendue::viewer {

class FileThumbnails {
 public:
  explicit FileThumbnails(std::function<void()> wake) : wake_(std::move(wake)) {}

  // The image of a file or of a built-in scene, which must stay valid until the next call. Starts to make it at the
  // first call; null until it is complete, and if it cannot be made.
  const ThumbnailImage* find(const std::string& file);
  // Whether the image of this file is still being made.
  bool is_pending(const std::string& file) const { return queue_.contains(file); }
  // Forgets requests that were not started.
  void cancel_waiting();
  // Whether a complete image was not taken over yet.
  bool has_result() const { return task_.has_result(); }

 private:
  // A set of names in the order of their requests.
  class Queue {
   public:
    bool contains(const std::string& file) const;
    void push(const std::string& file) { files_.push_back(file); }
    void clear_after_first();
    std::optional<std::string> front() const;
    void pop() { files_.pop_front(); }

   private:
    std::deque<std::string> files_;
  };

  void take_result();
  void start_next();

  std::function<void()> wake_;
  std::map<std::string, std::optional<ThumbnailImage>> images_;
  Queue queue_;  // its first file is being made while the task is running
  BackgroundTask<Result<ThumbnailImage>> task_;
};

}  // namespace etendue::viewer
