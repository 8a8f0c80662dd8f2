// Where the energy of the view on the desk comes from, and what the method of the document finds of that.
//
// The table is of all paths, whichever of them are chosen to count, and by the trusted method: it belongs to the scene
// and the camera, and an edit of either leaves it standing as that of the view before.
#pragma once
#include <string>
#include <vector>

#include "advisor/missing_paths.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/progressive_task.h"

namespace etendue::viewer {

struct PathsTable {
  advisor::ClassTable table;
  std::vector<std::string> beyond_methods;  // what no method finds, as far as that can be told
};

// The table as one method sees it.
struct MethodView {
  enum class Finds : uint8_t { all, part, nothing };
  std::vector<Finds> rows;
  advisor::MissingPaths misses;
};

class PathsHand {
 public:
  PathsHand(const render::Session& session, const Editor& editor, int threads, const std::function<void()>& wake)
      : session_(session), editor_(editor), threads_(threads), study_(wake) {}

  // Of the document as it is.
  void measure();
  // A new document: its table is made when somebody looks.
  void forget() { study_.clear(), begun_ = false; }

  // Null until the first classes are there.
  const PathsTable* shown() const { return study_.shown().get(); }
  // Whether what is shown is of the view on the desk.
  bool fresh() const;
  bool running() const { return study_.running(); }
  bool has_news() const { return study_.has_news(); }
  // Once a frame; somebody may be looking. An edit of the view ends the work.
  void advance(bool looked_at);

  // Of what is shown, by the document's method.
  const MethodView& seen();

 private:
  const render::Session& session_;
  const Editor& editor_;
  const int threads_;
  bool begun_ = false;
  render::Document document_;  // that the table is of
  Study<PathsTable> study_;

  std::shared_ptr<const PathsTable> seen_table_;
  render::MethodSettings seen_method_;
  bool seen_hindered_ = false;
  MethodView seen_;
};

}  // namespace etendue::viewer
