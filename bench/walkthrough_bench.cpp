// Frames per second of a walk through a radiosity solution: by casting rays, as the viewer does, and by rasterising the
// patches with OpenGL.
//
//   walkthrough_bench [SCENE [PATCHES [FRAMES]]]
//
// SCENE is a built-in scene (cornell) of diffuse surfaces, PATCHES the requested number of patches (20,000). Images have
// 1280 x 720 pixels, and the camera turns between frames. Three ways to make a frame are measured in turn:
//
//   rays, one sample     one ray per pixel in the whole resolution; the solution is kept
//   rays, first frame    the preview that the viewer shows until this sample is ready
//   rasterised           two-sided triangles with a colour per side, depth buffer, 1 sample per pixel
//
// Rays include the transfer of the frame to a texture; OpenGL has its result in one. The name of the OpenGL renderer says
// whether it is software. Solving the system is not part of a frame; its time comes first.
#include <EGL/egl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <thread>
#include <vector>

#include "camera/camera_ray.h"
#include "render/session.h"
#include "support/scenes.h"
#include "viewer/platform/platform.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;
using integrator::SolutionView;

constexpr int kWidth = 1280, kHeight = 720;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <class Function>
Function gl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

render::Document turned(render::Document d, int step) {
  const float angle = 0.3f * std::sin(0.2f * static_cast<float>(step));
  d.camera.to_world = d.camera.to_world * glm::rotate(Mat4(1), angle, Vec3(0, 1, 0));
  return d;
}

// Position, colour.
std::vector<float> triangles_of(const SolutionView& solution, bool front) {
  std::vector<float> data;
  for (const SolutionView::Patch& patch : solution.patches) {
    const Rgb color = (front ? patch.front : patch.back).radiosity / kPi;
    // Corners counterclockwise as seen from the side.
    const bool ccw = glm::dot(glm::cross(patch.corners[1] - patch.corners[0], patch.corners[2] - patch.corners[0]),
                              patch.normal) > 0;
    for (const size_t corner :
         {size_t{0}, ccw == front ? size_t{1} : size_t{2}, ccw == front ? size_t{2} : size_t{1}}) {
      const Vec3& p = patch.corners[corner];
      data.insert(data.end(), {p.x, p.y, p.z, color.r, color.g, color.b});
    }
  }
  return data;
}

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 color;
uniform mat4 transform;
out vec3 radiance;
void main() { radiance = color; gl_Position = transform * vec4(position, 1); })";
constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 radiance;
out vec4 color;
void main() { color = vec4(radiance, 1); })";

// Draws the triangles of a solution into a texture of half floats.
class Rasteriser {
 public:
  Rasteriser(const viewer::Gl& gl, const SolutionView& solution) : gl_(gl) {
    make_program();
    make_target();
    std::vector<float> data = triangles_of(solution, true);
    const std::vector<float> back = triangles_of(solution, false);
    data.insert(data.end(), back.begin(), back.end());
    vertices_ = static_cast<GLsizei>(data.size() / 6);
    make_buffer(data);
  }

  void draw(const Mat4& transform) const {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, kWidth, kHeight);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Enable(GL_CULL_FACE);
    gl_.ClearColor(0, 0, 0, 1);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.UseProgram(program_);
    gl_function<PFNGLUNIFORMMATRIX4FVPROC>("glUniformMatrix4fv")(gl_.GetUniformLocation(program_, "transform"), 1,
                                                                 GL_FALSE, &transform[0][0]);
    gl_.BindVertexArray(array_);
    gl_.DrawArrays(GL_TRIANGLES, 0, vertices_);
    gl_.Finish();
  }

  double mean() const {
    std::vector<float> pixels(static_cast<size_t>(kWidth * kHeight) * 3);
    gl_.ReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_FLOAT, pixels.data());
    double sum = 0;
    for (const float v : pixels) sum += double{v};
    return sum / static_cast<double>(pixels.size());
  }

 private:
  GLuint compiled(GLenum kind, const char* source) const {
    const GLuint shader = gl_.CreateShader(kind);
    gl_.ShaderSource(shader, 1, &source, nullptr);
    gl_.CompileShader(shader);
    return shader;
  }

  void make_program() {
    program_ = gl_.CreateProgram();
    gl_.AttachShader(program_, compiled(GL_VERTEX_SHADER, kVertexShader));
    gl_.AttachShader(program_, compiled(GL_FRAGMENT_SHADER, kFragmentShader));
    gl_.LinkProgram(program_);
  }

  void make_target() {
    GLuint textures[2];
    gl_.GenTextures(2, textures);
    gl_.BindTexture(GL_TEXTURE_2D, textures[0]);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, kWidth, kHeight, 0, GL_RGB, GL_FLOAT, nullptr);
    gl_.BindTexture(GL_TEXTURE_2D, textures[1]);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kWidth, kHeight, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[0], 0);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, textures[1], 0);
  }

  void make_buffer(const std::vector<float>& data) {
    gl_.GenVertexArrays(1, &array_);
    gl_.BindVertexArray(array_);
    GLuint buffer = 0;
    gl_function<PFNGLGENBUFFERSPROC>("glGenBuffers")(1, &buffer);
    gl_function<PFNGLBINDBUFFERPROC>("glBindBuffer")(GL_ARRAY_BUFFER, buffer);
    gl_function<PFNGLBUFFERDATAPROC>("glBufferData")(
        GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(), GL_STATIC_DRAW);
    for (const GLuint attribute : {0u, 1u}) {
      gl_function<PFNGLVERTEXATTRIBPOINTERPROC>("glVertexAttribPointer")(
          attribute, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float),
          reinterpret_cast<const void*>(attribute * 3 * sizeof(float)));
      gl_function<PFNGLENABLEVERTEXATTRIBARRAYPROC>("glEnableVertexAttribArray")(attribute);
    }
  }

  const viewer::Gl& gl_;
  GLuint program_ = 0, framebuffer_ = 0, array_ = 0;
  GLsizei vertices_ = 0;
};

Mat4 transform_of(const Camera& camera) {
  const float aspect = static_cast<float>(kWidth) / kHeight;
  return glm::perspective(camera.yfov, aspect, 0.01f, 100.0f) * glm::inverse(camera.to_world);
}

// A session that keeps the solution from frame to frame.
class RayCaster {
 public:
  RayCaster(const viewer::Gl& gl, const render::Document& document) : gl_(gl), session_({.interactive = true}) {
    const auto start = Clock::now();
    frame_at(document);
    std::printf("solved in %.1f s, with the first frame\n", milliseconds_since(start) * 1e-3);
    gl_.GenTextures(1, &texture_);
    gl_.BindTexture(GL_TEXTURE_2D, texture_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, kWidth, kHeight, 0, GL_RGB, GL_FLOAT, nullptr);
  }

  // Milliseconds until the sample of every pixel is in the texture.
  double frame_at(const render::Document& document) {
    const auto start = Clock::now();
    const uint64_t version = session_.submit(document);
    session_.finish();
    while (session_.frame()->version < version || !session_.status().finished)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    if (texture_) {
      gl_.BindTexture(GL_TEXTURE_2D, texture_);
      gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kWidth, kHeight, GL_RGB, GL_FLOAT, session_.frame()->pixels->data());
      gl_.Finish();
    }
    return milliseconds_since(start);
  }

  std::vector<double> first_frames() { return session_.take_latencies(); }
  std::shared_ptr<const SolutionView> solution() { return session_.solution_view(); }
  double mean() {
    double sum = 0;
    for (const Rgb& pixel : *session_.frame()->pixels) sum += double{pixel.r} + double{pixel.g} + double{pixel.b};
    return sum / (3.0 * kWidth * kHeight);
  }

 private:
  const viewer::Gl& gl_;
  render::Session session_;
  GLuint texture_ = 0;
};

void row(const char* what, std::vector<double> milliseconds) {
  std::ranges::sort(milliseconds);
  const size_t n = milliseconds.size();
  const double p50 = milliseconds[n / 2], p95 = milliseconds[n * 95 / 100];
  std::printf("%-20s %8.2f %8.2f %8.1f\n", what, p50, p95, 1000 / p50);
}

int measure(const std::string& scene, int patches, int frames) {
  auto document = render::new_document(scene);
  if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
  document->width = kWidth;
  document->height = kHeight;
  document->method.integrator = "radiosity";
  document->method.settings = {{"radiosity.patches", Value(patches)}};
  document->limits.samples = 1;
  const auto platform = viewer::make_offscreen(kWidth, kHeight);
  if (!platform) return std::fprintf(stderr, "%s\n", platform.error().message.c_str()), 2;
  const viewer::Gl& gl = (*platform)->gl();
  std::printf("OpenGL: %s\n", reinterpret_cast<const char*>(gl.GetString(GL_RENDERER)));

  RayCaster rays(gl, *document);
  const auto solution = rays.solution();
  const Rasteriser rasteriser(gl, *solution);
  rays.first_frames();
  std::vector<double> cast, drawn;
  for (int i = 0; i < frames; ++i) {
    const render::Document d = turned(*document, i + 1);
    cast.push_back(rays.frame_at(d));
    const auto start = Clock::now();
    rasteriser.draw(transform_of(d.camera));
    drawn.push_back(milliseconds_since(start));
  }
  std::printf("%-20s %8s %8s %8s\n", "milliseconds", "p50", "p95", "frames/s");
  row("rays, one sample", cast);
  row("rays, first frame", rays.first_frames());
  row("rasterised", drawn);

  // Rasterised patches do not emit.
  document->method.paths = "ED+L";
  rays.frame_at(*document);
  rasteriser.draw(transform_of(document->camera));
  std::printf("%zu patches; mean radiance of reflected light: rays %.5f, rasterised %.5f\n", solution->patches.size(),
              rays.mean(), rasteriser.mean());
  return 0;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  const std::string scene = argc > 1 ? argv[1] : "cornell";
  const int patches = argc > 2 ? std::atoi(argv[2]) : 20'000, frames = argc > 3 ? std::atoi(argv[3]) : 100;
  if (patches < 1 || frames < 1)
    return std::fprintf(stderr, "walkthrough_bench: give numbers above 0 of patches and frames\n"), 2;
  return etendue::measure(scene, patches, frames);
}
