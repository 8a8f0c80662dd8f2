// etendue figure: the figures of [Lang], made by this program.
#include <cstdio>
#include <memory>

#include "command.h"
#include "figures/composition.h"
#include "figures/figure.h"
#include "image/image.h"
#include "interrupt.h"
#include "json.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

using figures::Figure;

struct FigureArguments {
  std::string number, out;
  bool all = false, json = false;
  int width = 320, threads = 0;
  double effort = 1;
  uint64_t seed = 0;
};

constexpr int kThumbnail = 300, kThumbnailColumns = 6;  // of the contact sheet

int list_figures(bool as_json) {
  if (as_json) {
    json list = json::array();
    for (const Figure& f : figures::figures())
      list.push_back({{"number", f.number}, {"title", f.title}, {"note", f.note}, {"made", true}});
    for (const auto& f : figures::not_made())
      list.push_back({{"number", f.number}, {"made", false}, {"reason", figures::explanation(f.reason)}});
    std::printf("%s\n", list.dump(2).c_str());
    return 0;
  }
  for (const Figure& f : figures::figures()) std::printf("%-6s %s\n", f.number, f.title);
  std::printf("%zu further figures are not made; etendue figure NUMBER states the reason\n",
              figures::not_made().size());
  return 0;
}

Result<const Figure*> figure_of(const std::string& number) {
  if (const Figure* figure = figures::find_figure(number)) return figure;
  if (const auto* other = figures::find_not_made(number))
    return input_error("figure " + number + " is not made: " + figures::explanation(other->reason));
  return usage_error("there is no figure '" + number + "'; etendue figure lists all numbers, such as 7.4");
}

figures::MakeContext context_of(const FigureArguments& a) {
  return {.threads = a.threads, .width = a.width, .effort = a.effort, .seed = a.seed};
}

Result<void> write_with_heading(const std::filesystem::path& file, const Figure& figure, const figures::Parts& parts) {
  const std::string heading = std::string("Figure ") + figure.number + ": " + figure.title;
  return figures::write_figure(file, figures::composed(parts, figure.columns, heading));
}

int make_one(const FigureArguments& a) {
  const auto figure = figure_of(a.number);
  if (!figure) return fail(figure.error());
  const std::string file = a.out.empty() ? "figure-" + a.number + ".png" : a.out;
  const auto parts = (*figure)->make(context_of(a));
  if (!parts) return fail(parts.error());
  if (const auto written = write_with_heading(file, **figure, *parts); !written) return fail(written.error());
  std::printf("%s: %s\n", file.c_str(), (*figure)->title);
  if (*(*figure)->note != '\0') std::printf("%s\n", (*figure)->note);
  return 0;
}

// All figures as files, and a contact sheet.
int make_all(const FigureArguments& a) {
  if (a.out.empty()) return fail(usage_error("figure --all: give a folder for the files with --out"));
  const std::filesystem::path folder = a.out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(output_error(a.out + ": the folder cannot be created: " + error.message()));
  const std::atomic<bool>& interrupted = watch_interrupts();
  figures::Parts sheet;
  for (const Figure& figure : figures::figures()) {
    if (interrupted) return fail({Fault::interrupted, "interrupted; the figures up to now are in " + a.out});
    std::fprintf(stderr, "figure %s: %s\n", figure.number, figure.title);
    const auto parts = figure.make(context_of(a));
    if (!parts) return fail(parts.error());
    const auto file = folder / (std::string("figure-") + figure.number + ".png");
    if (const auto written = write_with_heading(file, figure, *parts); !written) return fail(written.error());
    sheet.push_back(
        {.caption = std::string(figure.number) + " " + figure.title,
         .content = figures::thumbnail(figures::rasterized(figures::composed(*parts, figure.columns)), kThumbnail)});
  }
  const auto file = folder / "contact-sheet.png";
  if (const auto written = figures::write_figure(file, figures::composed(sheet, kThumbnailColumns)); !written)
    return fail(written.error());
  std::printf("%zu figures, %s\n", sheet.size(), file.c_str());
  return 0;
}

int run_figure(const FigureArguments& a) {
  if (a.all && !a.number.empty()) return fail(usage_error("figure: give a number or --all, not both"));
  if (a.all) return make_all(a);
  return a.number.empty() ? list_figures(a.json) : make_one(a);
}

}  // namespace

Command figure_command() {
  const auto a = std::make_shared<FigureArguments>();
  return {.name = "figure",
          .summary = "Make a figure of [Lang] by its number; without a number, list them",
          .options = {{.names = "number", .target = &a->number, .doc = "Number of the figure, such as 7.4"},
                      {.names = "--all", .target = &a->all, .doc = "Make all figures and a contact sheet"},
                      {.names = "-o,--out",
                       .target = &a->out,
                       .doc = "File, .png or .svg; with --all the folder. Default figure-NUMBER.png"},
                      {.names = "--width",
                       .target = &a->width,
                       .doc = "Width of a rendered picture in pixels. Default 320",
                       .bounds = between(16, 4096)},
                      {.names = "--effort",
                       .target = &a->effort,
                       .doc = "Factor for the samples of renderings, unless their number is the subject. Default 1",
                       .bounds = kPositive},
                      seed_option(a->seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_figure(*a); }};
}

}  // namespace etendue::cli
