// etendue manual: writes the reference manual from the registries and the comments of the sources.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "command.h"
#include "manual_images.h"
#include "manual_pages.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct ManualArguments {
  std::string out, source = ".";
  bool images = false, new_images = false;
  int threads = 0;
};

Result<void> write_page(const std::filesystem::path& folder, const ManualPage& page) {
  const auto file = folder / page.file;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return write_file(file, page.text.data(), page.text.size());
}

int run_manual(const ManualArguments& a) {
  const auto sources = SourceFiles::open(a.source);
  if (!sources) return fail(sources.error());
  if (a.images || a.new_images)
    if (auto ok = write_manual_images(std::filesystem::path(a.out) / "images", a.threads, !a.images); !ok)
      return fail(ok.error());
  for (const ManualPage& page : manual_pages(*sources))
    if (auto ok = write_page(a.out, page); !ok) return fail(ok.error());
  return 0;
}

}  // namespace

Command manual_command() {
  const auto a = std::make_shared<ManualArguments>();
  return {.name = "manual",
          .summary = "Write the reference manual as Markdown",
          .options = {{.names = "folder", .target = &a->out, .doc = "Folder for the pages", .required = true},
                      {.names = "--source",
                       .target = &a->source,
                       .doc = "Checkout of the sources, whose comments become text of the pages; default: the current "
                              "folder"},
                      {.names = "--images", .target = &a->images, .doc = "Also render the images, which takes minutes"},
                      {.names = "--new-images",
                       .target = &a->new_images,
                       .doc = "Also render the images that do not exist"},
                      threads_option(a->threads)},
          .run = [a] { return run_manual(*a); }};
}

}  // namespace etendue::cli
