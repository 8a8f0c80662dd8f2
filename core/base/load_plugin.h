// Plugins: shared libraries that the program loads on first use.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue {

// What messages say about a plugin.
struct PluginDescription {
  const char* file;             // of the plugin
  const char* library;          // that it uses
  const char* runtime_package;  // with which it runs
  const char* packages;         // with which it is built: "the package ..." or "the packages ..."
};

// The folder named by the environment variable ETENDUE_PLUGIN_PATH, or, if that is not set, the folder of the program and
// ../lib/etendue relative to it.
std::vector<std::filesystem::path> plugin_folders();

// Loads a plugin from the first of these folders that has it. It exports a function with the name `get`, which returns
// the plugin, or null if `version` is not its own. The error says what is missing and what to install; it is to be put
// after the name of what needs the plugin.
Result<const void*> load_plugin(const PluginDescription& description, const std::vector<std::filesystem::path>& folders,
                                const char* get, int version);

}  // namespace etendue
