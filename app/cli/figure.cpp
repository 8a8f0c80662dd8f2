// etendue figure: the figures of [Lang], made by this program.
#include <cstdio>
#include <functional>
#include <memory>

#include "base/file.h"
#include "base/number_text.h"
#include "command.h"
#include "figures/collection.h"
#include "figures/composition.h"
#include "interrupt.h"
#include "job_parts.h"
#include "json.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

using figures::Figure;

struct FigureArguments {
  std::string number, out, part;
  bool all = false, json = false;
  int width = 320, threads = 0;
  double effort = 1;
  uint64_t seed = 0;
};

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

using FinishedFigures = std::vector<figures::FinishedFigure>;

Result<void> write_file_of(const figures::FinishedFigure& figure, const std::filesystem::path& folder) {
  const auto file = folder / (std::string("figure-") + figure.figure->number + ".png");
  return write_file(file, figure.png.data(), figure.png.size());
}

Result<void> create_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return {};
  return output_error(folder + ": the folder cannot be created: " + error.message());
}

int write_contact_sheet(const FinishedFigures& finished, const std::filesystem::path& folder) {
  const auto file = folder / "contact-sheet.png";
  const auto sheet = figures::composed(figures::contact_sheet(finished), figures::kContactSheetColumns);
  if (const auto written = figures::write_figure(file, sheet); !written) return fail(written.error());
  std::printf("%zu figures, %s\n", finished.size(), file.c_str());
  return 0;
}

// The figures of a share, one after the other; `done` is called with each.
Result<FinishedFigures> made(const FigureArguments& a, const job_part::Share& share,
                             const std::function<Result<void>(const figures::FinishedFigure&)>& done) {
  const std::atomic<bool>& interrupted = watch_interrupts();
  FinishedFigures list;
  for (size_t i = 0; i < figures::figures().size(); ++i) {
    if (!share.has(i)) continue;
    if (interrupted) return Error{Fault::interrupted, "interrupted"};
    const Figure& figure = figures::figures()[i];
    std::fprintf(stderr, "figure %s: %s\n", figure.number, figure.title);
    auto finished = figures::finished(figure, context_of(a));
    if (!finished) return finished.error();
    if (auto ok = done(*finished); !ok) return ok.error();
    list.push_back(std::move(*finished));
  }
  return list;
}

// All figures as files, and a contact sheet.
int make_all(const FigureArguments& a) {
  if (auto ok = create_folder(a.out); !ok) return fail(ok.error());
  auto finished = made(a, {}, [&](const figures::FinishedFigure& figure) { return write_file_of(figure, a.out); });
  if (!finished && finished.error().fault == Fault::interrupted)
    return fail({Fault::interrupted, "interrupted; the figures up to now are in " + a.out});
  return finished ? write_contact_sheet(*finished, a.out) : fail(finished.error());
}

int make_part(const FigureArguments& a) {
  const auto share = job_part::parse_share(a.part);
  if (!share) return fail(share.error());
  const auto path = job_part::new_part_path(a.out, *share);
  if (!path) return fail(path.error());
  const auto finished = made(a, *share, [](const figures::FinishedFigure&) -> Result<void> { return {}; });
  if (!finished) return fail(finished.error());
  const job_part::PartHeader header{.job = "figure",
                                    .version = ETENDUE_VERSION,
                                    .share = *share,
                                    .settings = {{"--seed", std::to_string(a.seed)},
                                                 {"--width", std::to_string(a.width)},
                                                 {"--effort", format_number(a.effort, 17)}}};
  if (auto ok = job_part::write_part(*path, {header, figures::bytes_of(*finished)}); !ok) return fail(ok.error());
  std::printf("%s: %zu of %zu figures\n", path->c_str(), finished->size(), figures::figures().size());
  return 0;
}

int run_figure(const FigureArguments& a) {
  if (a.all && !a.number.empty()) return fail(usage_error("figure: give a number or --all, not both"));
  if (!a.part.empty() && !a.all) return fail(usage_error("figure: --part divides --all; give both"));
  if (a.all && a.out.empty()) return fail(usage_error("figure --all: give a folder for the files with --out"));
  if (!a.part.empty()) return make_part(a);
  if (a.all) return make_all(a);
  return a.number.empty() ? list_figures(a.json) : make_one(a);
}

}  // namespace

int merge_figures(const job_part::PartSet& parts, const std::string& folder) {
  std::vector<FinishedFigures> figures_of_part;
  for (const auto& file : parts.files) {
    const auto part = job_part::read_part(file);
    if (!part) return fail(part.error());
    auto finished = figures::figures_from(part->content);
    if (!finished) return fail(job_part::damaged(file));
    figures_of_part.push_back(std::move(*finished));
  }
  // Figures are distributed in turn (job_part::Share::has).
  FinishedFigures all;
  const size_t count = parts.files.size();
  for (size_t i = 0; i < figures::figures().size(); ++i) {
    FinishedFigures& from = figures_of_part[i % count];
    if (i / count >= from.size() || from[i / count].figure != &figures::figures()[i])
      return fail(job_part::damaged(parts.files[i % count]));
    all.push_back(std::move(from[i / count]));
  }
  if (auto ok = create_folder(folder); !ok) return fail(ok.error());
  for (const auto& figure : all)
    if (auto ok = write_file_of(figure, folder); !ok) return fail(ok.error());
  return write_contact_sheet(all, folder);
}

Command figure_command() {
  const auto a = std::make_shared<FigureArguments>();
  return {.name = "figure",
          .summary = "Make a figure of [Lang] by its number; without a number, list them",
          .options = {{.names = "number", .target = &a->number, .doc = "Number of the figure, such as 7.4"},
                      {.names = "--all", .target = &a->all, .doc = "Make all figures and a contact sheet"},
                      {.names = "-o,--out",
                       .target = &a->out,
                       .doc = "File, .png or .svg; with --all the folder. Default figure-NUMBER.png"},
                      part_option(a->part),
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
