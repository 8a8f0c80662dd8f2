// The path classes of a view that carry energy but are not found by a method.
//
// The result follows from the declaration of the integrator (a test verifies the declarations) and from the path class
// table. Light that no method finds does not appear in any table; it is inferred from the lights and materials of the
// scene.
#pragma once
#include <string>
#include <vector>

#include "advisor/class_table.h"
#include "advisor/declared_paths.h"
#include "scene/forward.h"

namespace etendue::advisor {

struct MissingPathClass {
  std::string paths;
  ClassEnergy energy;
  double share = 0;                // of the total energy
  bool from_point_lights = false;  // only the part from lights without extent is missing
  bool partial = false;            // only some of these paths are missing; the energy is an upper bound
};

struct MissingPaths {
  std::vector<MissingPathClass> classes;  // by decreasing share
  double share = 0;                       // of all missing classes in the total energy
  double rms = 0;                         // approximate contribution of the missing paths to the RMSE of an image
  bool uncertain = false;                 // some energies were found by few samples only

  bool none() const { return classes.empty(); }
};

MissingPaths missing_paths(const DeclaredPaths& declared, const ClassTable& table);

// The paths that the document's method misses, measured without a table of all paths. Nothing is rendered if the method
// declares to find all requested paths; `total` is then empty.
struct MeasuredMissingPaths {
  MissingPaths missing;
  ClassEnergy total;
  double relative_square = 0;  // approximate contribution to relMSE
  int width = 0;               // of the measured images; 0 if none was rendered
  bool finished = true;
};
MeasuredMissingPaths measure_missing_paths(render::Session& session, const render::Document& document,
                                           const TableOptions& options, const bench::Progress& progress);

// A predicate for messages: "misses 31 % of the light: EDD+L, EGD+L and 3 more", or "misses no path class with
// measurable energy".
std::string missing_paths_text(const MissingPaths& missing);

// One sentence for each kind of light transport that the scene may contain and no integrator finds, as far as its
// lights and materials reveal it.
std::vector<std::string> beyond_all_methods(const scene::CompiledScene& scene);

}  // namespace etendue::advisor
