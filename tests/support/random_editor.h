// Random edits of a document with undo and redo, for tests. Derived classes choose the edits.
#pragma once
#include <random>
#include <utility>
#include <vector>

#include "render/document.h"
#include "scene/structural_edit.h"

namespace etendue::test {

class RandomEditor {
 public:
  RandomEditor(render::Document document, uint32_t seed) : document_(std::move(document)), random_(seed) {}

  const render::Document& document() const { return document_; }
  size_t undo_depth() const { return undo_.size(); }
  // How many edits were possible.
  size_t done() const { return done_; }

  void undo();
  void redo();

 protected:
  size_t below(size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random_); }
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

  // An edit that adds a light, a shape or a camera.
  scene::StructuralEdit adding(scene::EditKind kind);
  // An impossible edit, as of a removed node, changes nothing.
  void apply(const scene::StructuralEdit& edit);
  void step(render::Document changed);

 private:
  render::Document document_;
  std::vector<render::Document> undo_, redo_;
  std::mt19937 random_;
  size_t done_ = 0;
};

}  // namespace etendue::test
