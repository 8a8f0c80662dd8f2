// Where the energy of a view comes from: a table of path classes that partition all counted paths.
//
// Paths are sampled in the same way whichever classes are counted (transport/path_expression/class_shares.h). Small
// images of the classes of a partition, rendered with the same random numbers, therefore sum to the image of all paths,
// pixel by pixel and up to rounding. The table starts with the coarsest classes and repeatedly splits the class with
// the most energy. Classes that some integrator finds only in part are split along that boundary first.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "advisor/class_energy.h"
#include "bench/progress.h"
#include "render/document.h"
#include "transport/path_expression/path_classes.h"

namespace etendue::advisor {

struct ClassRow {
  std::string paths;  // a path expression, as accepted by --paths
  ClassEnergy energy;
  ClassEnergy from_points;  // the part from lights without extent (point, spot, directional)
  double share = 0;         // of the energy of all counted paths
};

struct ClassTable {
  std::string paths;  // the union of all rows; empty if all paths are counted
  render::MethodSettings reference;  // the method that measured the table; other paths do not appear in it
  int width = 0, height = 0;
  uint32_t samples = 0;
  ClassRow total;
  std::vector<ClassRow> rows;  // classes with energy, by decreasing energy
  // Classes in which no sample found energy: they carry none, too little, or are too hard to sample.
  std::vector<std::string> unseen;
  bool point_lights = false;  // the scene has lights without extent
  bool volumes = false;       // the scene has scattering media; without them, expressions match no V
  bool finished = false;      // no class is left to split within the limits
  double seconds = 0;         // the time the table took

  // Those of the rows.
  std::vector<double> shares() const;
};

struct TableOptions {
  // Images are reduced: both sides are divided by `divisor`, down to a shorter side of `min_side` pixels.
  int divisor = 8, min_side = 64;
  uint32_t samples = 16;  // per pixel, an even number
  size_t max_rows = 24;
  double min_share = 0.01;  // classes with a smaller share of the energy are not split
  double seconds = 0;       // time limit; 0 is none. The coarsest classes are always rendered
  transport::Naming naming = transport::Naming::runs;
  // Additional sets of paths along whose boundaries rows are split, besides those that integrators declare.
  std::vector<transport::Automaton> split_sets;
};

// The energy of all counted paths, with the options of a table; nothing if interrupted.
std::optional<ClassEnergy> total_energy(render::Session& session, const render::Document& document,
                                        const TableOptions& options, const bench::Progress& progress);

// Receives each refinement of the table.
using TablePublisher = std::function<void(const ClassTable&)>;

// The table of the document's image, measured with the reference integrator, for the paths the document counts. With
// `only`, restricted to these paths; the set must not be empty. Rendering takes place in `session`, which afterwards
// holds one of the small images. If `progress` returns false, the table is what has been measured so far.
ClassTable class_table(render::Session& session, const render::Document& document, const TableOptions& options,
                       const bench::Progress& progress, const TablePublisher& publish = {});
ClassTable class_table(render::Session& session, const render::Document& document, const transport::Automaton& only,
                       const TableOptions& options, const bench::Progress& progress,
                       const TablePublisher& publish = {});

}  // namespace etendue::advisor
