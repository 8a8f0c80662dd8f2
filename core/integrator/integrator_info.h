// Descriptions of integrators, and the list of all integrators.
#pragma once
#include <array>
#include <cstddef>
#include <source_location>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue::integrator {

enum class Bias { unbiased, consistent, biased };
std::string_view bias_name(Bias bias);

// How an integrator delivers its samples.
enum class Accumulation {
  per_pixel,    // block by block; one pixel may have more samples than another
  per_image,    // block by block; all pixels have the same number of samples at a time
  with_splats,  // contributions to other pixels, besides the block's own
  splats_only   // contributions to any pixel, no blocks
};

// The families of integrators, as in [Lang, ch. 9].
enum class Group { gathering, shooting, bidirectional, markov_chain, two_pass };

struct GroupInfo {
  const char *name, *label, *doc;
};
inline constexpr std::array<GroupInfo, 5> kGroups{
    {{"gathering", "Gathering", "Paths from the camera"},
     {"shooting", "Shooting", "Paths from the lights, splatted to the image"},
     {"bidirectional", "Bidirectional", "Connected subpaths from the camera and the lights"},
     {"markov-chain", "Markov chain", "Mutations of paths, distributed in proportion to their contribution"},
     {"two-pass", "Two-pass",
      "Light is stored in the scene in a first pass and looked up from the camera in a second"}}};
inline const GroupInfo& info_of(Group group) { return kGroups[static_cast<size_t>(group)]; }

// The names of the parameters that select bidirectional techniques (s, t), s vertices from the light and t from the
// camera: two sets of techniques (bdpt/techniques.h), those excluded and those shown, and the switch of MIS weighting.
// Empty for integrators without techniques.
struct TechniqueParameters {
  std::string_view without, only, weighted;

  bool empty() const { return only.empty(); }
};

// How a rendering divides into parts that several processes compute. Merged parts have the bits of one run.
enum class DivisionUnit {
  samples,  // ranges of sample numbers, which are independent
  passes,   // the same; each sample, or each part, repeats a pass over the whole scene
  none      // samples depend on those before
};
std::string_view division_name(DivisionUnit unit);

struct Division {
  DivisionUnit unit = DivisionUnit::samples;
  bool regions = true;  // whether it divides into parts of the image as well
  std::string reason = "Every sample depends on its pixel and its number only.";  // sentences
};

struct IntegratorInfo {
  std::string name, label;
  std::string summary;  // one sentence
  Group group = Group::gathering;
  std::string paths;        // the sampled light paths, as a path expression
  std::string point_paths;  // those sampled for point, spot and directional lights; empty: none
  Bias bias = Bias::unbiased;
  std::string cost, limitations;
  Accumulation accumulation = Accumulation::per_pixel;
  Division division = {};
  char shortcut = 0;  // key that selects it in the viewer, '1' to '9'; 0: none
  TechniqueParameters techniques = {};
  bool scattering_media = false;     // renders participating media that scatter; scenes with such media need it
  bool heterogeneous_media = false;  // the same for media whose density varies
  bool emitting_media = false;       // the same for media that emit light
  bool starts_in_media = false;      // light paths start in media that emit light, which need an end
  bool subsurface = false;  // renders diffusion below surfaces, which is biased; scenes with such materials need it
  bool ignores_portals = false;   // no light sample is guided by the environment portals of a scene
  bool negative_samples = false;  // the estimate of a sample may be negative; its expectation is not
  std::string same_without_specular = {};  // the integrator with equal samples in scenes without specular surfaces
  bool spectral = false;          // renders with wavelengths instead of RGB; materials that disperse light need it
  std::vector<ParameterInfo> parameters = {};  // filled in by the registry
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

// A photon or a virtual light, for display.
struct StoredPoint {
  Vec3 position;
  Rgb power;  // lm
};

// A diagnostic number.
struct Statistic {
  std::string name;  // "accepted-large-steps"
  double value;
  std::string unit, doc;
};

const std::vector<IntegratorInfo>& integrator_infos();
const IntegratorInfo* find_integrator(std::string_view name);

// Whether any of the paths that an integrator samples is a path of another expression (one that
// PathExpression::parse_paths accepts, or empty: all paths). Paths that it does not sample are missing from its image.
bool finds_any(std::string_view sampled, std::string_view paths);

}  // namespace etendue::integrator
