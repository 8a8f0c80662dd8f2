// A fixture in which the folder of the test is the home folder of the user.
#pragma once
#include <cstdlib>
#include <optional>

#include "scripted.h"

namespace etendue {

class HomeFolder : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    for (const char* name : kVariables) {
      const char* value = std::getenv(name);
      former_.push_back(value ? std::optional<std::string>(value) : std::nullopt);
      ::unsetenv(name);
    }
    ::setenv("HOME", folder_.c_str(), 1);
  }
  void TearDown() override {
    for (size_t i = 0; i < std::size(kVariables); ++i)
      if (former_[i])
        ::setenv(kVariables[i], former_[i]->c_str(), 1);
      else
        ::unsetenv(kVariables[i]);
    Viewer::TearDown();
  }

 private:
  static constexpr const char* kVariables[] = {"HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME"};
  std::vector<std::optional<std::string>> former_;
};

}  // namespace etendue
