// What integrators state about themselves, and the list of all of them.
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

// How samples come to the pixels.
enum class Accumulation {
  per_pixel,    // block by block; one pixel may have more samples than another
  per_image,    // block by block; all pixels have the same number of samples at a time
  with_splats,  // contributions to other pixels, besides the block's own
  splats_only   // contributions to any pixel, no blocks
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
struct TechniqueParameters {
  std::string_view without, only, weighted;

  bool empty() const { return only.empty(); }
};

struct IntegratorInfo {
  std::string name, label;
  std::string summary;  // one sentence
  Group group = Group::gathering;
  std::string paths;        // the light paths that it samples, as a path expression
  std::string point_paths;  // those of them that it samples for point, spot and directional lights; empty: none
  Bias bias = Bias::unbiased;
  std::string cost, limitations;
  Accumulation accumulation = Accumulation::per_pixel;
  char shortcut = 0;  // the key that selects it in the viewer, '1' to '9'; 0: none
  TechniqueParameters techniques = {};
  std::vector<ParameterInfo> parameters = {};  // filled in by the registry
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

// Something that a method keeps in space: a photon, a virtual light.
struct StoredPoint {
  Vec3 position;
  Rgb power;  // watts
};

// A number that a method knows about its own work.
struct Statistic {
  std::string name;  // "accepted-large-steps"
  double value;
  std::string unit, doc;
};

const std::vector<IntegratorInfo>& integrator_infos();
const IntegratorInfo* find_integrator(std::string_view name);

// Whether an integrator finds any of the paths that an expression (PathExpression::parse_paths takes it, or it is
// empty) stands for. What it does not find is missing from its image, or black.
bool finds_any(const IntegratorInfo& info, std::string_view paths);

}  // namespace etendue::integrator
