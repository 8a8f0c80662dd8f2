// etendue: the command line. `etendue [SCENE]` opens the viewer; everything else is a subcommand.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "command.h"

namespace etendue::cli {

int fail(const Error& error) {
  std::fprintf(stderr, "etendue: %s\n", error.message.c_str());
  return static_cast<int>(error.fault);
}

namespace {

struct Subcommand {
  const char* name;
  const char* doc;
  Command (*add)(CLI::App&);
};

constexpr Subcommand kSubcommands[] = {
    {"render", "Render a scene to a file", add_render},
    {"compare", "Measure how far an image is from a reference", add_compare},
    {"bench", "Chart the error of methods against time", add_bench},
    {"advise", "Rank methods by the time to an error", add_advise},
    {"certify", "Say whether the error that an image states stands", add_certify},
    {"inspect", "Say what is in a scene and what model it needs", add_inspect},
    {"bsdf", "Measure what a reflection model does with light", add_bsdf},
    {"probe", "Measure light at a point of the picture: radiance, irradiance, flux", add_probe},
    {"save", "Write a scene as glTF", add_save},
    {"list", "List integrators, samplers and what else there is", add_list},
    {"stress", "Try methods where they are known to fail, and say whether they do", add_stress},
    {"view", "Open the workbench; what etendue does without a subcommand", add_view},
};

// "etendue" and "etendue SCENE" are "etendue view" and "etendue view SCENE".
bool means_view(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return true;
  const auto& first = arguments.front();
  return !first.starts_with("-") && std::ranges::none_of(kSubcommands, [&](const auto& s) { return first == s.name; });
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app{"Étendue: a workbench for light transport", "etendue"};
  app.require_subcommand(1);
  int code = 0;
  for (const auto& subcommand : kSubcommands) {
    CLI::App* parser = app.add_subcommand(subcommand.name, subcommand.doc);
    parser->callback([&code, command = subcommand.add(*parser)] { code = command(); });
  }
  app.footer("etendue [SCENE] opens the workbench.");
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (means_view(arguments)) arguments.insert(arguments.begin(), "view");
  std::ranges::reverse(arguments);  // as the parser takes them
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::CallForAllHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(usage_error(std::string(error.what()) + "; see etendue --help"));
  }
  return code;
}

}  // namespace etendue::cli

int main(int argc, char** argv) { return etendue::cli::run(argc, argv); }
