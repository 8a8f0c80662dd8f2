// What an integrator is to the rest of the program: a description, parameters, and the work of making a picture.
//
// A picture is made sample by sample of all its pixels. A method that gathers answers for a block of pixels at a time,
// and for each by itself. One that sends something out first (photons, virtual lights), or whose paths end on pixels
// that it did not choose (light paths, Markov chains), has phases before that, whose tasks run side by side. All of it
// is chosen through virtual calls of tasks that trace thousands of rays; inside, the hot loops are templates over the
// transport model.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/stopwatch.h"
#include "camera/camera_ray.h"
#include "film/filter.h"
#include "film/splats.h"
#include "sampling/sampler.h"
#include "scene/compiled.h"
#include "transport/model.h"

namespace etendue::integrator {

enum class Bias { unbiased, consistent, biased };
std::string_view bias_name(Bias bias);

// How samples come to the pixels.
enum class Sampling {
  pixels,    // block by block, each by itself: a pixel may have more of them than another
  pictures,  // block by block, but all pixels of the picture have the same number at a time
  splats,    // and what is found in a block, or before it, may belong to pixels anywhere
  only_splats
};

// The families of methods, as the thesis has them.
enum class Group { gathering, shooting, bidirectional, markov_chain, two_pass };

struct GroupInfo {
  const char *name, *label, *doc;
};
inline constexpr std::array<GroupInfo, 5> kGroups{
    {{"gathering", "Gathering", "Rays and walks from the camera, which collect light"},
     {"shooting", "Shooting", "Walks from the lights, which bring light to the picture"},
     {"bidirectional", "Bidirectional", "Walks from both ends, connected"},
     {"markov-chain", "Markov chain", "Paths that are changes of paths, most of them where the light is"},
     {"two-pass", "Two-pass", "Light is laid down in the scene first, and looked up from the camera then"}}};
inline const GroupInfo& info_of(Group group) { return kGroups[static_cast<size_t>(group)]; }

// The parameters of a method that finds each path by several techniques (s, t), s vertices from the light and t from
// the camera: two that take sets of them (integrator/techniques.h), those left to the others and those shown alone, and
// the switch of their weights. Empty for all other methods.
struct TechniqueKnobs {
  std::string_view without, only, weighted;

  bool empty() const { return only.empty(); }
};

struct IntegratorInfo {
  std::string name, label, doc;
  Group group = Group::gathering;
  std::string paths;  // the light paths it finds, in Heckbert's notation as the thesis extends it (8.1)
  // Those among them that it finds even if the light has no extent (point, spot, directional); empty if none.
  std::string point_paths;
  Bias bias = Bias::unbiased;
  Sampling sampling = Sampling::pixels;
  std::string cost, fails;
  char key = 0;  // that chooses it in the viewer, '1' to '9'; the most used have one
  TechniqueKnobs techniques;
  std::vector<ParameterInfo> parameters;
};

// Everything of a picture that does not change from pixel to pixel.
struct Pass {
  const scene::CompiledScene* scene;
  const transport::Model* model;
  const Sampler* sampler;
  const CameraRays* camera;
  const film::Filter* filter;
  uint64_t seed;  // the user's
  int width, height;
  // When all paths are, from 0 at the shutter's opening to 1 at its closing; empty: each has a time of its own, if
  // anything moves.
  std::optional<float> moment{};

  bool draws_times() const { return model->moving && !moment; }
};

// The same with one moment for all of a sample, where anything moves: for methods whose first pass must see what the
// second does. Moments of the samples of a half lie evenly over the time that the shutter is open.
Pass at_one_moment(Pass pass, uint32_t sample);

// One sample of each pixel of a rectangle, kWidth x kHeight pixels at most.
struct PixelBlock {
  static constexpr int kWidth = 32, kHeight = 16;
  static constexpr size_t kMostPixels = size_t{kWidth} * kHeight;
  int x, y, width, height;
  uint32_t sample;  // counts all samples of a pixel: it alternates between the film's halves
};

// What a task is given besides its name.
struct Turn {
  const std::function<bool()>* wanted = nullptr;  // asked now and then: a task is given up if nobody wants it any more
  film::Splats* splats = nullptr;                 // takes what is found for pixels anywhere
  // Runs, if anybody asks, while a task is busy with neither rays nor shading: with the numbers and decisions of Markov
  // chains, or looking up photons. All tasks that it is given to run on one thread.
  Stopwatch* bookkeeping = nullptr;
};

// Tasks that may run side by side, and are done before anything else goes on.
struct Phase {
  const char* name;  // for people: "tracing photons"
  int tasks;
};

// Something that a method keeps in space: a photon, a virtual light.
struct PointOfLight {
  Vec3 position;
  Rgb power;  // watts
};

// A number that a method knows about its own work.
struct Statistic {
  std::string name;  // "accepted-large-steps"
  double value;
  std::string unit, doc;
};

// One picture in the making: what a method keeps from one sample of its pixels to the next. Tasks return the number of
// rays traced; nothing if they were given up, and are then done again from their beginning.
class Work {
 public:
  virtual ~Work() = default;

  // What comes before sample `sample` of the pixels.
  virtual std::vector<Phase> phases(uint32_t sample) { return (void)sample, std::vector<Phase>(); }
  virtual std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const Turn& turn);
  // Called alone, after the last task of a phase.
  virtual void finish(uint32_t sample, size_t phase) { (void)sample, (void)phase; }

  // Fills `radiance` row by row of the block. Of methods that only splat nobody asks it.
  virtual std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn);

  virtual size_t memory() const { return 0; }  // bytes, of what it keeps

  // A look at what it keeps in space, between two tasks: kMostPoints at most; null if it keeps nothing of the kind.
  static constexpr size_t kMostPoints = 200'000;
  virtual std::shared_ptr<const std::vector<PointOfLight>> points() const { return nullptr; }
  // Asked between tasks.
  virtual std::vector<Statistic> statistics() const { return {}; }

  // What later samples depend on besides their numbers (the states of Markov chains), as it was before anything was
  // done for sample `sample`, the present or the next one; empty if there is nothing. An equal work that takes it up
  // before its first sample goes on to the same bits; one that refuses goes on in its own way, as correctly.
  virtual std::vector<std::byte> state(uint32_t sample) const { return (void)sample, std::vector<std::byte>(); }
  virtual bool restore(std::span<const std::byte> state) { return state.empty(); }
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual std::vector<ParameterInfo> parameters() const = 0;
  virtual bool set(std::string_view name, const Value& value) = 0;
  // What `pass` points to, and the integrator itself, must outlive the work. `previous` is what the picture before this
  // one left, by any method, or null: what it knows of the same scene may be used again.
  virtual std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const = 0;
  // Why it finds no light at all in this picture, and what to do about it; empty if nothing stands in its way.
  virtual std::string obstacle(const Pass& pass) const { return (void)pass, std::string(); }
};

const std::vector<IntegratorInfo>& integrator_infos();
const IntegratorInfo* find_integrator(std::string_view name);

// Whether an integrator finds any of the paths that an expression (PathExpression::parse_paths takes it, or it is
// empty) stands for. What it does not find is missing from its image, or black.
bool finds_any(const IntegratorInfo& info, std::string_view paths);

// `settings` must have been checked; names the integrator does not have are ignored.
std::unique_ptr<Integrator> make_integrator(std::string_view name, const std::vector<Setting>& settings = {});

}  // namespace etendue::integrator
