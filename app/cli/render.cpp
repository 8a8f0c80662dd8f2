// etendue render: renders a scene to a file until a limit on samples, time or error is reached.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <thread>

#include "advisor/choice_revision.h"
#include "base/number_text.h"
#include "base/provided_files.h"
#include "bench/reference_key.h"
#include "cluster/checkpoint_ranges.h"
#include "cluster/mpi_job.h"
#include "cluster/single_rank.h"
#include "command.h"
#include "interrupt.h"
#include "part_options.h"
#include "progress_bar.h"
#include "render/checkpoint.h"
#include "render/division.h"
#include "render/image_output.h"
#include "render/incompatibility.h"
#include "render/light_path_layers.h"
#include "render/partial_result.h"
#include "render/session.h"
#include "render/session_file.h"
#include "render_ranks.h"
#include "render_results.h"
#include "render_statistics.h"
#include "revised_render.h"
#include "scene/builtin/builtin.h"
#include "sample_difference.h"
#include "scene_options.h"
#include "sequence_options.h"

namespace etendue::cli {
namespace {

constexpr uint32_t kDefaultSamples = 64;  // per pixel, without any limit
constexpr const char* kFromRank0 = "rank0";

struct RenderArguments {
  SceneArguments scene;
  PartArguments part;
  SequenceArguments sequence;
  std::string out, png, denoised, denoiser = "auto", integrator, sampler, aovs, json, resume, like, measure, scene_from;
  uint32_t samples = 0;
  double seconds = 0, error = 0, checkpoint_interval = 0;
  int threads = 0, max_depth = -1, collectors = -1;
  int64_t seed = -1;
  double exposure = NAN;
};

std::string checkpoint_file_of(const RenderArguments& a) {
  return a.resume.empty() ? render::checkpoint_of_image(a.out) : a.resume;
}

// The fraction of the time limit that remains for the rendering if the choice of the integrator took longer than
// planned.
constexpr double kLeastRemainingTime = 0.5;

// The document to render, and the samples that exist already.
struct Start {
  render::Document document;
  std::optional<render::ResumePoint> resume_point = {};
  double seconds = 0;                 // of rendering that the existing samples took
  cluster::SampleRanges ranges = {};  // the numbers of the existing samples
};

Result<Start> start_from_checkpoint(const std::string& file) {
  auto checkpoint = render::read_checkpoint(file);
  if (!checkpoint) return checkpoint.error();
  auto document = render::document_from_state(checkpoint->state, file);
  if (!document) return document.error();
  document->part = render::part_from_state(checkpoint->state);
  if (const auto& region = document->part.region; region && !is_inside(*region, document->width, document->height))
    return input_error(file + ": its region is not a part of the image; render this part again");
  auto ranges = cluster::ranges_of(checkpoint->state, checkpoint->film.samples(0, 0));
  return Start{.document = std::move(*document),
               .resume_point = render::ResumePoint(std::move(checkpoint->film), std::move(checkpoint->integrator_state),
                                                   std::move(checkpoint->tails)),
               .seconds = checkpoint->seconds,
               .ranges = std::move(ranges)};
}

Result<Start> start_like(const std::string& file) {
  if (std::filesystem::path(file).extension() == render::kSessionExtension) {
    auto document = render::read_session_file(file);
    if (!document) return document.error();
    return Start{.document = std::move(*document)};
  }
  const auto snapshot = image::read_exr(file);
  if (!snapshot) return snapshot.error();
  const auto state = snapshot->attributes.find(render::kStateAttribute);
  if (state == snapshot->attributes.end())
    return input_error(file + ": the file carries no settings; give an .exr that etendue wrote");
  auto document = render::document_from_state(state->second, file);
  if (!document) return document.error();
  return Start{.document = std::move(*document)};
}

Result<Start> find_start(const RenderArguments& a) {
  if (!a.resume.empty()) return start_from_checkpoint(a.resume);
  if (!a.like.empty()) return start_like(a.like);
  if (a.scene.scene.empty())
    return usage_error("render: no scene; give a .gltf or .glb file, or one of " + scene::builtin_names());
  auto document = open_scene_or_session(a.scene.scene, a.scene.camera);
  if (!document) return document.error();
  return Start{.document = std::move(*document)};
}

// The arguments of a resumed rendering may repeat the settings of its checkpoint, but not change them.
Result<void> check_resumed(const RenderArguments& a, const render::Document& checkpoint, render::Document changed) {
  changed.limits = checkpoint.limits;
  std::string difference = sample_difference(checkpoint, changed);
  std::string scene = a.scene.scene;
  if (scene.ends_with(render::kSessionExtension)) {
    const auto session = render::read_session_file(scene);
    if (!session) return session.error();
    scene = session->scene_name;
  }
  if (!scene.empty() && scene != checkpoint.scene_name)
    difference = "the scene is " + checkpoint.scene_name + ", not " + scene;
  else if (!a.scene.camera.empty() && a.scene.camera != checkpoint.camera_name)
    difference = "the camera is " + checkpoint.camera_name + ", not " + a.scene.camera;
  if (difference.empty()) return {};
  return usage_error("--resume: a checkpoint continues with its own settings: " + difference);
}

Result<void> apply(const RenderArguments& a, render::Document& d) {
  const auto set = [&](const std::string& name, const std::string& value) {
    return value.empty() ? Result<void>() : set_parameter(d, name, value);
  };
  if (auto r = set_size(d, a.scene.size); !r) return r;
  if (auto r = set("render.integrator", a.integrator); !r) return r;
  // A method that was chosen for the image of --like is chosen again on request only.
  if (a.integrator == render::kAutomatic && a.resume.empty()) d.automatic.reason.clear();
  if (auto r = set("render.sampler", a.sampler); !r) return r;
  if (auto r = set_environment(d, a.scene.environment); !r) return r;
  if (auto r = set_parameters(d, a.scene.settings); !r) return r;
  if (auto r = set("film.paths", a.scene.paths); !r) return r;
  if (auto r = set("max-depth", a.max_depth >= 0 ? std::to_string(a.max_depth) : ""); !r) return r;
  if (auto r = set("render.seed", a.seed >= 0 ? std::to_string(a.seed) : ""); !r) return r;
  if (auto r = set("camera.exposure", std::isnan(a.exposure) ? "" : std::to_string(a.exposure)); !r) return r;
  const std::string reason = render::adaptive_incompatibility(d.method.integrator);
  if (d.method.adaptive != render::Adaptive::off && !reason.empty()) return usage_error("render.adaptive: " + reason);
  // Snapshots, sessions and checkpoints carry limits, which hold unless there are new ones.
  const bool is_session = a.scene.scene.ends_with(render::kSessionExtension);
  const bool carries_limits = !a.like.empty() || !a.resume.empty() || is_session;
  if (a.samples > 0 || a.seconds > 0 || a.error > 0 || !carries_limits)
    d.limits = {a.samples, a.seconds, a.error, d.limits.measure};
  if (!a.measure.empty()) d.limits.measure = measure_of(a.measure);
  if (!d.limits.any()) d.limits.samples = kDefaultSamples;
  return {};
}

// One rendering: runs the session with progress and checkpoints, then writes the results.
class RenderJob {
 public:
  RenderJob(const RenderArguments& a, std::vector<std::string> aovs, Start start, bool writes_part)
      : a_(a),
        writes_part_(writes_part),
        aovs_(std::move(aovs)),
        document_(std::move(start.document)),
        earlier_seconds_(start.seconds),
        checkpoint_file_(checkpoint_file_of(a)),
        resume_point_(std::move(start.resume_point)),
        session_({.threads = a.threads}) {}

  int run() {
    const std::atomic<bool>& interrupted = watch_interrupts();
    if (document_.automatic.is_pending())
      if (auto ok = choose_method(interrupted); !ok) return fail(ok.error());
    if (choice_ && choice_->interrupted) {
      std::fprintf(stderr, "etendue: interrupted while the integrator was chosen; nothing was rendered\n");
      return static_cast<int>(Fault::interrupted);
    }
    if (auto ok = record_layers(); !ok) return fail(ok.error());
    if (is_revised()) {
      RevisedRendering rendering =
          render_with_revision(session_, document_, *choice_, seconds_after_choice(), interrupted);
      document_ = std::move(rendering.document);
      status_ = rendering.status;
    } else {
      submit();
      if (auto ok = render(interrupted); !ok) return fail(ok.error());
      status_ = session_.status();
    }
    print_incompatibility();
    print_notes();
    if (interrupted && a_.checkpoint_interval > 0)
      if (auto ok = write_checkpoint(); !ok) return fail(ok.error());
    if (interrupted && writes_part_) {
      std::fprintf(stderr, "etendue: interrupted at %u spp; %s was not written, because a part needs all its samples\n",
                   status_.samples, a_.out.c_str());
      return static_cast<int>(Fault::interrupted);
    }
    if (auto ok = write_files(); !ok) return fail(ok.error());
    if (!writes_part_) print_reliability(a_.out, status_);
    if (interrupted) {
      std::fprintf(stderr, "etendue: interrupted at %u spp; %s holds the result so far\n", status_.samples,
                   a_.out.c_str());
      return static_cast<int>(Fault::interrupted);
    }
    std::error_code ignored;
    if (a_.checkpoint_interval > 0 || !a_.resume.empty()) std::filesystem::remove(checkpoint_file_, ignored);
    return 0;
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Resolves the automatic integrator, and prints the reason.
  Result<void> choose_method(const std::atomic<bool>& interrupted) {
    Progress progress;
    const auto show_progress = [&](double done, const std::string& task) {
      progress.show(done, task);
      return !interrupted;
    };
    auto choice = advisor::choose_method(session_, document_, show_progress);
    progress.finish();
    if (!choice) return choice.error();
    choice_ = std::move(*choice);
    if (!choice_->interrupted)
      std::fprintf(stderr, "etendue: %s (%s)\n", choice_->reason.c_str(), format_duration(choice_->seconds).c_str());
    document_ = advisor::with_choice(std::move(document_), *choice_);
    return {};
  }

  // Whether the choice is revised during the rendering: if only the time is limited. A checkpoint holds the film of one
  // integrator.
  bool is_revised() const {
    return choice_ && advisor::is_revisable(*choice_) && document_.limits.samples == 0 && document_.limits.error == 0 &&
           a_.checkpoint_interval <= 0 && !resume_point_;
  }

  // Time for the choice of the integrator counts towards the time limit.
  double seconds_after_choice() const {
    const double seconds = document_.limits.seconds;
    return choice_ ? std::max(kLeastRemainingTime * seconds, seconds - choice_->seconds) : seconds;
  }

  // Prepares the recording of layers of light paths, which belongs to the first sample.
  Result<void> record_layers() {
    if (!has_light_path_layers(aovs_)) return {};
    auto recording = render::record_light_path_layers(document_, aovs_);
    if (!recording) return recording.error();
    path_layers_ = std::move(*recording);
    resume_point_.emplace(film::Film(document_.width, document_.height));
    resume_point_->layers = path_layers_;
    return {};
  }

  void submit() {
    render::Document limited = document_;
    if (limited.limits.seconds > 0) limited.limits.seconds = seconds_after_choice();
    version_ = resume_point_ ? session_.submit(limited, std::move(*resume_point_)) : session_.submit(limited);
  }

  Result<void> render(const std::atomic<bool>& interrupted) {
    Progress progress;
    auto last_checkpoint = Clock::now();
    // Until the session has started this version, the status is that of a pilot.
    while (!(status_.version == version_ && status_.finished) && !interrupted) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      status_ = session_.status();
      if (status_.version != version_) continue;
      print_incompatibility();
      print_notes();
      progress.show(status_.progress, progress_text(status_));
      const double elapsed = std::chrono::duration<double>(Clock::now() - last_checkpoint).count();
      if (a_.checkpoint_interval > 0 && elapsed >= a_.checkpoint_interval) {
        if (auto ok = write_checkpoint(); !ok) return ok;
        last_checkpoint = Clock::now();
      }
    }
    session_.stop();
    return {};
  }

  // Warns once if the integrator finds no light.
  void print_incompatibility() {
    if (incompatibility_printed_ || status_.incompatibility.empty()) return;
    std::fprintf(stderr, "etendue: %s\n", status_.incompatibility.c_str());
    incompatibility_printed_ = true;
  }

  // Prints each note of the integrator once.
  void print_notes() {
    for (const std::string& note : status_.notes)
      if (notes_printed_.insert(note).second) std::fprintf(stderr, "etendue: %s\n", note.c_str());
  }

  Result<void> write_checkpoint() {
    const render::Status status = session_.status();
    render::ResumePoint point = session_.resume_point();
    return render::write_checkpoint(checkpoint_file_, {.state = render::state_json(document_, status.samples),
                                                       .film = std::move(point.film),
                                                       .seconds = status.seconds + earlier_seconds_,
                                                       .integrator_state = std::move(point.integrator_state),
                                                       .tails = std::move(point.tails)});
  }

  // A part has no certificate, because its samples alone are not the image.
  Result<void> write_part() {
    render::Document whole = document_;
    whole.limits = {};
    whole.part = {};
    const render::RenderPart& part = document_.part;
    const render::PixelRect all{0, 0, document_.width, document_.height};
    const render::SampleBox block{part.first_sample, part.first_sample + status_.samples, part.region.value_or(all)};
    const double seconds = status_.seconds + earlier_seconds_;
    render::PartInfo info{.state = render::state_json(whole, 0),
                          .version = ETENDUE_VERSION,
                          .scene_hash = bench::image_key(whole),
                          .width = document_.width,
                          .height = document_.height,
                          .blocks = {block},
                          .rays = status_.rays,
                          .microseconds = static_cast<uint64_t>(seconds * 1e6)};
    if (auto ok = render::write_part(a_.out, std::move(info), {session_.film_copy(), session_.tail_states()}); !ok)
      return ok;
    if (a_.json.empty()) return {};
    return write_statistics(a_.json, statistics_json({.document = document_,
                                                      .status = status_,
                                                      .model = session_.model(),
                                                      .threads = a_.threads,
                                                      .certificate = "null",
                                                      .choice = "null"}));
  }

  Result<void> write_files() {
    if (writes_part_) return write_part();
    const std::string choice = choice_ ? advisor::choice_json(*choice_) : "null";
    return write_results(session_, document_, status_,
                         {.out = a_.out,
                          .png = a_.png,
                          .json = a_.json,
                          .denoised = a_.denoised,
                          .denoiser = a_.denoiser,
                          .aovs = aovs_,
                          .threads = a_.threads,
                          .path_layers = path_layers_},
                         choice);
  }

  const RenderArguments& a_;
  bool writes_part_;
  std::vector<std::string> aovs_;
  render::Document document_;
  double earlier_seconds_;
  std::string checkpoint_file_;
  std::optional<render::ResumePoint> resume_point_;
  std::shared_ptr<integrator::PathLayerRecording> path_layers_;  // null: none
  std::optional<advisor::MethodChoice> choice_;  // of the automatic integrator, if it was made by this job
  render::Session session_;
  uint64_t version_ = 0;  // of the document in the session
  render::Status status_;
  bool incompatibility_printed_ = false;
  std::set<std::string> notes_printed_;
};

// The part of the arguments, or that of a checkpoint, which the arguments may repeat. Parts have a fixed number of
// samples.
Result<void> check_part_arguments(const RenderArguments& a, Start& start) {
  render::Document& d = start.document;
  if (a.seconds > 0 || a.error > 0)
    return usage_error("render: a part has a fixed number of samples; give --samples or --spp, not --time or --error");
  if (!a.png.empty() || !a.aovs.empty() || !a.denoised.empty())
    return usage_error("render: a part has no --png, no --aov and no --denoise; give them to etendue merge");
  if (!a.out.ends_with(".exr")) return usage_error("render: '" + a.out + "' cannot hold a part; give -o FILE.exr");
  if (start.resume_point) return check_resumed_part(a.part, d);
  if (auto ok = apply_part(a.part, a.samples, d); !ok) return ok;
  const std::string reason = render::division_incompatibility(d);
  return reason.empty() ? Result<void>() : Result<void>(usage_error("render: " + reason));
}

// The film with a whole number of samples per pixel, which the ranks need. That of an interrupted rendering may have one
// more in some pixels.
Result<void> complete_sample(const RenderArguments& a, Start& start) {
  const film::Film& film = start.resume_point->film;
  uint32_t least = film.samples(0, 0), most = least;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      least = std::min(least, film.samples(x, y));
      most = std::max(most, film.samples(x, y));
    }
  if (least == most) return {};
  render::Document document = start.document;
  document.limits = {least + 1, 0, 0, document.limits.measure};
  render::Session session({.threads = a.threads});
  session.submit(document, std::move(*start.resume_point));
  session.finish();
  start.resume_point = session.resume_point();
  start.ranges = {};
  start.ranges.add({0, least + 1});
  return {};
}

int run_on_rank_0(const RenderArguments& a, cluster::Communicator& ranks, std::vector<std::string> aovs, Start start) {
  if (a.part.is_given() || !start.document.part.is_whole())
    return fail(usage_error("render: mpirun divides the rendering itself; leave out --samples and --region"));
  if (const std::string reason = ranks_incompatibility(start.document); !reason.empty())
    return fail(usage_error("render: mpirun: " + reason));
  std::optional<RenderedSamples> rendered;
  if (start.resume_point) {
    if (auto ok = complete_sample(a, start); !ok) return fail(ok.error());
    rendered = {{std::move(start.resume_point->film), std::move(start.resume_point->tails)},
                std::move(start.ranges),
                start.seconds};
  }
  const RanksArguments arguments{
      .files = {.out = a.out,
                .png = a.png,
                .json = a.json,
                .denoised = a.denoised,
                .denoiser = a.denoiser,
                .aovs = std::move(aovs),
                .threads = a.threads},
      .checkpoint_file = checkpoint_file_of(a),
      .checkpoint_interval = a.checkpoint_interval,
      .resumes = !a.resume.empty(),
      .sends_scene = a.scene_from == kFromRank0,
      .collectors = a.collectors >= 0 ? std::optional(a.collectors) : std::nullopt};
  return render_on_ranks(ranks, start.document, arguments, std::move(rendered));
}

// Whether samples before the last one are missing, because several ranks were interrupted.
bool has_gaps(const Start& start) { return !start.ranges.contains({0, start.ranges.count()}); }

// Layers of light paths are recorded with all samples of the image, by one process.
Result<void> check_layers(const RenderArguments& a, const std::vector<std::string>& aovs, const Start& start,
                          bool has_ranks) {
  if (!has_light_path_layers(aovs)) return {};
  if (has_ranks) return usage_error("--aov: layers of light paths cannot be recorded by several processes");
  if (!a.resume.empty() || a.checkpoint_interval > 0)
    return usage_error("--aov: checkpoints do not hold layers of light paths; leave out --checkpoint and --resume");
  if (start.document.automatic.is_pending()) return {};
  const auto recording = render::record_light_path_layers(start.document, aovs);
  return recording ? Result<void>() : Result<void>(recording.error());
}

// The arguments for one image of a sequence, whose files have its number.
RenderArguments with_frame_files(RenderArguments a, uint32_t number) {
  for (std::string* file : {&a.out, &a.png, &a.denoised, &a.json})
    if (!file->empty()) *file = render::frame_file(*file, number);
  return a;
}

// Renders image after image. Ends at the first one that fails or is interrupted.
int run_sequence(const RenderArguments& a, const std::vector<std::string>& aovs, const render::Document& document) {
  if (a.json == "-") return fail(usage_error("render: --json - holds one image; give a file, which is numbered as well"));
  const auto sequence = image_sequence(document, a.sequence);
  if (!sequence) return fail(sequence.error());
  const render::FrameRange range = sequence->range();
  for (uint32_t frame = range.first; frame < range.end; ++frame) {
    const auto shown = sequence->at(frame);
    if (!shown) return fail(shown.error());
    const RenderArguments arguments = with_frame_files(a, frame);
    std::fprintf(stderr, "etendue: image %u of %u: %s\n", frame - range.first + 1, range.count(), arguments.out.c_str());
    if (const int code = RenderJob(arguments, aovs, {.document = *shown}, false).run(); code != 0) return code;
  }
  return 0;
}

// Wrong arguments fail before anything is rendered. `ranks` is null if there is one process only.
int run_render(const RenderArguments& a, cluster::Communicator* ranks) {
  if (auto ok = check_names(a.out, {a.png, a.denoised}, "render"); !ok) return fail(ok.error());
  if (auto denoiser = render::denoiser_named(a.denoiser); !denoiser) return fail(denoiser.error());
  auto aovs = parse_aovs(a.aovs);
  if (!aovs) return fail(aovs.error());
  auto start = find_start(a);
  if (!start) return fail(start.error());
  const render::Document resumed = start->document;
  if (auto ok = apply(a, start->document); !ok) return fail(ok.error());
  if (!a.resume.empty())
    if (auto ok = check_resumed(a, resumed, start->document); !ok) return fail(ok.error());
  const bool writes_part = a.part.is_given() || !start->document.part.is_whole();
  if (a.sequence.is_given() && (ranks || writes_part || !a.resume.empty() || a.checkpoint_interval > 0))
    return fail(usage_error("render: --frames and --turntable render whole images by one process; leave out mpirun, "
                            "--samples, --region, --checkpoint and --resume, and divide the frames instead"));
  // A single rank renders as a process without mpirun does.
  if (ranks && ranks->size() == 1) ranks = nullptr;
  if (writes_part && !ranks)
    if (auto ok = check_part_arguments(a, *start); !ok) return fail(ok.error());
  if (auto ok = check_layers(a, *aovs, *start, ranks != nullptr); !ok) return fail(ok.error());
  print_warnings(start->document);
  if (a.sequence.is_given()) return run_sequence(a, *aovs, start->document);
  if (ranks) return run_on_rank_0(a, *ranks, std::move(*aovs), std::move(*start));
  if (start->resume_point && has_gaps(*start)) {
    cluster::SingleRank single;
    return run_on_rank_0(a, single, std::move(*aovs), std::move(*start));
  }
  return RenderJob(a, std::move(*aovs), std::move(*start), writes_part).run();
}

int run_render_command(const RenderArguments& a) {
  if (!cluster::is_mpi_job()) return run_render(a, nullptr);
  if (a.scene_from == kFromRank0) record_files_read();
  return run_on_ranks(a.threads, [&](cluster::Communicator& ranks) { return run_render(a, &ranks); });
}

}  // namespace

Command render_command() {
  const auto a = std::make_shared<RenderArguments>();
  return {
      .name = "render",
      .summary = "Render a scene to an image file",
      .options = {scene_option(a->scene.scene, false),
                  {.names = "-o,--out",
                   .target = &a->out,
                   .doc = "Output file: .exr (linear, with all settings), .hdr (linear), .png (as displayed), "
                          "or of another format"},
                  {.names = "--png", .target = &a->png, .doc = "Additional output of the displayed image, a .png"},
                  {.names = "--denoise",
                   .target = &a->denoised,
                   .doc = "Additional output of the denoised image, .png (as displayed), .exr or .hdr (linear); biased, "
                          "for display only"},
                  denoiser_option(a->denoiser),
                  {.names = "--spp",
                   .target = &a->samples,
                   .doc = "Samples per pixel (64 if no limit is given)",
                   .bounds = between(1, 1'000'000)},
                  samples_option(a->part.samples),
                  region_option(a->part.region),
                  frames_option(a->sequence.frames),
                  frames_per_second_option(a->sequence.frames_per_second),
                  turntable_option(a->sequence.turntable),
                  {.names = "--time", .target = &a->seconds, .doc = "Rendering time in seconds", .bounds = kPositive},
                  {.names = "--error",
                   .target = &a->error,
                   .doc = "Stop at this estimated error; 0.01 is 1 % of a relative or displayed error",
                   .bounds = kPositive},
                  error_measure_option(a->measure, "Measure of --error: rmse, relative or displayed (rmse)"),
                  {.names = "--integrator",
                   .target = &a->integrator,
                   .doc = "Light transport algorithm; see etendue list integrators. auto: chosen by short pilot "
                          "renderings (auto.allow, auto.error)"},
                  {.names = "--sampler", .target = &a->sampler, .doc = "Sampler; see etendue list samplers"},
                  set_option(a->scene.settings),
                  size_option(a->scene.size),
                  camera_option(a->scene.camera),
                  seed_option(a->seed),
                  threads_option(a->threads),
                  {.names = "--max-depth",
                   .target = &a->max_depth,
                   .doc = "Largest number of path segments from camera to light; 0: no limit",
                   .bounds = between(0, 1000)},
                  paths_option(a->scene.paths),
                  {.names = "--aov",
                   .target = &a->aovs,
                   .doc = "Additional layers of the .exr, separated by commas, e.g. albedo,depth; all: those of first "
                          "hits; media: the terms of the equation of transfer; bounces, direct-indirect, photon-terms, "
                          "NAME=EXPRESSION: parts of the light, recorded with the image"},
                  environment_option(a->scene.environment),
                  {.names = "--exposure",
                   .target = &a->exposure,
                   .doc = "Exposure compensation of the .png in EV",
                   .bounds = between(-30, 30)},
                  {.names = "--json", .target = &a->json, .doc = "File for statistics as JSON; '-' is standard output"},
                  {.names = "--checkpoint",
                   .target = &a->checkpoint_interval,
                   .doc = "Time between checkpoints in seconds; they are written to OUT.checkpoint",
                   .bounds = kPositive},
                  {.names = "--resume",
                   .target = &a->resume,
                   .doc = "Continue from this checkpoint; other options may repeat its settings"},
                  {.names = "--like",
                   .target = &a->like,
                   .doc = "Use all settings of this .exr that etendue wrote, or of this session (.etendue)"},
                  {.names = "--scene-from",
                   .target = &a->scene_from,
                   .doc = "Where the ranks of a job of mpirun read the scene: each from disk (the default), or from "
                          "rank0, which sends all files of the scene to the others",
                   .choices = {"disk", kFromRank0}},
                  {.names = "--collectors",
                   .target = &a->collectors,
                   .doc =
                       "Number of ranks of a job of mpirun that add results for rank 0; default: none, or the square "
                       "root of the number of ranks if rank 0 would be too slow",
                   .bounds = between(0, 10'000)}},
      .run = [a] { return run_render_command(*a); },
      .supports_ranks = true};
}

}  // namespace etendue::cli
