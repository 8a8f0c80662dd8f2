// A first picture of a scene whose textures are still being read.
//
// Materials have constant colours in it. The exposure suits the surfaces, as that of the scene will when it is open. It is
// rendered only if the textures take longer than a moment, because it delays them a little.
#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "render/session.h"
#include "scene/scene.h"
#include "viewer/files/stored_picture.h"

namespace etendue::viewer {

class LoadingPicture {
 public:
  // `environment` as in Loader::open.
  LoadingPicture(std::string file, std::string environment, ShowPicture show)
      : file_(std::move(file)), environment_(std::move(environment)), show_(std::move(show)) {}

  // Starts to render in the background, after kPatience. Pictures are shown until every pixel has a sample, or until this
  // object is destroyed. Called at most once, from any thread.
  void start(const scene::Scene& scene);

  static constexpr std::chrono::milliseconds kPatience{300};

 private:
  void render(const scene::Scene& scene);
  void update();

  std::string file_, environment_;
  ShowPicture show_;
  render::Document document_;
  std::unique_ptr<render::Session> session_;
  std::jthread waiting_;
};

}  // namespace etendue::viewer
