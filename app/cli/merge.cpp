// etendue merge: makes the image of a rendering, or the results of another command, from their parts.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <tuple>

#include "base/file.h"
#include "bench/reference_key.h"
#include "command.h"
#include "job_parts.h"
#include "progress_bar.h"
#include "render/image_output.h"
#include "render/partial_result.h"
#include "render_results.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string out, png, denoised, denoiser = "auto", aovs, json;
  uint32_t samples = 0;
  int threads = 0;
  bool partial = false;
};

// The number of missing ranges that a message names.
constexpr size_t kNamedGaps = 3;

// The descriptions of all parts, and of their union.
struct PartList {
  std::vector<render::PartInfo> infos;
  render::PartInfo merged;
};

Result<void> check_overlap(const PartList& list, const std::vector<std::string>& files) {
  std::vector<render::SampleBox> blocks;
  std::vector<size_t> owners;
  for (size_t i = 0; i < list.infos.size(); ++i)
    for (const auto& block : list.infos[i].blocks) {
      blocks.push_back(block);
      owners.push_back(i);
    }
  const auto overlap = render::find_overlap(blocks);
  if (!overlap) return {};
  const auto [a, b] = *overlap;
  const auto text = [&](size_t i) {
    return files[owners[i]] + " (" + text_of(blocks[i], list.merged.width, list.merged.height) + ")";
  };
  return input_error(text(b) + ": has samples in common with " + text(a) + "; give each sample once");
}

// Reads the descriptions and checks that the parts belong together.
Result<PartList> read_list(const std::vector<std::string>& files) {
  PartList list;
  for (const std::string& file : files) {
    auto info = render::read_part_info(file);
    if (!info) return info.error();
    if (info->version != ETENDUE_VERSION)
      return input_error(file + ": is a part of etendue " + info->version +
                         ", but this is etendue " ETENDUE_VERSION "; merge with the version that rendered it");
    if (!list.infos.empty())
      if (const std::string text = difference_of(*info, list.infos[0]); !text.empty())
        return input_error(file + ": is not a part of the same rendering as " + files[0] + ": " + text);
    list.infos.push_back(std::move(*info));
  }
  // The first part in the order of samples provides the settings that do not matter, such as the exposure.
  const auto first = std::ranges::min_element(list.infos, {}, [](const render::PartInfo& info) {
    const auto& block = info.blocks[0];
    return std::tuple(block.first, block.pixels.y, block.pixels.x);
  });
  list.merged = *first;
  list.merged.rays = list.merged.microseconds = 0;
  list.merged.blocks.clear();
  for (const auto& info : list.infos) {
    list.merged.rays += info.rays;
    list.merged.microseconds += info.microseconds;
    list.merged.blocks.insert(list.merged.blocks.end(), info.blocks.begin(), info.blocks.end());
  }
  if (auto ok = check_overlap(list, files); !ok) return ok.error();
  list.merged.blocks = render::joined(std::move(list.merged.blocks));
  return list;
}

uint32_t end_of(const render::PartInfo& info) {
  return std::ranges::max_element(info.blocks, {}, &render::SampleBox::end)->end;
}

// All pixels need the samples from 0 to `end`.
Result<void> check_complete(const render::PartInfo& info, uint32_t end) {
  if (end_of(info) > end)
    return usage_error("--spp: the parts have " + std::to_string(end_of(info)) + " samples per pixel, not " +
                       std::to_string(end));
  const auto gaps = render::find_gaps(info.blocks, info.width, info.height, end, kNamedGaps + 1);
  if (gaps.empty()) return {};
  std::string text;
  for (size_t i = 0; i < std::min(gaps.size(), kNamedGaps); ++i)
    text += (i > 0 ? "; " : "") + text_of(gaps[i], info.width, info.height);
  if (gaps.size() > kNamedGaps) text += "; and more";
  return input_error("merge: missing: " + text + "; render these, or give --partial to merge what there is");
}

Result<void> check_output(const MergeArguments& a) {
  for (const std::string& part : a.parts) {
    std::error_code code;
    if (std::filesystem::equivalent(part, a.out, code))
      return usage_error("merge: " + a.out + " is one of the parts; give another name to -o");
  }
  if (auto denoiser = render::denoiser_named(a.denoiser); !denoiser) return denoiser.error();
  if (!a.partial) return check_names(a.out, {a.png, a.denoised}, "merge");
  if (!a.out.ends_with(".exr")) return usage_error("merge: '" + a.out + "' cannot hold a part; give -o FILE.exr");
  if (!a.png.empty() || !a.denoised.empty() || !a.aovs.empty() || !a.json.empty())
    return usage_error("merge: --partial has no --png, --aov and --json; give them to the last merge");
  return check_writable(a.out);
}

// Adds the parts one after the other. The next one is read meanwhile.
Result<render::PartialSamples> merged_samples(const MergeArguments& a, const PartList& list) {
  const int width = list.merged.width, height = list.merged.height;
  render::PartialSamples samples{film::Film(width, height), {}};
  samples.tails.resize(render::TailStatistics::tile_count(width, height));
  Progress progress;
  const auto load = [&](size_t i) {
    return std::async(std::launch::async, [&, i] { return render::load_part(a.parts[i], list.infos[i]); });
  };
  auto next = load(0);
  for (size_t i = 0; i < a.parts.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(a.parts.size()), a.parts[i]);
    const auto part = next.get();
    if (!part) return part.error();
    if (i + 1 < a.parts.size()) next = load(i + 1);
    render::add_part(*part, list.infos[i], samples);
  }
  progress.finish();
  return samples;
}

// The document of the image. The scene must be the one that the parts have.
Result<render::Document> document_of(const render::PartInfo& info, const std::string& file, uint32_t samples) {
  auto document = render::document_from_state(info.state, file);
  if (!document) return document;
  document->limits = {};
  if (bench::image_key(*document) != info.scene_hash)
    return input_error(document->scene_name + ": has changed since " + file +
                       " was rendered; merge with the scene of the parts");
  document->limits.samples = samples;
  return document;
}

Result<void> merge(const MergeArguments& a) {
  if (auto ok = check_output(a); !ok) return ok;
  const auto aovs = parse_aovs(a.aovs);
  if (!aovs) return aovs.error();
  if (has_light_path_layers(*aovs))
    return usage_error("merge: --aov: parts do not hold layers of light paths; record them with etendue render");
  const auto list = read_list(a.parts);
  if (!list) return list.error();
  if (a.partial) {
    auto samples = merged_samples(a, *list);
    return samples ? render::write_part(a.out, list->merged, *samples) : Result<void>(samples.error());
  }
  const uint32_t end = a.samples > 0 ? a.samples : end_of(list->merged);
  if (auto ok = check_complete(list->merged, end); !ok) return ok;
  const auto document = document_of(list->merged, a.parts[0], end);
  if (!document) return document.error();
  auto samples = merged_samples(a, *list);
  if (!samples) return samples.error();
  const ResultFiles files{.out = a.out,
                          .png = a.png,
                          .json = a.json,
                          .denoised = a.denoised,
                          .denoiser = a.denoiser,
                          .aovs = *aovs,
                          .threads = a.threads};
  const double seconds = static_cast<double>(list->merged.microseconds) * 1e-6;
  return write_samples(*document, {std::move(*samples), list->merged.rays, seconds}, files);
}

int run_merge(const MergeArguments& a) {
  if (!job_part::is_part(a.parts[0])) {
    const auto merged = merge(a);
    return merged ? 0 : fail(merged.error());
  }
  if (a.partial || a.samples > 0 || !a.png.empty() || !a.denoised.empty() || !a.aovs.empty() || !a.json.empty())
    return fail(usage_error("merge: " + a.parts[0] + " is not a part of a rendering; give -o FOLDER as only option"));
  return merge_job_parts(a.parts, a.out);
}

}  // namespace

Command merge_command() {
  const auto a = std::make_shared<MergeArguments>();
  return {
      .name = "merge",
      .summary =
          "Merge parts: of render --samples or --region to an image, of bench, stress or figure --part to results",
      .options = {{.names = "parts",
                   .target = &a->parts,
                   .doc = "Parts of one rendering or of one command, in any order",
                   .required = true},
                  {.names = "-o,--out",
                   .target = &a->out,
                   .doc = "Output file, as of etendue render; for parts of bench, stress and figure the folder",
                   .required = true},
                  {.names = "--partial",
                   .target = &a->partial,
                   .doc = "Write a part that contains the given ones, which can be merged again"},
                  {.names = "--spp",
                   .target = &a->samples,
                   .doc = "Samples per pixel that the parts must have together; default: those of the last part",
                   .bounds = between(1, 1'000'000)},
                  {.names = "--png", .target = &a->png, .doc = "Additional output of the displayed image, a .png"},
                  {.names = "--denoise",
                   .target = &a->denoised,
                   .doc =
                       "Additional output of the denoised image, .png (as displayed), .exr or .hdr (linear); biased, "
                       "for display only"},
                  denoiser_option(a->denoiser),
                  {.names = "--aov", .target = &a->aovs, .doc = "Additional layers of the .exr, as of etendue render"},
                  {.names = "--json", .target = &a->json, .doc = "File for statistics as JSON; '-' is standard output"},
                  threads_option(a->threads)},
      .run = [a] { return run_merge(*a); }};
}

}  // namespace etendue::cli
